"""Whether what a command answers is what it answered when it was recorded."""

import fnmatch
import math

TOLERANCE = 1e-12
"""Relative, of every number not named below.

It holds from a processor without fused multiplication or wide vectors to one with both.
"""

TOLERANCES = (
    (
        "*",
        "*step_error*",
        1e-4,
        "an estimate: the state on another step is closed by Newton to 1e-7 of it",
    ),
    (
        "block *",
        "block_*.vtu:friction_Pa",
        5e-6,
        "as of all of a block, below; at one instant it moved by 0.9e-6 between two processors "
        "and by 2.5e-6 where sums were added up in another order",
    ),
    (
        "block *",
        "*",
        1e-6,
        "an increment is iterated to 1e-9 of the load; whether the iteration that comes just below "
        "is the last is for the last bits of the processor to say, and moves the greatest "
        "pressure of a march by up to 2e-7",
    ),
    (
        "sweep *triangle*",
        "*",
        1e-6,
        "a march meets the corners of a triangle in the middle of a step; at one point that sticks "
        "and slips the last bits decide in which, and move the ratio by 2e-7",
    ),
    (
        "optimise gearset-3 --set rating.iso14521_edition=1998",
        "json.*pressure_angle_deg*",
        1.0,
        "the edition of 1998 knows no pressure angle: any is as good as any other",
    ),
    (
        "optimise *",
        "*trade_off.profile_shift*",
        1e-5,
        "as of all of an optimum, below; what 3e-7 move in the diameter factor is 4e-6 of x_2, the "
        "small difference that is left to it",
    ),
    (
        "optimise *",
        "*",
        1e-6,
        "near an optimum the efficiency is flat: it is found to half its digits, and the last bits "
        "move a design by up to 1e-7",
    ),
    *(
        ("thesis *", place, 1e-6, "exhibits of the optimised gearsets, found as above")
        for place in (
            "figure-3.4.nc:*",
            "figure-3.5.nc:*",
            "table-3.6.csv:*",
            "table-3.7.csv:*",
            "json.tables*",
        )
    ),
    (
        "rig reduce *",
        "*",
        1e-8,
        "sines and levels are fitted to noise, and linear algebra has its own kernels for each "
        "processor: 3e-10 between one with and one without AVX-512",
    ),
    (
        "export table-4.4 *",
        "law.csv:across *",
        1.0,
        "there is no force across: what stands there is rounding, 1e-11 of the force along",
    ),
    (
        "flank *",
        "*hertz_pressure_mean_MPa",
        1e-10,
        "a mean over lines that end where rounding has it: it moved by 5e-12 between one processor "
        "with and one without AVX-512",
    ),
    *(
        (
            "wear *",
            f"wear.nc:{name}_course",
            5e-4,
            "at one turn of four one patch more or less bears, by the same: 2e-4 of the area",
        )
        for name in ("area", "pressure")
    ),
    (
        "misalign *",
        "misalign.nc:pattern",
        1e-3,
        "at one phase one patch more or less bears, by the same: 5e-4 of the mean pressure",
    ),
    *(
        (
            line,
            "*",
            1e-4,
            "where patches bear, gaps of 1e-5 of the approach are left; between processors whose "
            "linear algebra adds up in another order the greatest line load moved by 6e-5",
        )
        for line in ("drive *--static *", "wear *", "roots *", "relief *", "misalign *")
    ),
    ("flank *", "*.glb:*", 1e-6, "vertices are written in single precision"),
    ("flank *", "*.stl:*", 1e-6, "vertices are written in single precision"),
)
"""(command lines, places, tolerance, why), as measured between two such processors."""

LEFT_OUT = {
    "seconds": "time it took",
    "condense_seconds": "time it took",
    "ms_per_increment": "time it took",
    "cached": "what an earlier run left",
    "condensed_from_cache": "what an earlier run left",
    "reused": "what an earlier run left",
    "file": "a folder of the test",
    "files": "a folder of the test",
    "index": "a folder of the test",
    "path": "a folder of the test",
    "picture": "a folder of the test",
    "dataset": "a folder of the test",
    "solver": "which libraries are installed",
    "notes": "words for people, which may become clearer",
    "note": "words for people, which may become clearer",
    "error": "words for people, which may become clearer",
    "settings": "numbers that stand beside as such, printed to the last digit",
    "how": "commands that give a figure, which may be said in another way",
}
"""Keys of JSON that are not compared, and why."""

# Where numbers are differences of such as cancel, what counts is the size of those.
_OF_FORMULAS = {"cases", "rate", "sensitivity", "methods", "optimise"}
_NATURAL = {"": 1.0, "1": 1.0, "rad": 1.0}
_UNITS = (
    ("_N_per_mm", "N/mm"),
    ("_m_per_N", "m/N"),
    ("_Pa_per_m", "Pa/m"),
    ("_mm_per_s", "mm/s"),
    ("_MPa", "MPa"),
    ("_rad", "rad"),
    ("_deg", "deg"),
    ("_mm", "mm"),
    ("_um", "um"),
    ("_Nm", "N m"),
    ("_N", "N"),
    ("_W", "W"),
    ("_s", "s"),
)


def differences(line, recorded, seen):
    """Say where two answers of a command line differ.

    Parameters
    ----------
    line : str
        The command line.
    recorded, seen : dict
        What :func:`observe.observe` saw, then and now.

    Returns
    -------
    list of str
        Place, what was recorded, what is seen.
    """
    command = line.split()[0]
    found = []

    def differ(place, before, now):
        found.append(f"{place}: {before!r} was recorded, now {now!r}")

    if recorded["code"] != seen["code"]:
        differ("code", recorded["code"], seen["code"])
    scales = {} if command in _OF_FORMULAS else _scales(recorded["json"])
    tolerances = [
        (place, tolerance)
        for lines, place, tolerance, _ in TOLERANCES
        if fnmatch.fnmatch(line, lines)
    ]

    def same(place, a, b, scale):
        fits = (tolerance for at, tolerance in tolerances if fnmatch.fnmatch(place, at))
        tolerance = next(fits, TOLERANCE)
        return a == b or math.isclose(a, b, rel_tol=tolerance, abs_tol=tolerance * scale)

    _compare_json("json", recorded["json"], seen["json"], scales, same, differ)
    # Views of solids are there where this machine can draw them. More files may be there than were,
    # and more in them.
    for name in sorted(name for name in recorded["files"] if "view-" not in name):
        if name not in seen["files"]:
            differ(name, "a file", "none")
            continue
        _compare_file(name, recorded["files"][name], seen["files"][name], same, differ)
    return found


def _compare_json(place, before, now, scales, same, differ, unit=""):
    if isinstance(before, dict) and isinstance(now, dict):
        for key in sorted({*before, *now} - {*LEFT_OUT}):
            here = f"{place}.{key}"
            if key not in before or key not in now:
                differ(here, before.get(key, "no such key"), now.get(key, "no such key"))
            else:
                _compare_json(here, before[key], now[key], scales, same, differ, _unit(key) or unit)
    elif isinstance(before, list) and isinstance(now, list) and len(before) == len(now):
        for n, pair in enumerate(zip(before, now, strict=True)):
            _compare_json(f"{place}[{n}]", *pair, scales, same, differ, unit)
    elif _is_number(before) and _is_number(now):
        if not same(place, before, now, scales.get(unit, 0.0)):
            differ(place, before, now)
    elif before != now or type(before) is not type(now):
        differ(place, before, now)


def _compare_file(name, before, now, same, differ):
    units = {n: v.get("units") for n, v in before.items()}
    scales = dict(_NATURAL)
    for n, variable in before.items():
        scales[units[n]] = max(scales.get(units[n], 0.0), _largest(variable["value"]))
    for n in sorted(before):
        place = f"{name}:{n}"
        if n not in now:
            differ(place, "a variable", "none")
            continue
        for about in ("units", "dims"):
            if before[n].get(about) != now[n].get(about):
                differ(f"{place}.{about}", before[n].get(about), now[n].get(about))
        scale = scales[units[n]] if units[n] is not None else _largest(before[n]["value"])
        then, today = before[n]["value"], now[n]["value"]
        if not _same_digest(place, then, today, scale, same):
            differ(place, then, today)


def _same_digest(place, before, now, scale, same):
    if not isinstance(before, dict) or before.keys() != now.keys():
        return before == now
    for key, then in before.items():
        each = (then, now[key]) if isinstance(then, list) else ([then], [now[key]])
        for a, b in zip(*each, strict=False):
            if not (same(place, a, b, scale) if _is_number(a) and _is_number(b) else a == b):
                return False
        if len(each[0]) != len(each[1]):
            return False
    return True


def _largest(value):
    if not isinstance(value, dict) or "samples" not in value:
        return 0.0
    return max([value.get("largest", 0.0), *(abs(n) for n in value["samples"] if n is not None)])


def _scales(answer):
    """The largest number of each unit in an answer."""
    scales = dict(_NATURAL)

    def look(value, unit):
        if isinstance(value, dict):
            for key, inner in value.items():
                look(inner, _unit(key) or unit)
        elif isinstance(value, list):
            for inner in value:
                look(inner, unit)
        elif _is_number(value) and unit:
            scales[unit] = max(scales.get(unit, 0.0), abs(value))

    look(answer, "")
    return scales


def _unit(key):
    return next((unit for ending, unit in _UNITS if key.endswith(ending)), "")


def _is_number(value):
    return isinstance(value, int | float) and not isinstance(value, bool)

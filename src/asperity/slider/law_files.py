"""The mean friction of a body as files that other programs take: CSV, MATLAB, C.

The law is that of `asperity.slider.cycle_mean_law`; all of it that another program needs is
written: the table, the cubics between its places, and what holds beyond its ends.
"""

import io
import textwrap
from collections.abc import Callable, Iterator, Sequence
from typing import Any

import numpy as np

from asperity.arrays import FloatArray
from asperity.errors import plain
from asperity.results.files import csv_text
from asperity.slider import cycle_mean_law as hl
from asperity.slider.cycle_mean_law import HomogenisedLaw
from asperity.slider.friction_map import FrictionMap

_COLUMNS = (
    ("friction", "N", hl.FORCE),
    ("highest", "N", hl.HIGHEST_X),
    ("lowest", "N", hl.LOWEST_X),
    ("across", "N", hl.FORCE_Y),
    ("across_highest", "N", hl.HIGHEST_Y),
    ("across_lowest", "N", hl.LOWEST_Y),
    ("power_of_vibration", "W", hl.POWER_IN),
    ("power_lost_to_friction", "W", hl.POWER_LOST),
    ("power_lost_in_damper", "W", hl.POWER_DAMPED),
    ("power_untransferred", "W", hl.UNTRANSFERRED),
)


def csv_files(laws: FrictionMap, about: Sequence[str]) -> dict[str, str]:
    """Return the table as CSV, by the name of its file; lines that begin with # say what it is."""
    key = [f"{laws.key} [{laws.unit}]" if laws.unit else laws.key] if laws.key else []
    rows: list[Sequence[object]] = [
        [*key, "velocity [m/s]", *(f"{name} [{unit}]" for name, unit, _ in _COLUMNS)]
    ]
    for value, law in zip(laws.values, laws.laws, strict=True):
        own = [float(value)] if laws.key else []
        table = np.column_stack([law.velocity, *_columns(law).values()])
        rows += ([*own, *row] for row in table.tolist())
    told = "".join(f"# {line}\n" for line in _told(laws, about))
    return {f"{_stem(laws)}.csv": told + csv_text(rows)}


def mat_files(laws: FrictionMap, about: Sequence[str]) -> dict[str, bytes]:
    """Return table and cubics as variables of MATLAB and Octave, by the name of the file.

    ``ppval(mkpp(breaks, coefs), v)`` is the friction in N within the table. A map has a cell of
    such structures in ``laws``, and what differs in ``value``.
    """
    from scipy.io import savemat

    written: dict[str, Any] = {"about": "\n".join(_told(laws, about))}
    if laws.key:
        # MATLAB's cell array, whatever the lengths of its members.
        cells = np.empty((len(laws.laws), 1), dtype=object)
        cells[:, 0] = [_variables(law) for law in laws.laws]
        written |= {"key": laws.key, "unit": laws.unit, "value": laws.values, "laws": cells}
    else:
        written |= _variables(laws.laws[0])
    file = io.BytesIO()
    savemat(file, written, oned_as="column")
    return {f"{_stem(laws)}.mat": file.getvalue()}


def c_files(laws: FrictionMap, about: Sequence[str]) -> dict[str, str]:
    """Return the law as C99 without dependencies, source and header, by their names."""
    stem = _stem(laws)
    told = "\n".join(f" * {line}".rstrip() for line in commented(_told(laws, about)))
    more = ", double value" if laws.key else ""
    of = f" and {laws.key}, {laws.unit or 'a ratio'}" if laws.key else ""
    guard = f"ASPERITY_{stem.upper()}_H"
    header = _HEADER.format(told=told, guard=guard, more=more, of=commented([of])[0])
    body = _MAP if laws.key else _CURVE
    source = "\n".join([_BEGIN.format(stem=stem, told=told), *_tables(laws), _FORCE + body])
    return {f"{stem}.c": source, f"{stem}.h": header}


WRITERS: dict[str, Callable[[FrictionMap, Sequence[str]], dict[str, Any]]] = {
    "c": c_files,
    "csv": csv_files,
    "mat": mat_files,
}


def _stem(laws: FrictionMap) -> str:
    return "map" if laws.key else "law"


def _columns(law: HomogenisedLaw) -> dict[str, FloatArray]:
    return {
        name: law.table[:, place] * (law.full_friction if unit == "N" else 1.0) + 0.0
        for name, unit, place in _COLUMNS
    }


def _variables(law: HomogenisedLaw) -> dict[str, Any]:
    breaks, cubics, viscous = law.arguments
    full = law.full_friction
    scalars = {"full_friction": full, "viscous": viscous * full}
    pieces = {"breaks": breaks[None, :], "coefs": full * cubics.T}
    return {"velocity": law.velocity, **_columns(law), **scalars, **pieces}


def _told(laws: FrictionMap, about: Sequence[str]) -> list[str]:
    full = sorted({law.full_friction for law in laws.laws})
    viscous = sorted({law.viscous * law.full_friction for law in laws.laws})
    notes = dict.fromkeys(note for law in laws.laws for note in (*law.notes, *law.remarks))
    said = [
        "Mean friction force, N, over a cycle of the vibration, at the mean velocity of the body, "
        "m/s, of either sign; for motions that are slow against the vibration.",
        "Between velocities: monotone cubics (PCHIP). Beyond the last: full friction, "
        f"{_range(full)} N, and viscous, {_range(viscous)} N s/m; what is missing of it falls as "
        "1/velocity^2.",
    ]
    if laws.key:
        said.append(
            f"Between values of {laws.key}, {_range(laws.values.tolist())} {laws.unit}: linear; "
            "beyond the first and the last their own law holds."
        )
    wrapped = [line for text in (*said, *notes) for line in textwrap.wrap(text, 96)]
    return [plain(line) for line in (*about, *wrapped)]


def _range(values: Sequence[float]) -> str:
    first, last = values[0], values[-1]
    return f"{first:.17g}" if first == last else f"{first:.17g} to {last:.17g}"


def commented(lines: Sequence[str]) -> list[str]:
    """Return lines that stand in a comment of C, whatever is in them."""
    # Neither the end of a comment nor a trigraph, which may stand for one.
    return [line.replace("*/", "* /").replace("/*", "/ *").replace("??", "? ?") for line in lines]


def _tables(laws: FrictionMap) -> Iterator[str]:
    for number, law in enumerate(laws.laws):
        breaks, cubics, _ = law.arguments
        yield f"static const double breaks_{number}[] = {{"
        yield from (f"    {value!r}," for value in breaks.tolist())
        yield f"}};\nstatic const double cubics_{number}[][4] = {{"
        yield from (f"    {{{', '.join(map(repr, row))}}}," for row in cubics.T.tolist())
        yield "};"
    yield f"#define LAWS {len(laws.laws)}\nstatic const struct law laws[LAWS] = {{"
    for number, (value, law) in enumerate(zip(laws.values.tolist(), laws.laws, strict=True)):
        pieces = law.velocity.size - 1
        numbers = f"{value!r}, {float(law.full_friction)!r}, {float(law.viscous)!r}, {pieces}"
        yield f"    {{{numbers}, breaks_{number}, cubics_{number}}},"
    yield "};"


_BEGIN = """\
/*
{told}
 */
#include "{stem}.h"

struct law {{
    double value;              /* of what differs between laws, SI */
    double full;               /* friction far above the velocities of the vibration, N */
    double viscous;            /* viscous friction over full, s/m */
    int pieces;
    const double *breaks;      /* velocities, m/s, one more than pieces */
    const double (*cubics)[4]; /* of a piece, over full, highest power first */
}};
"""

_FORCE = """
static double force(const struct law *law, double velocity, double *slope)
{
    const double *breaks = law->breaks;
    const double first = breaks[0], last = breaks[law->pieces];
    const double at = velocity < first ? first : velocity > last ? last : velocity;
    double value, rise = 0.0;
    int low = 0, high = law->pieces;
    while (high - low > 1) {
        const int middle = low + (high - low) / 2;
        if (breaks[middle] <= at)
            low = middle;
        else
            high = middle;
    }
    value = law->cubics[low][0];
    for (int i = 1; i < 4; i++) {
        rise = rise * (at - breaks[low]) + value;
        value = value * (at - breaks[low]) + law->cubics[low][i];
    }
    if (at < velocity || at > velocity) {
        const double full = velocity > 0.0 ? 1.0 : -1.0;
        const double gap = value - law->viscous * at - full;
        const double share = (at / velocity) * (at / velocity);
        value = full + law->viscous * velocity + gap * share;
        rise = law->viscous - 2.0 * gap * share / velocity;
    }
    *slope = law->full * rise;
    return law->full * value;
}
"""

_CURVE = """
double asperity_friction(double velocity)
{
    double slope;
    return force(&laws[0], velocity, &slope);
}

double asperity_friction_slope(double velocity)
{
    double slope;
    force(&laws[0], velocity, &slope);
    return slope;
}
"""

_MAP = """
static double between(double velocity, double value, double *slope)
{
    int low = 0;
    double share, lower, upper, steep;
    if (!(value > laws[0].value))
        return force(&laws[0], velocity, slope);
    if (value >= laws[LAWS - 1].value)
        return force(&laws[LAWS - 1], velocity, slope);
    while (laws[low + 1].value <= value)
        low++;
    share = (value - laws[low].value) / (laws[low + 1].value - laws[low].value);
    lower = force(&laws[low], velocity, slope);
    upper = force(&laws[low + 1], velocity, &steep);
    *slope = (1.0 - share) * *slope + share * steep;
    return (1.0 - share) * lower + share * upper;
}

double asperity_friction(double velocity, double value)
{
    double slope;
    return between(velocity, value, &slope);
}

double asperity_friction_slope(double velocity, double value)
{
    double slope;
    between(velocity, value, &slope);
    return slope;
}
"""

_HEADER = """\
/*
{told}
 */
#ifndef {guard}
#define {guard}

#ifdef __cplusplus
extern "C" {{
#endif

/* Mean friction force, N, against a mean velocity, m/s{of}; of finite numbers. */
double asperity_friction(double velocity{more});

/* Its slope over the velocity, N s/m. */
double asperity_friction_slope(double velocity{more});

#ifdef __cplusplus
}}
#endif

#endif
"""

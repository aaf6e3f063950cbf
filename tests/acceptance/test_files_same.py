"""JSON, netCDF, CSV, workbook and report of one result carry the same numbers, command by command.

The commands are those of ``--help``, each asked something by lot.
"""

import csv
import importlib.util
import json
import math
import random
from pathlib import Path

import numpy as np
import pytest
from apparatus import reports

from asperity.commands import COMMANDS
from asperity.results import read
from asperity.results.quantity import Entry, unit_suffix

HERE = Path(__file__).parent
TEETH = (
    'drive.deflection=[["22 N m", "50 urad"], ["366 N m", "365 urad"]]',
    "drive.effective_radius=9.8 mm", "drive.tangential_compliance=2.9 nm/N",
)  # fmt: skip
BLOCK = (
    "block.elements=[2, 2, 2]", "block.element=hex8", "vibration.start=1 ms", "solve.step=4 us",
    "solve.duration=2 ms",
)  # fmt: skip
KEYED = {
    "rate",
    "shafts",
    "flank",
    "drive",
    "roots",
    "wear",
    "slide",
    "static",
}
"""Those in whose reports each number says where in JSON it stands."""
ANSWERS = HERE.parent / "answers"


def helper(path):
    """Load a file of tests for what it has to read files with."""
    spec = importlib.util.spec_from_file_location(path.stem, path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def asked(name, lot):
    """Return the words of a command by lot."""
    ratio, torque = f"{lot.uniform(0.3, 12.0):.4g}", f"{lot.uniform(100.0, 400.0):.4g} N m"
    speed = f"{lot.uniform(200.0, 3000.0):.4g} rpm"
    shaken = f"vibration.velocity_ratio={ratio}"
    gear = f"operation.output_torque={torque}", f"operation.worm_speed={speed}"
    periodic = "solve.method=periodic"
    law = (
        "vibration.frequency=4 kHz", shaken, "friction.model=dahl", "friction.mu=0.1",
        "friction.max_deflection=68.75 nm",
    )  # fmt: skip
    shake = "vibration.frequency=20 kHz", f"vibration.displacement_amplitude={ratio} um"
    words = {
        "slide": (
            ["table-4.3"],
            [periodic, shaken, f"vibration.direction={lot.uniform(0.0, 180.0):.4g} deg"],
        ),
        "static": (
            ["table-4.3"],
            ["friction.model=coulomb", f"vibration.displacement_amplitude={lot.uniform(0, 2)} nm"],
        ),
        "block": (["block-longitudinal"], [*BLOCK, shaken]),
        "sweep": (["table-4.3", "--over", f"vibration.velocity_ratio=1,{ratio}"], [periodic]),
        "branches": (["normal-pin", "--over", "vibration.velocity_ratio=2,3,4"], []),
        "rate": (["gearset-3"], [*gear]),
        "shafts": (["actuator-shafts"], [f"worm_shaft.peak={lot.uniform(1.0, 3.0):.4g}"]),
        "sensitivity": (["gearset-3"], [*gear]),
        "methods": (["gearset-3"], [*gear, *law]),
        "optimise": (["gearset-3"], []),
        "flank": (["gearset-3b", "--density", "coarse"], []),
        "crossed": (["gearset-3"], gear),
        "drive": (["drive-screw"], [*TEETH, *shake]),
        "directions": (["drive-screw"], [*TEETH, *shake]),
        "misalign": (
            ["drive-screw", "--over", f"mount.axial_offset=0,{lot.uniform(5.0, 50.0):.4g} um"],
            ["drive.teeth=1", "drive.phases=2"],
        ),
        "relief": (
            ["drive-screw", "--over", f"modification.tip_relief=0,{lot.uniform(5.0, 30.0):.4g} um"],
            ["drive.teeth=1", "drive.phases=2"],
        ),
        "roots": (["drive-screw"], ["drive.teeth=1", "drive.phases=2"]),
        "wear": (["drive-screw", "--revolutions", "20"], ["drive.teeth=1", "drive.phases=2"]),
        "locking": (["drive-actuator"], [*TEETH]),
        "control": (["drive-actuator"], [*TEETH, "drive.stroke=16 deg", "control.failures=dead"]),
        "fit": ([ANSWERS / "ratios.csv", "table-4.3", "--free", "friction.max_deflection"], []),
        "rig plan": (["rig-final"], [f"plan.repeats={lot.randint(1, 4)}"]),
        "rig check": ([ANSWERS / "rig.nc"], []),
        "rig reduce": ([ANSWERS / "rig.nc"], []),
    }  # fmt: skip
    given, settings = words[name]
    return [*name.split(), *map(str, given), *(f"--set={each}" for each in settings)]


# They write recordings or a page of a folder's, of which `rig reduce` has the numbers, or take
# minutes: tests of their own.
ELSEWHERE = {
    *(
        "rig run",
        "rig look",
        "rig import",
        "rig report",
        "rig package",
        "optimise",
        "rexs",
    ),
}
QUICK = ("sweep", "rig plan")
# Of those that print what stands in arrays.
ARRAYS = {"sweep": 2, "branches": 9, "fit": 1}


def number(value):
    return isinstance(value, int | float) and not isinstance(value, bool)


def check_netcdf(path, printed):
    """Hold the numbers of a netCDF file, and the JSON kept in it, to what was printed."""
    saved = read(path)
    assert saved.to_json() == printed
    count = 0
    declared: list[Entry] = list(saved.of.declared())
    for entry in declared:
        if not (entry.in_json and entry.in_file) or entry.variable not in saved.dataset.variables:
            continue
        told, kept = printed.get(entry.key), saved.dataset[entry.variable].to_numpy()
        if kept.ndim or kept.dtype.kind not in "fiub":
            continue  # see `check_arrays`
        if told is None:
            assert not np.isfinite(kept), entry.key
        else:
            assert float(kept) == float(told), entry.key
        count += 1
    return count


def check_arrays(path, printed):
    """Hold each array of a netCDF file to the list of its name that was printed, if one was."""
    saved = read(path).dataset
    named = {name: name for name in saved.variables}
    # A name that tells the unit is printed in that; an axis as it was asked for.
    named |= {n + unit_suffix(v.attrs.get("units", "")): n for n, v in saved.variables.items()}
    count = 0
    for name, told in {**printed, **printed.get("coords", {})}.items():
        if name not in named or not isinstance(told, list) or printed.get("units", {}).get(name):
            continue
        kept = saved[named[name]].to_numpy()
        of_rows = any(isinstance(row, dict) for row in told)
        if not kept.ndim or kept.dtype.kind not in "fiub" or of_rows:
            continue
        # Nothing is no number.
        np.testing.assert_array_equal(kept.astype(float), np.array(told, dtype=float), name)
        count += 1
    return count


def check_csv(path, printed):
    """Hold the rows of a table of a rating, by standard and key, to what was printed."""
    with path.open(newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert rows
    for row in rows:
        told = printed[row["standard"]][row["key"]]
        if number(told):
            assert float(row["value"]) == told, row
    return {(row["standard"], row["meaning"]): row["value"] for row in rows}


def check_workbook(path, table):
    """Hold the values that a workbook shows to those of the table."""
    sheets = helper(HERE.parent / "unit" / "test_workbook.py").Workbook(path)
    count = 0
    for standard in sorted({standard for standard, _ in table}):
        for _, cells in sheets.rows(standard):
            shown = getattr(cells[1], "value", cells[1])
            if number(shown) and (kept := table.get((standard, cells[3]))):
                assert math.isclose(shown, float(kept), rel_tol=1e-12), cells
                count += 1
    assert count > 50


def by_lot():
    """Each command three times; a wheel's flanks, which take half a minute, once."""
    for each in COMMANDS:
        if each.name in ELSEWHERE:
            continue
        for seed in range(1 if each.name == "flank" else 3):
            ordinary = each.name in QUICK and seed == 0
            marks = () if ordinary else (pytest.mark.slow, pytest.mark.campaign)
            yield pytest.param(each.name, seed, marks=marks)


@pytest.mark.parametrize(("name", "seed"), [*by_lot()])
def test_every_file_of_an_answer_has_the_numbers_that_are_printed(asperity, tmp_path, name, seed):
    words = asked(name, random.Random(f"{name} {seed}"))
    code, output, errors = asperity(*words, "--json", "--out", tmp_path / "out")
    assert code == 0, errors
    printed = json.loads(output)
    folder = tmp_path / "out"
    (written,) = (path for path in folder.glob("*.json") if path.with_suffix(".nc").exists())
    assert json.loads(written.read_text("utf-8")) == printed
    count = check_netcdf(written.with_suffix(".nc"), printed)
    arrays = check_arrays(written.with_suffix(".nc"), printed)
    assert arrays >= ARRAYS.get(name, 0)
    assert count > 3 or name not in ("slide", "static", "block", "drive")
    if (folder / "rate.csv").exists():
        check_workbook(folder / "rate.xlsx", check_csv(folder / "rate.csv", printed))
    if (report := folder / "report.html").exists():
        page = reports.Page(report.read_text("utf-8"))
        if name in KEYED:
            assert page.numbers
            reports.check_numbers(page, printed)
        else:
            page.numbers, all_of_it = [n for n in page.numbers if n[1] is not None], page.numbers
            reports.check_numbers(page, printed)
            page.numbers = all_of_it
            reports.check_told(page, printed)


def test_every_command_is_asked_or_has_tests_of_its_own():
    names = {each.name for each in COMMANDS}
    assert names >= ELSEWHERE
    for name in names - ELSEWHERE:
        assert asked(name, random.Random(name))[0] == name.split()[0]

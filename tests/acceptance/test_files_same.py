"""JSON, netCDF, CSV, workbook and report of one result carry the same numbers, command by command.

The commands are those of ``--help``, each asked something by lot.
"""

import csv
import importlib.util
import json
import math
import random
import re
from pathlib import Path
from xml.etree import ElementTree

import h5py
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
        "rig look": ([ANSWERS / "wave.csv", "--columns", "time,torque", "--units", "s,V"], []),
        "rig check": ([ANSWERS / "rig.nc"], []),
        "rig report": ([ANSWERS], []),
        "rig reduce": ([ANSWERS / "rig.nc"], []),
    }  # fmt: skip
    given, settings = words[name]
    return [*name.split(), *map(str, given), *(f"--set={each}" for each in settings)]


# They write no answer beside its netCDF file, or (`rig run`, its package) take long: see below,
# `test_cli_rig_run.py` and `test_rig_package.py`.
ELSEWHERE = {"rig run", "rig import", "rig package", "rexs"}
QUICK = ("sweep", "rig plan")
# Of those that print what stands in arrays.
ARRAYS = {"sweep": 2, "branches": 9, "fit": 1}


def number(value):
    return isinstance(value, int | float) and not isinstance(value, bool)


def cells(path):
    """Return the numbers of a table; the report of a folder has budgets, which JSON leaves out."""
    with path.open(newline="", encoding="utf-8") as file:
        texts = [text for row in csv.reader(file) for text in row]
    return [float(text) for text in texts if re.fullmatch(r"-?\d[\d.]*(e[-+]\d+)?", text)]


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


def check_segments(folder, printed):
    """Hold the rows of a table of segments, and their arrays, to what was printed."""
    path, saved = folder / "reduce.csv", read(folder / "reduce.nc").dataset
    with path.open(newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    count = 0
    for row, told in zip(rows, printed["segments"], strict=True):
        for key, value in told.items():
            if number(value) and row.get(key):
                assert float(row[key]) == value, key
                count += 1
    assert count > 8
    units = {
        name: unit_suffix(kept.attrs.get("units", "")) for name, kept in saved.variables.items()
    }
    held = 0
    for name, unit in units.items():
        told = [one.get(f"{name}{unit}") for one in printed["segments"]]
        if all(map(number, told)):
            assert saved[name].to_numpy().tolist() == told, name
            held += 1
    assert held > 8


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
    kept = json.loads(written.read_text("utf-8"))
    if name == "rig report":
        # Beside the reduction that is written it prints what of the plan is there.
        assert len(kept) > 8
        printed = {key: printed[key] for key in kept}
    assert kept == printed
    count = check_netcdf(written.with_suffix(".nc"), printed)
    arrays = check_arrays(written.with_suffix(".nc"), printed)
    assert arrays >= ARRAYS.get(name, 0)
    assert count > 3 or name not in ("slide", "static", "block", "drive")
    if (folder / "rate.csv").exists():
        check_workbook(folder / "rate.xlsx", check_csv(folder / "rate.csv", printed))
    if (folder / "reduce.csv").exists():
        check_segments(folder, printed)
    if (report := folder / "report.html").exists():
        page = reports.Page(report.read_text("utf-8"))
        if name in KEYED:
            assert page.numbers
            reports.check_numbers(page, printed)
        else:
            page.numbers, all_of_it = [n for n in page.numbers if n[1] is not None], page.numbers
            reports.check_numbers(page, printed)
            page.numbers = all_of_it
            budgets = [*folder.glob("budget.csv")]
            reports.check_told(page, printed | {"budget": [*map(cells, budgets)]})


def test_a_recording_that_is_imported_is_what_is_printed_and_what_came_in(asperity, tmp_path):
    given, made = ANSWERS / "rig.nc", tmp_path / "run.nc"
    code, output, errors = asperity("rig", "import", given, "rig-final", "--out", made, "--json")
    assert code == 0, errors
    printed = json.loads(output)
    with h5py.File(given) as before, h5py.File(made) as after:
        assert after["raw"].shape == (printed["samples"], len(printed["channels"]))
        assert after.attrs["sample_interval"][0] == printed["sample_interval_s"]
        assert after.attrs["start"] == printed["start"]
        for n, channel in enumerate(printed["channels"]):
            assert after["signal"][n].decode() == channel["signal"]
            assert after["units"][n].decode() == channel["units"]
            assert after["scale"][n] == channel["scale"]
        columns = {name: n for n, name in enumerate(before["signal"][:])}
        for n, name in enumerate(after["signal"][:]):
            values = (
                f["offset"][i] + f["scale"][i] * f["raw"][:, i]
                for f, i in ((before, columns[name]), (after, n))
            )
            # To half a count of what it is kept in.
            np.testing.assert_allclose(*values, rtol=0, atol=0.51 * after["scale"][n])


OF_REXS = {
    "number_of_teeth": ("starts", "wheel_teeth"),
    "center_distance": ("centre_distance_mm",),
    "axial_module": ("axial_module_mm",),
    "lead_angle_worm_gear": ("lead_angle_deg",),
    "pressure_angle_worm_gear": ("pressure_angle_deg",),
    "addendum_modification_coefficient_worm_wheel": ("profile_shift",),
    "reference_diameter_worm_gear": ("worm_pitch_diameter_mm", "wheel_reference_diameter_mm"),
    "root_diameter_worm_gear": ("worm_root_diameter_mm", "wheel_root_diameter_mm"),
    "face_width_worm_wheel": ("wheel_face_width_mm",),
    "length_worm_gear": ("worm_face_width_mm",),
    "force_acting_on_shaft_u": ("worm_axial_N", "wheel_axial_N"),
    "force_acting_on_shaft_v": ("worm_radial_N", "wheel_tangential_N"),
    "force_acting_on_shaft_w": ("worm_tangential_N", "wheel_radial_N"),
}


def test_a_rexs_file_has_as_many_parts_as_are_printed_and_the_gearset_s_numbers(asperity, tmp_path):
    file = tmp_path / "gearset.rexs"
    code, output, errors = asperity("rexs", "gearset-3", "--out", file, "--json")
    assert code == 0, errors
    printed, model = json.loads(output), ElementTree.parse(file).getroot()
    counts = {"components": "component", "attributes": "attribute", "relations": "relation"}
    assert {key: len(model.findall(f".//{tag}")) for key, tag in counts.items()} == {
        key: printed[key] for key in counts
    }
    assert model.get("version") == printed["rexs"]
    rated = json.loads(asperity("rate", "gearset-3", "--json")[1])
    forces = rated["forces"]["clockwise"]
    for attribute, keys in OF_REXS.items():
        kept = {float(one.text) for one in model.iter("attribute") if one.get("id") == attribute}
        told = {abs({**rated["geometry"], **forces}[key]) for key in keys}
        # The hob stands in it as well.
        assert told <= {*map(abs, kept)}, attribute


def test_every_command_is_asked_or_has_tests_of_its_own():
    names = {each.name for each in COMMANDS}
    assert names >= ELSEWHERE
    for name in names - ELSEWHERE:
        assert asked(name, random.Random(name))[0] == name.split()[0]

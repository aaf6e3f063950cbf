"""`asperity flank` as a user runs it: numbers, files, and what is refused."""

import csv
import gc
import json
import math
import re
import sys
from pathlib import Path

import pytest

from asperity.casefile.schema import keys_of
from asperity.cli.main import main
from asperity.errors import ConvergenceError
from asperity.files.store import read_dataset
from asperity.flanks.parameters import Disc, Hob, MeasuringOptions, Modification, Mount
from asperity.gearset.blanks import Blanks
from asperity.units import quantity_of, to_si

PAGE = (Path(__file__).parents[2] / "docs" / "flanks.rst").read_text("utf-8")

OF_A_FLANK = {
    "transmission_error_rad",
    "transmission_error_mean_rad",
    "ease_off_max_um",
    "ease_off_min_um",
    "pattern_area_fraction",
    "pattern_centre_mm",
    "undercut",
    "conjugacy_residual_mm",
    "contact_ratio",
    "vibration",
    "loaded",
}
OF_THE_GEARSET = {
    "lead_angle_deg",
    "base_radius_mm",
    "base_lead_angle_deg",
    "backlash_normal_mm",
    "axial_clearance_mm",
    "seconds",
}
BACKLASH = ("--set", "mount.backlash=0.05 mm")
PICTURES = ("pattern", "ease-off", "contact-lines", "transmission-error", "vibration")


def one_object(output):
    assert output.count("\n") == 1
    return json.loads(output)


@pytest.fixture(scope="module")
def nominal(asperity):
    code, output, errors = asperity("flank", "gearset-3b", "--json", *BACKLASH)
    assert (code, errors) == (0, "")
    return one_object(output)


@pytest.mark.slow
def test_json_has_every_number_for_one_flank_and_for_both(nominal):
    assert nominal.keys() >= OF_A_FLANK | OF_THE_GEARSET | {"mesh", "flanks", "notes"}
    assert nominal["flanks"].keys() == {"+1", "-1"}
    for found in nominal["flanks"].values():
        assert found.keys() >= OF_A_FLANK
    assert {key: nominal[key] for key in OF_A_FLANK} == {
        key: nominal["flanks"]["+1"][key] for key in OF_A_FLANK
    }
    assert nominal["mesh"].keys() >= {"nodes", "elements", "scaled_jacobian_min"}


@pytest.mark.slow
def test_the_numbers_are_those_of_the_gearset_and_its_oversized_tilted_hob(nominal):
    assert nominal["lead_angle_deg"] == pytest.approx(25.463, abs=1e-3)
    assert nominal["base_radius_mm"] == pytest.approx(6.9041, abs=1e-4)
    assert nominal["base_lead_angle_deg"] == pytest.approx(31.961, abs=1e-3)
    assert nominal["ease_off_max_um"] == pytest.approx(156.0, abs=1.0)
    assert nominal["ease_off_min_um"] == pytest.approx(-8.4, abs=0.1)
    assert nominal["pattern_area_fraction"] == pytest.approx(0.19, abs=0.005)
    assert nominal["pattern_centre_mm"] == pytest.approx([1.66, 0.02], abs=0.05)
    assert nominal["transmission_error_rad"] < 1e-12
    assert nominal["conjugacy_residual_mm"] < 1e-12
    assert nominal["undercut"] is False
    assert nominal["mesh"]["scaled_jacobian_min"] > 0.4


def test_both_flanks_are_alike_turned_about_the_middle_of_the_tooth(nominal):
    plus, minus = nominal["flanks"]["+1"], nominal["flanks"]["-1"]
    assert minus["ease_off_max_um"] == pytest.approx(plus["ease_off_max_um"], abs=1e-9)
    assert minus["pattern_centre_mm"][0] == pytest.approx(-plus["pattern_centre_mm"][0], abs=2e-3)
    assert minus["pattern_area_fraction"] == pytest.approx(plus["pattern_area_fraction"], rel=5e-3)


def test_the_backlash_is_the_one_asked_for_and_leaves_the_worm_room_along_its_axis(nominal):
    assert nominal["backlash_normal_mm"] == pytest.approx(0.05, abs=1e-9)
    # Normal play over the axial one is near the cosine of lead and pressure angle.
    normal = math.cos(math.radians(nominal["lead_angle_deg"])) * math.cos(math.radians(20.0))
    assert nominal["axial_clearance_mm"] == pytest.approx(0.05 / normal, rel=0.02)


@pytest.mark.slow
def test_a_left_hand_is_the_mirror_image(asperity, nominal):
    code, output, _ = asperity(
        "flank", "gearset-3b", "--json", *BACKLASH, "--set", "gearset.hand=left"
    )
    left = one_object(output)
    assert code == 0
    assert left["pattern_centre_mm"][0] == pytest.approx(-nominal["pattern_centre_mm"][0])
    for key in ("pattern_area_fraction", "ease_off_max_um", "axial_clearance_mm"):
        assert left[key] == pytest.approx(nominal[key], rel=1e-9)


@pytest.mark.slow
def test_without_a_tilt_the_pattern_lies_near_the_edge_of_the_face(asperity, nominal):
    code, output, _ = asperity("flank", "gearset-3b", "--json", "--set", "hob.tilt=0 deg")
    assert code == 0
    answer = one_object(output)
    assert answer["pattern_centre_mm"][0] == pytest.approx(4.8, abs=0.2)
    # As it comes, worm and wheel would cut into each other: said, and not hidden.
    assert answer["backlash_normal_mm"] < 0.0
    assert "give mount.backlash" in answer["notes"][0]


@pytest.mark.slow
def test_what_to_measure_is_told_with_limits_and_what_is_assumed(nominal):
    found = nominal["measuring"]
    assert found["pin_diameter_mm"] == 3.5
    assert found["over_pins_upper_mm"] == pytest.approx(23.154, abs=5e-4)
    assert found["over_pins_lower_mm"] < found["over_pins_upper_mm"]
    assert found["over_balls_lower_mm"] < found["over_balls_upper_mm"]
    assert found["backlash_normal_min_mm"] == nominal["backlash_normal_mm"]
    assert found["assumed"].keys() == MeasuringOptions.model_fields.keys()
    assert "DIN 3967" in found["from_memory"]["tolerance of the tooth thickness"]
    parts = [line["part"] for line in found["drawing"]]
    assert list(dict.fromkeys(parts)) == ["worm", "wheel", "both"]
    assert nominal["blank"]["bore_mm"] == 29.0
    assert "bore" in nominal["blank"]["assumed"]


@pytest.mark.slow
def test_a_reader_is_told_what_was_assumed_and_what_is_from_memory(asperity):
    code, output, _ = asperity(
        "flank", "gearset-3b", "--json",
        *("--set", "gearset.flank=ZC"), *("--set", "gearset.centre_distance=73.66 mm"),
    )  # fmt: skip
    assert code == 0
    answer = one_object(output)
    assert answer["base_radius_mm"] is None
    assert {"disc.diameter", "disc.profile_radius"} <= answer["assumed"].keys()
    assert {"disc.diameter", "disc.profile_radius"} <= answer["from_memory"].keys()
    assert answer["conjugacy_residual_mm"] < 1e-10


@pytest.mark.slow
def test_tables_for_people_have_values_with_units_and_notes(asperity):
    code, output, errors = asperity("flank", "gearset-3b")
    assert (code, errors) == (0, "")
    assert re.search(r"^base radius +r_b +6\.9041 +mm$", output, re.MULTILINE)
    assert re.search(r"^ease-off, greatest +156\.\d+ +156\.\d+ +um$", output, re.MULTILINE)
    assert re.search(r"^nodes +\d{4,}$", output, re.MULTILINE)
    assert re.search(r"^Hertzian pressure, greatest +\d+.* MPa$", output, re.MULTILINE)
    assert "- measuring pins and balls: DIN 3977:1981, table 1 (one source; " in output
    assert all(len(line) <= 100 for line in output.splitlines())


@pytest.fixture
def without(monkeypatch):
    """Hide a package that is installed, and what of it another test has loaded."""

    def hide(package):
        # What a test before has drawn with it asks for it once more when it goes.
        gc.collect()
        loaded = [name for name in sys.modules if name.startswith(f"{package}.")]
        for name in (package, *loaded):
            monkeypatch.setitem(sys.modules, name, None)

    return hide


@pytest.fixture(params=[False, pytest.param(True, marks=pytest.mark.slow)], ids=["flat", "space"])
def in_space(request):
    """Whether there are views in space and STEP files, which take a while."""
    return request.param


@pytest.mark.slow
@pytest.mark.campaign
def test_files_hold_the_same_numbers_and_every_picture(asperity, without, tmp_path, in_space):
    folder = tmp_path / "new" / "out"
    step = ("--step",) if in_space else ()
    if not in_space:
        without("pyvista")
    code, output, errors = asperity(
        "flank", "gearset-3b", "--json", *step, "--density", "coarse", "--out", folder
    )
    assert code == 0
    *notes, errors = errors.splitlines()
    if in_space:
        assert not notes
        for name in ("gearset", "tooth-mesh"):
            assert (folder / f"view-{name}.png").read_bytes().startswith(b"\x89PNG")
    else:
        assert len(notes) == 1
        assert "pip install asperity[view]" in notes[0]
    answer = one_object(output)
    names = errors.strip().removeprefix(f"written to {folder}: ").split(", ")
    assert {path.name for path in folder.iterdir()} == set(names)
    assert json.loads((folder / "flank.json").read_text()) == answer
    found = read_dataset(folder / "flank.nc")
    assert 1e3 * float(found.ease_off.max()) == pytest.approx(answer["ease_off_max_um"])
    assert found.ease_off.attrs["units"] == "mm"
    assert found.side.values.tolist() == [1, -1]
    assert found.vibration.sizes["part"] == 3
    for name in PICTURES:
        assert (folder / f"{name}.png").read_bytes().startswith(b"\x89PNG")
    assert (folder / "tooth.vtu").read_bytes().startswith(b"<?xml")
    assert "*SURFACE, TYPE=ELEMENT, NAME=flank_plus" in (folder / "tooth.inp").read_text()
    for name in ("tooth.stl", "worm.stl"):
        assert (folder / name).stat().st_size > 10_000
    assert (folder / "gearset.glb").read_bytes().startswith(b"glTF")
    with (folder / "drawing.csv").open(newline="", encoding="utf-8") as file:
        drawing = {(row["part"], row["symbol"]): row for row in csv.DictReader(file)}
    over = drawing["worm", "M_dR1,s"]
    assert float(over["value"]) == answer["measuring"]["over_pins_upper_mm"]
    assert over["on the drawing"] == f"{float(over['value']):.3f}"
    assert drawing["both", "a"]["value"] == "73.66"
    for name in ("tooth.step", "worm.step", "wheel.step", "gearset.step") if in_space else ():
        assert (folder / name).read_text().startswith("ISO-10303-21;")


@pytest.mark.parametrize(
    ("arguments", "line"),
    [
        (("--density", "cors"), "--density is 'cors'; it must be one of 'coarse', "),
        (("--density", "cors"), "(did you mean 'coarse'?)"),
        (("--density", "0.5"), "such as '0.5 mm'"),
        (("--density", "0 mm"), "an element size must be positive"),
        (("--density", "1 um"), "at most 2 GiB is allowed"),
        pytest.param(
            ("--step",),
            "--step: there is no folder for the files; name one with --out DIR",
            marks=pytest.mark.slow,
        ),
        (("--set", "hob.tlt=2 deg"), "did you mean 'tilt'?"),
        (("--set", "hob.oversize=0.5"), "hob.oversize is 0.5; it must be at least 1"),
        pytest.param(
            ("--set", "mount.backlash=5 mm"),
            "the worm's threads would be pointed",
            marks=pytest.mark.slow,
        ),
        (("--set", "gearset.pressure_angle=30 deg"), "the hob's thread is pointed"),
        (("--set", "gearset.wheel_face_width=40 mm"), "gearset.wheel_face_width of at most"),
        (("--set", "gearset.starts=0"), "gearset.starts is 0"),
        pytest.param(
            ("--set", "measuring.pin_diameter=9 mm"),
            "rest on the worm's flanks and stand out of",
            marks=pytest.mark.slow,
        ),
        pytest.param(
            ("--set", "measuring.ball_diameter=9 mm"),
            "take one nearer to 3.66 mm",
            marks=pytest.mark.slow,
        ),
        (("--set", "blank.bore=200 mm"), "blank.bore is 200 mm; the inside of the rim has"),
        (("--set", "blank.shaft_diameter=14 mm"), "the worm's root diameter is 13.84 mm"),
    ],
)
def test_mistakes_are_one_line_and_exit_2(asperity, tmp_path, arguments, line):
    folder = () if "--step" in arguments else ("--out", tmp_path / "out")
    code, output, errors = asperity("flank", "gearset-3b", "--json", *arguments, *folder)
    assert (code, output) == (2, "")
    assert errors.count("\n") == 1
    assert line in errors
    assert errors.startswith(("--", "gearset-3b: "))


def test_what_is_refused_leaves_no_folder(asperity, tmp_path):
    asperity("flank", "gearset-3b", "--density", "1 um", "--out", tmp_path / "out")
    assert not (tmp_path / "out").exists()


def test_case_without_a_gearset_is_told_which_table_is_missing(asperity):
    code, output, errors = asperity("flank", "table-4.3")
    assert (code, output) == (2, "")
    assert errors.startswith("table-4.3: it is a case of another kind, without [gearset]")


def test_a_missing_extra_is_named_before_any_work(asperity, without, tmp_path):
    without("OCP")
    code, output, errors = asperity("flank", "gearset-3b", "--step", "--out", tmp_path / "out")
    assert (code, output) == (2, "")
    assert errors.count("\n") == 1
    assert "pip install asperity[cad]" in errors
    assert not (tmp_path / "out").exists()


@pytest.mark.slow
def test_a_worm_that_misses_the_wheel_is_no_convergence(asperity):
    code, output, errors = asperity(
        "flank", "gearset-3b", "--json", "--set", "mount.centre_distance_error=8 mm"
    )
    assert code == 3
    assert errors.startswith("the worm reaches no tooth")
    assert one_object(output)["reached"] == {"share_of_pitch": 0.0}


@pytest.mark.slow
def test_what_was_reached_may_be_no_number(capsys, monkeypatch):
    def lost(prepared):
        raise ConvergenceError("lost", reached={"backlash_mm": math.nan})

    monkeypatch.setattr("asperity.flanks.study.flank.study", lost)
    with pytest.raises(SystemExit) as ended:
        main(["flank", "gearset-3b", "--json"])
    assert ended.value.code == 3
    assert one_object(capsys.readouterr().out)["reached"] == {"backlash_mm": None}


@pytest.mark.parametrize("table", [Hob, Disc, Modification, Mount, Blanks, MeasuringOptions])
def test_the_page_has_each_key_with_its_default(table):
    part = re.split(r"^``\[(\w+)\]``", PAGE, flags=re.MULTILINE)
    page = dict(zip(part[1::2], part[2::2], strict=True))[table.table]
    assert f".. case-table:: {table.table}\n" in page
    keys = {key.name: key for key in keys_of(table)}
    assert keys.keys() == table.model_fields.keys()
    for name, key in keys.items():
        assert key.meaning, name
        default = table.model_fields[name].default
        if default is None:
            assert key.default == "", name
            continue
        written = key.default.strip('"')
        quantity = quantity_of(table, name)
        given = to_si(written, quantity.unit) if quantity and quantity.unit else written
        assert (float(given) if isinstance(default, float) else given) == default, name


def test_both_flanks_carry_the_torque_alike(nominal):
    twists = [
        sorted(line["loaded_twist_rad"] for line in nominal["flanks"][side]["loaded"])
        for side in ("+1", "-1")
    ]
    assert twists[1] == pytest.approx(twists[0], rel=5e-3)

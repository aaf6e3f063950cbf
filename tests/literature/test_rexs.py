"""REXS: what is written is of the format, what is read back is the same gearset.

Sources in `tests/rexs`: the format's schema and description of version 1.5 (FVA), and the example
of a worm stage that ships with the C++ library REXSapi: z 2/41, m 4, d_m1 36, left, 300 N m at 1000
rpm of the worm, a polyglycol 220/37 at 73.2 degC by injection.
"""

import functools
import json
import random
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import pytest
from apparatus.grid import grid

from asperity.casefile import Case, read_case
from asperity.commands import case_tables
from asperity.errors import InputError
from asperity.flanks.export.rexs.document import read_document
from asperity.flanks.export.rexs.export import answer, prepare
from asperity.flanks.export.rexs.read import found_in, read_rexs
from asperity.flanks.parameters import Disc, Hob, Mount
from asperity.gearset import Gearset
from asperity.rating import Operation, rate, rate_case
from asperity.runs import Run
from asperity.shafts import study

FILES = Path(__file__).parents[1] / "rexs"
EXAMPLE = FILES / "FVA_worm_stage_1-4.rexs"
MODEL = json.loads((FILES / "worm-stage-1.5.json").read_text())
CASES = ("gearset-2", "gearset-3", "gearset-3b")
DESCRIBED = (*CASES, "actuator-shafts")
MORE = (
    ("gearset.flank=ZC", "gearset.hand=left", "disc.diameter='400 mm'"),
    ("gearset.flank=ZK", "mount.axial_offset='0.1 mm'", "mount.shaft_angle_error='0.1 deg'"),
    ("gearset.flank=ZN", "operation.lubrication=spray", "operation.oil_temperature='65 degC'"),
    ('operation.lubricant={ base_oil="polyglycol", viscosity_40="220 mm^2/s", '
     'viscosity_100="37 mm^2/s" }', "operation.bearing_span='150 mm'"),
)  # fmt: skip
# With five settings every second combination is one of each case and of each setting.
DESCRIPTIONS = pytest.mark.parametrize(
    ("name", "settings"), grid(DESCRIBED, [(), *MORE], ordinary=2)
)


def written(name, tmp_path, settings=()):
    case = read_case(name, case_tables(), settings)
    path = tmp_path / "gearset.rexs"
    answer(prepare(case), Run()).save(path)
    return case, path


def read_back(path):
    tables = read_rexs(path).tables
    known = case_tables()
    return {
        name: known[name].model_validate(values, context={"text_only": True})
        for name, values in tables.items()
    }


def same(one, other):
    for key, value in one.geometry.to_json().items():
        if value is None:
            assert other.geometry.to_json()[key] is None
            continue
        assert other.geometry.to_json()[key] == pytest.approx(value, rel=1e-12, abs=1e-12), key
    for key in ("name", "flank", "hand", "tooth_proportions"):
        assert getattr(other, key) == getattr(one, key)
    for key in ("worm_material", "wheel_material"):
        assert getattr(other, key).name == getattr(one, key).name
    assert other.worm_roughness == pytest.approx(one.worm_roughness, rel=1e-12)


@pytest.mark.ordinary(5)
@DESCRIPTIONS
def test_what_is_read_back_is_the_same_gearset(name, settings, tmp_path):
    case, path = written(name, tmp_path, settings)
    found = read_back(path)
    same(case.require(Gearset), found["gearset"])
    for table in (Hob, Disc, Mount):
        own, other = case.get(table), found.get(table.table)
        ground = case.require(Gearset).flank in ("ZK", "ZC")
        if own is None or (table is Disc and not ground):
            continue
        for key in own.model_fields_set:
            given, back = getattr(own, key), getattr(other, key)
            assert back == (pytest.approx(given, rel=1e-12) if isinstance(given, float) else given)


@pytest.mark.ordinary(2)
@pytest.mark.parametrize("settings", [(), *MORE])
@pytest.mark.parametrize("name", CASES)
def test_what_is_read_back_rates_the_same(name, settings, tmp_path):
    case, path = written(name, tmp_path, settings)
    found = read_back(path)
    before = rate(case.require(Gearset), case.require(Operation))
    after = rate(found["gearset"], found["operation"])
    for standard, rating in before.found.items():
        for entry in rating:
            if isinstance(entry.value, float):
                assert after.found[standard][entry.key] == pytest.approx(
                    entry.value, rel=1e-9, abs=1e-12
                ), entry.key


def test_a_duty_cycle_becomes_load_cases_and_comes_back(tmp_path):
    cycle = (
        'operation.duty_cycle=[{ duration = "500 h", output_torque = "250 N m" }, { duration = '
        '"1500 h", output_torque = "150 N m", worm_speed = "700 rpm" }]'
    )
    case, path = written("gearset-3", tmp_path, [cycle])
    assert len(read_document(path).load_cases) == 2
    steps = read_back(path)["operation"].duty_cycle
    for step, own in zip(steps, case.require(Operation).duty_cycle, strict=True):
        assert step.duration == pytest.approx(own.duration)
        assert step.output_torque == pytest.approx(own.output_torque)
    assert steps[1].worm_speed == pytest.approx(case.require(Operation).duty_cycle[1].worm_speed)


@functools.cache
def schema():
    import xmlschema

    return xmlschema.XMLSchema(FILES / "rexs-file.xsd")


@pytest.mark.slow
@DESCRIPTIONS
def test_what_is_written_validates_against_the_schema_of_the_format(name, settings, tmp_path):
    pytest.importorskip("xmlschema")
    _, path = written(name, tmp_path, settings)
    schema().validate(path)


@pytest.mark.ordinary(7)
@DESCRIPTIONS
def test_components_attributes_units_and_relations_are_those_of_version_1_5(
    name, settings, tmp_path
):
    _, path = written(name, tmp_path, settings)
    root = ElementTree.parse(path).getroot()
    assert root.get("version") == "1.5"
    types = {}
    for component in root.iterfind("components/component"):
        own = MODEL["components"][component.get("type")]
        types[component.get("id")] = component.get("type")
        for attribute in component.iterfind("attribute"):
            key = attribute.get("id")
            if not key.startswith("custom_"):
                assert attribute.get("unit") == own[key]["unit"], key
                allowed = own[key].get("values")
                assert allowed is None or attribute.text in allowed, key
    assert len(types) == len(list(root.iterfind("components/component")))
    for relation in root.iterfind("relations/relation"):
        roles = {ref.get("role"): types[ref.get("id")] for ref in relation.iterfind("ref")}
        assert roles in MODEL["relations"][relation.get("type")], relation.get("type")


def test_forces_that_are_written_are_those_of_the_rating_and_balance(tmp_path):
    case, path = written("gearset-3", tmp_path)
    document = read_document(path)
    (worm,), (wheel,) = document.of_type("worm_gear"), document.of_type("worm_wheel")
    on_worm = [worm.value(f"force_acting_on_shaft_{axis}") for axis in "uvw"]
    on_wheel = [wheel.value(f"force_acting_on_shaft_{axis}") for axis in "uvw"]
    # The wheel's u is the worm's w, its v the worm's u, its w the worm's v.
    w, u, v = on_wheel
    assert [u, v, w] == pytest.approx([-force for force in on_worm])
    iso = rate(case.require(Gearset), case.require(Operation)).iso14521
    sizes = [iso["F_tm2_N"], iso["F_rm_N"], iso["F_tm1_N"]]
    assert [abs(force) for force in on_worm] == pytest.approx(sizes)


def test_the_public_example_is_read_to_its_numbers():
    found = read_rexs(EXAMPLE)
    gearset, run = found.tables["gearset"], found.tables["operation"]
    assert (gearset["starts"], gearset["wheel_teeth"]) == (2, 41)
    assert (gearset["axial_module"], gearset["diameter_factor"]) == ("4.0 mm", 9.0)
    assert (gearset["centre_distance"], gearset["pressure_angle"]) == ("100.0 mm", "20.0 deg")
    assert (gearset["hand"], gearset["flank"]) == ("left", "ZI")
    assert gearset["worm_material"] == "16MnCr5"
    assert (run["worm_speed"], run["output_torque"]) == ("1000.0 rpm", "300.0 N m")
    assert (run["oil_temperature"], run["lubrication"]) == ("73.2 degC", "spray")
    assert (run["life"], run["bearing_span"]) == ("100000.0 h", "160.0 mm")
    oil = run["lubricant"]
    assert oil["base_oil"] == "polyglycol"
    assert (oil["viscosity_40"], oil["viscosity_100"]) == ("220.0 mm^2/s", "37.0 mm^2/s")
    # It gives its wheel a steel.
    (remark,) = found.remarks
    assert "wheel_material as '16MnCr5'" in remark


def test_the_public_example_rates_as_its_numbers_do():
    tables = read_back(EXAMPLE)
    iso = rate(tables["gearset"], tables["operation"]).iso14521
    assert round(iso["mu_zm"], 5) == 0.02825
    assert round(iso["sigma_Hm_MPa"], 2) == 263.39
    assert round(iso["F_tm1_N"], 2) == 922.16
    assert round(iso["F_rm_N"], 2) == 1373.25


@pytest.mark.slow
def test_a_damaged_file_is_one_line_and_never_another_error(tmp_path):
    text = EXAMPLE.read_text()
    wrong = tmp_path / "wrong.rexs"
    rng = random.Random(1)
    for _ in range(150):
        cut = list(text)
        for _ in range(rng.choice((1, 3, 30))):
            place = rng.randrange(len(cut))
            cut[place] = rng.choice(("", "<", ">", "0", "-", "x", "&", '"', "9e9", cut[place] * 2))
        if rng.random() < 0.2:
            del cut[rng.randrange(len(cut)) :]
        wrong.write_text("".join(cut))
        # What is left of it may still be a gearset.
        said = ""
        try:
            read_rexs(wrong)
        except InputError as error:
            said = str(error)
        assert "\n" not in said


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ('version="1.4"', 'version="9"', "is of REXS '9'"),
        ("<model ", "<!DOCTYPE m [<!ENTITY a 'b'>]><model ", "has a document type"),
        ('type="worm_stage"', 'type="bevel_stage"', "0 worm stages"),
        ('id="number_of_teeth"', 'id="teeth"', "has no number_of_teeth"),
        ('unit="mm">36.0', 'unit="furlong">36.0', "in 'furlong', which is not read"),
        ('unit="mm">36.0', 'unit="mm">thick', "must be a number"),
        ("<relation id", "<relation identity", None),
        ("</model>", "", "is no XML"),
    ],
)
def test_what_is_wrong_with_a_file_is_said(old, new, said, tmp_path):
    wrong = tmp_path / "wrong.rexs"
    text = EXAMPLE.read_text()
    assert old in text
    wrong.write_text(text.replace(old, new))
    if said is None:
        read_rexs(wrong)
        return
    with pytest.raises(InputError, match=said):
        read_rexs(wrong)


def test_shafts_are_written_as_the_case_has_them(tmp_path):
    case, path = written("actuator-shafts", tmp_path)
    document = read_document(path)
    for part in ("worm", "wheel"):
        table = case.tables[f"{part}_shaft"]
        (shaft,) = (
            one for one in document.components
            if one.type == "shaft" and one.name == f"{part} shaft"
        )  # fmt: skip
        parts = [*document.related("assembly", "assembly", shaft.number, "part")]
        sections = [one for one in parts if one.type == "shaft_section"]
        assert len(sections) == len(table.section)
        end = 0.0  # numbers are in SI
        for one, given in zip(sections, table.section, strict=True):
            assert one.value("u_coordinate_on_shaft") == pytest.approx(end, abs=1e-12)
            assert one.value("length") == pytest.approx(given.length, rel=1e-12)
            if given.diameter is not None:
                assert one.value("outer_diameter_end") == pytest.approx(given.diameter)
            end += given.length
        assert end == pytest.approx(table.length, rel=1e-12)
        bearings = [*document.related("side", "inner_part", shaft.number, "assembly")]
        for one, given in zip(bearings, table.bearing, strict=True):
            rolling, wide = given.bearing, 2.0 if given.pair else 1.0
            assert one.value("u_coordinate_on_shaft_inner_side") == pytest.approx(given.at)
            assert one.value("inner_diameter") == pytest.approx(rolling.bore)
            assert one.value("width") == pytest.approx(wide * rolling.width)
        takes = [one.text("axial_force_absorption") for one in bearings]
        assert takes == ["both_directions", "no_direction"]
        (gear,) = (one for one in parts if one.type in ("worm_gear", "worm_wheel"))
        assert gear.value("u_coordinate_on_shaft") == pytest.approx(table.mesh)


@pytest.mark.parametrize(
    ("arrangement", "takes"),
    [
        ("adjusted face-to-face", ["negative", "positive"]),
        ("adjusted back-to-back", ["positive", "negative"]),
    ],
)
def test_of_adjusted_bearings_each_takes_the_axial_force_one_way(arrangement, takes, tmp_path):
    table = read_case("actuator-shafts", case_tables()).raw["worm_shaft"]
    ball = {
        "kind": "angular contact", "contact_angle": "40 deg", "bore": "30 mm",
        "outside_diameter": "62 mm", "width": "16 mm", "dynamic_rating": "36 kN",
        "static_rating": "26 kN", "name": "x",
    }  # fmt: skip
    bearings = [
        {"at": at, "arrangement": arrangement, "bearing": ball} for at in ("30 mm", "180 mm")
    ]
    given = prepare(read_case("actuator-shafts", case_tables()))
    shaft = type(given.worm_shaft).model_validate({**table, "bearing": bearings})
    document = answer(given._replace(worm_shaft=shaft), Run()).document
    found = [one for one in document.components if one.type == "concept_bearing"][:2]
    assert [one.text("axial_force_absorption") for one in found] == takes


CARRIED = ("actuator-shafts", "actuator-duty")


@pytest.mark.parametrize("name", CARRIED)
def test_what_the_format_has_no_place_for_comes_back(name, tmp_path):
    settings = ["tolerances.grade=8", "blank.web_width=12 mm", "rating.friction_factor=1.1"]
    case, path = written(name, tmp_path, settings)
    found = found_in(read_document(path))
    assert not found.remarks
    back = Case("back", tmp_path, {}, found.tables, case_tables()).replace(())
    for table in set(case.raw) - {"gearset", "operation", "project"}:
        assert back.tables[table] == case.tables[table], table
    before, after = rate_case(case), rate_case(back)
    for standard, rating in before.found.items():
        for entry in rating:
            if isinstance(entry.value, float):
                assert after.found[standard][entry.key] == pytest.approx(entry.value, rel=1e-9)


def test_shafts_come_back_and_come_to_the_same(tmp_path):
    case, path = written("actuator-shafts", tmp_path, [])
    back = Case("back", tmp_path, {}, found_in(read_document(path)).tables, case_tables())
    one, other = (study.answer(study.prepare(each), Run()) for each in (case, back.replace(())))
    for row, own in zip(one.rows, other.rows, strict=True):
        assert own.value == pytest.approx(row.value, rel=1e-9)


@pytest.mark.parametrize(
    ("name", "old", "new", "gone"),
    [
        ("actuator-shafts", ">30.0<", ">32.0<", "[worm_shaft], [wheel_shaft], [bearings]"),
        ("actuator-duty", ">1400.0<", ">1200.0<", "[spectrum]"),
    ],
)
def test_what_another_program_changed_is_not_overruled(name, old, new, gone, tmp_path):
    _, path = written(name, tmp_path, [])
    text = path.read_text("utf-8")
    assert old in text
    path.write_text(text.replace(old, new), "utf-8")
    found = found_in(read_document(path))
    assert any(f"what it carries of {gone} is left out" in said for said in found.remarks)
    assert not {"worm_shaft", "wheel_shaft", "spectrum"} & set(found.tables)


@pytest.mark.parametrize("text", ["{", "[1]", '{"housing": 3}', "[" * 100_000])
def test_carried_tables_that_cannot_be_read_are_told(text, tmp_path):
    _, path = written("actuator-duty", tmp_path, [])
    document = read_document(path)
    unit = next(document.of_type("gear_unit"))
    unit.attributes["custom_asperity_tables"] = (text, "none")
    assert any("cannot be read" in said for said in found_in(document).remarks)


def test_what_no_file_holds_is_named(tmp_path):
    case = read_case("drive-thesis", case_tables())
    notes = answer(prepare(case), Run()).notes
    (said,) = [note for note in notes if note.startswith("left out: ")]
    assert "[drive]" in said

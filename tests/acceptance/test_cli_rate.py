"""``asperity rate`` as a user runs it."""

import csv
import json
import re
import textwrap
from pathlib import Path

import pytest

from asperity import gearset

KEYS = {
    "geometry": {"lead_angle_deg", "profile_shift", "worm_pitch_diameter_mm"},
    "iso14521": {
        "sliding_velocity_m_s", "mu_0T", "mu_zm", "Y_S", "Y_G", "Y_W", "Y_R", "h_star", "p_m_star",
        "s_star", "eta_z1_2", "eta_z2_1", "eta_ges", "input_power_W", "input_torque_Nm",
        "loss_meshing_W", "loss_idle_W", "loss_bearing_W", "loss_seal_W", "sigma_Hm_MPa",
        "safety_wear", "safety_pitting", "safety_deflection", "safety_root", "safety_temperature",
    },
    "bs721": {"M_26k_Nm", "M_w_Nm", "M_s_Nm"},
    "agma6034": {
        "mu", "eta", "allowable_torque_Nm", "bending_stress_MPa", "C_s", "C_m", "C_v",
    },
}  # fmt: skip
OWN = """
# A gearset of the user's own, with no more than what is required

[gearset]
starts = 2
wheel_teeth = 40
centre_distance = "100 mm"
axial_module = "4 mm"
diameter_factor = 10
worm_material = "case-hardened steel"
wheel_material = "CuSn12-C-GZ"

[operation]
worm_speed = "1500 rpm"
output_torque = "300 N m"
lubricant = { base_oil = "mineral", viscosity_40 = "220 mm^2/s", viscosity_100 = "19 mm^2/s" }
"""


@pytest.fixture
def own(tmp_path):
    file = tmp_path / "own.toml"
    file.write_text(OWN)
    return file


def one_object(output):
    assert output.count("\n") == 1
    return json.loads(output, parse_constant=lambda name: pytest.fail(f"{name} is no JSON"))


@pytest.mark.ordinary(2)
@pytest.mark.parametrize("name", ["gearset-2", "gearset-3", "gearset-3b"])
def test_gearsets_that_ship_print_one_object_with_the_keys_of_the_contract(asperity, name):
    code, output, errors = asperity("rate", name, "--json")
    assert (code, errors) == (0, "")
    answer = one_object(output)
    for part, keys in KEYS.items():
        assert answer[part].keys() >= keys
    assert answer["notes"] == []


def test_gearset_3_through_the_command_line(asperity):
    answer = one_object(asperity("rate", "gearset-3", "--json")[1])
    assert answer["iso14521"]["mu_zm"] == pytest.approx(0.1344, abs=5e-5)
    assert answer["iso14521"]["eta_z1_2"] == pytest.approx(0.73, abs=5e-3)
    assert answer["geometry"]["lead_angle_deg"] == pytest.approx(26.0, abs=0.05)


def test_the_torque_that_wear_is_judged_by_stands_by_the_bars_where_it_is_assumed(asperity, own):
    valve = ("--set", "operation.service=valve")
    shown = " ".join(asperity("rate", own, *valve)[1].split())
    said = "wear is judged at T_2 = 100 N m, of a valve assumed a third of the 300 N m given: else "
    assert f"{said}give operation.through_travel_torque" in shown
    assert "wear is judged" not in asperity("rate", own)[1]
    assert "wear is judged" not in asperity("rate", own, *valve, "--standard", "agma6034")[1]


def test_file_with_no_more_than_what_is_required_is_rated_and_tells_the_rest(asperity, own):
    code, output, errors = asperity("rate", own, "--json")
    assert (code, errors) == (0, "")
    answer = one_object(output)
    assert answer["assumed"]["operation.seals"] == "2"
    assert "seals" in answer["iso14521"]["assumed"]
    assert "nu_40_mm2_s" not in answer["iso14521"]["assumed"]


def test_standard_asked_for_alone_leaves_the_others_null(asperity, own):
    answer = one_object(asperity("rate", own, "--standard", "bs721", "--json")[1])
    assert answer["bs721"]["M_w_Nm"] > 0.0
    assert answer["iso14521"] is None
    assert answer["agma6034"] is None


def test_all_is_the_default(asperity, own):
    default, everything = (
        asperity("rate", own, "--json"),
        asperity("rate", own, "--standard", "all", "--json"),
    )
    assert default == everything


def test_table_names_symbol_value_unit_equation_and_trust(asperity):
    code, output, errors = asperity("rate", "gearset-3", "--full")
    assert (code, errors) == (0, "")
    lines = output.splitlines()
    assert max(map(len, lines)) <= 100
    assert output.isascii()
    (line,) = (line for line in lines if line.startswith("Y_S "))
    assert line.split() == ["Y_S", "1.1552", "size", "factor", "sqrt(100/a)", "verified"]
    assert any(line.startswith("- from memory, check before use:") for line in lines)
    assert any(line.startswith("- outside its validity: lead angle") for line in lines)
    assert any(line.startswith("Self-locking at a lead angle of 26") for line in lines)


@pytest.mark.ordinary(1)
@pytest.mark.parametrize("case", ["gearset-2", "gearset-3", "gearset-3b"])
def test_one_screen_says_whether_it_holds(asperity, case):
    code, output, errors = asperity("rate", case)
    assert (code, errors) == (0, "")
    lines = output.splitlines()
    assert len(lines) <= 25
    assert max(map(len, lines)) <= 80
    assert output.isascii()
    answer = one_object(asperity("rate", case, "--json")[1])
    verdict = answer["verdict"]
    assert verdict["holds"]["iso14521"] is False
    assert "does not hold by ISO/TR 14521" in output
    for safety in verdict["safeties"]:
        assert answer[safety["standard"]][safety["key"]] == safety["value"]
        (line,) = (
            line
            for line in lines
            if f"{safety['symbol']} {safety['value']:.3g} of" in line
            and "|" in line
            and safety["name"] in line
        )
        assert (
            line.endswith("FAILS") == (not safety["holds"]) == (safety["value"] < safety["asked"])
        )
    least = min(verdict["safeties"], key=lambda s: s["value"] / s["asked"])
    assert verdict["first"] == f"{least['standard']}.{least['key']}"
    assert f"first to fail: {least['name']}" in output


def test_what_moves_the_first_to_fail_is_what_raising_it_does(asperity):
    before = one_object(asperity("rate", "gearset-3", "--json")[1])
    levers = {lever["name"]: lever["exponent"] for lever in before["verdict"]["moved_by"]}
    assert before["verdict"]["first"] == "iso14521.safety_deflection"
    setting = "operation.output_torque=369.66 N m", "operation.through_travel_torque=123.22 N m"
    after = one_object(
        asperity("rate", "gearset-3", "--json", "--set", setting[0], "--set", setting[1])[1]
    )
    ratio = after["iso14521"]["safety_deflection"] / before["iso14521"]["safety_deflection"]
    assert ratio == pytest.approx(1.01 ** levers["torque"], rel=1e-9)
    sizes = [abs(exponent) for exponent in levers.values()]
    assert sizes == sorted(sizes, reverse=True)


def test_a_thicker_oil_is_looked_at_a_grade_away(asperity, own):
    before = one_object(asperity("rate", own, "--json")[1])
    levers = {lever["name"]: lever["exponent"] for lever in before["verdict"]["moved_by"]}
    oil = 'operation.lubricant={ base_oil = "mineral", viscosity_40 = "330 mm^2/s", '
    oil += 'viscosity_100 = "28.5 mm^2/s" }'
    after = one_object(asperity("rate", own, "--set", oil, "--json")[1])
    ratio = after["iso14521"]["safety_wear"] / before["iso14521"]["safety_wear"]
    assert ratio == pytest.approx(1.5 ** levers["oil viscosity"], rel=1e-9)
    assert levers["oil viscosity"] > 1.0


@pytest.mark.slow
def test_the_better_oil_and_wheel_give_what_choosing_them_does(asperity):
    before = one_object(asperity("rate", "gearset-2", "--json")[1])
    assert before["verdict"]["first"] == "iso14521.safety_wear"
    found = {other["key"]: other for other in before["verdict"]["alternatives"]}
    assert found.keys() == {"operation.lubricant", "gearset.wheel_material"}
    for key, other in found.items():
        after = asperity("rate", "gearset-2", "--json", "--set", f"{key}={other['value']}")[1]
        safety = one_object(after)["iso14521"]["safety_wear"]
        assert safety == pytest.approx(other["safety"], rel=1e-12)
        assert safety > before["iso14521"]["safety_wear"]
    # The best oil for the wear of aluminium bronze would be one that practice avoids with it.
    assert "polyglycol" not in found["operation.lubricant"]["value"]
    shown = " ".join(asperity("rate", "gearset-2")[1].split())
    assert (
        "best listed: oil ISO VG 460 polyalphaolefin (over 11; ISO/TR 14521: does not hold -> "
        "holds; no longer locks itself in motion by ISO/TR 14521), wheel CuSn12Ni2-C-GZ (5.39; "
        "ISO/TR 14521: does not hold -> holds)"
    ) in shown


SLOW = """[gearset]
starts = 2
wheel_teeth = 40
axial_module = "4 mm"
diameter_factor = 10
worm_material = "case-hardened steel"
wheel_material = "CuSn12-C-GZ"
[operation]
worm_speed = "15 rpm"
output_torque = "300 N m"
lubricant = "ISO VG 460 mineral"
"""


@pytest.mark.slow
def test_nothing_is_listed_as_best_that_a_standard_fails_by_which_it_holds(asperity, tmp_path):
    path = tmp_path / "slow.toml"
    path.write_text(SLOW, encoding="utf-8")

    def rated(*settings):
        return one_object(asperity("rate", str(path), *settings, "--json")[1])

    before = rated()
    assert before["verdict"]["first"] == "iso14521.safety_pitting"
    assert before["verdict"]["holds"]["iso14521"]
    listed = {one["key"]: one for one in before["verdict"]["alternatives"]}
    # More of that safety each, but of others not enough.
    for key, more in (
        ("gearset.wheel_material", "CuAl10Fe5Ni5-C-GZ"),
        ("operation.lubricant", "ISO VG 150 polyglycol"),
    ):
        other = rated("--set", f"{key}={more}")
        assert other["iso14521"]["safety_pitting"] >= listed[key]["safety"]
        assert other["verdict"]["holds"]["iso14521"] is False
        best = rated("--set", f"{key}={listed[key]['value']}")
        assert best["verdict"]["holds"]["iso14521"]
        assert best["iso14521"]["safety_pitting"] == pytest.approx(listed[key]["safety"], rel=1e-12)


ENDS_TWO = """
[gearset]
starts = 1
wheel_teeth = 29
axial_module = "5 mm"
diameter_factor = 10
worm_material = "case-hardened steel"
wheel_material = "CuSn12Ni2-C-GC"
[operation]
worm_speed = "45.88 rpm"
output_torque = "781.5 N m"
lubricant = "ISO VG 100 mineral"
"""


def test_nor_is_what_a_standard_by_which_it_holds_gives_no_answer_for(asperity, tmp_path):
    path = tmp_path / "heavy.toml"
    path.write_text(ENDS_TWO, encoding="utf-8")
    before = one_object(asperity("rate", str(path), "--json")[1])
    words = {"iso14521": False, "bs721": True, "agma6034": True}
    assert before["verdict"]["holds"] == words
    listed = {one["key"]: one for one in before["verdict"]["alternatives"]}
    iron = "gearset.wheel_material=EN-GJS-400-15"
    other = one_object(asperity("rate", str(path), "--set", iron, "--json")[1])
    _, _, first = before["verdict"]["first"].partition(".")
    assert other["iso14521"][first] > listed["gearset.wheel_material"]["safety"]
    assert other["verdict"]["holds"] == words | {"bs721": None, "agma6034": None}
    best = f"gearset.wheel_material={listed['gearset.wheel_material']['value']}"
    changed = one_object(asperity("rate", str(path), "--set", best, "--json")[1])
    assert changed["verdict"]["holds"] == words


def test_the_three_standards_word_a_failure_alike(asperity):
    heavy = ("--set", "operation.output_torque=900 N m")
    answer = one_object(asperity("rate", "gearset-3", *heavy, "--json")[1])
    for standard in ("iso14521", "bs721", "agma6034"):
        failing = [note for note in answer[standard]["notes"] if " fails: " in note]
        assert failing
        assert all(
            re.fullmatch(r"\w+ fails: S_\w+ is [\d.]+; at least [\d.]+ is asked", n)
            for n in failing
        )


def test_polyglycol_with_aluminium_bronze_is_remarked(asperity):
    oil = ("--set", "operation.lubricant=ISO VG 220 polyglycol")
    notes = one_object(asperity("rate", "gearset-3", *oil, "--json")[1])["iso14521"]["notes"]
    assert any("practice avoids" in note for note in notes)


@pytest.mark.slow
def test_files_hold_the_same_numbers(asperity, own, tmp_path):
    folder = tmp_path / "new" / "out"
    code, output, errors = asperity("rate", own, "--json", "--out", folder)
    assert code == 0
    assert errors == f"written to {folder}: rate.json, rate.nc, rate.csv, rate.xlsx, report.html\n"
    answer = one_object(output)
    assert json.loads((folder / "rate.json").read_text()) == answer
    with (folder / "rate.csv").open(newline="") as file:
        rows = {(row["standard"], row["key"]): row for row in csv.DictReader(file)}
    for name in ("iso14521", "bs721", "agma6034"):
        for key in KEYS[name]:
            assert float(rows[name, key]["value"]) == answer[name][key]
    assert rows["iso14521", "mu_zm"]["symbol"] == "mu_zm"
    assert "<table" in (folder / "report.html").read_text("utf-8")


@pytest.mark.slow
def test_a_spreadsheet_takes_no_source_for_a_formula(asperity, environment, own, tmp_path):
    data = (Path(gearset.__file__).parent / "data" / "materials.toml").read_text("utf-8")
    evil = re.sub(r'^name = "', 'name = "=HYPERLINK(1) ', data, flags=re.MULTILINE)
    (tmp_path / "mine.toml").write_text(evil)
    mine = {**environment, "ASPERITY_MATERIALS": str(tmp_path / "mine.toml")}
    code, _, errors = asperity("rate", own, "--out", tmp_path, env=mine)
    assert code == 0, errors
    text = (tmp_path / "rate.csv").read_text()
    assert "'=HYPERLINK(1)" in text
    with (tmp_path / "rate.csv").open(newline="") as file:
        assert not [cell for row in csv.reader(file) for cell in row if cell[:1] in "=+@" and cell]


def test_standard_that_cannot_be_applied_is_null_with_a_note(asperity, own):
    iron = ("--set", "gearset.wheel_material=EN-GJS-400-15", "--json")
    code, output, errors = asperity("rate", own, *iron)
    assert (code, errors) == (0, "")
    answer = one_object(output)
    assert answer["agma6034"] is None
    assert answer["iso14521"]["mu_zm"] > 0.0
    assert any(note.startswith("agma6034: ") for note in answer["notes"])
    code, output, errors = asperity("rate", own, *iron, "--standard", "agma6034")
    assert (code, output) == (2, "")
    assert errors.startswith("--set gearset.wheel_material=EN-GJS-400-15: gearset.wheel_material")


def test_end_of_h_star_is_one_line_with_the_effect_of_ratio_and_module(asperity):
    code, output, errors = asperity(
        "rate", "gearset-2", "--set", "gearset.wheel_teeth=77", "--standard", "iso14521"
    )
    assert (code, output) == (2, "")
    assert errors.count("\n") == 1
    assert errors.startswith("gearset-2: the film parameter h* is -0.00126; it must be above 0")
    assert "ratio below" in errors
    assert "axial module below" in errors


@pytest.mark.parametrize(
    ("setting", "line"),
    [
        ("gearset.centre_distance=80 mm", "gearset.centre_distance is 80 mm; with 60 teeth"),
        ("gearset.profile_shift=0.5", "gearset.centre_distance is 74.93 mm; 60 teeth"),
        ("gearset.wheel_teeth=60.5", "gearset.wheel_teeth is 60.5; it must be a whole number"),
        ("gearset.wheel_material=CuSn12-C-GX", "did you mean 'CuSn12-C-GZ'?"),
        ("gearset.worm_material=steel", "gearset.worm_material is 'steel'; no worm material"),
        ("operation.lubricant=ISO VG 69 mineral", "did you mean 'ISO VG 68 mineral'?"),
        ("operation.worm_speed=1440 mm", "such as '1440 rpm'"),
        ("operation.worm_sped=1440 rpm", "did you mean 'worm_speed'?"),
        ("rating.friction=-0.1", "rating.friction is -0.1"),
        ("rating.bs721_tables=none.toml", "none.toml cannot be read"),
    ],
)
def test_mistakes_are_one_line_and_exit_2(asperity, setting, line):
    code, output, errors = asperity("rate", "gearset-3", "--set", setting, "--json")
    assert (code, output) == (2, "")
    assert errors.count("\n") == 1
    assert line in errors
    assert errors.startswith(("--set", "gearset-3: "))


def test_case_without_a_gearset_is_told_which_table_is_missing(asperity):
    code, output, errors = asperity("rate", "table-4.3")
    assert (code, output) == (2, "")
    assert errors.startswith("table-4.3: it is a case of another kind, without [gearset]")


def test_unknown_standard_is_named_with_the_near_one(asperity):
    code, _, errors = asperity("rate", "gearset-3", "--standard", "agma634")
    assert code == 2
    assert errors.startswith("--standard agma634: it must be one of ")
    assert "did you mean 'agma6034'?" in errors


def test_edition_may_be_set_as_a_number(asperity):
    code, output, _ = asperity(
        "rate", "gearset-3", "--set", "rating.iso14521_edition=1998", "--json"
    )
    assert code == 0
    assert one_object(output)["iso14521"]["standard"] == "DIN 3996:1998"


@pytest.mark.parametrize("options", [["rate", "--standard", "iso14521"], ["methods"]])
def test_a_worm_that_hardly_turns_is_refused_in_one_line(asperity, options):
    setting = "operation.worm_speed=7.7e-307 rpm"
    code, output, errors = asperity(*options, "gearset-2", "--set", setting, "--json")
    assert (code, output) == (2, "")
    assert "too far apart" in errors
    assert errors.count("\n") == 1


def test_friction_that_no_factor_brings_to_the_limit_has_no_factor(asperity):
    code, output, errors = asperity(
        "rate", "gearset-2", "--set", "rating.base_friction=9.6085e-317",
        "--standard", "iso14521", "--json",
    )  # fmt: skip
    assert (code, errors) == (0, "")
    verdicts = one_object(output)["self_locking"]["verdicts"]
    assert [verdict["factor_to_limit"] for verdict in verdicts] == [None, None]
    assert all(0.0 < verdict["friction"] < 1e-300 for verdict in verdicts)


OIL = """
[source.us]
name = "our supplier"
confidence = "one source"

[lubricant."our oil"]
base_oil = "polyglycol"
viscosity_40 = "460 mm^2/s"
viscosity_100 = "75 mm^2/s"
from = { "*" = "us" }
"""


def test_an_oil_of_ones_own_is_in_a_file_named_on_the_command_line(asperity, tmp_path):
    (tmp_path / "ours.toml").write_text(OIL)
    ours = ["--materials", tmp_path / "ours.toml"]
    code, output, _ = asperity(*ours, "lubricants", "--json")
    assert code == 0
    listed = {thing["name"]: thing for thing in one_object(output)["listed"]}
    assert listed["our oil"]["sources"]["viscosity_40"]["name"] == "our supplier"
    lubricant = ["--set", "operation.lubricant=our oil", "--json"]
    code, output, _ = asperity(*ours, "rate", "gearset-3", *lubricant)
    assert code == 0
    film = one_object(output)["verdict"]["film"]
    assert film["regime"] == "boundary"
    assert 0.0 < film["lambda"] < 1.0
    code, _, errors = asperity("rate", "gearset-3", *lubricant)
    assert (code, errors.count("\n")) == (2, 1)


def _of_the_docs(asperity, folder, text):
    """Rate a gearset with the tables and the settings that stand in a part of the docs."""
    block = re.search(r"code-block:: toml\n\n((?:   .*\n|\n)+)", text)[1]
    (folder / "ours.toml").write_text(textwrap.dedent(block))
    settings = [part for one in re.findall(r'--set "([^"]+)"', text) for part in ("--set", one)]
    ours = ["--materials", folder / "ours.toml"]
    code, output, errors = asperity(*ours, "rate", "gearset-3", *settings, "--json")
    assert (code, errors) == (0, "")
    return one_object(output)


@pytest.mark.slow
def test_the_materials_and_the_oil_of_the_docs_rate_a_gearset(asperity, tmp_path):
    page = (Path(__file__).parents[2] / "docs" / "rating.rst").read_text("utf-8")
    own = page.partition("Materials and oils of your own\n")[2].partition("\nEditions\n")[0]
    bronze, _, iron = own.partition("\nAustempered iron")
    answer = _of_the_docs(asperity, tmp_path, bronze)
    assert all(answer[standard] for standard in ("iso14521", "bs721", "agma6034"))
    assert answer["iso14521"]["E_2_MPa"] == pytest.approx(95000.0)
    answer = _of_the_docs(asperity, tmp_path, iron)
    assert (answer["iso14521"] is None, answer["bs721"]) == (False, None)
    assert answer["iso14521"]["E_2_MPa"] == pytest.approx(165000.0)


@pytest.mark.parametrize(("name", "why"), [("nowhere.toml", "no such file"), ("a:b", "':'")])
def test_a_file_of_ones_own_that_is_wrong_is_named(asperity, tmp_path, name, why):
    code, output, errors = asperity("--materials", name, "lubricants", cwd=tmp_path)
    assert (code, output, errors.count("\n")) == (2, "", 1)
    assert name in errors
    assert why in errors


@pytest.mark.slow
def test_one_step_has_the_levers_of_the_constant_load(asperity):
    load = ("rate", "gearset-3", "--set", "operation.life=500 h")
    code, output, errors = asperity(*load, "--json")
    assert code == 0, errors
    constant = json.loads(output)["verdict"]["moved_by"]
    operation = json.loads(asperity("rate", "gearset-3", "--json")[1])["iso14521"]
    torque, speed = operation["output_torque_Nm"], operation["worm_speed_rpm"]
    code, output, errors = asperity(
        "rate", "gearset-3", "--set", f'spectrum.step="{torque:g} N m, {speed:g} rpm, 500 h"',
        "--json",
    )  # fmt: skip
    assert code == 0, errors
    step = json.loads(output)["verdict"]["moved_by"]
    for lever in ("torque", "worm speed"):
        own, other = (
            [one["exponent"] for one in levers if one["name"] == lever]
            for levers in (constant, step)
        )
        assert own == pytest.approx(other, rel=1e-9), lever
    assert any(one["name"] == "worm speed" for one in step)

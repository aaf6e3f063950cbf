"""What size is given it holds, and recommendations tell what they change, self-locking too."""

import itertools
import json
import random
import tomllib

import pytest
from apparatus.rated_cases import ACTUATOR

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.rating import rate_case
from asperity.studies.series import MODULES, grid

SIZE = (
    "size", "--ratio", "40", "--output-torque", "300 N m", "--worm-speed", "1500 rpm", "--uncut",
)  # fmt: skip
KEYS = {
    "starts": "1", "wheel_teeth": "41", "centre_distance": "137 mm", "axial_module": "5 mm",
    "diameter_factor": "9.7", "worm_pitch_diameter": "45 mm", "profile_shift": "0.1",
}  # fmt: skip


@pytest.fixture
def here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "own.toml").write_text(ACTUATOR)
    return tmp_path


def sized(asperity, *more):
    code, output, errors = asperity(*SIZE, *more, "--json")
    assert code == 0, errors
    return json.loads(output)


@pytest.mark.parametrize("key", KEYS)
def test_what_is_set_of_a_gearset_is_held_by_every_proposal(asperity, here, key):
    answer = sized(asperity, "--set", f"gearset.{key}={KEYS[key]}")
    value = float(KEYS[key].split()[0])
    assert answer["proposals"]
    for one in answer["proposals"]:
        found = {
            **one,
            "centre_distance": one["centre_distance_mm"],
            "axial_module": one["axial_module_mm"],
            "worm_pitch_diameter": one["axial_module_mm"] * one["diameter_factor"],
        }
        assert found[key] == pytest.approx(value, rel=1e-9)
    assert f"held as it is set: gearset.{key}" in answer["notes"]


@pytest.mark.slow
def test_a_proposal_that_holds_is_the_case_that_it_writes(asperity, here):
    settings = ("--set", "gearset.worm_pitch_diameter=45 mm", "--set", "gearset.profile_shift=0.1")
    code, _, errors = asperity(*SIZE, *settings, "--out", "out")
    assert code == 0, errors
    answer = json.loads((here / "out" / "size.json").read_text("utf-8"))
    rated = rate_case(read_case("out/proposal-1.toml", case_tables()))
    assert rated.iso14521["eta_ges"] == pytest.approx(answer["proposals"][0]["efficiency"])
    assert rated.geometry.worm_pitch_diameter == pytest.approx(45.0)
    assert rated.geometry.profile_shift == pytest.approx(0.1)


def test_what_cannot_be_held_is_refused_in_a_line(asperity):
    for settings, said in (
        (("gearset.starts=3", "gearset.wheel_teeth=50"), "hold less"),
        (("gearset.starts=1.5",), "it must be a whole number"),
        (("gearset.axial_module=4 N",), "gearset.axial_module"),
    ):
        given = itertools.chain.from_iterable(("--set", text) for text in settings)
        code, output, errors = asperity(*SIZE, *given)
        assert (code, output) == (2, ""), settings
        assert said in " ".join(errors.split())
        assert "Traceback" not in errors


def test_a_grid_with_everything_free_is_the_series_and_what_is_held_a_part_of_it():
    whole = set(grid(30.0, {}, exact=False))
    rng = random.Random(7)
    for row in rng.sample(sorted(whole), 20):
        names = ("starts", "wheel_teeth", "centre_distance", "axial_module", "diameter_factor")
        held = {name: row[names.index(name)] for name in rng.sample(names, rng.randint(1, 5))}
        kept = {one for one in whole if all(one[names.index(n)] == held[n] for n in held)}
        assert kept <= set(grid(30.0, held, exact=False))
    assert {row[3] for row in whole} <= set(MODULES)


def test_size_tells_of_each_proposal_whether_it_locks_and_keeps_to_it_where_it_is_asked(asperity):
    free = sized(asperity)["proposals"]
    assert {one["locks"] for one in free} <= {"no", "by some", "at rest", "in motion"}
    one = free[0]
    settings = [part for text in one["settings"] for part in ("--set", text)]
    run = ("operation.output_torque=300 N m", "operation.worm_speed=1500 rpm")
    case = read_case("gearset-3", case_tables(), [
        "gearset.wheel_material=CuSn12Ni2-C-GZ", "operation.lubricant=ISO VG 220 polyglycol",
        "gearset.worm_roughness=0.5 um", *settings[1::2], *run,
    ])  # fmt: skip
    locking = rate_case(case).self_locking
    for state, key in (("static", "locks_at_rest"), ("dynamic", "locks_in_motion")):
        assert one[key] == [v.standard for v in locking if v.state == state and v.locks]
    rest = sized(asperity, "--locks", "rest")["proposals"]
    assert {one["locks"] for one in rest} <= {"at rest", "in motion"}
    code, _, errors = asperity(*SIZE, "--locks", "motion")
    assert code == 2
    assert "locks itself in motion by every standard" in " ".join(errors.split())


@pytest.mark.slow
def test_an_optimum_says_what_it_unlocks_and_keeps_what_is_to_be_kept(asperity, here):
    answer = json.loads(asperity("optimise", "own.toml", "--json")[1])
    assert answer["locking"]["given"]["locks itself at rest"] == "yes"
    assert answer["locking"]["optimum"]["locks itself at rest"] == "by BS and AGMA"
    said = "no longer locks itself at rest by ISO/TR 14521 (--keep locking holds that)"
    assert said in answer["notes"]
    kept = json.loads(asperity("optimise", "own.toml", "--keep", "locking", "--json")[1])
    for design in ("optimum", "made"):
        assert kept["locking"][design]["locks itself at rest"] == "yes"
    assert not any("locks itself" in note for note in kept["notes"])
    assert 0.0 < kept["gain_points"] < answer["gain_points"]
    held = [limit for limit in kept["constraints"] if limit["key"].startswith("locking.")]
    assert len(held) == 3
    assert any(limit["active"] for limit in held)


@pytest.mark.slow
def test_a_wheel_that_is_best_listed_tells_what_it_changes(asperity, here):
    settings = (
        "--set",
        "gearset.wheel_material=EN-GJL-250",
        "--set",
        "operation.output_torque=600 N m",
    )
    answer = json.loads(asperity("rate", "own.toml", *settings, "--json")[1])
    for other in answer["verdict"]["alternatives"]:
        changed = json.loads(
            asperity("rate", "own.toml", *settings, "--set", f"{other['key']}={other['value']}",
                     "--json")[1]
        )  # fmt: skip
        words = {n: one["word"] for n, one in answer["verdict"]["standing"].items()}
        now = {n: one["word"] for n, one in changed["verdict"]["standing"].items()}
        for name, word in words.items():
            told = any(f"{word} -> {now[name]}" in text for text in other["changes"])
            assert told == (word != now[name])


def test_size_does_not_say_by_every_standard_over_one_that_has_no_answer(asperity, here):
    answer = sized(asperity, "--set", "gearset.wheel_material=EN-GJL-250")
    assert any("AGMA 6034 covers" in note for note in answer["notes"])
    assert answer["holding"] == 0
    assert answer["notes"][-1].startswith("none holds by every standard, since one or another")
    assert all(one["holds"] for one in answer["proposals"])


def test_size_refuses_tables_that_are_not_there_as_rate_does(asperity, here):
    code, _, errors = asperity(*SIZE, "--set", "rating.bs721_tables=nope.toml")
    assert code == 2
    assert "nope.toml cannot be read: no such file or directory; name a file of tables" in errors


def test_a_required_ratio_stands_for_the_option(asperity, tmp_path):
    line = ["size", "--output-torque", "250 N m", "--worm-speed", "1400 rpm", "--uncut", "--json"]
    code, required, _ = asperity(*line, "--set", "requirements.ratio=50")
    assert code == 0
    found = json.loads(required)["proposals"]
    assert found == json.loads(asperity(*line, "--ratio", "50")[1])["proposals"]
    code, _, said = asperity(*line)
    assert code == 2
    assert "ratio is missing" in said
    code, _, _ = asperity("new", "gear", str(tmp_path / "own.toml"), "--defaults",
                          "--set", "requirements.ratio=50")  # fmt: skip
    assert code == 0
    gearset = tomllib.loads((tmp_path / "own.toml").read_text())["gearset"]
    assert gearset["wheel_teeth"] / gearset["starts"] == pytest.approx(50, rel=0.03)


def test_the_power_of_the_worm_stands_in_place_of_the_torque(asperity):
    asked = ("size", "--ratio", "40", "--worm-speed", "1500 rpm", "--uncut", "--json")
    code, by_option, errors = asperity(*asked, "--input-power", "1.5 kW")
    assert code == 0, errors
    code, by_set, errors = asperity(*asked, "--set", "operation.input_power=1.5 kW")
    assert code == 0, errors
    assert json.loads(by_option)["proposals"] == json.loads(by_set)["proposals"]


@pytest.mark.parametrize(
    ("more", "says"),
    [
        (("--output-torque", "300 N m"), "--output-torque 300 N m says what it comes to"),
        (("--set", "operation.input_torque=3 N m"), "--input-power 1.5 kW says the same"),
    ],
)
def test_two_forms_of_a_load_are_refused(asperity, more, says):
    code, _, errors = asperity(
        "size", "--ratio", "40", "--worm-speed", "1500 rpm", "--input-power", "1.5 kW", *more
    )
    assert code == 2
    assert says in errors
    assert len(errors.strip().splitlines()) == 1


def test_a_page_is_refused_units_that_there_are_not(asperity):
    code, _, errors = asperity("page", "--units", "mm")
    assert code == 2
    assert "--units mm: it must be one of 'si', 'us'" in errors

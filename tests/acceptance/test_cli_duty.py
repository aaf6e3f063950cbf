"""A duty as a case file of its own, sized; the shelf of hobs, masses and backlash of proposals."""

import io
import json
import tomllib

import pytest

from asperity.casefile import read_case
from asperity.cli.new import new
from asperity.commands import case_tables
from asperity.gearset import Gearset
from asperity.gearset.hob_shelf import PAIRS
from asperity.gearset.masses import masses
from asperity.python import rate
from asperity.rating import rate_case

TEXT = "250 N m, 1400 rpm, 500 h; 150 N m, 1400 rpm, 1500 h; 60 N m, 700 rpm, 3000 h"
SHELF = """
[source.shop]
name = "tool crib"
confidence = "verified"
[hob."3.15 x 40"]
axial_module = "3.15 mm"
worm_pitch_diameter = "40 mm"
from = { "*" = "shop" }
[hob."4 x 44 left"]
axial_module = "4 mm"
worm_pitch_diameter = "44 mm"
hand = "left"
starts = 1
from = { "*" = "shop" }
"""


@pytest.mark.slow
def test_a_duty_is_begun_checked_and_sized_and_its_proposal_rated(asperity, tmp_path):
    begun = ("new", "duty", "my.toml", "--defaults", "--ratio", "50")
    code, output, errors = asperity(
        *begun, "--set", f"spectrum.step={TEXT}", "--set", "requirements.self_locking=wanted",
        "--set", "operation.output_torque=250 N m", "--set", "operation.worm_speed=1400 rpm",
        cwd=tmp_path,
    )  # fmt: skip
    assert code == 0, errors
    assert "asperity size my.toml" in output
    code, output, errors = asperity("check", "my.toml", cwd=tmp_path)
    assert code == 0, errors
    assert "asperity size can take it" in output
    code, output, errors = asperity("size", "my.toml", "--uncut", "--out", "out", cwd=tmp_path)
    assert code == 0, errors
    told = json.loads((tmp_path / "out" / "size.json").read_text("utf-8"))
    rated = rate_case(read_case(tmp_path / "out" / "proposal-1.toml", case_tables()))
    best = told["proposals"][0]
    assert rated.iso14521["eta_ges"] == pytest.approx(best["efficiency"], rel=1e-9)
    assert best["locks_at_rest"] == ["iso14521", "bs721", "agma6034"]
    assert best["mass_kg"] == pytest.approx(masses(rated_gearset(tmp_path)).whole)


def rated_gearset(folder):
    return read_case(folder / "out" / "proposal-1.toml", case_tables()).require(Gearset)


def test_torque_and_speed_are_those_of_the_greatest_load(asperity, tmp_path):
    (tmp_path / "own.toml").write_text(
        f'[requirements]\nratio = 50\n[operation]\nlubricant = "ISO VG 220 polyglycol"\n'
        f'[spectrum]\nstep = "{TEXT}"\n'
    )
    options = ("--uncut", "--json")
    code, output, errors = asperity("size", "own.toml", *options, cwd=tmp_path)
    assert code == 0, errors
    own = json.loads(output)
    code, output, errors = asperity(
        "size", "own.toml", *options, "--output-torque", "250 N m", "--worm-speed", "1400 rpm",
        cwd=tmp_path,
    )  # fmt: skip
    assert code == 0, errors
    assert own == json.loads(output)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("[requirements]\nratio = 50\n", "own.toml: operation.output_torque is missing"),
        ('[operation]\noutput_torque = "9 N m"\nworm_speed = "9 rpm"\n', "ratio is missing"),
        ("[gears]\n", "[gears] is not a table of a case file"),
        (
            f'[requirements]\nratio = 500\n[spectrum]\nstep = "{TEXT}"\n',
            "own.toml: requirements.ratio is 500",
        ),
        ("[[requirements]]\nratio = 50\n", "write it as [requirements]"),
    ],
)
def test_a_duty_that_lacks_something_is_refused_by_its_file(asperity, tmp_path, text, said):
    (tmp_path / "own.toml").write_text(text)
    code, _, errors = asperity("size", "own.toml", cwd=tmp_path)
    assert code == 2
    assert said in errors
    assert errors.count("\n") <= 1


@pytest.mark.slow
@pytest.mark.parametrize(
    "life",
    [
        "wheel_revolutions = 100000",
        'duty_cycle = "300 N m, 1000 h; 90 N m, 4000 h"',
        'life = "3000 h"',
    ],
)
def test_a_life_in_any_form_takes_the_place_of_the_assumed_one(asperity, tmp_path, life):
    (tmp_path / "own.toml").write_text(
        "[requirements]\nratio = 40\n[operation]\n"
        f'output_torque = "300 N m"\nworm_speed = "1500 rpm"\n{life}\n'
    )
    code, _, errors = asperity("size", "own.toml", "--uncut", "--out", "out", cwd=tmp_path)
    assert code == 0, errors
    operation = read_case(tmp_path / "out" / "proposal-1.toml", case_tables()).tables["operation"]
    key = life.partition(" ")[0]
    assert getattr(operation, key) is not None
    assert {"wheel_revolutions", "duty_cycle", "life"} & operation.model_fields_set == {key}


def test_without_case_or_torque_it_is_asked_for(asperity, tmp_path):
    code, _, errors = asperity("size", "--ratio", "40", cwd=tmp_path)
    assert code == 2
    assert "operation.output_torque is missing; give it, as --output-torque" in errors


REFUSED = [
    (("spectrum.step=300 N m, 1400 rpm, 5 h", "operation.output_torque=250 N m"),
     "spectrum.step has a part with 300 N m"),
    (("requirements.centre_distance=20 mm",), "[requirements] asks for centre distance at most"),
    (("requirements.hobs=own",), "no data file has a hob"),
    (("requirements.bearings=own",), "no data file has a bearing"),
    (("requirements.ratio=99", "requirements.self_locking=avoided"), "self-locking avoided"),
    (("gearset.pressure_angle=44 deg",), "every thread for a ratio of"),
]  # fmt: skip


@pytest.mark.ordinary(2)
@pytest.mark.parametrize(("settings", "said"), REFUSED, ids=[said for _, said in REFUSED])
def test_new_and_check_refuse_what_size_refuses_in_its_words(asperity, tmp_path, settings, said):
    code, _, errors = asperity("new", "duty", "plain.toml", "--defaults", cwd=tmp_path)
    assert code == 0, errors
    given = [word for setting in settings for word in ("--set", setting)]
    found = {}
    for words in (
        ("size", "plain.toml", "--uncut"), ("check", "plain.toml"),
        ("new", "duty", "own.toml", "--defaults"),
    ):  # fmt: skip
        code, output, errors = asperity(*words, *given, cwd=tmp_path)
        assert code == 2, words
        # Check prints what it finds, and then how much that is.
        found[words[0]] = output if words[0] == "check" else errors
        assert said in found[words[0]]
    assert not (tmp_path / "own.toml").exists()
    assert found["check"].strip().endswith(found["new"].strip().partition(": ")[2][-60:])


class Typed(io.StringIO):
    """What somebody types at a terminal."""

    def isatty(self):
        return True


def asked(monkeypatch, capsys, folder, *lines, settings=()):
    """Begin a duty at a terminal; returns what is asked and told."""
    monkeypatch.chdir(folder)
    monkeypatch.setattr("sys.stdin", Typed("".join(f"{line}\n" for line in lines)))
    new("duty", None, {}, settings, "", defaults=False, as_json=False)
    return capsys.readouterr().err


def test_a_load_above_the_rated_torque_is_asked_for_again(monkeypatch, capsys, tmp_path):
    known = ("requirements.ratio=50", "requirements.ratio_tolerance=0.03",
             "requirements.self_locking=any", "spectrum.duty=S1", "project.units=si",
             "operation.output_torque=250 N m", "operation.worm_speed=1400 rpm",
             "operation.lubricant=ISO VG 220 polyglycol")  # fmt: skip
    lines = ("300 N m, 1400 rpm, 5 h", "200 N m, 1400 rpm, 5 h", *[""] * 9)
    said = asked(monkeypatch, capsys, tmp_path, *lines, settings=known)
    assert "spectrum.step has a part with 300 N m, number 1 of the list; none may exceed" in said
    assert '"200 N m, 1400 rpm, 5 h"' in (tmp_path / "duty.toml").read_text("utf-8")


def test_a_duty_asks_how_far_the_ratio_may_be_off_and_in_which_units(
    monkeypatch, capsys, tmp_path, asperity
):
    lines = ("50", "0.5 %", "wanted", "2213 lb-in", "1400 rpm", "", "S3 15 %", "", "", "", "us")
    said = asked(monkeypatch, capsys, tmp_path, *lines)
    assert "by how much teeth may miss that ratio [3 %]" in said
    assert "units that are shown: si or us [si]" in said
    code, output, errors = asperity("size", "duty.toml", "--uncut", cwd=tmp_path)
    assert code == 0, errors
    assert "a (in)" in output
    code, output, errors = asperity("size", "duty.toml", "--uncut", "--json", cwd=tmp_path)
    assert {one["wheel_teeth"] for one in json.loads(output)["proposals"]} == {50}


@pytest.mark.ordinary(3)
@pytest.mark.parametrize(
    ("duty", "answers", "housing"),
    [
        ("S3 15 %", ("12 kg", ""), {"iron": "12 kg"}),
        ("S2 15 min", ("twelve", "12 kg", "3 kg"), {"iron": "12 kg", "aluminium": "3 kg"}),
        ("S2 15 min", ("12 mm", "", "3 kg"), {"aluminium": "3 kg"}),
        ("S3 15 %", ("", ""), None),
        ("S1", (), None),
    ],
)
def test_a_duty_that_comes_and_goes_asks_what_the_gearbox_weighs(
    monkeypatch, capsys, tmp_path, duty, answers, housing
):
    known = ("requirements.ratio=50", "requirements.ratio_tolerance=0.03",
             "requirements.self_locking=any", f"spectrum.duty={duty}", "project.units=si",
             "operation.output_torque=250 N m", "operation.worm_speed=1400 rpm",
             "spectrum.step=200 N m, 1400 rpm, 5 h")  # fmt: skip
    said = asked(monkeypatch, capsys, tmp_path, *answers, "ISO VG 320 mineral", settings=known)
    assert ("mass of iron" in said) == (duty != "S1")
    written = tomllib.loads((tmp_path / "duty.toml").read_text("utf-8"))
    assert written.get("housing") == housing
    assert written["operation"]["lubricant"] == "ISO VG 320 mineral"


def test_what_is_an_example_in_a_file_that_is_begun_is_called_one(monkeypatch, capsys, tmp_path):
    known = ("operation.output_torque=250 N m", "operation.worm_speed=1400 rpm")
    monkeypatch.chdir(tmp_path)
    new("duty", None, {}, known, "", defaults=True, as_json=False)
    text = (tmp_path / "duty.toml").read_text("utf-8")
    blocks = {block.splitlines()[-1]: block.split() for block in text.split("\n\n") if block}
    # What follows from others has no value of its own that is assumed.
    for line in (
        '#oil_temperature = "each"',
        '#oil_temperature = "20 degC"',
        '#idle_loss = "30 W"',
    ):
        assert " ".join(blocks[line]).replace(" # ", " ").count("For example:") == 1
    for line in ('#shock = "uniform"', '#cycle = "10 min"'):
        assert "example:" not in blocks[line]


def test_only_hobs_of_the_shelf_are_proposed_and_each_is_named(asperity, tmp_path):
    (tmp_path / "hobs.toml").write_text(SHELF)
    duty = ("size", "--output-torque", "100 N m", "--worm-speed", "1400 rpm", "--uncut", "--json")
    asked = ("--ratio", "50", "--set", "requirements.ratio_tolerance=0.1")
    for which in ("own", "standard"):
        code, output, errors = asperity(
            "--materials", "hobs.toml", *duty, *asked, "--set", f"requirements.hobs={which}",
            cwd=tmp_path,
        )  # fmt: skip
        assert code == 0, errors
        found = json.loads(output)["proposals"]
        assert found
        for one in found:
            module, diameter = map(float, one["hob"].split(" x "))
            assert one["axial_module_mm"] == pytest.approx(module)
            assert one["diameter_factor"] * module == pytest.approx(diameter)
            # The left hob cuts no right-hand worm.
            assert diameter in ((40.0,) if which == "own" else PAIRS[module])
    code, output, errors = asperity("--materials", "hobs.toml", "hobs", cwd=tmp_path)
    assert code == 0, errors
    assert "3.15 x 40" in output
    assert "tool crib" in output


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (("size", "--ratio", "50", "--output-torque", "9 N m", "--worm-speed", "9 rpm",
          "--set", "requirements.hobs=own"), "no data file has a hob"),
        (("optimise", "gearset-3", "--set", "requirements.hobs=standard"), "needs another hob"),
        (("optimise", "gearset-3", "--set", "requirements.hobs=standard", "--free",
          "worm_roughness"), "none of them cuts a gearset"),
    ],
)  # fmt: skip
def test_a_shelf_that_cannot_be_kept_is_refused(asperity, tmp_path, options, said):
    code, _, errors = asperity(*options, cwd=tmp_path)
    assert code == 2
    assert said in errors


@pytest.mark.slow
def test_backlash_of_each_proposal_is_that_of_its_rating(asperity, tmp_path):
    settings = ("--set", "tolerances.centre_distance=js7",
                "--set", "tolerances.thread=['-40 um', '-70 um']",
                "--set", "tolerances.tooth=['-50 um', '-100 um']")  # fmt: skip
    code, output, errors = asperity(
        "size", "--ratio", "50", "--output-torque", "250 N m", "--worm-speed", "1400 rpm",
        "--uncut", "--set", "gearset.centre_distance=100 mm", "--set", "gearset.diameter_factor=12",
        "--out", "out", *settings, cwd=tmp_path,
    )  # fmt: skip
    assert code == 0, errors
    assert "backlash (arcmin)" in output
    best = json.loads((tmp_path / "out" / "size.json").read_text("utf-8"))["proposals"][0]
    rated = rate(tmp_path / "out" / "proposal-1.toml").to_json()
    new = rated["backlash"]["new"]
    assert best["backlash_arcmin"] == pytest.approx(
        [new["wheel_min_arcmin"], new["wheel_max_arcmin"]]
    )

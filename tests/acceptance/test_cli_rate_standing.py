"""The first lines of a rating name every standard that cannot tell, or rates outside its range."""

import json

import pytest
from apparatus.any_gearset import gearset, written
from apparatus.rated_cases import SMALL_FAN

CATALOGUE_100 = """
[gearset]
name = "NMRV 063, i=100"
starts = 1
wheel_teeth = 100
centre_distance = "63 mm"
axial_module = "0.98910 mm"
diameter_factor = 27.38854
worm_material = "case-hardened steel"
wheel_material = "CuSn12-C-GZ"
[operation]
life = "12000 h"
lubricant = "ISO VG 320 polyglycol"
output_torque = "30 N m"
worm_speed = "1400 rpm"
"""
CATALOGUE_30 = """
[gearset]
name = "NMRV 030, i=60"
starts = 1
wheel_teeth = 60
centre_distance = "30 mm"
axial_module = "0.785 mm"
diameter_factor = 16.4331
worm_material = "case-hardened steel"
wheel_material = "CuSn12-C-GZ"
[operation]
life = "12000 h"
lubricant = "ISO VG 320 polyglycol"
output_torque = "13 N m"
worm_speed = "1400 rpm"
"""
SLOW_WHEEL = """
[gearset]
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
SAID = {
    "a ratio beyond two standards": (
        CATALOGUE_100,
        "holds by AGMA 6034; no answer by ISO/TR 14521 and BS 721 ISO/TR 14521: the "
        "film parameter h* is -0.00541",
        {"iso14521": None, "bs721": None, "agma6034": True},
    ),
    "a small gearbox that idles": (
        CATALOGUE_30,
        "outside its range: ISO/TR 14521 (centre distance a, ratio u, losses without load 1.49 of "
        "P_2); BS 721 (axial module m, the worm is not rated)",
        {"iso14521": False, "bs721": True, "agma6034": True},
    ),
    "a small one with a fan": (
        SMALL_FAN,
        "holds by BS 721 and AGMA 6034; undecided by ISO/TR 14521 ISO/TR 14521 has no answer for "
        "wear, root and temperature: centre_distance is 26.6 mm; it must be above 48 mm",
        {"iso14521": None, "bs721": True, "agma6034": True},
    ),
    "a slow wheel": (
        SLOW_WHEEL,
        "holds by ISO/TR 14521 and AGMA 6034; no answer by BS 721 BS 721: wheel_speed is 0.75 rpm",
        {"iso14521": True, "bs721": None, "agma6034": True},
    ),
}


@pytest.fixture
def here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


def _top(asperity):
    code, shown, _ = asperity("rate", "own.toml")
    assert code == 0
    return " ".join(" ".join(shown.splitlines()[2:8]).split())


@pytest.mark.ordinary(1)
@pytest.mark.parametrize(("text", "said", "holds"), SAID.values(), ids=SAID)
def test_first_lines_name_every_standard_that_cannot_tell_or_rates_outside(
    asperity, here, text, said, holds
):
    (here / "own.toml").write_text(text)
    assert said in _top(asperity)
    verdict = json.loads(asperity("rate", "own.toml", "--json")[1])["verdict"]
    assert verdict["holds"] == holds
    for name, one in verdict["standing"].items():
        assert (one["word"] in ("no answer", "undecided")) == (holds[name] is None)


@pytest.mark.parametrize(
    "text",
    [
        CATALOGUE_100,
        *(
            pytest.param(each, marks=pytest.mark.slow)
            for each in (CATALOGUE_30, SMALL_FAN, SLOW_WHEEL)
        ),
    ],
    ids=SAID,
)
def test_a_comparison_and_the_report_have_the_words_of_the_first_lines(asperity, here, text):
    (here / "own.toml").write_text(text)
    top = _top(asperity)
    compared = " ".join(asperity("compare", "own.toml", "own.toml")[1].split())
    assert top.partition(";")[0] in compared
    assert asperity("rate", "own.toml", "--out", "out")[0] == 0
    report = (here / "out" / "report.html").read_text("utf-8")
    assert top.partition(";")[0] in " ".join(report.split())
    assert (here / "out" / "rate.xlsx").is_file()


def test_an_efficiency_outside_its_range_is_marked_as_such(asperity, here):
    (here / "own.toml").write_text(CATALOGUE_30)
    shown = " ".join(asperity("rate", "own.toml")[1].split())
    assert "efficiency 29.2 % of the gearbox, 52.7 % of the teeth (OUTSIDE ITS RANGE)" in shown
    # In its range it is not.
    assert "OUTSIDE" not in asperity("rate", "gearset-3")[1]


def test_a_standard_that_was_not_asked_for_is_not_missed(asperity, here):
    (here / "own.toml").write_text(CATALOGUE_100)
    shown = asperity("rate", "own.toml", "--standard", "agma6034")[1]
    assert shown.splitlines()[2] == "holds by AGMA 6034"


@pytest.mark.parametrize(
    "part",
    [0, *(pytest.param(n, marks=(pytest.mark.slow, pytest.mark.campaign)) for n in range(1, 44))],
)
def test_no_line_of_a_screen_is_longer_than_a_terminal_and_silence_never_holds(
    asperity, here, part
):
    for seed in range(5 * part, 5 * part + 5):
        (here / "own.toml").write_text(written(gearset(seed)))
        code, shown, errors = asperity("rate", "own.toml")
        assert code == 0, (seed, errors)
        assert max(map(len, shown.splitlines())) <= 79, seed
        verdict = json.loads(asperity("rate", "own.toml", "--json")[1])["verdict"]
        first = " ".join(shown.split())
        for name, one in verdict["standing"].items():
            missing = [path for path in verdict["unrated"] if path.startswith(name)]
            assert not (one["word"] == "holds" and missing), seed
            assert verdict["holds"].keys() == {"iso14521", "bs721", "agma6034"}
            for what in one["outside"]:
                assert what in first, (seed, what)

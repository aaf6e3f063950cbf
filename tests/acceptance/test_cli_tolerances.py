"""Tolerances as a user gives them to ``asperity rate`` and ``asperity flank``."""

import csv
import json
import re

import pytest

SET = "--set"
TEMPERATURES = 'tolerances.temperatures={ housing = "60 degC", gears = "70 degC" }'
WRONG = {
    "tolerances.centre_distance=jx7": "must be a symmetric deviation such as 'js7'",
    "tolerances.centre_distance=js3": "it must be one of 'js5'",
    "tolerances.centre_distance='7 s'": "must be a symmetric deviation such as 'js7'",
    "tolerances.thread='-40 um'": "must be a list of two lengths",
    'tolerances.thread=["-70 um", "-40 um"]': "the upper allowance and then the lower one",
    'tolerances.thread=["5 um", "-40 um"]': "number 1 of the list",
    'tolerances.thread=["-4 mm", "-5 mm"]': "threads up to 5 mm thinner",
    "tolerances.fit=Q": "must be one of 'H', 'E', 'D', 'C', 'B', 'A'",
    "tolerances.grade=3": "must be one of 6, 7, 8, 9",
    "tolerances.temperatures=60": "must be a table such as",
    'tolerances.temperatures={ hosing = "60 degC" }': "did you mean 'housing'",
    "tolerances.shaft_angle='9 deg'": "at most 5 deg",
    "tolerances.gread=8": "did you mean 'grade'",
}


def test_without_tolerances_nothing_is_said_of_them(asperity):
    assert "backlash" not in asperity("rate", "gearset-2")[1]
    assert "backlash" not in json.loads(asperity("rate", "gearset-2", "--json")[1])


@pytest.mark.slow
def test_rate_says_the_backlash_new_warm_and_worn(asperity):
    sets = SET, "tolerances.centre_distance=js7", SET, "tolerances.fit=C", SET, TEMPERATURES
    screen = asperity("rate", "gearset-2", *sets)[1]
    assert screen.count("\nbacklash ") == 1
    line = " ".join(screen.partition("\nbacklash ")[2].split())
    said = r"[\d.]+ to [\d.]+ arcmin at the wheel; [\d.]+ less warm; [\d.]+ more when worn"
    assert re.match(said, line)
    answer = json.loads(asperity("rate", "gearset-2", "--json", *sets)[1])["backlash"]
    assert answer["by"] == "by the exact flanks"
    assert answer["new"]["normal_min_um"] == pytest.approx(74.0)
    states = [answer[state]["circumferential_min_um"] for state in ("new", "warm", "worn")]
    # Gears that are warmer than their housing close it, wear opens it again.
    assert states[1] < states[0] < states[2]
    assert "Backlash, by the exact flanks" in asperity("rate", "gearset-2", "--full", *sets)[1]


@pytest.mark.parametrize("setting", WRONG)
def test_what_is_wrong_with_a_tolerance_is_one_line(asperity, setting):
    code, _, errors = asperity("rate", "gearset-2", SET, setting)
    assert code == 2
    assert WRONG[setting] in errors
    assert errors.count("\n") == 1


@pytest.mark.slow
def test_two_ways_to_say_a_thickness_are_one_line(asperity):
    for more, said in (
        (("mount.backlash='0.05 mm'", "tolerances.fit=C"), "mount.backlash and tolerances.fit"),
        (("measuring.thread_tolerance='20 um'", "tolerances.grade=8"), "measuring.thread_toler"),
    ):
        code, _, errors = asperity(
            "flank", "gearset-2", *(word for one in more for word in (SET, one))
        )
        assert code == 2
        assert said in errors


@pytest.mark.slow
def test_flank_has_limits_grades_and_corners(asperity, tmp_path):
    code, _, _ = asperity(
        "flank", "gearset-3b", "--density", "coarse", SET, "tolerances.centre_distance=js7",
        SET, 'tolerances.thread=["-40 um", "-70 um"]', SET, "tolerances.grade=8",
        SET, "tolerances.axial_offset='20 um'", "--out", tmp_path,
    )  # fmt: skip
    assert code == 0
    assert (tmp_path / "corners.png").stat().st_size > 10_000
    answer = json.loads((tmp_path / "flank.json").read_text())
    off, measured = answer["tolerances"], answer["measuring"]
    assert [corner["name"] for corner in off["corners"]] == [
        "a -, offset -", "a -, offset +", "a +, offset -", "a +, offset +",
    ]  # fmt: skip
    assert measured["thread_allowance_upper_mm"] == pytest.approx(-0.04)
    assert measured["thread_allowance_lower_mm"] == pytest.approx(-0.07)
    assert measured["over_pins_upper_mm"] > measured["over_pins_lower_mm"]
    assert measured["backlash_circumferential_min_mm"] == pytest.approx(
        1e-3 * off["backlash"]["new"]["circumferential_min_um"]
    )
    rows = list(csv.DictReader((tmp_path / "drawing.csv").read_text().splitlines()))
    by_symbol = {row["symbol"]: row for row in rows}
    assert by_symbol["f_px"]["on the drawing"] == "0.019"
    assert "grade 8, GOST 3675-81" in by_symbol["f_px"]["name"]
    assert by_symbol["f_a"]["value"] == "0.015"
    assert {"F_p2", "E_sn2,s"} <= set(by_symbol)

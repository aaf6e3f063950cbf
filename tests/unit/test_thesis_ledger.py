import doctest

import pytest

from asperity.thesis.products import Finding
from asperity.thesis.reproduce import page as report
from asperity.thesis.sliding.bodies import Body, Sweep
from asperity.thesis.sliding.claims import drive_stiffness


def finding(**parts):
    return Finding.judged(parts, "1.0", "Because.", {"ratio": 1.0}, ["asperity slide table-4.3"])


def test_a_claim_is_reproduced_if_every_part_holds():
    judged = finding(first=True, second=True)
    assert judged.verdict == "reproduced"
    assert judged.reason == "Because."


def test_a_claim_differs_if_one_part_fails_and_names_it():
    judged = finding(first=True, second=False)
    assert judged.verdict == "differs"
    assert judged.reason == "Holds: first. Does not hold: second. Because."


def test_a_claim_of_which_nothing_holds_claims_no_success():
    assert finding(only=False).reason == "Does not hold: only. Because."


def test_the_printed_points_give_the_printed_drive_stiffness():
    stiffness = drive_stiffness(
        0.5, 0.5e-3, (1.500001386, 1.500006410), (0.1833e-3, 0.2234e-3), 0.749175e-3, -3.91128
    )
    assert round(stiffness) == 96068


def test_a_body_at_rest_under_a_force_has_the_stiffness_of_a_spring():
    assert drive_stiffness(3.0, 1.0, (1.0, 2.0), (0.0, 0.0), 1.5, 10.0) == pytest.approx(20.0)


def test_a_body_knows_its_command():
    body = Body("table-4.3", ("solve.method=periodic", "vibration.direction=45 deg"))
    assert body.command() == (
        "asperity slide table-4.3 --set solve.method=periodic --set 'vibration.direction=45 deg'"
    )


def test_a_sweep_knows_its_command_its_values_and_its_models():
    sweep = Sweep(
        "table-4.4",
        (("vibration.velocity_ratio", "2,20"), ("vibration.direction", "0:90:45")),
        ("solve.method=periodic",),
    )
    assert sweep.command() == (
        "asperity sweep table-4.4 --over vibration.velocity_ratio=2,20 "
        "--over vibration.direction=0:90:45 --set solve.method=periodic"
    )
    assert sweep.values(0).tolist() == [2.0, 20.0]
    assert sweep.values(1).tolist() == [0.0, 45.0, 90.0]
    ratios = sweep.ratios()
    assert ratios.shape == (2, 3)
    for settings, ratio in (("2", "90"), ratios[0, 2]), (("20", "0"), ratios[1, 0]):
        given = ("vibration.velocity_ratio", "vibration.direction")
        one = [f"{key}={value}" for key, value in zip(given, settings, strict=True)]
        body = Body("table-4.4", ("solve.method=periodic", *one))
        assert ratio == pytest.approx(body.result.ratio, rel=1e-9)


def test_a_point_that_cannot_be_solved_is_not_passed_over():
    sweep = Sweep("table-4.3", (("vibration.velocity_ratio", "2,6"),), ("solve.duration=0.1 s",))
    with pytest.raises(ValueError, match=r"solve\.duration"):
        sweep.ratios()


def test_symbols_are_set_and_everything_else_is_escaped():
    assert report.typeset("k <= 1: v_a < v_d") == ("k ≤ 1: v<sub>a</sub> &lt; v<sub>d</sub>")
    assert doctest.testmod(report).failed == 0


def test_a_page_without_ledger_and_figures_says_how_to_get_them():
    page = report.render((), (), {}, "0.0")
    assert "asperity thesis" in page
    assert "✓" not in page

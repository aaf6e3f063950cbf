"""Whether steady sliding stays, or sticks and slips."""

import dataclasses
import math

import pytest

from asperity.casefile import read_case
from asperity.slider import TABLES, Model, solve
from asperity.slider.steady import growth_rate, still_leaves, until_it_sticks


def falling(faster):
    """A body whose friction falls with its speed; everything so many times as fast."""
    return Model.from_case(
        read_case(
            "table-4.3", TABLES,
            ["friction.model=lugre", "friction.static_mu=0.15",
             f"friction.stribeck_velocity={1e-3 * faster} m/s",
             f"slider.drive_velocity={0.5e-3 * faster} m/s", f"slider.mass={0.5 / faster**2} kg",
             f"friction.contact_damping={300.0 / faster} N s/m", "vibration.velocity_ratio=0"],
        )
    )  # fmt: skip


def test_a_body_that_does_all_of_it_faster_leaves_steady_sliding_as_much_faster():
    rate = growth_rate(falling(1.0))
    assert rate > 1.0
    assert growth_rate(falling(1e8)) == pytest.approx(1e8 * rate, rel=1e-6)


def test_a_march_beside_unstable_steady_sliding_has_not_settled_until_it_has_left():
    body = falling(1.0)
    rate = growth_rate(body)
    half = 0.5 / rate
    grown = math.exp(0.5)
    assert "has not come to stick and slip" in still_leaves(body, half, (1e-4, 1e-4 * grown))
    assert still_leaves(body, half, (1e-4, 1e-4)) == ""
    assert still_leaves(body, half, (0.3 / grown, 0.3)) == ""
    # Too short for its growth to be seen, what swings little may be on its way.
    assert still_leaves(body, 0.01 / rate, (1e-4, 1e-4))
    # But not after so long that rounding has grown to what sticks: such a body keeps a small swing.
    longest = math.log(0.5 / 1e-12) / rate
    assert still_leaves(body, 0.01 / rate, (1e-4, 1e-4), 0.99 * longest)
    assert still_leaves(body, 0.01 / rate, (1e-4, 1e-4), 1.01 * longest) == ""
    assert until_it_sticks(body, 1e-4) == pytest.approx(math.log(0.5 / 1e-4) / rate)
    steady = falling(1.0).__class__(
        body.slider, body.friction.model_copy(update={"static_mu": 0.1})
    )
    assert still_leaves(steady, half, (1e-4, 1e-4 * grown)) == ""


@pytest.mark.slow
def test_a_body_that_rings_for_ever_on_its_drive_has_settled_in_the_mean_and_says_what_it_does():
    """It comes to its swing at once and keeps it; the mean is that of steady sliding to 1e-3."""
    body = Model.from_case(
        read_case(
            "table-4.3", TABLES,
            ["slider.drive_velocity=8.6 mm/s", "slider.normal_force=5.18 N",
             "slider.mass=0.4866 kg", "slider.drive_stiffness=66.4 MN/m",
             "slider.drive_damping=0 N s/m", "slider.lateral=guided", "friction.model=lugre",
             "friction.mu=0.568", "friction.static_mu=0.7014", "friction.max_deflection=0.053 um",
             "friction.stribeck_velocity=2.99 mm/s", "vibration.velocity_ratio=0",
             "solve.duration=0.6 s"],
        )
    )  # fmt: skip
    found = solve(body, history=False)
    assert found.settled
    assert any("steady sliding is unstable" in note for note in found.notes)
    assert found.ratio == pytest.approx(1.0025, abs=1e-3)


@pytest.mark.slow
@pytest.mark.parametrize("method", ["march", "periodic"])
def test_who_sticks_and_slips_is_sent_to_no_other_method_nor_to_a_longer_march(method):
    """Its window of 0.4 s holds less than one slip of a soft drive: no duration does."""
    body = falling(1.0)
    table = body.solve.model_copy(update={"method": method, "duration": 2.0}, units="SI")
    slider = body.slider.model_copy(update={"drive_stiffness": 2e4}, units="SI")
    found = solve(dataclasses.replace(body, slider=slider, solve=table), history=False)
    assert not found.settled
    said = " ".join(found.notes)
    assert "no solve.duration is foreseen" in said
    assert "whole slips" in said
    assert not any(other in said for other in ("'periodic'", "'march'", "longer", "would do, by"))


@pytest.mark.slow
def test_a_window_of_few_slips_has_not_settled_though_its_halves_agree():
    """Where in a slip the window ends moves the mean by 0.7 %: two durations, two ratios."""
    sticks = (
        "vibration.velocity_ratio=0", "friction.model=lugre", "friction.mu=0.1",
        "friction.static_mu=0.158455", "friction.stribeck_velocity=2.29293 mm/s",
        "slider.drive_velocity=0.846896 mm/s", "slider.mass=0.0928557 kg",
        "slider.drive_stiffness=289494 N/m", "slider.drive_damping=9.76411 N s/m",
        "solve.method=march", "solve.step=10 us",
    )  # fmt: skip
    found = [
        solve(
            Model.from_case(read_case("table-4.3", TABLES, [*sticks, f"solve.duration={end} s"])),
            history=False,
        )
        for end in (1.195, 1.6)
    ]
    assert abs(found[0].ratio - found[1].ratio) > 5e-3
    for one in found:
        assert not one.settled
        assert "slips in the window" in one.settled_by

"""How asperities are taken up whose slip keeps its direction: by a law, and by marches."""

import numpy as np
import pytest
from apparatus.grid import grid

from asperity.casefile import read_case
from asperity.slider import TABLES, Model, solve
from asperity.slider.longer import lasting
from asperity.slider.taken_up import taken_up_after


def still(*settings):
    """A body that nothing shakes."""
    plain = "vibration.velocity_ratio=0", "vibration.start=0 s"
    return Model.from_case(read_case("table-4.3", TABLES, [*plain, *settings]))


SLOW = "slider.drive_damping=100 N s/m", "solve.duration=0.1 s", "slider.drive_velocity=2 mm/s"


def foreseen(answer):
    (said,) = [note for note in answer.notes if "would do, by the means" in note]
    return float(said.split()[3])


@pytest.mark.slow
@pytest.mark.parametrize(
    ("exponent", "bends"),
    grid(
        [1.02, 1.05, 1.1, 1.3], [20, 400], ordinary=[(1.02, 400), (1.05, 20), (1.1, 400), (1.3, 20)]
    ),
)
def test_the_first_duration_that_is_foreseen_does_whatever_the_exponent(exponent, bends):
    body = still(f"friction.exponent={exponent}", f"friction.max_deflection={bends} um", *SLOW)
    first = solve(body, history=False)
    assert not first.settled
    late = solve(lasting(body, foreseen(first)), history=False)
    assert late.settled
    assert late.ratio == pytest.approx(1.0, abs=2e-3)


@pytest.mark.slow
def test_a_body_that_never_bears_all_of_its_friction_slides_for_all_that():
    body = still("friction.exponent=1.3", "friction.max_deflection=5 um", *SLOW)
    found = solve(lasting(body, 1.0), history=False)
    assert found.breakaway_time is None
    assert found.settled
    assert not any("broken away" in note for note in found.notes)


@pytest.mark.parametrize("exponent", [0.5, 1.0, 1.5, 2.0])
def test_asperities_are_taken_up_when_their_law_says_so(exponent):
    """The equation by small steps: halves of the window within 8e-4, its mean within 1.6e-3."""
    body = still(f"friction.exponent={exponent}", "friction.max_deflection=400 um", *SLOW)
    bends, velocity = 400e-6, body.slider.drive_velocity
    stretch = body.full_friction / body.slider.drive_stiffness
    way, lacks = [0.0], np.geomspace(1.0, 1e-7, 400_001)
    middle = np.sqrt(lacks[1:] * lacks[:-1])
    way = np.append(0.0, np.cumsum((bends * middle**-exponent + stretch) * -np.diff(lacks)))
    found = taken_up_after(body) / 1.02
    window = min(body.window, 0.75 * found)
    times = found - window + window * (np.arange(1000) + 0.5) / 1000
    early, late = np.interp(times * velocity, way, lacks).reshape(2, 500).mean(axis=1)
    worst = max(early - late, 0.5 * (early + late) - 8e-4)
    assert worst == pytest.approx(8e-4, rel=0.05)


def test_nothing_is_waited_for_that_does_not_bend_or_is_bent_back():
    assert taken_up_after(still("friction.model=coulomb")) == 0.0
    back = still("friction.exponent=2", "vibration.velocity_ratio=2")
    assert taken_up_after(back) == 0.0


def test_what_takes_more_than_a_thousand_usual_durations_has_none():
    body = still("friction.exponent=3", "friction.max_deflection=1 mm", *SLOW)
    assert taken_up_after(body) is None


@pytest.mark.parametrize("exponent", [0.5, 1, 1.2])
def test_a_still_body_whose_friction_lacks_something_has_not_settled(exponent):
    """Halves of a ring on the drive agree now and then; all that slides comes to mu F_N."""
    body = still(
        "slider.drive_velocity=1.39 mm/s", "slider.mass=8.63 kg",
        "slider.drive_stiffness=92300 N/m", "slider.drive_damping=10 N s/m",
        f"friction.exponent={exponent}", "friction.max_deflection=0.852 um", "solve.duration=0.1 s",
    )  # fmt: skip
    answer = solve(body, history=False)
    assert not answer.settled
    assert answer.ratio < 0.97

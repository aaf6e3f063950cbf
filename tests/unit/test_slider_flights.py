"""Bodies that are thrown for long: the free flight of a mass under a dead load."""

from types import SimpleNamespace

import pytest
from apparatus.grid import slow

from asperity.casefile import read_case
from asperity.slider import TABLES, Model, solve
from asperity.slider.flights import longest_flight

THROWN = (
    "slider.drive_velocity=1 mm/s", "slider.normal_force=30 N", "slider.mass=0.5 kg",
    "slider.lateral=guided", "friction.model=coulomb", "friction.mu=0.3", "normal.law=hertz",
    "normal.stiffness=1 MN/m", "normal.damping_ratio=0.05", "vibration.frequency=4 kHz",
    "vibration.elevation=90 deg", "vibration.start=0 s", "solve.method=march",
)  # fmt: skip


def thrown(ratio, duration):
    settings = (*THROWN, f"vibration.velocity_ratio={ratio}", f"solve.duration={duration}")
    case = read_case("normal-pin", TABLES, settings)
    rest = {"solve.step": None, "slider.drive_stiffness": None, "slider.drive_damping": None}
    model = Model.from_case(case.replace_values(rest))
    return solve(model, history=False)


def flight(penetration, rise, load=0.0, least=0.0):
    """Of a body that gains 1e-3 a step of 1 ms, way in steps of its velocity."""
    loading = SimpleNamespace(mobility=1e-3, base=0.0)
    state = {"load": load, "penetration": penetration, "rise": rise}
    table, sums = SimpleNamespace(step=1e-3), {"penetration_min": least}
    return longest_flight(SimpleNamespace(q=loading, state=state), table, sums)


def test_a_flight_lasts_as_long_as_a_thrown_mass_is_up():
    # v = 2 a step: up for 2000 steps, and down for as many; as from halfway up.
    assert flight(0.0, 2.0) == pytest.approx(4.0)
    height = 2.0 * 1000 - 0.5 * 1e-3 * 1000**2
    assert flight(-height, 1.0) == flight(-height, -1.0) == pytest.approx(4.0)
    # Of one that has landed, by how high it was.
    assert flight(0.1, 0.0, load=1.0, least=-2000.0) == pytest.approx(4.0)
    assert flight(0.1, 0.0, load=1.0, least=0.1) == 0.0
    rigid = SimpleNamespace(q=SimpleNamespace(mobility=0.0, base=0.0), state={})
    assert longest_flight(rigid, SimpleNamespace(step=1.0), {}) == 0.0
    assert longest_flight(SimpleNamespace(state={}), SimpleNamespace(step=1.0), {}) == 0.0


@pytest.mark.slow
@pytest.mark.parametrize(
    ("ratio", "duration"),
    [(1e5, "10 ms"), (1e5, "20 ms"), (1e5, "0.1 s"), slow(1e5, "0.4 s"), slow(1e4, "0.4 s")],
)
def test_a_body_in_free_flight_is_told_no_duration(ratio, duration):
    """It was told 0.8 s: it lands as chance has it, and has not settled then or in 3 s."""
    answer = thrown(ratio, duration)
    assert not answer.settled
    assert answer.notes[-1].startswith("no solve.duration is foreseen")


def test_one_that_hops_many_times_in_a_window_is_told_one_that_does():
    answer = thrown(1e3, "10 ms")
    assert not answer.settled
    assert "a solve.duration of 0.8 s would do" in answer.notes[-1]
    assert thrown(1e3, "0.8 s").settled

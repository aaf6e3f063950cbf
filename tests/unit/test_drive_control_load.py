"""The load of a stroke by the wheel's turn, and how long its vibration takes to come."""

import math
from types import SimpleNamespace

import pytest

from asperity.drive.control.machine import load_at, rise_of, seat_and_between


def drive(*, through=None, actuator=None):
    operation = SimpleNamespace(output_torque=60.0, travel_share=0.4, through_travel_torque=through)
    return SimpleNamespace(
        drive=SimpleNamespace(stroke=1.6, stroke_seat=0.2), operation=operation, actuator=actuator
    )


@pytest.mark.parametrize(("through", "between"), [(None, 24.0), (10.0, 10.0), (70.0, 70.0)])
def test_a_seat_s_load_goes_straight_over_to_that_of_the_way_and_back(through, between):
    problem, control = drive(through=through), SimpleNamespace(seat_edge=0.1)
    assert seat_and_between(problem) == (60.0, between)
    quarter = 60.0 + 0.25 * (between - 60.0)
    for turn, load in (
        (-0.01, 60.0), (0.0, 60.0), (0.2, 60.0), (0.225, quarter), (0.25, 30.0 + 0.5 * between),
        (0.3, between), (0.8, between),
    ):  # fmt: skip
        # The same from either end.
        assert load_at(problem, control, turn) == pytest.approx(load)
        assert load_at(problem, control, 1.6 - turn) == pytest.approx(load)


def test_an_amplitude_comes_as_its_resonator_rings_unless_it_is_given_or_coupled():
    actuator = SimpleNamespace(quality_factor=250.0)
    given, free = SimpleNamespace(rise=2e-3, kind="load"), SimpleNamespace(rise=None, kind="load")
    coupled = SimpleNamespace(rise=None, kind="clutch")
    assert rise_of(drive(actuator=actuator), given, 20e3) == 2e-3
    # An amplitude falls by e in Q/pi cycles.
    assert rise_of(drive(actuator=actuator), free, 20e3) == pytest.approx(250.0 / math.pi / 20e3)
    assert rise_of(drive(actuator=actuator), coupled, 20e3) == 0.0
    assert rise_of(drive(), free, 20e3) == 0.0

"""A body without vibration on a soft drive: sliding steadily or sticking and slipping, by its past.

LuGre friction as Canudas de Wit et al. (1995) have it, integrated from two starts by another
integrator: where the damping outdoes the fall of friction at the drive's speed but not that from
rest, both states last.
"""

import numpy as np
import pytest
from apparatus.grid import slow
from scipy.integrate import solve_ivp

from asperity.friction import Friction
from asperity.slider import Model, Slider, Solve, solve

MASS, SPRING, LOAD, MU, STATIC = 0.5, 1e6, 50.0, 0.2, 0.4
ASPERITIES, STRIBECK, OF_RATE, VISCOUS = 1e7, 3e-3, 300.0, 10.0


def body(speed, method, viscous=VISCOUS, **asked):
    slider = Slider(
        drive_velocity=speed, normal_force=LOAD, drive_stiffness=SPRING, mass=MASS, units="SI"
    )
    friction = Friction(
        model="lugre", mu=MU, static_mu=STATIC, tangential_stiffness=ASPERITIES,
        stribeck_velocity=STRIBECK, contact_damping=OF_RATE, viscous_damping=viscous, units="SI",
    )  # fmt: skip
    return Model(slider, friction, None, Solve(method=method, **asked, units="SI"))


def swing_alone(speed, start, viscous=VISCOUS):
    """How far friction swings over mu N after 0.5 s, by another integrator, and its mean."""

    def friction(v, z):
        limit = LOAD * (MU + (STATIC - MU) * np.exp(-((v / STRIBECK) ** 2)))
        rate = v - np.abs(v) * ASPERITIES * z / limit
        return ASPERITIES * z + OF_RATE * rate + viscous * v, rate

    def rates(_, state):
        stretch, v, z = state
        force, rate = friction(v, z)
        return [speed - v, (SPRING * stretch - force) / MASS, rate]

    times = np.linspace(0.5, 0.55, 4001)
    answer = solve_ivp(
        rates, (0.0, times[-1]), start, method="LSODA", rtol=1e-8, atol=1e-12, t_eval=times
    )
    force = friction(answer.y[1], answer.y[2])[0] / (MU * LOAD)
    return float(np.ptp(force)), float(force.mean())


def steady(speed, viscous=VISCOUS):
    return (
        1.0
        + (STATIC / MU - 1.0) * np.exp(-((speed / STRIBECK) ** 2))
        + (viscous * speed / (MU * LOAD))
    )


@pytest.mark.slow
def test_another_integrator_stays_in_either_state():
    speed = 0.012
    force = MU * LOAD * steady(speed) - VISCOUS * speed
    sliding = [MU * LOAD * steady(speed) / SPRING, 0.999 * speed, force / ASPERITIES]
    assert swing_alone(speed, sliding)[0] < 1e-3
    swing, mean = swing_alone(speed, [0.0, 0.0, 0.0])
    found = solve(body(speed, "march", duration=0.5), history=False)
    assert found.ratio == pytest.approx(mean, abs=0.03)
    shown = (found.friction_x_max - found.friction_x_min) / (MU * LOAD)
    assert shown == pytest.approx(swing, rel=0.05)


@pytest.mark.ordinary(1)
@pytest.mark.parametrize("method", ["periodic", "march"])
def test_of_two_states_that_last_the_one_from_rest_is_shown_and_the_other_told(method):
    found = solve(body(0.012, method, duration=0.3), history=False)
    assert found.ratio > steady(0.012) + 0.01
    assert found.friction_x_max - found.friction_x_min > MU * LOAD
    (note,) = (each for each in found.notes if "sticks and slips" in each)
    assert f"steady sliding, with the ratio {steady(0.012):.5g}, would last as well" in note
    assert "which is shown" in note


@pytest.mark.slow
@pytest.mark.parametrize(
    ("viscous", "method"), [(VISCOUS, "periodic"), (300.0, "march"),
                            slow(VISCOUS, "march"), slow(300.0, "periodic")],
)  # fmt: skip
def test_a_body_that_comes_to_sliding_from_rest_is_told_of_no_other_state(method, viscous):
    found = solve(body(0.02, method, viscous, duration=1.0), history=False)
    assert found.settled
    assert found.ratio == pytest.approx(swing_alone(0.02, [0.0, 0.0, 0.0], viscous)[1], abs=1e-3)
    assert not any("slips" in each or "may stick" in each for each in found.notes)


def test_where_following_it_from_rest_takes_too_long_that_is_said():
    slow = body(0.02, "periodic", step=1e-8)
    found = solve(slow, history=False)
    assert found.ratio == pytest.approx(steady(0.02), rel=1e-6)
    assert any("may stick and slip instead" in each for each in found.notes)

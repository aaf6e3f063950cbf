"""Implicit motion of a few coordinates, and of a condensed body on its contact."""

import numpy as np
import pytest

from asperity.contact import hht
from asperity.errors import InputError


def swing(steps, *, alpha, period=1.0, spring=None):
    """March one mass on a spring for a period from a displacement of one; return state and loss."""
    omega = 2.0 * np.pi / period
    step = period / steps
    mass = np.array([[2.0]])
    linear = np.array([[2.0 * omega**2]]) if spring is None else np.zeros((1, 1))
    operator = hht.step_operator(mass, linear, step, alpha=alpha)
    state = hht.rest(1)
    state[hht.PLACE] = 1.0
    state[hht.FORCE] = linear[0] if spring is None else -spring(1.0)
    state[hht.ACCELERATION] = -state[hht.FORCE] / 2.0
    trial, place, velocity = hht.rest(1), np.empty(1), np.empty(1)
    known, force = np.zeros(1), np.zeros(1)
    lost = work = 0.0
    for _ in range(steps):
        hht.predict(
            state, known, operator.carry, operator.compliance, operator.scalars, place, velocity
        )
        last = force.copy()
        if spring is not None:
            last[0] = spring(state[hht.PLACE, 0])
            free = place[0]
            for _ in range(100):
                place[0] = free + operator.compliance[0, 0] * spring(place[0])
            force[0] = spring(place[0])
        lost += hht.complete(
            state, trial, place, force, mass, linear, operator.held, operator.scalars
        )
        work += 0.5 * (last + force) @ (trial[hht.PLACE] - state[hht.PLACE])
        state, trial = trial, state
    kinetic = 1.0 * state[hht.VELOCITY, 0] ** 2
    stored = 0.5 * linear[0, 0] * (state[hht.PLACE, 0] ** 2 - 1.0) + kinetic
    return state, lost, work, stored


def test_the_method_is_of_second_order():
    errors = [abs(swing(n, alpha=-0.05)[0][hht.PLACE, 0] - 1.0) for n in (40, 80)]
    velocities = [abs(swing(n, alpha=-0.05)[0][hht.VELOCITY, 0]) for n in (40, 80)]
    assert np.log2(velocities[0] / velocities[1]) == pytest.approx(2.0, abs=0.05)
    assert errors[1] < errors[0] / 4.0


def test_without_alpha_a_linear_swing_keeps_its_energy():
    state, lost, _, stored = swing(30, alpha=0.0)
    assert lost == pytest.approx(0.0, abs=1e-12)
    assert stored == pytest.approx(0.0, abs=1e-10 * state[hht.ACCELERATION, 0] ** 2)


@pytest.mark.parametrize("alpha", [-0.05, -1.0 / 3.0])
def test_the_energy_the_method_takes_is_what_is_missing(alpha):
    _, lost, _, stored = swing(30, alpha=alpha)
    assert lost > 0.0
    assert lost == pytest.approx(-stored, rel=1e-9)


def test_the_energy_the_method_takes_is_exact_for_any_force():
    _, lost, work, stored = swing(25, alpha=-0.1, spring=lambda x: -40.0 * x * abs(x))
    assert lost > 0.0
    assert work - lost == pytest.approx(stored, rel=1e-9)


def test_a_held_coordinate_goes_on_whatever_pushes_it():
    mass, none = np.diag([2.0, 3.0]), np.zeros((2, 2))
    operator = hht.step_operator(mass, none, 0.1, held=np.array([True, False]))
    state, trial = hht.rest(2), hht.rest(2)
    state[hht.VELOCITY, 0] = 4.0
    place, velocity, force = np.empty(2), np.empty(2), np.array([7.0, 0.0])
    hht.predict(
        state, np.zeros(2), operator.carry, operator.compliance, operator.scalars, place, velocity
    )
    place += operator.compliance @ force
    lost = hht.complete(state, trial, place, force, mass, none, operator.held, operator.scalars)
    assert (place[0], trial[hht.VELOCITY, 0], place[1]) == pytest.approx((0.4, 4.0, 0.0))
    assert trial[hht.REACTION, 0] == -7.0
    assert lost == 0.0


@pytest.mark.parametrize("alpha", [0.1, -0.5])
def test_a_method_that_is_not_stable_is_refused(alpha):
    with pytest.raises(InputError, match=r"between -1/3 and 0"):
        hht.coefficients(alpha)

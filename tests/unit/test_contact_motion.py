"""Implicit motion of a few coordinates, and of a condensed body on its contact."""

import dataclasses

import numpy as np
import pytest
from apparatus.implicit import completed, predicted

from asperity.contact.interface.normal import NormalLaw, pressure
from asperity.contact.motion import hht, ledger
from asperity.contact.motion import mechanism as motion
from asperity.contact.motion.works import potential
from asperity.errors import InputError

pytestmark = pytest.mark.usefixtures("plain_kernels")


def swing(steps, *, alpha, period=1.0, spring=None, damping=0.0):
    """March one mass on a spring for a period from a displacement of one.

    Return its state, what the method and the damping took, the work of the spring, and the change
    of the energy.
    """
    omega = 2.0 * np.pi / period
    step = period / steps
    mass = np.array([[2.0]])
    linear = np.array([[2.0 * omega**2]]) if spring is None else np.zeros((1, 1))
    operator = hht.step_operator(mass, linear, step, damping=np.array([damping]), alpha=alpha)
    state = hht.Coordinates.at_rest(1, place=np.ones(1))
    resisting = linear[0] if spring is None else -np.array([spring(1.0)])
    state = state._replace(force=resisting, acceleration=-resisting / 2.0)
    force, lost, work = np.zeros(1), np.zeros(2), 0.0
    for _ in range(steps):
        place = predicted(operator, state)
        last = force.copy()
        if spring is not None:
            last[0] = spring(state.place[0])
            free = place[0]
            for _ in range(100):
                place[0] = free + operator.compliance[0, 0] * spring(place[0])
            force = np.array([spring(place[0])])
        before = state
        state, *taken = completed(operator, before, place, force)
        lost += np.array(taken)
        work += 0.5 * (last + force) @ (state.place - before.place)
    kinetic = 1.0 * state.velocity[0] ** 2
    stored = 0.5 * linear[0, 0] * (state.place[0] ** 2 - 1.0) + kinetic
    return state, lost, work, stored


def test_the_method_is_of_second_order():
    errors = [abs(swing(n, alpha=-0.05)[0].place[0] - 1.0) for n in (40, 80)]
    velocities = [abs(swing(n, alpha=-0.05)[0].velocity[0]) for n in (40, 80)]
    assert np.log2(velocities[0] / velocities[1]) == pytest.approx(2.0, abs=0.05)
    assert errors[1] < errors[0] / 4.0


def test_without_alpha_a_linear_swing_keeps_its_energy():
    state, lost, _, stored = swing(30, alpha=0.0)
    assert lost == pytest.approx([0.0, 0.0], abs=1e-12)
    assert stored == pytest.approx(0.0, abs=1e-10 * state.acceleration[0] ** 2)


@pytest.mark.parametrize("alpha", [-0.05, -1.0 / 3.0])
def test_the_energy_the_method_takes_is_what_is_missing(alpha):
    _, (lost, damped), _, stored = swing(30, alpha=alpha)
    assert lost > 0.0
    assert lost == pytest.approx(-stored, rel=1e-9)
    assert damped == 0.0


@pytest.mark.parametrize("alpha", [0.0, -0.05])
def test_a_damped_swing_loses_to_its_damping_what_the_method_does_not_take(alpha):
    _, (lost, damped), _, stored = swing(30, alpha=alpha, damping=0.3)
    assert damped > 100.0 * abs(lost)
    assert lost + damped == pytest.approx(-stored, rel=1e-9)


def test_a_damped_swing_dies_away_as_its_closed_form_to_second_order():
    # x = exp(-z w t) [cos(w_d t) + z w/w_d sin(w_d t)], w_d = w sqrt(1 - z^2), after one period.
    ratio, omega = 0.1, 2.0 * np.pi
    damped = omega * np.sqrt(1.0 - ratio**2)
    exact = np.exp(-ratio * omega) * (np.cos(damped) + ratio * omega / damped * np.sin(damped))
    errors = [
        abs(swing(n, alpha=-0.05, damping=2.0 * ratio * 2.0 * omega)[0].place[0] - exact)
        for n in (80, 160)
    ]
    assert np.log2(errors[0] / errors[1]) == pytest.approx(2.0, abs=0.1)
    assert errors[1] < 2e-3


def test_the_energy_the_method_takes_is_exact_for_any_force():
    _, (lost, _), work, stored = swing(25, alpha=-0.1, spring=lambda x: -40.0 * x * abs(x))
    assert lost > 0.0
    assert work - lost == pytest.approx(stored, rel=1e-9)


def test_a_held_coordinate_goes_on_whatever_pushes_it():
    mass, none = np.diag([2.0, 3.0]), np.zeros((2, 2))
    operator = hht.step_operator(mass, none, 0.1, held=np.array([True, False]))
    state = hht.Coordinates.at_rest(2, velocity=np.array([4.0, 0.0]))
    force = np.array([7.0, 0.0])
    place = predicted(operator, state) + operator.compliance @ force
    end, *taken = completed(operator, state, place, force)
    assert (end.place[0], end.velocity[0], end.place[1]) == pytest.approx((0.4, 4.0, 0.0))
    assert end.reaction[0] == -7.0
    assert taken == [0.0, 0.0]


@pytest.mark.parametrize("alpha", [0.1, -0.5])
def test_a_method_that_is_not_stable_is_refused(alpha):
    with pytest.raises(InputError, match=r"between -1/3 and 0"):
        hht.coefficients(alpha)


def random_mechanism(seed=0, *, damping=30.0, modes=1):
    """Build two contact nodes on three free coordinates and modes, pulled by a drive, loaded."""
    rng = np.random.default_rng(seed)
    size, count = 3 + modes, 6
    root = rng.normal(size=(count, count))
    mass = np.diag(rng.uniform(0.5, 2.0, size))
    stiffness = np.diag([0.0] * 3 + [4e4] * modes)
    drive = motion.Drive(
        motion.Port(rng.normal(size=size), 1e-6 * rng.normal(size=count), 2e-6), 5e3, damping
    )
    load = motion.Port(rng.normal(size=size), 1e-6 * rng.normal(size=count))
    return motion.Mechanism(
        flexibility=1e-6 * (root @ root.T),
        shapes=rng.normal(size=(count, size)),
        mass=mass,
        stiffness=stiffness,
        held=np.zeros(size, bool),
        drive=drive,
        load=load,
        damping=np.array([0.0] * 3 + [20.0] * modes),
    )


def one_step(mechanism, step, springs, state, drive_state, far, speed):
    """Take a step on linear springs under the contact nodes; also what it takes from the energy."""
    moving = motion.motion_step(mechanism, step)
    imposed = motion.Imposed(far, speed, 1.0)
    start = motion.approached(moving, state, drive_state, imposed)
    u = np.linalg.solve(np.eye(len(springs)) + moving.compliance * springs, start.free)
    end, now = motion.settled(moving, state, drive_state, imposed, start, -springs * u)
    return u, end, now.drive, (now.lost, now.damped)


def test_a_step_solves_motion_deformation_drive_and_contact_at_once():
    mechanism, step = random_mechanism(), 1e-3
    springs = np.array([2e5, 1e4, 3e5, 0.0, 5e4, 1e5])
    size, drive, load = mechanism.size, mechanism.drive, mechanism.load
    q0, v0, a0 = np.random.default_rng(1).normal(size=(3, size)) * [[1e-4], [1e-2], [1.0]]
    state = hht.Coordinates.at_rest(
        size, place=q0, velocity=v0, acceleration=a0, force=np.array([3.0, -2.0, 1.0, 5.0])
    )
    drive_state = motion.DriveState(strain=3e-6)
    far, speed = 2e-3, 0.7
    u, trial, drive_trial, _ = one_step(mechanism, step, springs, state, drive_state, far, speed)
    q, v, a = trial.place, trial.velocity, trial.acceleration
    force, pull = -springs * u, drive_trial.force
    strain = drive.port.response @ force + drive.port.own * pull
    way = drive.port.generalised @ q + strain
    pace = drive.port.generalised @ v + (strain - drive_state.strain) / step
    assert pull == pytest.approx(
        drive.stiffness * (far - way) + drive.damping * (speed - pace), rel=1e-9
    )
    shown = mechanism.shapes @ q + mechanism.flexibility @ force
    shown += drive.port.response * pull + load.response
    assert u == pytest.approx(shown, rel=1e-9)
    resistance = mechanism.stiffness @ q + mechanism.damping * v - mechanism.shapes.T @ force
    resistance -= drive.port.generalised * pull + load.generalised
    left = mechanism.mass @ a + (1.0 + hht.ALPHA) * resistance - hht.ALPHA * state.force
    assert left == pytest.approx(np.zeros(size), abs=1e-9 * np.abs(resistance).max())
    beta, gamma = hht.coefficients()
    ahead = q0 + step * v0 + step**2 * ((0.5 - beta) * a0 + beta * a)
    assert q == pytest.approx(ahead, rel=1e-9)
    assert v == pytest.approx(v0 + step * ((1 - gamma) * a0 + gamma * a), rel=1e-9)


def test_without_a_dashpot_the_compliance_is_symmetric_and_positive():
    compliance = motion.motion_step(random_mechanism(damping=0.0), 1e-3).compliance
    assert compliance == pytest.approx(compliance.T, rel=1e-12)
    assert np.linalg.eigvalsh(compliance).min() > 0.0


def test_the_energy_of_motion_deformation_and_spring_balances_the_works():
    mechanism, step = random_mechanism(), 1e-3
    springs = np.array([2e5, 1e4, 3e5, 0.0, 5e4, 1e5])
    state, drive_state = hht.Coordinates.at_rest(mechanism.size), motion.DriveState()
    u0, force0, far = np.zeros(6), np.zeros(6), 0.0
    energy0, supplied = None, 0.0
    for n in range(200):
        far += 1e-5
        u, trial, drive_trial, lost = one_step(
            mechanism, step, springs, state, drive_state, far, 1e-2
        )
        force = -springs * u
        if n > 0:
            supplied += 0.5 * (drive_state.force + drive_trial.force) * 1e-5
            supplied += 0.5 * (force0 + force) @ (u - u0)
            supplied += mechanism.load.generalised @ (trial.place - state.place)
            supplied += mechanism.load.response @ (force - force0)
            pull = 0.5 * (drive_state.pull + drive_trial.pull)
            supplied -= sum(lost) + pull * (drive_trial.stretch - drive_state.stretch)
        state, drive_state, u0, force0 = trial, drive_trial, u, force
        if n == 0:
            energy0 = ledger.body_energies(mechanism, state, drive_state, force, 1.0).total
    change = ledger.body_energies(mechanism, state, drive_state, force0, 1.0).total - energy0
    assert change == pytest.approx(supplied, rel=1e-8)


def test_a_drive_without_stiffness_is_refused():
    mechanism = random_mechanism()
    drive = motion.Drive(mechanism.drive.port, 0.0)
    with pytest.raises(InputError, match="a stiffness of 0 N/m"):
        motion.motion_step(dataclasses.replace(mechanism, drive=drive), 1e-3)


@pytest.mark.parametrize("over", [0.5e-6, 1.5e-6, 4e-6])
@pytest.mark.parametrize(
    "law", [NormalLaw("linear", 2e13), NormalLaw("two-stage", 2e13, 3e12, 1e-6, 3e-6)]
)
def test_the_energy_of_the_overclosure_is_the_integral_of_the_pressure(law, over):
    at = np.linspace(0.0, over, 20_001)
    pressures = np.array([pressure(x, 0.0, law.numbers)[0] for x in at])
    assert potential(over, law.numbers) == pytest.approx(np.trapezoid(pressures, at), rel=1e-6)

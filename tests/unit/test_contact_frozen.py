"""Increments solved with kept tangents: few iterations, and none trusted beyond its digits."""

import dataclasses

import numpy as np
import pytest

from asperity.block.problem import BlockProblem
from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.contact.increment import ContactState, IncrementSolver
from asperity.contact.increment.iterations import CONVERGED, SLOW, _terminate
from asperity.contact.increment.tangents import factored
from asperity.contact.motion.rest import rest_under_load
from asperity.contact.motion.steps import Stepper

pytestmark = pytest.mark.usefixtures("plain_kernels")

SMALL = ("block.elements=[4,3,3]", "block.element=hex8", "vibration.start=0 s")
MARCHES = {
    "along": ("block-longitudinal",),
    "across": ("block-transverse",),
    "with modes": ("block-transverse", "block.modes=4"),
    "guided": ("block-longitudinal", "slider.lateral=guided"),
}


def walking(name):
    case, *settings = MARCHES[name]
    problem = BlockProblem.from_case(read_case(case, case_tables(), [*SMALL, *settings]))
    return Stepper(problem.system, rest_under_load(problem.system, problem.loads))


@pytest.mark.parametrize("step", [1e-6, 1e-5])
@pytest.mark.parametrize("name", MARCHES)
def test_increments_of_a_shaken_block_take_four_iterations_and_never_a_newton_step(name, step):
    stepper = walking(name)
    numbers = []
    for number in range(1, 301):
        stepper.step_to(number * step, step)
        numbers.append(stepper.state.contact.iterations)
    assert np.mean(numbers[50:]) < 4.2
    # Newton steps begin with two evaluations of the guess, and come after a tangent has failed.
    assert max(numbers[50:]) <= 6


def test_a_kept_tangent_finds_what_newtons_method_finds():
    stepper = walking("across")
    step = 1e-5
    for number in range(1, 31):
        stepper.step_to(number * step, step)
    solver = stepper.stepping(step).solver
    problem = solver.problem
    motion, _ = stepper.system.surface_motion(30 * step, 31 * step)
    state = stepper.state.contact.state
    free = state.displacement - problem.flexibility @ state.force
    kept = solver.solve(free, motion, state)
    unprepared = dataclasses.replace(state, predictor=ContactState.rest(problem).predictor)
    alone = IncrementSolver(problem).solve(free, motion, unprepared)
    assert kept.iterations < alone.iterations
    assert kept.force == pytest.approx(alone.force, abs=1e-8 * np.abs(alone.force).max())


def test_an_inverse_tells_how_many_digits_a_far_stiffer_contact_leaves():
    stepper = walking("along")
    stepper.step_to(1e-5, 1e-5)
    problem = stepper.stepping(1e-5).solver.problem
    touching = np.ones(problem.points, dtype=bool)
    lost = []
    for stiffness in (1e14, 1e17, 1e20):
        at_points = np.zeros((problem.points, 3, 3))
        at_points[:, 2, 2] = -stiffness
        lost.append(factored(problem, touching, at_points).rounding)
    assert lost[0] < 1e-12
    assert lost[0] < lost[1] < lost[2]


@pytest.mark.parametrize("unit", [1e-9, 1.0, 1e9])
@pytest.mark.parametrize(("lost", "ends"), [(1e3, CONVERGED), (1e5, SLOW)])
def test_whether_digits_are_too_few_does_not_depend_on_the_unit_of_force(unit, lost, ends):
    """Of 12 digits those are lost by which what is asked of the tangent exceeds the forces."""
    norm, whole, asked = (1e-10 * unit) ** 2, unit**2, (lost * unit) ** 2
    status, residual, _ = _terminate(
        norm, whole, asked, False, 1e-12, 1e-8, 1e-20 * unit, np.inf, 0
    )
    assert status == ends
    assert residual == pytest.approx(1e-10)

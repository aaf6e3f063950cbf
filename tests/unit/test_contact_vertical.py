"""A block on a base that vibrates up and down."""

import dataclasses

import numpy as np
import pytest
from apparatus.grid import slow

from asperity.block.problem import BlockProblem
from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.contact.motion import ledger
from asperity.contact.motion.rest import rest_under_load
from asperity.contact.motion.steps import Stepper

STEP = 5e-6
STIFFNESS = 1e10  # Pa/m
FREQUENCY = 400.0


def shaken(amplitude, *changes):
    """Let the base of a block on a soft contact rise and fall; also its resting state."""
    settings = (
        "block.elements=[2, 2, 2]", "block.element=hex8", "vibration.start=0 s",
        f"vibration.frequency={FREQUENCY} Hz", f"solve.step={STEP} s", "slider.lateral=guided",
        f"contact.stiffness={STIFFNESS} Pa/m", *changes,
    )  # fmt: skip
    problem = BlockProblem.from_case(read_case("block-longitudinal", case_tables(), settings))
    system = problem.system
    shaking = dataclasses.replace(system.shaking, amplitude=(0.0, 0.0, amplitude))
    system = dataclasses.replace(system, shaking=shaking, drive_velocity=0.0)
    return problem, Stepper(system, rest_under_load(system, problem.loads))


def test_the_force_on_a_block_is_that_of_a_mass_on_a_spring_on_a_shaken_base():
    amplitude = 1e-7
    problem, stepper = shaken(amplitude)
    spring = STIFFNESS * problem.block.area
    own, imposed = np.sqrt(spring / problem.mass), 2.0 * np.pi * FREQUENCY
    times = STEP * np.arange(1, 1001)
    forces = []
    for time in times:
        stepper.step_to(time, STEP)
        forces.append(stepper.state.forces.normal)
    # z'' + own^2 (z - z_base) = 0 from rest, with z_base = amplitude sin(imposed t).
    share = own / (own**2 - imposed**2)
    z = amplitude * share * (own * np.sin(imposed * times) - imposed * np.sin(own * times))
    swing = spring * (amplitude * np.sin(imposed * times) - z)
    assert 0.02 * 55.0 < np.abs(swing).max() < 55.0
    assert np.array(forces) - 55.0 == pytest.approx(swing, abs=0.01 * np.abs(swing).max())


@pytest.mark.slow
@pytest.mark.parametrize(
    "contact",
    [
        ("contact.normal=linear",),
        slow(("contact.normal=two-stage", "contact.stiffness=1e12 Pa/m")),
        slow(("contact.normal=hard",)),
    ],
)
def test_a_block_that_is_thrown_up_keeps_its_momentum_and_its_ledger(contact):
    problem, stepper = shaken(2e-5, *contact)
    mass = problem.mass
    before = ledger.energies(stepper.system, stepper.state)
    touching, landings = True, 0
    for number in range(1, 4001):
        stepper.step_to(number * STEP, STEP)
        before_it, touching = touching, stepper.state.contact.active > 0
        landings += touching and not before_it
    assert landings >= 2
    sums = stepper.sums
    push = sums.normal_force - 55.0 * sums.time
    assert push == pytest.approx(
        mass * stepper.state.coordinates.velocity[2], abs=0.02 * 55.0 * sums.time
    )
    balance = ledger.power_ledger(sums, before, ledger.energies(stepper.system, stepper.state))
    assert balance.vibration > 0.0
    missing = balance.drive + balance.vibration + balance.loads - balance.friction
    missing -= balance.damping + balance.numerical + balance.stored
    assert abs(missing) < 1e-6 * balance.vibration

"""From which vibration on a self-locking gearset creeps, against a plain model of its drive.

The model (`apparatus.plain_drive`) has equations and steps of its own; the gearset's numbers are
calculated here once more. Slip goes along one line, where asperities that stick until they slip and
the teeth behind them are one spring with a limit.
"""

import math

import numpy as np
import pytest
from apparatus.plain_drive import COULOMB, SINE, Plain, march
from apparatus.random_drives import approach_at

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.drive.locking import answer, prepare
from asperity.drive.reduced.reduction import reduction
from asperity.runs import Run

# Gearset 2 and its drive, as the case `drive-actuator` has them.
STARTS, TEETH, MODULE, FACTOR, PRESSURE = 1, 60, 1.70e-3, 10.8, math.radians(20.0)
LEAD, CIRCLE, ARM = 0.5 * MODULE * STARTS, 0.5 * MODULE * FACTOR, 0.5 * MODULE * TEETH
MU, LIMIT, LOAD, FREQUENCY = 0.149, 70e-9, 66.0, 20e3


def at_rest(mesh, amplitude):
    """Return the plain model without its motor, and the state in which friction holds the worm."""
    radius = mesh.radius
    length = math.hypot(radius, LEAD)
    axial = math.cos(math.atan2(STARTS, FACTOR)) * math.cos(PRESSURE)
    along = axial * LEAD / radius
    sliding = LOAD / ARM / (axial - MU * LEAD / length)
    torques, angles = np.array(mesh.deflection).T
    logs = np.log(np.stack([axial * ARM * angles, sliding * torques / LOAD]))
    (far, other), (most, before) = np.exp(logs[:, -1]), logs[1, -2:][::-1]
    power = (most - before) / (logs[0, -1] - logs[0, -2])
    stiffness = MU * sliding / (LIMIT + mesh.compliance * MU * sliding)
    share = axial * LEAD * length / (MU * radius**2)
    force = LOAD / ARM / (axial + share * MU * LEAD / length)
    shaken = np.zeros(5)
    shaken[:2] = amplitude / CIRCLE, -LEAD * amplitude / CIRCLE
    model = Plain(
        lead=LEAD, radius=radius, arm=ARM, logs=logs,
        end=np.array([far, other, power * other / far]),
        normal=np.array([along, axial, math.sqrt(1.0 - along**2 - axial**2)]),
        damping=0.01, backlash=0.15e-3, law=COULOMB, mu=MU, reference=sliding, stiffness=stiffness,
        teeth=0.0, rate=0.0, viscous=0.0, torsion=1e-12, torsion_damping=0.0, worm_inertia=7e-6,
        seat=0.0, seat_damping=0.0, worm_mass=0.2, wheel_inertia=3e-3, load=LOAD, speed=0.0,
        amplitudes=shaken, wave=SINE, rise=0.1, frequency=FREQUENCY,
    )  # fmt: skip
    approach, _ = approach_at(logs, force)
    bent = -share * MU * force / stiffness * np.array([radius, -LEAD, 0.0]) / length
    return model, np.array([0.0, 0.0, -approach / axial / ARM, *bent])


def wheel(mesh, amplitude, cycles=2000):
    """Return the wheel's speed in its load's direction over a tenth of a second, and its swing."""
    means = np.zeros((cycles, 9))
    march(*at_rest(mesh, amplitude), cycles, 1500, means)
    place = -np.cumsum(means[:, 8]) / FREQUENCY
    tenth = cycles // 10
    early = place[cycles // 2 : cycles // 2 + tenth]
    went = place[-tenth:].mean() - early.mean()
    return went * FREQUENCY / (0.4 * cycles), np.ptp(early)


@pytest.mark.slow
def test_a_gearset_holds_below_the_amplitude_that_is_told_and_creeps_above_it():
    asked = prepare(read_case("drive-actuator", case_tables(), ()))
    mesh, found = reduction(asked, Run()), answer(asked, Run())
    assert found.threshold == pytest.approx(132.2e-9, rel=5e-3)
    for amplitude in (0.4, 0.7, 0.9, 0.98):
        speed, swing = wheel(mesh, amplitude * found.threshold)
        # It rings on its teeth, and is where it was.
        assert abs(speed) < 1e-7
        assert swing < 1e-6
    for amplitude in (1.02, 1.1):
        speed, _ = wheel(mesh, amplitude * found.threshold)
        assert speed > 3e-4
    speed, _ = wheel(mesh, 20e-6)
    assert found.creep == pytest.approx(speed, rel=1e-3)

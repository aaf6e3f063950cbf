"""Elastic teeth as a mesh of the march: against the increments of the contact, and their energy."""

import dataclasses
import functools
import itertools
import math

import numpy as np
import pytest

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.contact.increment.problem import ContactState, IncrementProblem
from asperity.contact.increment.solver import IncrementSolver
from asperity.contact.interface.counter_motion import Drift, SurfaceMotion
from asperity.contact.interface.friction import DAHL, PointFriction
from asperity.contact.interface.normal import NormalLaw
from asperity.contact.interface.rigid import Pose, RigidSurface
from asperity.drive.elastic.mesh import advance, states
from asperity.drive.elastic.model import TeethModel
from asperity.drive.interface import AT, OUTS
from asperity.drive.problem import DriveProblem
from asperity.drive.reduced.reduction import Reduction
from asperity.drive.teeth.contact import CONTACT_STIFFNESS
from asperity.drive.teeth.placing import place_worm
from asperity.friction.dahl import VECTOR
from asperity.runs import Run

STEP = 0.5e-6
GIVEN = Reduction(9.8e-3, ((22.0, 80e-6), (366.0, 550e-6)), 2.6e-9)


@functools.cache
def model_of(*settings):
    problem = DriveProblem.from_case(
        read_case("drive-screw", case_tables(), ("drive.teeth=1", *settings))
    )
    return TeethModel.of(problem, GIVEN, Run())


def moved(model, count, way):
    """Poses and rates of a worm that turns, the wheel behind it by a deflection and a motion."""
    ratio, speed = model.point.ratio, model.problem.worm_speed
    behind = float(model.courses[0].deflection[0])
    t = STEP * np.arange(count + 1)
    q, v = np.zeros((count + 1, 4)), np.zeros((count + 1, 4))
    q[:, 0], v[:, 0] = speed * t, speed
    wave, rate = way(t)
    q[:, 2], v[:, 2] = speed / ratio * t - behind + wave, speed / ratio + rate
    return q, v


def marched(model, q, v):
    here = model.settled_in(q[0], 1.0)
    trial = here.copy()
    outs = np.zeros((len(q) - 1, OUTS))
    for k in range(1, len(q)):
        advance(model.teeth, here, trial, q[k], v[k], STEP, outs[k - 1])
        here, trial = trial, here
    return outs, here


def swung(amplitude, frequency=20e3):
    angle = 2.0 * math.pi * frequency
    return lambda t: (
        amplitude * (1.0 - np.cos(angle * t)),
        amplitude * angle * np.sin(angle * t),
    )


def test_a_tooth_takes_the_forces_that_increments_on_its_whole_flank_take():
    model = model_of("drive.flanks=driving")
    mesh, sector = model.teeth, model.sector
    q, v = moved(model, 8, swung(100e-6))
    outs, _ = marched(model, q, v)
    friction = mesh.laws.interface.friction
    surface = dataclasses.replace(sector.surface)
    surface.__dict__["points"] = sector.body.places.reshape(*surface.weights.shape, 3)
    point = PointFriction(
        DAHL, friction.mu, friction.limit, VECTOR, friction.exponent, reference=friction.reference
    )
    whole = np.zeros((len(q) - 1, 2))
    for place in range(mesh.teeth):
        tooth = float(mesh.gathered[place, 0])
        problem = IncrementProblem(
            sector.body.flexibility,
            surface,
            RigidSurface.worm(sector.wheel.pair.worm, side=1),
            NormalLaw("linear", CONTACT_STIFFNESS),
            point,
        )
        solver, state = IncrementSolver(problem), ContactState.rest(problem)

        def pose(p, tooth=tooth):
            rotation, translation = np.empty((3, 3)), np.empty(3)
            angle = p[2] + mesh.ahead + mesh.stand.pitch * tooth
            shift = np.array([0.0, 0.0, -p[1]])
            place_worm(mesh.stand, p[0], shift, angle, p[3], 1, rotation, translation)
            return Pose(rotation, translation)

        slid = q[0] - np.array([1e-3, 0.0, 1e-3 / model.point.ratio, 0.0])
        ways = [(slid, q[0]), (slid, q[0]), *itertools.pairwise(q)]
        for k, (before, after) in enumerate(ways):
            motion = SurfaceMotion(pose(after), base_1=Drift.between(pose(before), pose(after)))
            found = solver.solve(np.zeros(len(sector.body.flexibility)), motion, state)
            state = found.state
            if k >= 2:
                force = found.force.reshape(-1, 3)
                at = sector.surface.positions + found.displacement.reshape(-1, 3)
                whole[k - 2, 0] += np.cross(at, force)[:, 2].sum()
                whole[k - 2, 1] -= force[:, 2].sum()
    damped = mesh.damping * 100e-6 * 2.0 * math.pi * 20e3 * 0.065
    np.testing.assert_allclose(outs[:, AT.wheel_torque], whole[:, 0], rtol=2e-3 + damped)
    np.testing.assert_allclose(outs[:, AT.wheel_force], whole[:, 1], rtol=2e-3 + damped)


def closure(model, way, count=160):
    """What the mesh was given, and what of it is neither lost nor stored, in parts of that."""
    q, v = moved(model, count, way)
    outs, _ = marched(model, q, v)
    middle = 0.5 * (outs[1:, :4] + outs[:-1, :4])
    given = -float((middle * np.diff(q[1:], axis=0)).sum())
    lost = float(outs[1:, AT.friction].sum() + outs[1:, AT.damping].sum())
    stored = float(outs[-1, AT.stored] - outs[0, AT.stored])
    turned = float(np.abs(middle * np.diff(q[1:], axis=0)).sum())
    return (given - lost - stored) / turned, outs


@pytest.mark.slow
@pytest.mark.parametrize(
    ("amplitude", "limit"),
    # Sliding, in contact throughout, and lifting off at 5 m/s, which is 2.5 um a step.
    [(0.0, 1e-6), (100e-6, 1e-5), (600e-6, 1e-3)],
)
def test_what_the_teeth_are_given_is_lost_or_stored(amplitude, limit):
    left, outs = closure(model_of(), swung(amplitude))
    assert abs(left) < limit
    assert (outs[:, AT.friction] >= -1e-12).all()
    assert (outs[:, AT.damping] >= -1e-9 * outs[:, AT.stored].max()).all()
    assert outs[:, AT.residual].max() < 1e-6


def test_a_wheel_that_runs_ahead_bears_on_its_other_flank():
    model = model_of()
    play = 0.28e-3 / (model.point.normal_z * model.point.arm)
    q, v = moved(model, 60, lambda t: ((play + 0.8e-3) * t / t[-1], (play + 0.8e-3) / t[-1]))
    outs, _ = marched(model, q, v)
    driving, back = outs[:, AT.driving], outs[:, AT.back]
    assert driving[0] > 0.0
    assert back[0] == 0.0
    assert driving[-1] == 0.0
    assert back[-1] > 0.0
    assert outs[-1, AT.wheel_torque] < 0.0
    assert ((driving == 0.0) & (back == 0.0)).any()
    assert not ((driving > 0.0) & (back > 0.0)).any()
    # While nothing touches nothing acts and nothing is kept.
    free = (driving == 0.0) & (back == 0.0)
    assert (outs[free, :4] == 0.0).all()
    assert (outs[free, AT.stored] == 0.0).all()


def test_teeth_are_handed_over_at_a_pitch():
    model = model_of("drive.flanks=driving")
    q, v = moved(model, 3, swung(0.0))
    pitch = model.teeth.stand.pitch
    further = q + np.array([pitch * model.point.ratio, 0.0, pitch, 0.0])
    here, there = (marched(model, way, v)[0] for way in (q, further))
    np.testing.assert_allclose(there[:, :6], here[:, :6], rtol=2e-6, atol=1e-3)
    assert states(model.teeth) == len(model.settled_in(q[0], 1.0))

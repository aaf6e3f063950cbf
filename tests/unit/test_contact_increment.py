"""Tractions, their consistent tangent, and increments solved from them."""

import dataclasses

import numpy as np
import pytest
from apparatus.grid import grid
from scipy.spatial.transform import Rotation

from asperity.contact.increment import ContactState, IncrementProblem, IncrementSolver
from asperity.contact.interface.active_set import stiffness_forces
from asperity.contact.interface.counter_motion import Drift, SurfaceMotion
from asperity.contact.interface.friction import (
    COULOMB,
    DAHL,
    LUGRE,
    TWO_PHASE,
    PointFriction,
    share_and_tangent,
)
from asperity.contact.interface.normal import NormalLaw
from asperity.contact.interface.records import ContactPoints
from asperity.contact.interface.rigid import Pose, RigidSurface, distance
from asperity.contact.interface.surface import contact_surface
from asperity.contact.interface.tractions import tractions
from asperity.friction import SPLIT, UNSPLIT, VECTOR
from asperity.friction.two_phase import phases
from asperity.mesh import box

pytestmark = pytest.mark.usefixtures("plain_kernels")

LIMIT = 7e-8
FACE = contact_surface(box([4e-3, 3e-3, 1e-3], [4, 3, 1], 1), "bottom")
STIFF = NormalLaw("linear", 4e14)

LAWS = {
    "none": PointFriction(),
    "coulomb": PointFriction(COULOMB, 0.3, LIMIT),
    "dahl-vector": PointFriction(DAHL, 0.3, LIMIT, VECTOR),
    "dahl-vector-0": PointFriction(DAHL, 0.3, LIMIT, VECTOR, 0.0),
    "dahl-vector-2": PointFriction(DAHL, 0.3, LIMIT, VECTOR, 2.0),
    "dahl-split": PointFriction(DAHL, 0.3, LIMIT, SPLIT),
    "dahl-unsplit-1.5": PointFriction(DAHL, 0.3, LIMIT, UNSPLIT, 1.5),
    "two-phase": PointFriction(TWO_PHASE, 0.3, LIMIT, SPLIT),
    "two-phase-2": PointFriction(TWO_PHASE, 0.3, LIMIT, SPLIT, 2.0),
    "lugre": PointFriction(LUGRE, 0.3, LIMIT, VECTOR, 1.0, 1.4, 2e-3, 1e-2, 2e-3),
}
LAWS |= {
    f"{name}, stiffness kept": dataclasses.replace(LAWS[name], reference=4e6)
    for name in ("dahl-vector", "dahl-vector-0", "dahl-split", "dahl-unsplit-1.5", "lugre")
}


def flexible(surface, *, youngs_modulus=2e11, held=1e-10):
    """Symmetric positive definite stand-in: half-space-like decay and a rigid give."""
    at = surface.positions
    apart = np.linalg.norm(at[:, None] - at[None], axis=2)
    size = np.sqrt(surface.nodal_area.mean() / np.pi)
    part = np.exp(-apart / 3e-3) / (np.pi * youngs_modulus * size)
    flexibility = np.zeros((len(at), 3, len(at), 3))
    for axis in range(3):
        flexibility[:, axis, :, axis] = part + held
    return flexibility.reshape(3 * len(at), -1)


def problem_of(surface=FACE, counter=None, normal=STIFF, friction="dahl-vector", **settings):
    law = LAWS[friction] if isinstance(friction, str) else friction
    counter = counter or RigidSurface.plane()
    settings.setdefault("step", 1e-5)
    return IncrementProblem(flexible(surface), surface, counter, normal, law, **settings)


def evaluated(problem, u, state, motion, tangent):
    force, points = np.empty(3 * problem.nodes), ContactPoints.empty(problem.points)
    stiffness = np.empty((problem.points, 3, 3))
    tractions(
        u, state.committed(state.multiplier), problem.interface, motion.numbers(), force, points,
        stiffness, tangent,
    )  # fmt: skip
    return force, points, stiffness


def pushed(z, across=(0.0, 0.0)):
    return np.tile([across[0], across[1], z], len(FACE.positions))


def bent_state(problem, seed):
    rng = np.random.default_rng(seed)
    state = ContactState.rest(problem)
    flat = rng.normal(size=(problem.points, 3)) * 0.3 * LIMIT
    flat[:, 2] = 0.0
    return dataclasses.replace(
        state, deflection=flat, size=np.linalg.norm(flat, axis=1) / LIMIT,
        displacement=rng.normal(size=3 * problem.nodes) * 1e-8,
    )  # fmt: skip


def curved(kind):
    """A counter-surface below the patch."""
    if kind == "plane":
        return RigidSurface.plane(), Pose(Rotation.from_rotvec([0, 0.1, 0.4]).as_matrix())
    radius = 0.02
    if kind == "sphere":
        return RigidSurface.sphere(radius), Pose(np.eye(3), np.array([1e-4, 2e-4, -radius]))
    turn = Rotation.from_euler("x", 90, degrees=True).as_matrix()
    bore = RigidSurface.cylinder(radius, inside=True)
    return bore, Pose(turn, np.array([1e-4, 0.0, radius]))


def laid_on(problem, pose, lift=0.0):
    """Displacement that lays the nodes on the counter-surface, along z."""
    u = np.zeros((problem.nodes, 3))
    for _ in range(20):
        local = (problem.surface.positions + u - pose.translation) @ pose.rotation
        found = np.array([distance(*point, problem.counter.numbers)[:4] for point in local])
        u[:, 2] -= (found[:, 0] - lift) / (found[:, 1:] @ pose.rotation.T)[:, 2]
    return u.ravel()


@pytest.mark.parametrize(("friction", "kind"), grid([*LAWS], ["plane", "sphere", "bore"]))
def test_the_tangent_is_the_derivative_of_the_nodal_forces(friction, kind):
    counter, pose = curved(kind)
    problem = problem_of(counter=counter, friction=friction)
    state = bent_state(problem, 1)
    motion = SurfaceMotion(
        pose,
        Drift(np.array([2e-8, 0.0, 3e-9]), np.array([[0, -1e-6, 0], [1e-6, 0, 2e-6], [0, 0, 0]])),
        Drift(np.array([0.0, -1.3e-8, 0.0])),
        np.eye(3),
        np.diag([0.0, 0.3, 0.0]),
    )
    rng = np.random.default_rng(2)
    # Chords of the mesh stand above a hollow.
    flat = laid_on(problem, pose, -5e-6 if kind == "bore" else 0.0)
    u = flat + rng.normal(size=3 * problem.nodes) * 1e-8
    state = dataclasses.replace(state, displacement=state.displacement + flat)
    _, points, stiffness = evaluated(problem, u, state, motion, True)
    assert np.count_nonzero(points.pressure > 0.0) > 10
    faces, shapes, weights = problem.interface[:3]
    way = rng.normal(size=u.shape)
    predicted = np.empty_like(u)
    stiffness_forces(stiffness, faces, shapes, weights, way, predicted)
    step = 1e-12
    ahead = evaluated(problem, u + step * way, state, motion, False)[0]
    behind = evaluated(problem, u - step * way, state, motion, False)[0]
    slope = (ahead - behind) / (2 * step)
    assert slope == pytest.approx(predicted, rel=1e-5, abs=1e-5 * np.abs(predicted).max())


@pytest.mark.parametrize("exponent", [1.5, 2.0, 2.5])
@pytest.mark.parametrize("over", [4e-16, 1e-9, 0.01])
def test_a_deflection_beyond_its_limit_stays_there_under_further_slip(exponent, over):
    law = PointFriction(TWO_PHASE, 0.3, LIMIT, SPLIT, exponent)
    size, slip = 1.0 + over, 0.2
    assert phases(size, 1.0, 0.0, slip, 0.0, slip, 0.0, exponent, False) == (size, 1.0, 0.0)
    found = share_and_tangent(
        size * LIMIT,
        0.0,
        size,
        slip * LIMIT,
        0.0,
        slip * LIMIT,
        0.0,
        False,
        law.numbers(0.0),
        1.0,
    )
    assert found[:5] == pytest.approx((size * LIMIT, 0.0, size, size, 0.0), rel=1e-15)
    assert np.isfinite(found[5] + found[6]).all()
    # Across the slip the deflection may turn; along it, it no longer grows.
    assert found[5][0] == found[6][0] == 0.0


def test_exponents_below_one_overshoot_the_limit_and_stay_numbers():
    size, direction = 0.9, (1.0, 0.0)
    for _ in range(5):
        size, *direction = phases(size, *direction, 0.5, 0.0, 0.0, 0.0, 0.5, False)
    assert 1.0 < size < 1.2
    assert direction == [1.0, 0.0]


@pytest.mark.parametrize("normal", ["linear", "stiff", "hard"])
@pytest.mark.parametrize("seed", range(8))
def test_a_body_that_just_touches_is_an_ordinary_increment(seed, normal):
    law = {
        "linear": STIFF, "stiff": NormalLaw("linear", 4e17), "hard": NormalLaw("hard", 4e14)
    }[normal]  # fmt: skip
    rng = np.random.default_rng(seed)
    pose = Pose(
        Rotation.from_rotvec(0.3 * rng.normal(size=3)).as_matrix(), 1e-3 * rng.normal(size=3)
    )
    problem = problem_of(normal=law, friction="dahl-vector" if seed % 2 else "none")
    # On the plane but for the last digits, by which some points are over it and some are not.
    u, normals = np.zeros((problem.nodes, 3)), pose.rotation[:, 2]
    for _ in range(3):
        off = (problem.surface.positions + u - pose.translation) @ normals
        u -= off[:, None] * normals
    solver, state = IncrementSolver(problem), ContactState.rest(problem)
    touching = solver.solve(u.ravel(), SurfaceMotion(pose), state)
    assert touching.residual == 0.0
    assert np.linalg.norm(touching.force) < 1e-12 * problem.normal.stiffness * problem.area_norm
    # From there on it is pressed, and lifted off again.
    pressed = solver.solve(
        u.ravel() - np.tile(1e-7 * normals, problem.nodes), SurfaceMotion(pose), touching.state
    )
    assert pressed.active > 0
    assert 0.0 < pressed.residual < 1e-6
    lifted = solver.solve(
        u.ravel() + np.tile(1e-7 * normals, problem.nodes), SurfaceMotion(pose), pressed.state
    )
    assert (lifted.active, lifted.residual) == (0, 0.0)


def test_a_flexibility_of_a_folded_body_need_not_be_symmetric():
    """A quarter of a body stands for all four: a force on its edge is there once, others not."""
    problem = problem_of(friction="none")
    folded = np.repeat(np.where(FACE.positions[:, 0] == 0.0, 1.0, 2.0), 3)
    problem = dataclasses.replace(problem, flexibility=problem.flexibility * folded)
    tilted = pushed(-2e-7).reshape(-1, 3) * (1.0 + FACE.positions[:, :1] / 4e-3)
    found = IncrementSolver(problem).solve(
        tilted.ravel(), SurfaceMotion(), ContactState.rest(problem)
    )
    assert 0.0 < found.residual <= problem.tolerance
    answered = tilted.ravel() + problem.flexibility @ found.force
    assert found.state.displacement == pytest.approx(answered, rel=1e-9, abs=1e-15)

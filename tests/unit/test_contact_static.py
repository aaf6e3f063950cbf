"""Quasi-static contact: ways, loads, and the work done on them."""

import dataclasses

import numpy as np
import pytest
from apparatus.static_paths import follow, on_guide
from scipy.spatial.transform import Rotation

from asperity.contact.elastic import ElasticMaterial, Pressure, condense
from asperity.contact.increment import IncrementProblem, IncrementSolver
from asperity.contact.interface.friction import COULOMB, PointFriction
from asperity.contact.interface.normal import NormalLaw
from asperity.contact.interface.rigid import Pose, RigidSurface
from asperity.contact.interface.surface import contact_surface
from asperity.contact.static import Guide, load_to, move_to
from asperity.errors import ConvergenceError, InputError
from asperity.mesh import box

E = 2e11
SIZE = 1e-3
RADIUS = 0.05
MESH = box((4 * SIZE, 4 * SIZE, 3 * SIZE), (4, 4, 3))
BODY = condense(
    MESH, ElasticMaterial(E, 0.3, 7850.0), "bottom", tied="top",
    loads={"side": Pressure("left")}, use_cache=False,
)  # fmt: skip
UP, ALONG = np.array([0.0, 0.0, 1.0]), np.array([1.0, 0.0, 0.0])
BALL = Guide(UP, Pose(np.eye(3), np.array([0.0, 0.0, -RADIUS])))


def solver_of(mu=0.0, counter=None, **changes):
    law = NormalLaw("linear", 10 * E / SIZE)
    problem = IncrementProblem(
        BODY.flexibility, contact_surface(MESH, "bottom"), counter or RigidSurface.sphere(RADIUS),
        law, PointFriction(COULOMB, mu, 1e-9), **changes,
    )  # fmt: skip
    return IncrementSolver(problem)


def test_the_load_looked_for_is_borne_and_is_that_of_its_place():
    solver = solver_of()
    borne = load_to(solver, BALL, 500.0, step=1e-6)
    assert borne.load == pytest.approx(500.0, rel=2e-9)
    there = move_to(solver, BALL, borne.place)
    assert there.load == pytest.approx(500.0, rel=1e-8)
    # Back down from more, in steps.
    more = load_to(solver, BALL, 900.0, start=borne, step=1e-7)
    back = load_to(solver, BALL, 500.0, start=more, step=1e-7, increments=2)
    assert back.place == pytest.approx(borne.place, rel=1e-7)
    assert back.increments == 2


@pytest.mark.parametrize("load", [0.0, 1e-9, -1e-9, 1e-300])
def test_no_load_and_hardly_any_is_borne_from_where_there_was_one(load):
    # Pressed, rubbed aside, and pushed back until nothing holds it along there.
    solver = solver_of(0.3, RigidSurface.plane(), tolerance=1e-12)
    down = load_to(solver, Guide(UP), 500.0, step=1e-6)
    along = Guide(ALONG, Guide(UP).at(down.place))
    aside = move_to(solver, along, 2e-6, start=on_guide(solver, along, down), increments=4)
    back = load_to(solver, along, load, start=aside, step=-1e-7)
    assert abs(back.load - load) <= 1e-9 * 500.0
    assert back.place < aside.place
    # Friction has held its part of the way: it does not lie where it began.
    assert back.place != pytest.approx(0.0, abs=1e-8)
    # Lifted until nothing bears any more.
    up = load_to(solver, Guide(UP), load, start=down, step=-1e-7)
    assert abs(up.load - load) <= 1e-9 * 500.0
    assert load_to(solver, Guide(UP), 0.0).load == 0.0


def test_a_turn_bears_the_moment_of_its_forces():
    # A plane below the block, hinged on a line beside it.
    centre = np.array([-0.01, 0.0, 0.0])
    guide = Guide(np.array([0.0, -1.0, 0.0]), centre=centre)
    solver = solver_of(counter=RigidSurface.plane())
    state = move_to(solver, guide, 1e-4)
    forces = state.contact.force.reshape(-1, 3)
    assert forces[:, 2].sum() > 0.0
    arms = solver.problem.surface.positions + state.contact.displacement.reshape(-1, 3) - centre
    assert state.load == pytest.approx(
        (arms[:, 0] * forces[:, 2] - arms[:, 2] * forces[:, 0]).sum()
    )
    pose = guide.at(1e-4)
    assert pose.rotation == pytest.approx(Rotation.from_rotvec([0.0, -1e-4, 0.0]).as_matrix())
    assert pose.rotation @ centre + pose.translation == pytest.approx(centre, abs=1e-18)


@pytest.mark.parametrize("counter", ["plane", "sphere"])
def test_the_work_of_the_surface_is_stored_by_the_body_and_lost_by_friction(counter):
    surface = RigidSurface.plane() if counter == "plane" else RigidSurface.sphere(RADIUS)
    guide = Guide(UP) if counter == "plane" else BALL
    solver = solver_of(0.3, surface, tolerance=1e-12)
    down = load_to(solver, guide, 500.0, step=1e-6)
    along = Guide(ALONG, guide.at(down.place))
    start = on_guide(solver, along, down)
    assert start.load == pytest.approx(0.0, abs=5.0)
    places = np.concatenate([np.linspace(0.0, 2e-6, 41)[1:], np.linspace(2e-6, -2e-6, 81)[1:]])
    states = [start, *follow(solver, along, places, start=start)]
    work = np.trapezoid([state.load for state in states], [state.place for state in states])
    lost = sum(state.friction_work for state in states)
    stored = []
    for state in (states[0], states[-1]):
        contact = state.contact
        weights = solver.problem.surface.weights.ravel()
        springs = weights @ contact.pressure**2 / (2.0 * solver.problem.normal.stiffness)
        stored.append(0.5 * contact.force @ solver.problem.flexibility @ contact.force + springs)
    assert lost > 0.5 * work > 0.0
    # A ball's normals turn on the way, which trapezoids do not see to all digits.
    assert lost + stored[1] - stored[0] == pytest.approx(
        work, rel=1e-8 if counter == "plane" else 1e-3
    )


def test_the_way_can_be_gone_in_parts_or_at_once_without_friction():
    solver = solver_of()
    once = move_to(solver, BALL, 2e-6)
    parts = move_to(solver, BALL, 2e-6, increments=5)
    states = follow(solver, BALL, [1e-6, 2e-6], increments=2)
    assert (once.increments, parts.increments, states[1].increments) == (1, 5, 2)
    for other in (parts, states[1]):
        assert other.load == pytest.approx(once.load, rel=1e-7)
    assert once.friction_work == pytest.approx(0.0, abs=1e-12)


def test_a_way_that_finds_no_equilibrium_says_where_it_stopped():
    solver = solver_of(0.3, most_iterations=0)
    with pytest.raises(ConvergenceError, match=r"static contact stops at \S+ on the way to 2e-06"):
        move_to(solver, BALL, 2e-6)


def test_a_load_that_is_not_to_be_had_is_refused():
    solver = solver_of()
    with pytest.raises(InputError, match="step is missing"):
        load_to(solver, BALL, 500.0)
    aside = Guide(ALONG, Pose(np.eye(3), np.array([0.0, 0.0, -2 * RADIUS])))
    with pytest.raises(ConvergenceError, match="misses the body"):
        load_to(solver, aside, 500.0, step=1e-6)


@pytest.mark.parametrize("go", [move_to, load_to])
def test_less_than_one_increment_is_refused(go):
    with pytest.raises(InputError, match="increments is 0"):
        go(solver_of(), BALL, 1.0, increments=0)


def test_a_guide_without_direction_is_refused():
    with pytest.raises(InputError, match="give a direction"):
        Guide(np.zeros(3))
    with pytest.raises(InputError, match="give a direction"):
        dataclasses.replace(BALL, axis=np.array([np.nan, 0.0, 0.0]))

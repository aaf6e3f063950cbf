"""The condensed contact against the same contact with every node: in statics and in motion.

The uncondensed way solves one sparse system for all nodes in every iteration. It shares the contact
laws at a point with the condensed one, and nothing of how the body is treated.
"""

import dataclasses

import numpy as np
import pytest
from apparatus.grid import grid
from apparatus.whole_body import WholeSystem

from asperity.block.problem import BlockProblem
from asperity.block.tables import TABLES
from asperity.casefile import read_case
from asperity.contact.elastic import ElasticMaterial, Pressure, condense, elastic_body
from asperity.contact.increment import ContactState, IncrementProblem, IncrementSolver
from asperity.contact.interface.counter_motion import Drift, SurfaceMotion
from asperity.contact.interface.friction import PointFriction
from asperity.contact.interface.normal import NormalLaw
from asperity.contact.interface.rigid import Pose, RigidSurface
from asperity.contact.interface.surface import contact_surface
from asperity.contact.motion import mechanism as mo
from asperity.contact.motion.rest import rest_under_load
from asperity.contact.motion.steps import Stepper
from asperity.contact.motion.system import System
from asperity.errors import ConvergenceError, InputError
from asperity.mesh import box
from asperity.slider.tables import TABLES as SLIDER_TABLES

STEEL = ElasticMaterial(209e9, 0.3, 7850.0)
CASE = "cases/block-longitudinal.toml"


def tied_block(counter, element, elements):
    """A block that hangs from its top, on a counter-surface: condensed, and with every node."""
    mesh = box((0.04, 0.03, 0.03), elements, 2 if element == "hex27" else 1)
    loads = {"side": Pressure("left")}
    condensed = condense(
        mesh, STEEL, "bottom", element=element, tied="top", loads=loads, use_cache=False
    )
    count = len(condensed.flexibility)
    mechanism = mo.Mechanism(
        flexibility=condensed.flexibility,
        shapes=np.empty((count, 0)),
        mass=np.empty((0, 0)),
        stiffness=np.empty((0, 0)),
        held=np.zeros(0, dtype=bool),
    )
    system = System(
        mechanism=mechanism,
        surface=contact_surface(mesh, "bottom"),
        counter=counter,
        normal=NormalLaw("linear", 1e14),
        friction=PointFriction(model=1, mu=0.3, limit=2e-8, law=2),
    )
    whole = WholeSystem(
        elastic_body(mesh, STEEL, element=element, tied="top"), system, tolerance=1e-10
    )
    return condensed, system, whole, loads["side"].forces(mesh).ravel()


@pytest.mark.slow
@pytest.mark.parametrize("element", ["hex8", "hex8i", "hex27"])
@pytest.mark.parametrize("name", ["plane", "sphere"])
def test_statics_are_exact_while_the_surface_presses_and_rubs_a_tied_block(name, element):
    if name == "plane":
        counter, far, deep = RigidSurface.plane(), 0.0, 1.0
    else:
        counter, far, deep = RigidSurface.sphere(1.0), -1.0, 16.0
    elements = (3, 2, 2) if element == "hex27" else (5, 4, 3)
    condensed, system, whole, side = tied_block(counter, element, elements)
    problem = IncrementProblem(
        condensed.flexibility,
        system.surface,
        counter,
        system.normal,
        system.friction,
        tolerance=1e-10,
    )
    solver, mine, theirs = IncrementSolver(problem), ContactState.rest(problem), whole.start()
    rise, shares = [4e-7, 8e-7, 8e-7, 8e-7, 3e-7], [0.0, 1e6, 3e6, 3e6, 1e6]
    bent = 0.0
    rub = [0.0, 5e-8, 4e-7, -6e-7, 6e-7]
    for up, slide, share in zip(rise, rub, shares, strict=True):
        motion = SurfaceMotion(
            Pose(translation=np.array([0.0, 0.0, far + deep * up])),
            Drift(np.array([slide, 0.0, 0.0])),
            Drift(np.array([0.0, 0.5 * slide, 0.0])),
        )
        free = share * condensed.load_flexibility[:, condensed.load_index("side")]
        found = solver.solve(free, motion, mine)
        mine = found.state
        theirs = whole.static_step(theirs, share * side, motion)
        place = theirs.place.reshape(-1, 3)[condensed.nodes].ravel()
        assert np.abs(found.displacement - place).max() < 1e-9 * np.abs(place).max()
        assert np.abs(found.force - theirs.force).max() < 1e-9 * np.abs(theirs.force).max()
        pressure = theirs.pressure
        assert np.abs(found.pressure - pressure).max() < 1e-9 * pressure.max()
        assert (
            np.abs(mine.deflection - theirs.points.deflection).max() < 1e-9 * system.friction.limit
        )
        bent = max(bent, np.linalg.norm(mine.deflection, axis=1).max())
    touching = np.count_nonzero(theirs.pressure)
    share = touching / len(theirs.pressure)
    assert share > 0.8 if name == "plane" else 0.0 < share < 0.5
    assert bent > 0.5 * system.friction.limit


def block(*settings):
    """A shipped case on a light mesh, shaken from the start; condensed and with every node."""
    tables = {**SLIDER_TABLES, **TABLES}
    # The whole one has no damping but that of the drive.
    undamped = ["vibration.start=0 s", "block.damping_ratio=0"]
    problem = BlockProblem.from_case(read_case(CASE, tables, [*undamped, *settings]))
    body = elastic_body(problem.mesh, problem.material, element=problem.block.element)
    whole = WholeSystem(body, problem.system, problem.nodal_drive)
    return problem, whole


def loads_of(problem, whole):
    gravity = -9.80665 * whole.body.inertia[:, 2]
    return gravity, problem.nodal_loads


@pytest.mark.slow
@pytest.mark.parametrize(
    "settings",
    [
        ["block.modes=4"],
        ["block.modes=0"],
        ["block.modes=4", "block.element=hex8"],
        ["block.modes=0", "block.element=hex8i", "contact.normal=two-stage"],
    ],
)
def test_a_block_at_rest_presses_its_base_as_the_whole_one_does(settings):
    problem, whole = block("block.elements=[3, 2, 2]", *settings)
    mine = rest_under_load(problem.system, problem.loads)
    theirs = whole.rest_under_load(loads_of(problem, whole))
    pressure = theirs.pressure
    # Weight and friction bend the block: its pressure is not even.
    assert np.ptp(pressure) > 1e-3 * pressure.max()
    assert np.abs(mine.contact.pressure - pressure).max() < 1e-9 * pressure.max()
    assert whole.resultants(theirs)[2] == pytest.approx(55.0, rel=1e-9)


def apart(settings, step, count):
    """Largest differences of drive force, friction along and across, and normal force.

    Over the largest of each; last, that of the normal force over what it swings by.
    """
    problem, whole = block(*settings)
    stepper = Stepper(problem.system, rest_under_load(problem.system, problem.loads))
    loads = loads_of(problem, whole)
    theirs = whole.rest_under_load(loads)
    mine, exact = [], []
    for number in range(1, count + 1):
        stepper.step_to(number * step, step)
        theirs = whole.step_to(theirs, number * step, step, loads[-1])
        mine.append([stepper.state.drive.force, *stepper.state.forces[:3]])
        exact.append([theirs.drive_force, *whole.resultants(theirs)[:3]])
    mine, exact = np.array(mine), np.array(exact)
    friction = np.abs(exact[:, 1:3]).max()
    swing = 0.5 * np.ptp(exact[:, 3])
    assert friction > 3.0
    assert swing > 0.04
    scale = np.array([np.abs(exact[:, 0]).max(), friction, friction, exact[:, 3].max()])
    difference = np.abs(mine - exact).max(axis=0)
    return np.append(difference / scale, difference[3] / swing)


@pytest.mark.slow
@pytest.mark.parametrize(("element", "direction"), grid(["hex8", "hex8i"], [0, 45]))
def test_with_modes_a_shaken_block_moves_as_the_whole_one_within_a_thousandth(element, direction):
    light = [f"block.element={element}", "block.elements=[4, 3, 3]"]
    light.append(f"vibration.direction={direction}")
    *forces, swing = apart([*light, "block.modes=24"], 1e-5, 200)
    assert max(forces) < 1e-4
    assert swing < 0.02
    *without, unswung = apart([*light, "block.modes=0"], 1e-5, 40)
    assert max(without) > 10 * max(forces)
    assert unswung > 0.5


@pytest.mark.slow
@pytest.mark.campaign(
    tried_by="test_with_modes_a_shaken_block_moves_as_the_whole_one_within_a_thousandth"
)
@pytest.mark.parametrize("step", [1e-5, 1e-6])
def test_with_modes_a_block_of_27_node_elements_moves_as_the_whole_one(step):
    settings = ["block.elements=[4, 3, 3]", "block.modes=24", "vibration.direction=45"]
    *forces, swing = apart(settings, step, 200)
    assert max(forces) < 1e-3
    assert swing < 0.2


def test_equal_steps_share_a_matrix_and_few_lengths_of_steps_are_kept():
    problem, whole = block("block.elements=[2, 1, 1]", "block.element=hex8")
    load = loads_of(problem, whole)[-1]
    state = whole.rest_under_load(loads_of(problem, whole))
    step = 1e-5
    # Their ends are not as far apart as the steps are long, in the last digits.
    assert len({(number + 1) * step - number * step for number in range(8)}) > 2
    for number in range(1, 9):
        state = whole.step_to(state, number * step, step, load)
    assert whole.lengths == (step,)
    lengths = [number * 1e-6 for number in range(1, 9)]
    for length in lengths:
        state = whole.step_to(state, state.time + length, length, load)
    assert whole.lengths == tuple(lengths[4:])


def test_what_the_uncondensed_way_does_not_know_is_refused():
    for setting in ("slider.lateral=guided", "contact.normal=hard"):
        with pytest.raises(InputError, match="the uncondensed way knows no"):
            block("block.elements=[2, 1, 1]", "block.element=hex8", setting)


def test_no_equilibrium_is_told_with_the_residual():
    problem, whole = block("block.elements=[2, 1, 1]", "block.element=hex8")
    upwards = 20.0 * np.abs(loads_of(problem, whole)[-1])
    with pytest.raises(ConvergenceError, match="does not come to rest"):
        whole.rest_under_load((upwards,))
    impatient = dataclasses.replace(whole, tolerance=1e-30)
    with pytest.raises(ConvergenceError, match="relative residual") as caught:
        impatient.rest_under_load(loads_of(problem, whole))
    assert caught.value.reached["residual"] < 1e-6

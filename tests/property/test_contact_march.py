"""An elastic block off its base, thrown at it, shaken on it: the march goes on."""

import dataclasses

import numpy as np
import pytest
from apparatus.grid import grid
from apparatus.implicit import completed, predicted
from apparatus.released import released
from hypothesis import example, given, settings
from hypothesis import strategies as st

from asperity.block.problem import BlockProblem
from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.contact.increment.equations import Increment
from asperity.contact.increment.problem import ContactState
from asperity.contact.increment.solver import IncrementSolver
from asperity.contact.interface.counter_motion import SurfaceMotion
from asperity.contact.motion import hht, ledger
from asperity.contact.motion.rest import rest_under_load
from asperity.contact.motion.steps import Stepper
from asperity.errors import ConvergenceError

MESHES = {"hex8": "[2, 2, 2]", "hex8i": "[2, 2, 2]", "hex27": "[1, 1, 1]"}
LUGRE = (
    "friction.model=lugre", "friction.static_mu=0.15", "friction.stribeck_velocity=1 mm/s",
    "friction.contact_damping=300 N s/m", "friction.viscous_damping=0.4 N s/m",
)  # fmt: skip
TWO_PHASE = ("solve.scheme=two-phase",)
KEPT = (
    ("friction.keeps=stiffness", "friction.law=split"),
    ("friction.keeps=stiffness", "friction.law=vector", "friction.exponent=0"),
)
LAWS = (
    *KEPT,
    ("friction.law=split",),
    ("friction.law=vector", "friction.exponent=2"),
    ("friction.law=vector", "friction.exponent=0"),
    ("friction.law=unsplit", "friction.exponent=0.5"),
    ("friction.model=coulomb",),
    TWO_PHASE,
    LUGRE,
)
SECONDS = 2e-6
INCREMENTS = 150


def block(*changes, element="hex8"):
    common = (
        f"block.elements={MESHES[element]}", f"block.element={element}", "vibration.start=0 s",
        f"solve.step={SECONDS} s", "solve.duration=2 ms",
    )  # fmt: skip
    return BlockProblem.from_case(
        read_case("block-longitudinal", case_tables(), [*common, *changes])
    )


def thrown(system, lift, tilt, velocity, spin):
    """Let a block go with its lowest corner at a height over the base."""
    place, pace = np.zeros((2, system.mechanism.size))
    free = ~system.mechanism.held
    place[3:5] = tilt
    pace[:3], pace[3:6] = velocity, spin
    place[~free] = pace[~free] = 0.0
    place[2] = lift - (system.mechanism.shapes @ place)[2::3].min()
    return Stepper(system, released(system, place, pace))


def powers(balance):
    names = ("drive", "vibration", "loads", "friction", "damping", "numerical", "transfer")
    return [abs(getattr(balance, name)) for name in names]


def check_contact(system, contact, *, bounded):
    pressure = contact.pressure
    assert np.isfinite(pressure).all()
    assert np.isfinite(contact.traction).all()
    assert pressure.min() >= 0.0
    across = contact.traction - pressure[:, None] * contact.normal
    friction = np.linalg.norm(across, axis=1)
    assert not friction[pressure == 0.0].any()
    if bounded:
        assert (friction <= system.friction.mu * pressure * (1.0 + 1e-9)).all()


small = st.floats(-1.0, 1.0)


# The overshoot of the two-phase scheme, left to itself, came to 185 times the limit here, and
# friction fell with the slip 18 times as fast as the body could follow.
overshooting = example(
    law=TWO_PHASE, normal="linear", element="hex8i", modes=0, ratio=2.9595662565008274,
    direction=36.33640453602855, where=("body", "free", 1000), lift=3.2519466429822488e-06,
    tilt=(-0.6535157832567928, 0.5524179659718711, -4.552864450995746),
    velocity=(0.6431002894870288, -0.36043199441398865, -0.7862445308368804, -3.456925246834252),
    spin=(0.8387138784213759, -0.4130210112586645, 0.7875175953915796),
)  # fmt: skip
thrown_blocks = given(
    law=st.sampled_from(LAWS),
    normal=st.sampled_from(["linear", "two-stage", "hard"]),
    element=st.sampled_from(list(MESHES)),
    modes=st.sampled_from([0, 0, 2]),
    ratio=st.floats(0.0, 20.0),
    direction=st.floats(0.0, 360.0),
    where=st.tuples(
        st.sampled_from(["base", "body"]),
        st.sampled_from(["free", "guided"]),
        st.sampled_from([5, 55, 1000]),
    ),
    lift=st.floats(-9.0, -5.3).map(lambda power: 10.0**power),
    tilt=st.tuples(small, small, st.floats(-8.0, -4.5)),
    velocity=st.tuples(small, small, small, st.floats(-5.0, -2.0)),
    spin=st.tuples(small, small, small),
)


def check_thrown(law, normal, element, modes, ratio, direction, where, lift, tilt, velocity, spin):
    shaken, lateral, force = where
    problem = block(
        *law, f"contact.normal={normal}", f"block.modes={modes}",
        f"vibration.velocity_ratio={ratio}", f"vibration.direction={direction} deg",
        f"vibration.applied_to={shaken}", f"slider.lateral={lateral}",
        f"slider.normal_force={force} N", element=element,
    )  # fmt: skip
    system = problem.system
    stepper = thrown(
        system, lift, 10.0 ** tilt[2] * np.array(tilt[:2]),
        np.array([2e-3, 2e-3, 10.0 ** velocity[3]]) * velocity[:3], 0.2 * np.array(spin),
    )  # fmt: skip
    before = ledger.energies(system, stepper.state)
    for number in range(1, INCREMENTS + 1):
        stepper.step_to(number * SECONDS, SECONDS)
        check_contact(system, stepper.state.contact, bounded=law is not LUGRE)
        assert stepper.state.contact.residual <= 1e-9
    if law in KEPT:
        assert stepper.sums.friction_gain <= 1e-9 * stepper.sums.slip_work
    balance = ledger.power_ledger(stepper.sums, before, ledger.energies(system, stepper.state))
    sums = powers(balance)
    assert np.isfinite(sums).all()
    off = balance.drive + balance.vibration + balance.loads
    off -= sum(
        (balance.friction, balance.damping, balance.numerical, balance.transfer, balance.stored)
    )
    assert abs(off) <= 1e-6 * max(*sums, abs(balance.stored))


test_a_block_thrown_on_its_vibrating_base_parts_and_meets_again_and_marches_on = settings(
    max_examples=3
)(overshooting(thrown_blocks(check_thrown)))
test_a_block_thrown_again_and_again_on_its_vibrating_base_marches_on = pytest.mark.slow(
    settings(max_examples=24)(thrown_blocks(check_thrown))
)


def test_asperities_that_slip_too_far_for_the_two_phase_scheme_in_any_step_are_an_error():
    system = block(*TWO_PHASE).system
    stepper = thrown(system, 1e-9, (0.0, 0.0), (50.0, 0.0, -1e-2), (0.0, 0.0, 0.0))
    with pytest.raises(ConvergenceError, match=r"two-phase scheme bends asperities to .* times"):
        stepper.step_to(SECONDS, SECONDS)


def mechanical_energy(system, state):
    load = system.mechanism.load
    forces = load.generalised @ state.coordinates.place + load.response @ state.contact.force
    return ledger.energies(system, state).total - forces


STEPS = [2e-6, 2e-5]
DROPS = {
    "linear": (),
    "linear, far stiffer than a step resolves": ("contact.stiffness=1e19 Pa/m",),
    "two stages": ("contact.normal=two-stage",),
    "hard": ("contact.normal=hard",),
    "with modes": ("block.modes=2",),
    "with modes, hard": ("block.modes=2", "contact.normal=hard"),
}


@pytest.mark.slow
@pytest.mark.campaign
@pytest.mark.parametrize(("name", "element", "step"), grid([*DROPS], ["hex8", "hex27"], STEPS))
def test_a_dropped_block_never_has_more_energy_than_it_fell_with(name, element, step):
    problem = block(*DROPS[name], "vibration.velocity_ratio=0", element=element)
    system = dataclasses.replace(problem.system, drive_velocity=0.0)
    stepper = thrown(system, 2e-6, (2e-5, -3e-5), (0.0, 0.0, -2e-3), (0.0, 0.0, 0.0))
    start = mechanical_energy(system, stepper.state)
    touched = parted = 0
    energies = []
    for number in range(1, 501):
        touching = stepper.state.contact.active > 0
        stepper.step_to(number * step, step)
        now = stepper.state.contact.active > 0
        touched, parted = touched + (now and not touching), parted + (touching and not now)
        energies.append(mechanical_energy(system, stepper.state))
    assert touched >= 2
    assert parted >= 1
    assert max(energies) <= 1.02 * start


def test_a_block_at_rest_that_is_let_go_stays_where_it_is():
    system = block("vibration.velocity_ratio=0").system
    still = dataclasses.replace(system, drive_velocity=0.0)
    at_rest = rest_under_load(still, block().loads)
    place = at_rest.coordinates.place
    stepper = Stepper(still, released(still, place, np.zeros_like(place)))
    weight = at_rest.forces.normal
    for number in range(1, 41):
        stepper.step_to(number * SECONDS, SECONDS)
        # The asperities bend anew, which leaves the block a little to do.
        assert stepper.state.forces.normal == pytest.approx(weight, rel=1e-3)
    assert stepper.state.coordinates.place == pytest.approx(place, abs=1e-3 * abs(place[2]))


@pytest.mark.slow
@settings(max_examples=40)
@given(
    seed=st.integers(0, 2**32 - 1),
    normal=st.sampled_from(["linear", "two-stage", "hard"]),
    depth=st.floats(-9.0, -6.0).map(lambda power: 10.0**power),
    roughness=st.floats(0.1, 3.0),
)
def test_an_active_set_that_settles_is_an_equilibrium(seed, normal, depth, roughness):
    problem = block(f"contact.normal={normal}", "contact.stiffness=1e17 Pa/m")
    increments = increments_of(problem.system)
    rng = np.random.default_rng(seed)
    free = np.zeros((increments.nodes, 3))
    free[:, 2] = depth * (roughness * rng.normal(size=increments.nodes) - 1.0)
    free[:, :2] = 1e-7 * rng.normal(size=(increments.nodes, 2))
    state, motion = ContactState.rest(increments), SurfaceMotion()
    result = IncrementSolver(increments).solve(free.ravel(), motion, state)
    way = result.displacement - free.ravel()
    equations = Increment(
        increments, free.ravel(), motion.numbers(), state.committed(result.state.multiplier)
    )
    again = equations.evaluate(result.force, way)
    assert again.force == pytest.approx(
        result.force, rel=1e-6, abs=1e-7 * np.abs(result.force).max()
    )
    assert np.array_equal(again.touching, result.pressure > 0.0)
    answer = increments.flexibility @ result.force
    assert np.linalg.norm(answer - way) <= 1e-7 * np.linalg.norm(answer)


def test_an_active_set_that_does_not_settle_in_time_is_an_error_with_its_residual():
    problem = block("contact.stiffness=1e17 Pa/m")
    increments = dataclasses.replace(increments_of(problem.system), most_iterations=1)
    rng = np.random.default_rng(1)
    free = np.zeros((increments.nodes, 3))
    free[:, 2] = 1e-7 * (rng.normal(size=increments.nodes) - 0.5)
    with pytest.raises(ConvergenceError, match=r"found no equilibrium in \d+ iterations") as error:
        IncrementSolver(increments).solve(
            free.ravel(), SurfaceMotion(), ContactState.rest(increments)
        )
    assert error.value.reached["residual"] > 1e-9
    assert error.value.reached["active"] >= 0.0


def test_a_motion_that_is_not_finite_is_an_error():
    increments = increments_of(block().system)
    free = np.full(3 * increments.nodes, np.nan)
    with pytest.raises(ConvergenceError, match="left the finite numbers"):
        IncrementSolver(increments).solve(free, SurfaceMotion(), ContactState.rest(increments))


def increments_of(system):
    return system.increments(system.motion_step(SECONDS).compliance, SECONDS)


def leaving_speed(height, *, impact):
    """Speed at which a mass leaves a wall it meets with 1 m/s, in steps of 1 s, hard contact."""
    mass, none = np.eye(1), np.zeros((1, 1))
    method = hht.step_operator(mass, none, 1.0, impact=impact)
    state = hht.Coordinates.at_rest(1, place=np.array([height]), velocity=np.array([-1.0]))
    for _ in range(60):
        place = predicted(method, state)
        force = np.maximum(-place / method.compliance[0], 0.0)
        place = place + method.compliance[0] * force
        state, _, _ = completed(method, state, place, force)
    return float(state.velocity[0])


@pytest.mark.usefixtures("plain_kernels")
def test_a_mass_leaves_a_hard_contact_no_faster_than_it_came():
    heights = np.linspace(0.0, 1.0, 41)
    assert max(leaving_speed(height, impact=True) for height in heights) <= 1.0 + 1e-12
    beta, _ = hht.coefficients()
    too_fast = 1.0 / ((1.0 + hht.ALPHA) * beta) - 1.0
    assert leaving_speed(0.0, impact=False) == pytest.approx(too_fast, rel=1e-9)
    assert too_fast > 2.8


def test_the_bounce_of_a_stiff_block_on_a_soft_contact_is_that_of_a_mass_on_a_spring():
    soft = block("contact.stiffness=1e10 Pa/m", "slider.lateral=guided").system
    expected = np.sqrt(1e10 * 0.04 * 0.03 / 0.5)
    assert soft.bounce == pytest.approx(expected, rel=1e-3)
    assert not soft.impact(1.9 / expected)
    assert soft.impact(2.1 / expected)
    assert block("contact.normal=hard").system.impact(1e-9)

"""Blocks that flutter: what is found before they are marched, said of them, and damped."""

import dataclasses
import re

import numpy as np
import pytest

from asperity.block.problem import BlockProblem
from asperity.block.solution.march import BlockMarch, solve_block
from asperity.block.solution.stability import Flutter, Stability, flutter_note, slip_directions
from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.contact.interface.friction import PointFriction
from asperity.contact.motion import hht
from asperity.contact.motion.stability import Growth, sliding_motion
from asperity.errors import InputError

SMALL = (
    "block.elements=[2, 2, 2]", "block.element=hex8", "friction.law=vector",
    "vibration.velocity_ratio=0.01", "vibration.start=1 ms", "slider.drive_velocity=5 mm/s",
    "slider.drive_stiffness=5 MN/m", "solve.step=1 us", "solve.duration=10 ms",
)  # fmt: skip
SIXTY = (
    "block.elements=[4, 3, 3]", "block.element=hex8", "slider.drive_stiffness=5 MN/m",
    "friction.law=vector", "friction.transfer=1.0", "vibration.start=3 ms",
    "vibration.velocity_ratio=0.01", "solve.step=0.65 us", "solve.duration=20 ms",
)  # fmt: skip
FREE_OF_DAMPING = "block.damping_ratio=0"


def problem(*settings, of=SMALL):
    return BlockProblem.from_case(read_case("block-longitudinal", case_tables(), [*of, *settings]))


@pytest.mark.ordinary(1)
@pytest.mark.parametrize(
    ("modes", "rate", "kilohertz"),
    [(0, None, None), (20, 540.8, 67.44), (40, None, None), (50, 1717.3, 121.26), (60, 5611, 137)],
)
def test_which_numbers_of_modes_flutter_without_damping(modes, rate, kilohertz):
    """Marches measured 510/s at 67 kHz, 1724/s at 121 kHz, 5608/s at 137 kHz, and none."""
    flutter = Stability(problem(f"block.modes={modes}", FREE_OF_DAMPING, of=SIXTY)).flutter()
    if rate is None:
        assert flutter is None
    else:
        assert flutter.growth.rate == pytest.approx(rate, rel=1e-3)
        assert flutter.growth.frequency == pytest.approx(1e3 * kilohertz, rel=1e-3)
        assert flutter.stepped.rate < flutter.growth.rate


@pytest.mark.slow
def test_the_damping_that_is_named_holds_and_hardly_less_does_not():
    flutter = Stability(problem("block.modes=60", of=SIXTY)).flutter()
    assert flutter.holding == pytest.approx(0.0073, abs=0.0002)
    held = f"block.damping_ratio={flutter.holding}"
    assert Stability(problem("block.modes=60", held, of=SIXTY)).flutter() is None
    less = f"block.damping_ratio={0.9 * flutter.holding}"
    assert Stability(problem("block.modes=60", less, of=SIXTY)).flutter() is not None


@pytest.mark.slow
def test_a_coarse_step_holds_what_grows_in_time_and_the_note_says_so():
    block = problem("block.modes=60", "solve.step=1 us", of=SIXTY)
    flutter = Stability(block).flutter()
    assert flutter.growth.rate > 4000.0
    assert flutter.stepped is None
    told = flutter_note(block, flutter)
    assert "the numerical damping of steps of 1e-06 s holds it" in told
    assert "137 kHz grows by 4049/s" in told
    assert Stability(block).flutters_in_steps(0.65e-6)


def test_where_friction_is_high_a_block_flutters_as_a_rigid_body_which_modes_hardly_damp():
    high = "friction.mu=0.6", "vibration.velocity_ratio=6"
    rigid, elastic = (problem(*high, f"block.modes={modes}") for modes in (0, 4))
    flutters = [Stability(block).flutter() for block in (rigid, elastic)]
    assert flutters[0].holding is None
    assert flutters[1].holding > 0.1
    assert flutters[1].growth.frequency == pytest.approx(flutters[0].growth.frequency, rel=0.1)
    flutters[1] = dataclasses.replace(flutters[1], holding=None)
    told = [flutter_note(*pair) for pair in zip((rigid, elastic), flutters, strict=True)]
    assert ", which nothing damps; in steps of 1e-06 s it grows by" in told[0]
    assert told[0].endswith(": mistrust the result")
    assert ", which a block.damping_ratio of 0.002 does not hold; in steps" in told[1]
    assert told[1].endswith("mistrust the result; none does")


def test_a_growth_without_oscillation_and_its_direction_are_told():
    flutter = Flutter((0.0, 1.0), Growth(20.0, 0.0), Growth(19.0, 0.0), None)
    told = flutter_note(problem("block.modes=4"), flutter)
    assert "slides at 90 degrees to the drive: a motion that does not oscillate grows by 20" in told


@pytest.mark.parametrize(
    ("settings", "expected"),
    [
        (("vibration.velocity_ratio=0",), [(1, 0)]),
        (("vibration.velocity_ratio=0.5",), [(1, 0)]),
        (("vibration.velocity_ratio=6",), [(1, 0), (-1, 0)]),
        (
            ("vibration.velocity_ratio=1", "vibration.direction=90 deg", "friction.transfer=0.75"),
            [(1, 0), (0.8, -0.6), (0.8, 0.6)],
        ),
    ],
)
def test_a_block_slides_to_where_drive_and_vibration_take_it(settings, expected):
    found = slip_directions(problem(*settings))
    assert list(found) == [pytest.approx(way) for way in expected]
    assert np.copysign(1.0, found[0][1]) == 1.0


def linear_step(block, motion, state):
    """Step the coordinates of a sliding block by its own method, the contact put in by hand."""
    step = hht.step_operator(
        motion.mass, np.zeros_like(motion.mass), block.timetable.step,
        damping=np.diag(motion.damping).copy(),
    )  # fmt: skip
    size = len(motion.mass)
    place, velocity = np.empty((2, size))
    hht.predict(step, state, 0.0, np.zeros(size), np.empty((hht.ROOM, size)), place, velocity)
    end = hht.Coordinates.workspace(size)
    end.place[:] = np.linalg.solve(np.eye(size) + step.compliance @ motion.stiffness, place)
    hht.complete(step, state, -motion.stiffness @ end.place, end)
    return end


@pytest.mark.usefixtures("plain_kernels")
def test_eigenvalues_in_steps_are_those_of_the_steps_that_are_taken():
    block = problem("block.modes=10", "block.damping_ratio=0.01")
    (motion,) = Stability(block).motions
    step, size = block.timetable.step, len(motion.mass)
    rng = np.random.default_rng(3)
    place, velocity, acceleration = rng.normal(size=(3, size))
    state = hht.Coordinates.at_rest(
        size, place=place, velocity=velocity, acceleration=acceleration,
        force=motion.damping @ velocity + motion.stiffness @ place,
    )  # fmt: skip
    factors = np.exp(step * motion.in_steps(step))
    # Each sequence of places obeys the polynomial whose roots the factors are.
    polynomial = np.poly(factors).real
    places = []
    for _ in range(3):
        state = linear_step(block, motion, state)
    for _ in range(len(polynomial)):
        places.append(state.place)
        state = linear_step(block, motion, state)
    terms = polynomial[::-1, None] * np.array(places)
    assert np.abs(terms.sum(axis=0)).max() < 1e-6 * np.abs(terms).max()


@pytest.mark.parametrize("settings", [(), ("slider.drive_damping=50 N s/m",)])
def test_the_drive_s_dashpot_damps_what_the_drive_feels(settings):
    block = problem("block.modes=4", *settings)
    (motion,) = Stability(block).motions
    port = block.system.mechanism.drive.port.generalised
    dashpot = 50.0 if settings else 0.0
    modal = np.diag(block.system.mechanism.damping)
    # Along the drive nothing lies between the end that is pulled and the block as a whole.
    assert motion.damping[0, 0] == pytest.approx(dashpot * port[0] ** 2, rel=0.01)
    assert (motion.damping == pytest.approx(modal)) == (not settings)


def test_a_body_that_is_not_pressed_or_does_not_slide_is_refused():
    block = problem()
    system = block.system
    given = system.mechanism, system.surface, system.normal, system.friction
    with pytest.raises(InputError, match="pressure is 0 Pa; it must be positive"):
        sliding_motion(*given, 0.0, (1.0, 0.0))
    with pytest.raises(InputError, match="give where the body slides to"):
        sliding_motion(*given, 1e4, (0.0, 0.0))
    smooth = dataclasses.replace(system, friction=PointFriction())
    motion = sliding_motion(
        smooth.mechanism, smooth.surface, smooth.normal, smooth.friction, 1e4, (1.0, 0.0)
    )
    assert motion.stiffness == pytest.approx(motion.stiffness.T, abs=1e-9 * motion.stiffness.max())


def test_hard_contact_flutters_as_a_very_stiff_one():
    hard, stiff = (
        Stability(problem("block.modes=16", FREE_OF_DAMPING, *settings)).flutter()
        for settings in (
            ("contact.normal=hard",),
            ("contact.stiffness=2e17 Pa/m",),
        )
    )
    assert hard.growth.rate == pytest.approx(stiff.growth.rate, rel=0.02)
    assert hard.growth.frequency == pytest.approx(stiff.growth.frequency, rel=1e-3)


@pytest.mark.slow
def test_damping_of_modes_is_counted_and_leaves_a_block_without_them_alone():
    short = "vibration.velocity_ratio=6", "solve.step=2 us", "solve.duration=2 ms"
    damped = solve_block(problem("block.modes=4", "block.damping_ratio=0.1", *short), history=False)
    assert damped.ledger.damping > 1e-7 * damped.ledger.friction
    assert damped.ledger.residual < 1e-6
    without, other = (
        solve_block(problem(f"block.damping_ratio={ratio}", *short), history=False)
        for ratio in (0, 0.5)
    )
    for name in ("ratio", "drive_force", "normal_force", "peak_pressure"):
        assert getattr(without, name) == getattr(other, name)
    for name in ("friction", "damping", "numerical", "stored"):
        assert getattr(without.ledger, name) == getattr(other.ledger, name)
    assert other.ledger.damping == 0.0


@pytest.mark.slow
def test_a_fluttering_block_is_told_and_a_damped_one_slides_as_one_without_modes():
    march = BlockMarch(problem("block.modes=17", FREE_OF_DAMPING), history=False)
    assert march.flutter.stepped.rate > 1000.0
    assert march.done == 0
    result = march.run()
    assert result.notes[0] == flutter_note(march.problem, march.flutter)
    told = " ".join(result.notes)
    assert re.search(r"the time integration takes \S+ W, \S+ % of what friction does", told)
    assert "a solve.step of 8.5e-07 s resolves it, but the block flutters there" in told
    held = f"block.damping_ratio={march.flutter.holding}"
    damped = solve_block(problem("block.modes=17", held), history=False)
    rigid = solve_block(problem(), history=False)
    assert result.ratio < 0.99 * rigid.ratio
    assert damped.ratio == pytest.approx(rigid.ratio, rel=1e-5)
    for told in (" ".join(damped.notes), " ".join(rigid.notes)):
        assert "flutter" not in told
        assert "time integration takes 1e" not in told

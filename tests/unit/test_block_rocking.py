"""A block whose friction follows the pressure late rocks itself up; its contact may damp it."""

import dataclasses

import numpy as np
import pytest

from asperity.block.problem import BlockProblem
from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.contact.motion.rest import rest_under_load
from asperity.contact.motion.steps import Stepper

# Nearly rigid, on a contact that lets it rock at 24 kHz, and not vibrated.
RIGID = (
    "block.elements=[4, 1, 1]", "block.element=hex8", "block.youngs_modulus=20900 GPa",
    "contact.stiffness=1.5e13 Pa/m", "friction.law=vector", "vibration.velocity_ratio=0",
    "solve.step=1 us",
)  # fmt: skip
STEP = 1e-6
ROCKING, BOUNCE = 4, 2
PUSH = 4e-4  # rad/s
MU, FORCE, LIMIT, VELOCITY = 0.1, 55.0, 68.75e-9, 0.5e-3
LENGTH, HEIGHT, MASS, DRIVE = 0.04, 0.03, 0.5, 96068.0


def problem(*settings):
    return BlockProblem.from_case(
        read_case("block-longitudinal", case_tables(), [*RIGID, *settings])
    )


def pushed(stepper, coordinate, velocity):
    """The same with a push to one coordinate, without numerical damping."""
    state = stepper.state
    pace = state.coordinates.velocity.copy()
    pace[coordinate] += velocity
    moving = state.coordinates._replace(velocity=pace)
    return Stepper(with_(stepper.system, alpha=0.0), with_(state, coordinates=moving))


def with_(what, **changed):
    if dataclasses.is_dataclass(what):
        return dataclasses.replace(what, **changed)
    return what._replace(**changed)


def places(stepper, coordinate, count, step=STEP):
    first = round(stepper.state.time / step)
    found = []
    for number in range(first + 1, first + 1 + count):
        stepper.step_to(number * step, step)
        found.append(stepper.state.coordinates.place[coordinate])
    return np.array(found)


def sliding(problem):
    """A block that slides steadily under full friction, its asperities at their limits."""
    system = problem.system
    rest = rest_under_load(system, problem.loads)
    contact, drive, coordinates = rest.contact, rest.drive, rest.coordinates
    bent = np.zeros_like(contact.state.deflection)
    bent[:, 0] = LIMIT
    if problem.friction.reference > 0.0:
        bent[:, 0] *= contact.pressure / problem.friction.reference
    pace = coordinates.velocity.copy()
    pace[0] = VELOCITY
    full = MU * FORCE
    state = with_(
        rest,
        coordinates=coordinates._replace(velocity=pace),
        drive=drive._replace(force=full, reach=drive.way + full / DRIVE),
        contact=with_(contact, state=with_(contact.state, deflection=bent)),
    )
    # Long steps with much numerical damping let it lean as it slides.
    calm = Stepper(with_(system, alpha=-1.0 / 3.0), state)
    places(calm, ROCKING, 300, 10e-6)
    return calm


def growth_of(swings, step=STEP, window=500):
    sizes = np.log([np.ptp(part) for part in swings.reshape(-1, window)])
    return np.polyfit(window * step * np.arange(len(sizes)), sizes, 1)[0]


def rigid_rocking(count, frequency=24e3, points=4, parts=4):
    """Rocking of a rigid block on points that keep their stiffness, in a few lines of its own."""
    at, shares = np.polynomial.legendre.leggauss(points)
    x, shares = 0.5 * LENGTH * at, 0.5 * shares
    inertia = MASS * (LENGTH**2 + HEIGHT**2) / 12.0
    stiffness = (2.0 * np.pi * frequency) ** 2 * inertia / (LENGTH**2 / 12.0)
    lean = 0.5 * MU * FORCE * HEIGHT / (stiffness * LENGTH**2 / 12.0)
    give = LIMIT / (FORCE * shares)
    height, turn, way = -FORCE / stiffness, lean, 0.0
    limit = bent = give * stiffness * shares * (x * turn - height)
    pace = np.array([VELOCITY, 0.0, PUSH])
    turns = []
    step = STEP / parts
    for number in range(1, parts * count + 1):
        slip = step * (pace[0] - 0.5 * HEIGHT * pace[2])
        way, height, turn = np.array([way, height, turn]) + step * pace
        pressing = stiffness * shares * (x * turn - height)
        before, limit = limit, give * pressing
        middle = 0.5 * (before + limit)
        bent = np.minimum(middle + (bent - middle) * np.exp(-slip / middle), limit)
        friction = MU * bent / give
        pull = MU * FORCE + DRIVE * (VELOCITY * step * number - way)
        torque = 0.5 * HEIGHT * friction.sum() - x @ pressing
        forces = np.array([pull - friction.sum(), pressing.sum() - FORCE, torque])
        pace += step * forces / np.array([MASS, MASS, inertia])
        turns.append(turn)
    return np.array(turns[parts - 1 :: parts])


@pytest.mark.slow
def test_friction_that_follows_the_pressure_late_rocks_a_block_up_as_it_does_a_rigid_one():
    growths = {}
    for keeps in ("stiffness", "deflection"):
        stepper = pushed(sliding(problem(f"friction.keeps={keeps}")), ROCKING, PUSH)
        growths[keeps] = growth_of(places(stepper, ROCKING, 4000))
    alone = growth_of(rigid_rocking(4000))
    assert alone > 100.0
    # The block is not quite rigid, nor its pressure at its ends quite that of the points.
    assert growths["stiffness"] == pytest.approx(alone, rel=0.15)
    assert abs(growths["deflection"]) < 0.02 * alone


@pytest.mark.ordinary(1)
@pytest.mark.parametrize(
    ("coordinate", "share"), [(BOUNCE, 1.0), (ROCKING, LENGTH / np.hypot(LENGTH, HEIGHT))]
)
def test_dashpots_of_the_contact_damp_bounce_and_rocking(coordinate, share):
    """A rigid block rocks by sqrt(L^2/(L^2 + h^2)) as fast as it bounces, and is damped so."""
    ratio = 0.02
    still = problem(f"contact.damping_ratio={ratio}", "slider.drive_velocity=1e-9 m/s")
    system = with_(still.system, shaking=None)
    rest = Stepper(system, rest_under_load(system, still.loads))
    push = 1e-5 if coordinate == BOUNCE else PUSH
    swings = places(pushed(rest, coordinate, push), coordinate, 500)
    peaks = np.abs(np.fft.rfft((swings - swings.mean()) * np.hanning(500), 100_000))
    turned = 2.0 * np.pi * peaks.argmax() / (100_000 * STEP)
    decay = -growth_of(swings - swings[-50:].mean(), window=100)
    assert decay == pytest.approx(ratio * share * turned, rel=0.1)

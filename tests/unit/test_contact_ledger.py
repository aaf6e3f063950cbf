"""The power ledger of a body in contact: each term is found by itself, so a wrong one shows."""

import dataclasses
import itertools

import numpy as np
import pytest
from scipy.integrate import quad

from asperity.block.problem import BlockProblem
from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.contact.interface.normal import NormalLaw, pressure
from asperity.contact.interface.records import ContactPoints
from asperity.contact.motion import ledger
from asperity.contact.motion.rest import rest_under_load
from asperity.contact.motion.steps import Stepper
from asperity.contact.motion.works import (
    Asperities,
    overclosure_work,
    potential,
    surface_energies,
    works,
)

LINEAR = NormalLaw(stiffness=4e13)
TWO_STAGE = NormalLaw("two-stage", 4e13, 4e12, 1e-7, 3e-7)
LAWS = {"linear": LINEAR, "two-stage": TWO_STAGE}
KINKS = (0.0, 1e-7, 3e-7)
MU, LIMIT = 0.12, 2e-6
CYCLE = 1.0 / 3000.0


def steps_of(points=40, steps=30, seed=1):
    """Pressed points that come and go, their deflections turning: (steps, points, ...)."""
    rng = np.random.default_rng(seed)
    distance = rng.uniform(-5e-7, 2e-7, (steps, points))
    deflection = rng.uniform(-LIMIT, LIMIT, (steps, points, 3))
    return distance, deflection, rng.uniform(1e-7, 1e-6, points)


def pressures(distance, law):
    return np.array([[pressure(-d, 0.0, law)[0] for d in row] for row in distance])


@pytest.mark.usefixtures("plain_kernels")
@pytest.mark.parametrize("reference", [0.0, 3e6])
@pytest.mark.parametrize("law", LAWS)
def test_what_goes_into_asperities_and_overclosure_is_what_they_hold_more(law, reference):
    kept = Asperities(MU / LIMIT, reference)
    parameters = LAWS[law].numbers
    distance, deflection, weights = steps_of()
    pressed = pressures(distance, parameters)
    deflection[pressed == 0.0] = 0.0
    none = np.zeros((len(weights), 3))
    points = [
        ContactPoints(p, d, none, none, none, none, s, np.zeros(len(weights)))
        for p, d, s in zip(pressed, distance, deflection, strict=True)
    ]
    done = [works(*ends, weights, parameters, kept) for ends in itertools.pairwise(points)]
    over, asperities = np.subtract(
        *(
            surface_energies(pressed[n], distance[n], deflection[n], weights, parameters, kept)
            for n in (-1, 0)
        )
    )
    assert min(abs(over), abs(asperities)) > 0.0
    assert sum(work.overclosure for work in done) == pytest.approx(over, rel=1e-9)
    assert sum(work.asperities for work in done) == pytest.approx(asperities, rel=1e-9)


@pytest.mark.usefixtures("plain_kernels")
@pytest.mark.parametrize("law", LAWS)
def test_the_work_of_a_pressure_is_its_integral_and_its_potential(law):
    parameters = LAWS[law].numbers
    for begin, end in [(-2e-7, 5e-8), (5e-8, 2e-7), (4e-7, 2e-7), (6e-7, -1e-7), (5e-7, 9e-7)]:
        low, high = sorted((begin, end))
        inside = [kink for kink in KINKS if low < kink < high]
        between = quad(
            lambda over: pressure(over, 0.0, parameters)[0], begin, end, points=inside or None
        )[0]
        work = overclosure_work(begin, end, parameters)
        assert work == pytest.approx(between, rel=1e-10)
        stored = potential(end, parameters) - potential(begin, parameters)
        assert work == pytest.approx(stored, rel=1e-10)


@pytest.mark.usefixtures("plain_kernels")
def test_hard_contact_stores_nothing():
    assert overclosure_work(0.0, 1e-7, NormalLaw("hard", 4e13).numbers) == 0.0


def marched(steps, cycles=4.25, rise=0.0, settings=()):
    """A light block drawn over its base that vibrates along the drive, and perhaps rises."""
    step = CYCLE / steps
    case = [
        "block.elements=[2, 2, 2]", "block.element=hex8", "vibration.start=0 s",
        "vibration.frequency=3000 Hz", f"solve.step={step} s", *settings,
    ]  # fmt: skip
    problem = BlockProblem.from_case(read_case("block-longitudinal", case_tables(), case))
    system, start = problem.system, problem.system.shaking
    shaking = dataclasses.replace(start, amplitude=(*start.amplitude[:2], rise))
    system = dataclasses.replace(system, shaking=shaking)
    stepper = Stepper(system, rest_under_load(system, problem.loads))
    before = stepper.state
    for number in range(1, round(cycles * steps) + 1):
        stepper.step_to(number * step, step)
    return stepper, before


def balance(stepper, before):
    start, end = (ledger.energies(stepper.system, state) for state in (before, stepper.state))
    return ledger.power_ledger(stepper.sums, start, end)


SHAKEN = {"rise": 2e-9}
# The forces of an increment are right to 1e-9; their work is 500 times that of the drive, which is
# what the residual is a share of. Digits of the library decide what remains of it.
CLOSED = 5e-6


def test_a_wrong_energy_of_asperities_or_overclosure_opens_the_balance(monkeypatch):
    stepper, before = marched(160, **SHAKEN)
    right = ledger.surface_energies
    assert balance(stepper, before).residual < CLOSED
    for over, asperities in [(1.01, 1.0), (1.0, 1.01), (0.0, 1.0), (1.0, 0.0)]:

        def wrong(*contact, over=over, asperities=asperities):
            energies = right(*contact)
            return over * energies[0], asperities * energies[1]

        monkeypatch.setattr(ledger, "surface_energies", wrong)
        assert balance(stepper, before).residual > 3.0 * CLOSED


@pytest.mark.ordinary(1)
@pytest.mark.parametrize(
    "law",
    [
        (),
        ("friction.law=vector", "friction.exponent=0"),
        ("vibration.direction=45 deg",),
        ("friction.model=lugre", "friction.law=vector"),
    ],
)
def test_friction_gives_energy_where_asperities_keep_their_deflection_alone(law):
    shares = {}
    for keeps in ("stiffness", "deflection"):
        stepper, before = marched(80, settings=(f"friction.keeps={keeps}", *law), **SHAKEN)
        assert balance(stepper, before).residual < CLOSED
        shares[keeps] = stepper.sums.friction_gain / stepper.sums.slip_work
    assert shares["stiffness"] < 1e-9
    assert shares["deflection"] > 1e-3


def test_friction_is_what_it_is_whatever_is_said_to_be_stored(monkeypatch):
    stepper, before = marched(160, **SHAKEN)
    friction = balance(stepper, before).friction
    monkeypatch.setattr(ledger, "surface_energies", lambda *contact: (1.0, 1.0))
    assert balance(stepper, before).friction == friction


@pytest.mark.slow
def test_what_the_steps_take_is_small_and_goes_with_them():
    shares = []
    for steps in (100, 200, 400):
        powers = balance(*marched(steps, **SHAKEN))
        assert powers.residual < CLOSED
        shares.append(abs(powers.numerical) / powers.friction)
    assert shares[0] < 1e-4
    assert shares[1] < 0.5 * shares[0]
    assert shares[2] < 0.5 * shares[1]

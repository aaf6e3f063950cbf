"""Order of convergence, against the differential equations integrated by SciPy.

Source: P. R. Dahl, A Solid Friction Model, 1968, in one dimension; in two dimensions the relaxation
along the asperity (`split`, `unsplit`) or along the slip (`vector`). The explicit two-phase scheme:
chapter 4 of the thesis, equations (44)-(59).
"""

import functools

import numpy as np
import pytest
from apparatus.grid import grid, slow
from scipy.integrate import solve_ivp

from asperity.friction import SPLIT, UNSPLIT, VECTOR
from asperity.friction.dahl import advance
from asperity.friction.loaded import STIFFNESS, advance_loaded
from asperity.friction.two_phase import phases
from asperity.kernels.compiled import kernel

pytestmark = pytest.mark.usefixtures("plain_kernels")

END = 6.0
LAWS = {"split": SPLIT, "unsplit": UNSPLIT, "vector": VECTOR}


def ways(time):
    """Slip of both parts, in units of the limit; smooth, turning and reversing."""
    part_1 = [1.5 * time + 2.0 * np.sin(time), 0.7 * np.sin(time + 0.4)]
    part_2 = [0.0 * time, 1.1 * np.cos(2.0 * time)]
    return np.array(part_1), np.array(part_2)


def velocities(time):
    part_1 = [1.5 + 2.0 * np.cos(time), 0.7 * np.cos(time + 0.4)]
    return np.array(part_1), np.array([0.0, -2.2 * np.sin(2.0 * time)])


def rate(time, s, exponent, law):
    part_1, part_2 = velocities(time)
    slip = part_1 + part_2
    if law == VECTOR:
        speed = np.hypot(*slip)
        distance = slip / speed - s
        return speed * np.hypot(*distance) ** (exponent - 1.0) * distance
    size = np.hypot(*s)
    if size == 0.0:
        return slip
    e = s / size
    along = [e @ part_1, e @ part_2] if law == SPLIT else [e @ slip]
    lost = [u * (1.0 - (1.0 - min(size, 1.0) * np.sign(u)) ** exponent) for u in along]
    return slip - sum(lost) * e


@kernel
def walk(slips_1, slips_2, exponent, law):
    sx, sy = 0.0, 0.0
    for n in range(len(slips_1)):
        sx, sy = advance(
            sx, sy, slips_1[n, 0], slips_1[n, 1], slips_2[n, 0], slips_2[n, 1], exponent, law
        )
    return sx, sy


@kernel
def walk_in_two_phases(slips_1, slips_2, exponent):
    size, ax, ay = 0.0, 1.0, 0.0
    for n in range(len(slips_1)):
        size, ax, ay = phases(
            size, ax, ay, slips_1[n, 0], slips_1[n, 1], slips_2[n, 0], slips_2[n, 1],
            exponent, False,
        )  # fmt: skip
    return size * ax, size * ay


@kernel
def walk_under_load(slips_1, slips_2, limits, exponent, law):
    sx, sy = 0.0, 0.0
    for n in range(len(slips_1)):
        sx, sy, _, _ = advance_loaded(
            sx, sy, slips_1[n, 0], slips_1[n, 1], slips_2[n, 0], slips_2[n, 1],
            limits[n], limits[n + 1], exponent, law, STIFFNESS,
        )  # fmt: skip
    return sx, sy


def reached(steps, walker, *arguments):
    slips = [
        np.ascontiguousarray(np.diff(way, axis=1).T) for way in ways(np.linspace(0, END, steps + 1))
    ]
    return np.array(walker(*slips, *arguments))


@functools.cache
def exact(exponent, law):
    # Short steps, since the laws have kinks.
    answer = solve_ivp(
        rate, (0.0, END), [0.0, 0.0], "DOP853", args=(exponent, law),
        rtol=1e-12, atol=1e-13, max_step=0.01,
    )  # fmt: skip
    return answer.y[:, -1]


def observed_order(steps, errors):
    slope, _ = np.polyfit(np.log(steps), np.log(errors), 1)
    return -slope


@pytest.mark.slow
@pytest.mark.parametrize("exponent", [1.0, slow(1.5), 2.0])
@pytest.mark.parametrize("law", LAWS.values(), ids=LAWS)
def test_the_update_goes_to_the_differential_equation(law, exponent):
    assert reached(200_000, walk, exponent, law) == pytest.approx(exact(exponent, law), abs=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize("law", LAWS.values(), ids=LAWS)
def test_an_exponent_below_one_goes_to_its_equation_too(law):
    # The root of what is left to the limit makes the equation stiff: 1e-6 instead of 1e-9.
    assert reached(200_000, walk, 0.5, law) == pytest.approx(exact(0.5, law), abs=1e-6)


@pytest.mark.parametrize("exponent", [0.5, slow(1.0), slow(1.5), 2.0])
def test_vector_converges_with_order_two(exponent):
    steps = np.array([100, 200, 400, 800, 1600])
    truth = exact(exponent, VECTOR)
    errors = [np.abs(reached(n, walk, exponent, VECTOR) - truth).max() for n in steps]
    orders = np.log2(np.divide(errors[:-1], errors[1:]))
    assert orders == pytest.approx(2.0, abs=0.05)


@pytest.mark.ordinary(1)
@pytest.mark.parametrize(
    ("law", "exponent"),
    grid(["split", "unsplit"], [1.0, 1.5, 2.0], ordinary=[("split", 2.0), ("unsplit", 1.0)]),
)
def test_split_and_unsplit_converge_with_order_two_on_average_over_a_decade(law, exponent):
    steps = np.unique(np.geomspace(100, 1000, 40).astype(int))
    truth = exact(exponent, law)
    errors = [np.abs(reached(n, walk, exponent, law) - truth).max() for n in steps]
    assert observed_order(steps, errors) == pytest.approx(2.0, abs=0.1)


@pytest.mark.slow
@pytest.mark.parametrize("exponent", [1.0, 1.5, 2.0])
@pytest.mark.parametrize("law", LAWS.values(), ids=LAWS)
def test_under_a_load_that_swings_the_order_is_two_on_average_over_a_decade(law, exponent):
    # Eight phases of the load, so that the end falls on rising, falling, stuck and sliding.
    steps = np.unique(np.geomspace(60, 1000, 24).astype(int))
    errors = np.zeros(len(steps))
    for phase in np.arange(8) * np.pi / 4:

        def friction(steps, phase=phase):
            limits = 1.0 + 0.6 * np.sin(3.0 * np.linspace(0.0, END, steps + 1) + phase)
            return reached(steps, walk_under_load, limits, exponent, law)

        truth = friction(200_000)
        errors += [np.abs(friction(n) - truth).max() for n in steps]
    assert observed_order(steps, errors) == pytest.approx(2.0, abs=0.1)


def test_two_phase_converges_with_order_one_to_the_split_law():
    steps = np.array([2000, 4000, 8000, 16000])
    truth = exact(1.0, SPLIT)
    errors = [np.abs(reached(n, walk_in_two_phases, 1.0) - truth).max() for n in steps]
    orders = np.log2(np.divide(errors[:-1], errors[1:]))
    assert orders == pytest.approx(1.0, abs=0.05)
    assert errors[-1] < 1e-3


def test_vector_with_exponent_0_converges_with_order_one():
    # The asperity is at its limit at once, in the direction of the step: half a step late.
    steps = np.array([400, 800, 1600, 3200])
    slip = np.sum(velocities(END), axis=0)
    truth = slip / np.hypot(*slip)
    errors = [np.abs(reached(n, walk, 0.0, VECTOR) - truth).max() for n in steps]
    orders = np.log2(np.divide(errors[:-1], errors[1:]))
    assert orders == pytest.approx(1.0, abs=0.02)

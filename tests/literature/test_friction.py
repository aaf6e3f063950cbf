"""Dahl's law in closed form, and Coulomb friction as its limit.

Source: P. R. Dahl, A Solid Friction Model, Aerospace Corporation TOR-0158(3107-18)-1, 1968:
dF/dx = k (1 - (F/F_c) sgn v)^i. Its integrals for i = 0, 1/2, 1, 3/2, 2 from rest, the periodic
loop for i = 1 (peak, area); the two-dimensional relaxation along the slip for any exponent.
"""

import math

import numpy as np
import pytest
from apparatus.grid import slow

from asperity.friction import LAWS, SPLIT, UNSPLIT, VECTOR, update
from asperity.friction.coulomb import project
from asperity.friction.dahl import advance

pytestmark = pytest.mark.usefixtures("plain_kernels")

NOTHING = (0.0, 0.0)
LIMIT = 75.49e-9


def pulled(way, steps, exponent, law, start=0.0):
    """Force share along the line while the body goes ``way`` (in limits) in equal steps."""
    s, shares = (start, 0.0), [start]
    for _ in range(steps):
        s = advance(*s, way / steps, 0.0, *NOTHING, exponent, law)
        shares.append(s[0])
    return np.array(shares)


FROM_REST = {
    0.0: lambda x: min(x, 1.0),
    0.5: lambda x: 1.0 - max(1.0 - 0.5 * x, 0.0) ** 2,
    1.0: lambda x: -math.expm1(-x),
    1.5: lambda x: 1.0 - 1.0 / (1.0 + 0.5 * x) ** 2,
    2.0: lambda x: x / (1.0 + x),
}


@pytest.mark.parametrize("way", [0.01, 0.4, 1.0, 2.5, 40.0, 1000.0])
@pytest.mark.parametrize("exponent", FROM_REST)
def test_from_rest_one_step_of_the_vector_law_is_dahls_curve(exponent, way):
    assert pulled(way, 1, exponent, VECTOR)[-1] == pytest.approx(
        FROM_REST[exponent](way), rel=1e-13
    )


@pytest.mark.parametrize("law", LAWS.values(), ids=LAWS)
def test_from_rest_every_law_follows_the_exponential_at_any_step(law):
    for steps in (1, 7, 100):
        way = 3.0 * np.arange(steps + 1) / steps
        assert pulled(3.0, steps, 1.0, law) == pytest.approx(-np.expm1(-way), abs=1e-14)


@pytest.mark.parametrize("law", [SPLIT, UNSPLIT], ids=["split", "unsplit"])
@pytest.mark.parametrize("exponent", [1.5, 2.0])
def test_from_rest_split_and_unsplit_go_to_dahls_curve_with_order_two(law, exponent):
    errors = [
        abs(pulled(3.0, steps, exponent, law)[-1] - FROM_REST[exponent](3.0))
        for steps in (50, 100, 200)
    ]
    assert np.log2(np.divide(errors[:-1], errors[1:])) == pytest.approx(2.0, abs=0.1)


@pytest.mark.ordinary(2)
@pytest.mark.parametrize("law", LAWS.values(), ids=LAWS)
@pytest.mark.parametrize("amplitude", [0.2, 1.0, 5.0])
def test_the_steady_loop_has_dahls_peak_and_area(law, amplitude):
    steps = 2000
    start = 0.0
    # What the start leaves falls by exp(-4 amplitude) a cycle.
    for _ in range(math.ceil(8.0 / amplitude)):
        for way in (2 * amplitude, -2 * amplitude):
            # Of exponent 1 every law follows the exponential at any step.
            start = pulled(way, 10, 1.0, law, start)[-1]
    there = pulled(2 * amplitude, steps, 1.0, law, start)
    back = pulled(-2 * amplitude, steps, 1.0, law, there[-1])
    area = np.trapezoid(there - back[::-1], dx=2 * amplitude / steps)
    # The asperity passes zero half-way in at most one step of each stroke.
    assert there[-1] == pytest.approx(math.tanh(amplitude), abs=1e-9)
    assert back[-1] == pytest.approx(-math.tanh(amplitude), abs=1e-9)
    assert area == pytest.approx(4.0 * (amplitude - math.tanh(amplitude)), rel=1e-5)


@pytest.mark.parametrize("exponent", [0.0, 0.5, 1.0, 1.5, 2.0])
def test_at_a_reversal_the_stiffness_is_two_to_the_exponent(exponent):
    # (1 + 1)^i: Dahl's curve is steepest just after the slip turns at full friction.
    _, share, ((slope, *_), _) = update((1.0, 0.0), (-1e-9, 0.0), NOTHING, 1.0, exponent, VECTOR)
    assert slope == pytest.approx(2.0**exponent, rel=1e-8)
    assert share[0] < 1.0


@pytest.mark.parametrize("exponent", [0.0, 0.5, 1.0, 1.5, 2.0])
def test_the_vector_law_closes_in_on_the_slip_direction_at_dahls_rate(exponent):
    deflection, n = np.array([-0.5, 0.7]), np.array([0.8, -0.6])
    distance = np.hypot(*(n - deflection))
    for length in (0.05, 0.3, 0.9):
        new = update(tuple(deflection), tuple(length * n), NOTHING, 1.0, exponent, VECTOR)[0]
        left = np.hypot(*(n - new))
        # The integral of -d(rho)/rho^i along the slip is its length.
        if exponent == 1.0:
            assert math.log(distance / left) == pytest.approx(length, rel=1e-12)
        else:
            power = 1.0 - exponent
            passed = (distance**power - left**power) / power
            assert passed == pytest.approx(length, rel=1e-12)


@pytest.mark.parametrize("law", LAWS.values(), ids=LAWS)
def test_for_a_long_slip_dahl_friction_is_coulomb_friction(law):
    slip = np.array([-3e-6, 4e-6])
    _, share, _ = update((2e-8, 1e-8), tuple(slip), NOTHING, LIMIT, 1.0, law)
    assert share == pytest.approx(project(*slip, 0.0, 0.0, 0.0, 0.0), abs=1e-12)


@pytest.mark.ordinary(1)
@pytest.mark.parametrize("exponent", [slow(1.5), 2.0, slow(3.0), 4.0])
def test_an_asperity_near_its_limit_that_the_slip_turns_bends_as_in_fine_steps(exponent):
    """It comes to the limit as a power of the slip, and no step may put it there."""
    left = []
    for parts in (1, 50):
        s = (0.9, 0.0)
        for n in range(1000):
            across = 0.02 if n % 20 < 10 else -0.02
            for _ in range(parts):
                step = (0.02 / parts, across / parts, 0.0, 0.0, exponent, UNSPLIT)
                s = advance(*s, *step)
        left.append(1.0 - math.hypot(*s))
    assert left[0] == pytest.approx(left[1], rel=2e-3)
    assert left[0] > 1e-3


@pytest.mark.parametrize("law", [UNSPLIT, VECTOR])
def test_an_exponent_next_to_one_goes_as_one_does(law):
    """As a range of a sweep may have it, from whose rounding the slip bent nothing."""
    step = (0.8, 0.0), (0.02, 0.01), NOTHING, 1.0
    one, tangents = update(*step, 1.0, law)[1:]
    for exponent in (1.0 + 2.3e-16, 1.0 + 1e-13, 1.0 + 1e-9, 1.0 + 2e-7):
        near, near_tangents = update(*step, exponent, law)[1:]
        assert near == pytest.approx(one, abs=1e-6)
        assert np.ravel(near_tangents) == pytest.approx(np.ravel(tangents), abs=1e-3)

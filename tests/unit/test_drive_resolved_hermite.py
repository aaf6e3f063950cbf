"""Values between the knots of a lattice: smooth, and of a parabola what it is."""

import itertools

import numpy as np
import pytest

from asperity.drive.resolved.flank import hermite

KNOTS = np.array([-2.0, -1.4, -0.3, 0.1, 1.5, 2.2, 4.0])


def at(places, values, knots=KNOTS):
    index, weights = hermite(knots, np.asarray(places, dtype=float))
    return (weights * values[index]).sum(axis=1)


@pytest.mark.parametrize("knots", [KNOTS, KNOTS[:3], np.linspace(0.0, 1.0, 5)])
def test_parabolas_are_met_everywhere_and_values_at_the_knots(knots):
    places = np.linspace(knots[0], knots[-1], 101)
    for coefficients in ((0.7,), (-1.3, 0.2), (0.4, 2.0, -1.0)):
        wanted = np.polyval(coefficients, places)
        assert at(places, np.polyval(coefficients, knots), knots) == pytest.approx(
            wanted, abs=1e-12
        )
    values = np.random.default_rng(2).normal(size=len(knots))
    assert at(knots, values, knots) == pytest.approx(values, abs=1e-12)


def test_slopes_at_the_knots_are_those_of_parabolas_from_both_sides():
    values = np.random.default_rng(3).normal(size=len(KNOTS))
    for k in range(1, len(KNOTS) - 1):
        three = slice(k - 1, k + 2)
        parabola = np.polyfit(KNOTS[three], values[three], 2)
        slope = np.polyval(np.polyder(parabola), KNOTS[k])
        for side in (-1e-6, 1e-6):
            other = at([KNOTS[k] + side], values)[0]
            assert (other - values[k]) / side == pytest.approx(slope, rel=1e-4)


def test_between_two_knots_it_is_a_cubic():
    values = np.random.default_rng(4).normal(size=len(KNOTS))
    for low, high in itertools.pairwise(KNOTS):
        places = np.linspace(low, high, 9)[1:-1]
        fitted = np.polyfit(places, at(places, values), 3)
        inner = np.linspace(low, high, 31)[1:-1]
        assert at(inner, values) == pytest.approx(np.polyval(fitted, inner), abs=1e-9)


def test_beyond_the_ends_it_is_what_it_is_there():
    values = np.random.default_rng(5).normal(size=len(KNOTS))
    assert at([-9.0, -2.0, 4.0, 4.1], values) == pytest.approx(values[[0, 0, -1, -1]])

"""Brent's method: roots are found, and where SciPy finds them."""

import math

import numpy as np
import pytest

from asperity.errors import ConvergenceError
from asperity.roots import root_between

FUNCTIONS = {
    "line": (lambda x: 3.0 * x - 1.0, -2.0, 5.0),
    "square": (lambda x: x * x - 2.0, 0.0, 2.0),
    "cosine": (lambda x: math.cos(x) - x, 0.0, 1.0),
    "steep": (lambda x: math.expm1(30.0 * (x - 0.9)), 0.0, 1.0),
    "flat": (lambda x: (x - 0.3) ** 3 + 1e-3 * (x - 0.3), -1.0, 2.0),
    "step": (lambda x: -1.0 if x < 0.123 else 1.0, 0.0, 1.0),
    "falling": (lambda x: 1.0 / x - 3.0, 5.0, 0.1),
    "tiny": (lambda x: 1e-300 * (x**3 - x - 2.0), 1.0, 2.0),
}


@pytest.mark.parametrize("name", FUNCTIONS)
@pytest.mark.parametrize("within", [2e-12, 1e-3])
def test_the_places_that_are_asked_for_are_those_of_scipy(name, within):
    from scipy.optimize import brentq

    function, low, high = FUNCTIONS[name]

    def asking(places):
        return lambda x: places.append(x) or function(x)

    ours, theirs = [], []
    root = root_between(asking(ours), low, high, within=within)
    assert root == pytest.approx(brentq(asking(theirs), low, high, xtol=within), rel=1e-12)
    assert len(ours) == len(theirs)
    assert ours == pytest.approx(theirs, rel=1e-9)
    assert abs(root - low) <= abs(high - low)


def test_a_root_is_as_near_as_asked():
    root = root_between(lambda x: x**3 - 5.0, 0.0, 5.0)
    assert abs(root - 5.0 ** (1.0 / 3.0)) <= 4e-12
    assert root_between(lambda x: x, 0.0, 1.0) == 0.0
    assert root_between(lambda x: x - 1.0, 0.0, 1.0) == 1.0
    assert type(root_between(lambda x: np.float64(x), np.float64(-1.0), np.float64(2.0))) is float


def test_what_has_no_root_is_refused():
    with pytest.raises(ValueError, match="same sign"):
        root_between(lambda x: x * x + 1.0, 0.0, 1.0)
    with pytest.raises(ValueError, match="NaN at"):
        root_between(lambda x: math.nan if x > 0.4 else -1.0, 0.0, 1.0)
    with pytest.raises(ConvergenceError, match="not found") as raised:
        root_between(lambda x: -1.0 if x < 1e-290 else 1.0, 0.0, 1.0, within=1e-300)
    assert raised.value.reached["at"] > 0.0

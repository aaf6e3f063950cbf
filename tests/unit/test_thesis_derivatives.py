"""The thesis's printed derivatives (98) to (141), and the scheme they are to be derivatives of."""

import numpy as np
import pytest

from asperity.thesis.contact.derivatives import Before, printed, scheme, worst

AT = Before(m_x=0.1, m_y=-0.2, n_y=0.3, s_0=0.6, eta=0.29, exponent=2.0)
WRONG = {"114", "128", "129"}
SQUARED = {"113", "135"}


def test_complex_steps_give_the_slopes_that_differences_give():
    x, y, h = 0.5, 0.35, 1e-6
    above, below = (scheme(AT, x, y + step, 1.0) for step in (h, -h))
    step = scheme(AT, x, y + 1e-30j, 1.0)
    for name in ("mn_2", "s_1", "cos_b", "sin_b", "tau_x"):
        slope = (above[name] - below[name]).real / (2.0 * h)
        assert step[name].imag / 1e-30 == pytest.approx(slope, rel=1e-6, abs=1e-9), name


def test_three_of_the_printed_derivatives_are_none_and_two_with_their_square():
    off = worst()
    assert {number for number, error in off.items() if error > 1e-9} == WRONG | SQUARED
    unsquared = worst(squared=False)
    assert {number for number, error in unsquared.items() if error > 1e-9} == WRONG
    assert {number.partition(",")[0] for number in off} == {str(n) for n in range(98, 142)}


def test_with_their_factor_and_their_brackets_the_three_are_right():
    x, y = 0.5, 0.35
    found = printed(AT, x, y, 1.0)
    q = {name: value.real for name, value in scheme(AT, x, y, 1.0).items()}
    slope = {n: v.imag / 1e-30 for n, v in scheme(AT, x, y + 1e-30j, 1.0).items()}
    along = {n: v.imag / 1e-30 for n, v in scheme(AT, x + 1e-30j, y, 1.0).items()}
    across = (1.0 - AT.eta) * (y - AT.n_y) + q["s"] * q["sin_a"]
    assert found["114"][1] == pytest.approx((1.0 - AT.eta) * across / q["mn_2"])
    bracketed = (q["mn_2"] * (1.0 - AT.eta) - across * slope["mn_2"]) / q["mn_2"] ** 2
    assert found["129"][1] == pytest.approx(bracketed)
    bracketed = (q["mn_2"] * along["s sin_a"] - across * along["mn_2"]) / q["mn_2"] ** 2
    assert found["128"][1] == pytest.approx(bracketed)


def test_the_scheme_leaves_the_asperity_where_it_was_if_nothing_moves():
    angle = 0.4
    at = Before(0.0, 0.0, 0.5 * np.sin(angle), 0.5, 0.29, 1.0)
    q = scheme(at, 0.5 * np.cos(angle), at.n_y, 1.0)
    assert q["s_1"] == pytest.approx(0.5)
    assert q["cos_b"] == pytest.approx(np.cos(angle))

"""Every piece of two formulas of ISO/TR 14521 alone: what no sum of all of them would show.

Sources: DIN 3996:1998 (parameter of the mean contact stress) and ISO/TR 14521:2010 (least film), as
two open ports of one commercial program print them; the numbers here are worked out by hand from
the print.
"""

import math

import numpy as np
import pytest

from asperity.rating.iso14521 import contact, film

# p_m* of 1998 by hand: 1.03 (0.4 + x_2/u + 0.01 z_2 - 0.083 b/m + sqrt(2 q - 1)/6.9
#   + (q + 50 (u + 1)/u)/(15.9 + 37.5 q)), with q = 8 the last denominator is 315.9.
_LAST = 15.9 + 37.5 * 8.0


def p_m(starts=1, teeth=50, q=8.0, x=0.0, width=24.0, m=4.0):
    return contact.contact_parameter(
        starts, teeth, q, m, 100.0, math.radians(20.0), x, wheel_face_width=width, edition="1998"
    )


def test_contact_of_1998_is_the_sum_of_its_pieces_worked_out_by_hand():
    # 0.4 + 0 + 0.5 - 0.498 + 0.561311 + (8 + 51)/315.9
    pieces = 0.4 + 0.5 - 0.083 * 6.0 + math.sqrt(15.0) / 6.9 + 59.0 / _LAST
    assert p_m() == pytest.approx(1.03 * pieces, rel=1e-14)
    assert p_m() == pytest.approx(1.184572, abs=1e-6)


def test_ratio_profile_shift_and_width_have_their_own_share_of_contact_of_1998():
    # Starts change the ratio alone: 50/u from 1 to 2.
    assert p_m(starts=2) - p_m() == pytest.approx(1.03 * 50.0 / 50.0 / _LAST, rel=1e-9)
    assert p_m(x=0.5) - p_m() == pytest.approx(1.03 * 0.5 / 50.0, rel=1e-9)
    assert p_m(width=28.0) - p_m() == pytest.approx(-1.03 * 0.083, rel=1e-9)


EXPONENTS = {
    "film_parameter": 1.0, "pressure_coefficient": 0.6, "dynamic_viscosity": 0.7,
    "worm_speed": 0.7, "centre_distance": 1.39, "reduced_modulus": 0.03, "wheel_torque": -0.13,
}  # fmt: skip
POINT = {
    "film_parameter": 0.07, "pressure_coefficient": 1.7e-8, "dynamic_viscosity": 0.05,
    "worm_speed": 1500.0, "centre_distance": 100.0, "reduced_modulus": 140000.0,
    "wheel_torque": 300.0,
}  # fmt: skip


@pytest.mark.parametrize("name", EXPONENTS)
def test_the_film_goes_with_the_printed_power_of_each_of_its_factors(name):
    twice = film.film_thickness(**{**POINT, name: 2.0 * POINT[name]})
    exponent = math.log2(twice / film.film_thickness(**POINT))
    assert exponent == pytest.approx(EXPONENTS[name], rel=1e-10)


def test_the_films_factor_of_21_is_there():
    logs = sum(EXPONENTS[name] * np.log(value) for name, value in POINT.items())
    assert film.film_thickness(**POINT) == pytest.approx(21.0 * math.exp(logs), rel=1e-12)

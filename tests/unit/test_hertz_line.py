"""Hertz line contact of worm and wheel, beside ISO's mean stress, and the worm shaft's stiffness.

Sources: Hertz; thesis 7.2.2 and 7.2.4 (209 and 120 GPa, 778 N/mm2 under 366 N m, 23 N m for
194.3 N/mm2, 4394 N m/rad).
"""

import doctest
import math

import numpy as np
import pytest

from asperity.errors import InputError
from asperity.rating import shaft
from asperity.rating.iso14521 import hertz

MODULUS = hertz.contact_modulus(209e3, 0.3, 120e3, 0.3)
ALPHA = math.radians(20.0)


def gearset_3(q):
    lead = math.atan(4.0 / q)
    m = 20.0376 * math.cos(lead) / q
    return 60.0 * m, m, q, lead, ALPHA, MODULUS


def test_line_contact_is_that_of_hertz():
    # sqrt(F E*/(pi R L)), and the force it carries over the width 2 b = 4 F/(pi L p0).
    force, radius, length = 1000.0, 10.0, 20.0
    p0 = hertz.line_contact_stress(force, radius, length, MODULUS)
    half_width = math.sqrt(4.0 * force * radius / (math.pi * length * MODULUS))
    assert 0.5 * math.pi * p0 * half_width * length == pytest.approx(force, rel=1e-13)


def test_equal_bodies_share_their_modulus():
    assert hertz.contact_modulus(210e3, 0.3, 210e3, 0.3) == pytest.approx(210e3 / (2.0 * 0.91))


def test_contact_modulus_is_half_of_isos_reduced_modulus():
    reduced = 2.0 / ((1.0 - 0.3**2) / 210e3 + (1.0 - 0.35**2) / 122.6e3)
    assert hertz.contact_modulus(210e3, 0.3, 122.6e3, 0.35) == pytest.approx(0.5 * reduced)


def test_rated_torque_of_gearset_3_makes_the_stress_of_the_thesis():
    assert round(hertz.worm_contact_stress(366.0, *gearset_3(8.36))) == 778


@pytest.mark.parametrize(("q", "stress"), [(8.02, 747), (8.76, 815)])
def test_efficiency_of_gearset_3_leaves_stresses_about_that_of_the_thesis(q, stress):
    assert hertz.worm_contact_stress(366.0, *gearset_3(q)) == pytest.approx(stress, rel=5e-3)


def test_stress_grows_with_the_square_root_of_torque():
    gearset = gearset_3(8.36)
    scaled = hertz.worm_contact_stress(23.0, *gearset) / hertz.worm_contact_stress(366.0, *gearset)
    assert scaled == pytest.approx(math.sqrt(23.0 / 366.0), rel=1e-14)
    assert 778.0 * scaled == pytest.approx(195.0, abs=0.05)


def test_stress_of_the_disc_tests_asks_for_the_torque_of_the_thesis():
    stress = hertz.worm_contact_stress(np.array([22.5, 23.5]), *gearset_3(8.36))
    assert stress[0] < 194.3 < stress[1]


def test_stress_is_that_of_a_cylinder_on_a_plane():
    d2, m, q, lead, alpha, modulus = gearset_3(8.2)
    load = 2e3 * 366.0 / (d2 * math.cos(alpha) * math.cos(lead))
    expected = hertz.line_contact_stress(
        load, 0.5 * d2 * math.sin(alpha), 2.0 * m * math.sqrt(q + 1.0), modulus
    )
    assert hertz.worm_contact_stress(366.0, d2, m, q, lead, alpha, modulus) == pytest.approx(
        expected, rel=1e-14
    )


def test_what_makes_no_contact_is_refused():
    with pytest.raises(InputError, match="wheel_torque is -1 N m; it must be zero or positive"):
        hertz.worm_contact_stress(-1.0, *gearset_3(8.2))
    with pytest.raises(InputError, match=r"poisson_ratio_2 is 0\.6; it must be from 0 to 0\.5"):
        hertz.contact_modulus(210e3, 0.3, 120e3, 0.6)


def test_worm_shaft_of_the_thesis():
    assert round(shaft.torsional_stiffness(17.0, 150.0, 209e3, 0.3)) == 4394


def test_shaft_twice_as_thick_is_sixteen_times_as_stiff_and_half_as_long_twice():
    one = shaft.torsional_stiffness(17.0, 150.0, 209e3, 0.3)
    assert shaft.torsional_stiffness(34.0, 150.0, 209e3, 0.3) == pytest.approx(16.0 * one)
    assert shaft.torsional_stiffness(17.0, 75.0, 209e3, 0.3) == pytest.approx(2.0 * one)


def test_shaft_without_length_is_refused():
    with pytest.raises(InputError, match="length is 0 mm; it must be positive"):
        shaft.torsional_stiffness(17.0, 0.0, 209e3, 0.3)


@pytest.mark.parametrize("module", [hertz, shaft])
def test_examples_in_the_documentation_hold(module):
    results = doctest.testmod(module)
    assert results.attempted > 0
    assert results.failed == 0

"""Laws of a contact in its normal direction, in units of the load W and of W over the slope there.

Hertz: Johnson, Contact Mechanics (1985), section 4.2, the force grows with the penetration to 3/2;
exponential heights: Greenwood and Williamson (1966), it grows e-fold over an equal penetration.
"""

import math

import pytest
from scipy.integrate import quad

from asperity.normal import (
    HERTZ,
    LINEAR,
    ROUGH,
    elastic_energy,
    elastic_force,
    elastic_slope,
    indentation,
)

LAWS = {"linear": LINEAR, "hertz": HERTZ, "rough": ROUGH}
AT_LOAD = {"linear": 1.0, "hertz": 1.5, "rough": 0.0}  # penetration there

laws = pytest.mark.parametrize("law", LAWS)


@laws
def test_at_the_load_force_and_slope_are_one(law):
    assert elastic_force(LAWS[law], AT_LOAD[law]) == pytest.approx(1.0, rel=1e-15)
    assert elastic_slope(LAWS[law], AT_LOAD[law]) == pytest.approx(1.0, rel=1e-15)


@pytest.mark.parametrize("d", [0.03, 0.4, 1.5, 2.2])
def test_the_force_grows_as_the_law_says(d):
    assert elastic_force(LINEAR, 2.0 * d) / elastic_force(LINEAR, d) == pytest.approx(2.0)
    assert elastic_force(HERTZ, 4.0 * d) / elastic_force(HERTZ, d) == pytest.approx(8.0)
    assert elastic_force(ROUGH, d + 1.0) / elastic_force(ROUGH, d) == pytest.approx(math.e)


@pytest.mark.parametrize("d", [0.03, 0.4, 1.5, 2.2])
@laws
def test_the_slope_is_the_derivative_and_the_energy_the_integral_of_the_force(law, d):
    law = LAWS[law]
    h = 1e-5
    differences = (elastic_force(law, d + h) - elastic_force(law, d - h)) / (2.0 * h)
    assert elastic_slope(law, d) == pytest.approx(differences, rel=1e-7)
    work, _ = quad(lambda x: elastic_force(law, x), 0.0, d, epsabs=1e-13)
    stored = elastic_energy(law, d) - elastic_energy(law, 0.0)
    assert stored == pytest.approx(work, rel=1e-9)


@pytest.mark.parametrize("law", [LINEAR, HERTZ])
def test_surfaces_that_are_apart_feel_nothing(law):
    for d in (-2.0, -1e-9, 0.0):
        assert elastic_force(law, d) == elastic_slope(law, d) == elastic_energy(law, d) == 0.0


@pytest.mark.parametrize("damped", [0.1, 0.9, 1.0, 1.05, 3.0])
@laws
def test_the_indentation_bears_by_elastic_force_alone_what_damping_makes_of_it(law, damped):
    law, d = LAWS[law], 1.3
    elastic = elastic_force(law, d)
    depth = indentation(law, d, elastic, damped * elastic)
    assert elastic_force(law, depth) == pytest.approx(damped * elastic, rel=1e-6)

"""The axial section f(rho): derivatives, the base cylinder, tables and their ends."""

import math

import numpy as np
import pytest

from asperity.errors import InputError
from asperity.flanks.parameters import Disc
from asperity.flanks.worm.profiles import axial, tabulate
from asperity.flanks.worm.types import TYPES, profile

pytestmark = pytest.mark.usefixtures("plain_kernels")

NUMBERS = {
    "pitch_radius": 9.046,
    "lead_angle": 0.444419,
    "pressure_angle": math.radians(20.0),
    "half_space": 1.6916,
    "reach": (6.95, 7.31, 11.2),
    "module": 2.1538,
}


@pytest.mark.parametrize("kind", TYPES)
def test_the_derivatives_are_those_of_the_function(kind):
    shape = profile(kind, **NUMBERS)
    rho = np.linspace(7.5, 11.0, 30)
    step = 1e-3
    f, f1, f2 = shape.derivatives(rho + step * np.arange(-2, 3)[:, None])

    def by_differences(values):
        return (8.0 * (values[3] - values[1]) - (values[4] - values[0])) / (12.0 * step)

    assert by_differences(f) == pytest.approx(f1[2], abs=1e-11)
    assert by_differences(f1) == pytest.approx(f2[2], abs=1e-8)


@pytest.mark.parametrize("kind", TYPES)
def test_the_compiled_function_is_the_method(kind):
    shape = profile(kind, **NUMBERS)
    assert axial(9.0, shape.section, shape.table) == tuple(map(float, shape.derivatives(9.0)))
    assert shape(np.array([[8.0, 9.0]])).shape == (1, 2)


def test_below_the_base_cylinder_zi_goes_on_radially_without_an_edge():
    shape = profile("ZI", **NUMBERS)
    base = shape.base_radius
    f, f1, f2 = shape.derivatives([0.5 * base, 0.99 * base, base])
    assert np.ptp(f) == 0.0
    assert (f1 == 0.0).all()
    assert (f2 == 0.0).all()
    assert shape.derivatives(base * (1.0 + 1e-12))[1] == pytest.approx(0.0, abs=1e-5)


@pytest.mark.parametrize(("count", "order"), [(17, 64.0)])
def test_a_table_converges_with_the_sixth_power_of_its_step(count, order):
    def worst(n):
        rho, step = np.linspace(1.0, 3.0, n, retstep=True)
        shape = tabulate("ZK", 1.0, step, np.sin(rho), np.cos(rho), -np.sin(rho))
        fine = np.linspace(1.0, 3.0, 1001)
        return np.abs(shape(fine) - np.sin(fine)).max()

    assert worst(count) / worst(2 * count - 1) == pytest.approx(order, rel=0.1)


def test_beyond_its_ends_a_table_goes_on_straight():
    rho, step = np.linspace(1.0, 3.0, 9, retstep=True)
    shape = tabulate("ZK", 1.0, step, rho**2, 2.0 * rho, np.full(9, 2.0))
    f, f1, f2 = shape.derivatives([0.5, 1.0, 3.0, 4.0])
    assert f == pytest.approx([0.0, 1.0, 9.0, 15.0])
    assert f1 == pytest.approx([2.0, 2.0, 6.0, 6.0])
    assert f2 == pytest.approx([0.0, 2.0, 2.0, 0.0])


def test_a_disc_of_200_mm_for_500_mm_moves_a_zk_flank_by_a_hundredth_and_a_zi_flank_not_at_all():
    rho = np.linspace(8.0, 11.0, 7)
    for kind, least, most in (("ZK", 0.01, 0.015), ("ZI", 0.0, 0.0)):
        small = profile(kind, **NUMBERS, disc=Disc(diameter="200 mm"))
        large = profile(kind, **NUMBERS, disc=Disc(diameter="500 mm"))
        off = np.ptp((small(rho) - small(9.046)) - (large(rho) - large(9.046)))
        assert least <= off <= most


def test_a_smaller_profile_radius_makes_zc_more_hollow():
    hollow = [
        float(
            profile("ZC", **NUMBERS, disc=Disc(profile_radius=radius, units="SI")).derivatives(9.0)[
                2
            ]
        )
        for radius in ("10 mm", "13 mm", "20 mm")
    ]
    assert hollow == sorted(hollow)
    assert hollow[-1] < 0.0


def test_an_unknown_type_is_refused():
    with pytest.raises(InputError, match=r"gearset\.flank is 'ZX'; it must be one of 'ZI', 'ZA'"):
        profile("ZX", **NUMBERS)


def test_a_disc_that_cannot_reach_the_flank_is_refused():
    steep = NUMBERS | {"pressure_angle": math.radians(8.0), "reach": (5.0, 6.0, 11.2)}
    with pytest.raises(
        InputError, match=r"gearset\.flank is 'ZK'; its disc of 500 mm cannot grind"
    ):
        profile("ZK", **steep)


def test_where_a_disc_does_not_grind_down_to_the_root_the_flank_goes_on_straight():
    deep = NUMBERS | {"reach": (6.0, 7.31, 11.2)}
    shape = profile("ZK", **deep)
    f, f1, f2 = shape.derivatives([6.0, 6.1])
    assert (f2 == 0.0).all()
    assert f1[0] == f1[1] == pytest.approx(10.0 * np.diff(f)[0])

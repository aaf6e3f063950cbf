"""Orders of a transmission error, and the error of rigid flanks at angles of the worm.

The definition: e = mean + sum of a_n cos(2 pi n theta/theta_p - psi_n).
"""

import math

import numpy as np
import pytest
from apparatus.grid import slow

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.drive.problem import DriveProblem
from asperity.drive.static.harmonics import ErrorHarmonics, exact_error, harmonics
from asperity.drive.static.sweep import PitchSweep
from asperity.flanks.meshing.transmission import transmission
from asperity.flanks.wheel.enveloped import Wheel
from asperity.flanks.worm.setting import Pair

UNEVEN = ("hob.rule=axial-module", "mount.shaft_angle_error=0.1 deg")


def wheel_of(*settings):
    problem = DriveProblem.from_case(read_case("drive-screw", case_tables(), settings))
    pair = Pair.of(problem.gearset, problem.hob, problem.mount, problem.modification, problem.disc)
    return Wheel.cut(pair)


@pytest.mark.parametrize("count", [3, 8, 12, 25])
def test_orders_put_together_are_the_error_they_were_found_of(count):
    rng = np.random.default_rng(count)
    orders = (count - 1) // 2
    amplitude, phase = rng.uniform(0.1, 2.0, orders), rng.uniform(0.0, 2.0 * math.pi, orders)
    theta = 2.0 * math.pi * np.arange(count) / count
    n = np.arange(1, orders + 1)
    error = 5.0 + np.cos(np.outer(theta, n) - phase) @ amplitude
    found = harmonics(error)
    np.testing.assert_allclose(found[0], amplitude, rtol=1e-12)
    np.testing.assert_allclose(found[1], phase, atol=1e-11)


def test_what_is_rounding_has_neither_amplitude_nor_phase():
    even = 1e-4 + 1e-17 * np.random.default_rng(1).standard_normal(12)
    amplitude, phase = harmonics(even)
    assert not amplitude.any()
    assert not phase.any()


def test_begun_elsewhere_amplitudes_stay_and_phases_turn_by_their_order():
    rng = np.random.default_rng(5)
    error = rng.standard_normal(13)
    one, other = harmonics(error), harmonics(np.roll(error, 2))
    np.testing.assert_allclose(other[0], one[0], rtol=1e-12)
    n = np.arange(1, 7)
    turned = np.exp(1j * (other[1] - one[1] - 2.0 * math.pi * n * 2 / 13))
    np.testing.assert_allclose(turned, 1.0, atol=1e-12)


@pytest.mark.ordinary(1)
@pytest.mark.parametrize("settings", [(), slow(UNEVEN), ("gearset.hand=left", *UNEVEN)])
def test_the_error_without_load_is_that_of_the_flanks_alone(settings):
    wheel = wheel_of(*settings)
    flank = transmission(wheel.pair, wheel.flank(1), 8)
    np.testing.assert_allclose(exact_error(wheel, flank.worm_angle), flank.error, atol=1e-11)
    if settings:
        assert np.ptp(flank.error) > 1e-4


@pytest.mark.slow
def test_what_the_mesh_makes_by_itself_is_told_beside_the_orders():
    wheel = wheel_of(*UNEVEN)
    angle = np.arange(8) * (2.0 * math.pi / 60.0 * 15.0 / 8)
    exact = exact_error(wheel, angle)
    own = 1e-6 * np.cos(2.0 * math.pi * np.arange(8) / 8)
    pitch_sweep = PitchSweep(
        100.0, angle, exact + own, np.full(8, 4e-4), np.ones(8), np.ones((8, 6)), 0.0,
    )  # fmt: skip
    loaded = 3e-6 * np.cos(2.0 * math.pi * (2 * np.arange(8) - 1) / 8)
    found = ErrorHarmonics.of(wheel, [pitch_sweep], [5e-6 + loaded])
    assert found.torque.tolist() == [0.0, 100.0]
    np.testing.assert_allclose(found.unloaded, exact, atol=1e-12)
    # Without load the first touch, under load what patches bear elsewhere than its points.
    np.testing.assert_allclose(found.noise, [[1e-6, 0.0, 0.0], [0.0, 3e-6, 0.0]], atol=1e-11)
    np.testing.assert_allclose(found.noise_range, [2e-6, np.ptp(loaded)], rtol=1e-4)
    # A deflection that does not change through the pitch leaves the orders of the touching mesh.
    np.testing.assert_allclose(found.amplitude[0], harmonics(exact)[0], atol=1e-12)
    np.testing.assert_allclose(found.amplitude[1], harmonics(exact + own)[0], atol=1e-12)

"""What thesis 7.2.4 needs: speed from sliding, torque from stress, amplitude from velocity."""

import doctest
import math

import numpy as np
import pytest

from asperity.errors import InputError
from asperity.rating import inverses

LEAD = math.atan(4.0 / 8.2)
D1 = 20.0376 * math.cos(LEAD)


def test_sliding_velocity_of_gearset_3_is_that_of_1440_rpm():
    assert inverses.worm_speed(1.5108, D1, LEAD) == pytest.approx(1440.0, rel=5e-5)


def test_worm_speed_inverts_isos_sliding_velocity():
    speed = np.array([0.0, 1.0, 144.0, 1440.0])
    sliding = D1 * speed / (19098.0 * math.cos(LEAD))
    np.testing.assert_allclose(inverses.worm_speed(sliding, D1, LEAD), speed, rtol=1e-14)


@pytest.mark.parametrize("velocity_ratio", [0.1, 1.0, 20.0])
def test_worm_speed_falls_with_the_velocity_ratio_at_a_given_vibration(velocity_ratio):
    speed = inverses.worm_speed(0.059 / velocity_ratio, D1, LEAD)
    assert speed == pytest.approx(1440.0 * 0.059 / velocity_ratio / 1.5108, rel=1e-4)


def test_torque_inverts_isos_mean_contact_stress():
    torque, a, p, reduced, application = 366.0, 74.93, 0.95, 174053.0, 1.25
    stress = 4.0 / math.pi * math.sqrt(p * application * torque * 1e3 * reduced / a**3)
    back = inverses.wheel_torque_from_mean_contact_stress(
        stress, a, p, reduced, application_factor=application
    )
    assert back == pytest.approx(torque, rel=1e-13)


@pytest.mark.parametrize(("velocity", "amplitude"), [(0.059, 12.52), (0.087, 18.46)])
def test_amplitudes_of_the_simulation_sets_at_750_hz(velocity, amplitude):
    assert round(inverses.vibration_amplitude(velocity, 750.0), 2) == amplitude


@pytest.mark.parametrize(("ratio", "frequency"), [(1, 1503), (2, 3006), (5, 7514), (20, 30056)])
def test_frequencies_of_the_third_simulation_set_at_160_um(ratio, frequency):
    assert round(inverses.vibration_frequency(ratio * 1.5108, 160.0)) == frequency


def test_amplitude_and_frequency_invert_each_other():
    velocity = np.array([1e-3, 0.059, 30.0])
    amplitude = inverses.vibration_amplitude(velocity, 750.0)
    back = inverses.vibration_frequency(velocity, amplitude)
    np.testing.assert_allclose(back, 750.0, rtol=1e-14)


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (
            lambda: inverses.worm_speed(-1.0, D1, LEAD),
            "sliding_velocity is -1 m/s; it must be zero",
        ),
        (lambda: inverses.worm_speed(1.0, D1, 1.6), "lead_angle is 1.6 rad; it must be above 0"),
        (lambda: inverses.vibration_amplitude(0.1, 0.0), "frequency is 0 Hz; it must be positive"),
        (
            lambda: inverses.vibration_frequency(0.1, -1.0),
            "amplitude is -1 um; it must be positive",
        ),
    ],
)
def test_what_cannot_be_inverted_is_refused(call, words):
    with pytest.raises(InputError, match=words):
        call()


def test_examples_in_the_documentation_hold():
    results = doctest.testmod(inverses)
    assert results.attempted > 0
    assert results.failed == 0

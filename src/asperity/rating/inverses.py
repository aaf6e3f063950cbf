"""From what a test imposes back to what drives it: speed, torque and vibration (thesis 7.2.4).

The torque for a line-contact stress is `asperity.rating.hertz.wheel_torque_from_contact_stress`.
"""

import math
from typing import Any

import numpy as np
import numpy.typing as npt

from asperity.rating.formula import Argument, Invalid, angle, evaluate, positive


def worm_speed(
    sliding_velocity: npt.ArrayLike,
    worm_pitch_diameter: npt.ArrayLike,
    lead_angle: npt.ArrayLike,
    *,
    on_invalid: Invalid = "raise",
) -> Any:
    r"""Worm speed for a sliding velocity.

    .. math:: n_1 = \frac{19098\, v_{gm} \cos\gamma_{m1}}{d_{m1}}

    Parameters
    ----------
    sliding_velocity : array_like
        :math:`v_{gm}`, m/s.
    worm_pitch_diameter : array_like
        :math:`d_{m1}`, mm.
    lead_angle : array_like
        :math:`\gamma_{m1}`, rad.
    on_invalid : {'raise', 'mask'}
        What to do with elements of arrays that are not allowed.

    Returns
    -------
    float, ndarray or Masked
        rpm.

    Notes
    -----
    With the rounded 60000/pi of ISO/TR 14521, whose sliding velocity it inverts.

    Examples
    --------
    >>> round(worm_speed(1.5108, 18.0088, 0.453878))
    1440
    """
    return evaluate(
        lambda v, d, g: 19098.0 * v * np.cos(g) / d,
        Argument("sliding_velocity", sliding_velocity, "m/s", 0.0),
        positive("worm_pitch_diameter", worm_pitch_diameter, "mm"),
        angle("lead_angle", lead_angle),
        on_invalid=on_invalid,
    )


def wheel_torque_from_mean_contact_stress(
    mean_contact_stress: npt.ArrayLike,
    centre_distance: npt.ArrayLike,
    pressure_parameter: npt.ArrayLike,
    reduced_modulus: npt.ArrayLike,
    *,
    application_factor: npt.ArrayLike = 1.0,
    on_invalid: Invalid = "raise",
) -> Any:
    r"""Wheel torque for a mean contact stress of ISO/TR 14521.

    .. math:: T_2 = \frac{\pi^2 \sigma_{Hm}^2 a^3}{16000\, p_m^* E_{red} K_A}

    Parameters
    ----------
    mean_contact_stress : array_like
        :math:`\sigma_{Hm}`, MPa.
    centre_distance : array_like
        :math:`a`, mm.
    pressure_parameter : array_like
        :math:`p_m^*`, [-].
    reduced_modulus : array_like
        :math:`E_{red}`, MPa.
    application_factor : array_like
        :math:`K_A`, [-].
    on_invalid
        As in `worm_speed`.

    Returns
    -------
    float, ndarray or Masked
        N m.
    """
    return evaluate(
        lambda s, a, p, e, k: (math.pi * s) ** 2 * a**3 / (16e3 * p * e * k),
        Argument("mean_contact_stress", mean_contact_stress, "MPa", 0.0),
        positive("centre_distance", centre_distance, "mm"),
        positive("pressure_parameter", pressure_parameter),
        positive("reduced_modulus", reduced_modulus, "MPa"),
        positive("application_factor", application_factor),
        on_invalid=on_invalid,
    )


def vibration_amplitude(
    vibration_velocity: npt.ArrayLike, frequency: npt.ArrayLike, *, on_invalid: Invalid = "raise"
) -> Any:
    r"""Amplitude of displacement of a sine vibration, :math:`u_a = v_a / (2 \pi f)`.

    Parameters
    ----------
    vibration_velocity : array_like
        Amplitude of velocity :math:`v_a`, m/s.
    frequency : array_like
        :math:`f`, Hz.
    on_invalid
        As in `worm_speed`.

    Returns
    -------
    float, ndarray or Masked
        um.

    Notes
    -----
    Thesis (12).

    Examples
    --------
    >>> round(vibration_amplitude(0.059, 750.0), 2)
    12.52
    """
    return evaluate(
        lambda v, f: v / (2.0 * math.pi * f),
        Argument("vibration_velocity", vibration_velocity, "m/s", 0.0),
        positive("frequency", frequency, "Hz"),
        on_invalid=on_invalid,
        scale=1e6,
    )


def vibration_frequency(
    vibration_velocity: npt.ArrayLike, amplitude: npt.ArrayLike, *, on_invalid: Invalid = "raise"
) -> Any:
    r"""Frequency of a sine vibration, :math:`f = v_a / (2 \pi u_a)`.

    Parameters
    ----------
    vibration_velocity : array_like
        Amplitude of velocity :math:`v_a`, m/s.
    amplitude : array_like
        Amplitude of displacement :math:`u_a`, um.
    on_invalid
        As in `worm_speed`.

    Returns
    -------
    float, ndarray or Masked
        Hz.

    Notes
    -----
    Thesis (12): how its simulation set 3 varies the velocity at a fixed 160 um.

    Examples
    --------
    >>> round(vibration_frequency(1.5108, 160.0))
    1503
    """
    return evaluate(
        lambda v, u: v / (2.0 * math.pi * u),
        Argument("vibration_velocity", vibration_velocity, "m/s", 0.0),
        positive("amplitude", amplitude, "um"),
        on_invalid=on_invalid,
        scale=1e6,
    )

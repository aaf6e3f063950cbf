"""Sliding velocity, friction and efficiency by AGMA 6034-B92."""

import math
from typing import Any

import numpy as np
import numpy.typing as npt

from asperity.rating.agma6034.units import LENGTH, VELOCITY, Units
from asperity.rating.formula import Argument, FloatArray, Invalid, angle, evaluate

PRESSURE_ANGLES_DEG = (14.5, 20.0, 25.0, 30.0)
"""Normal pressure angles the standard has values for, degrees; linear in between."""

_LEAD_ANGLE_LIMITS_DEG = (16.0, 25.0, 35.0, 45.0)


def sliding_velocity(
    worm_diameter: npt.ArrayLike,
    lead_angle: npt.ArrayLike,
    worm_speed: npt.ArrayLike,
    *,
    units: Units = "si",
    on_invalid: Invalid = "raise",
) -> Any:
    r"""Sliding velocity at the worm's mean diameter.

    .. math:: V_s = \frac{\pi d n_W}{\cos\lambda}

    Parameters
    ----------
    worm_diameter : array_like
        Mean diameter of the worm :math:`d`, mm [in].
    lead_angle : array_like
        :math:`\lambda`, rad.
    worm_speed : array_like
        :math:`n_W`, rpm.
    units : {'si', 'inch'}
        The units of arguments and result; the second in brackets.
    on_invalid : {'raise', 'mask'}
        What to do with elements of arrays that are not allowed.

    Returns
    -------
    float, ndarray or Masked
        m/s [ft/min].

    Notes
    -----
    AGMA 6034-B92, verified. The standard goes up to 30.48 m/s and 3600 rpm (from memory).

    Examples
    --------
    >>> round(sliding_velocity(3.0, 0.083141, 1800.0, units="inch"))
    1419
    """
    return evaluate(
        lambda d, lam, n: math.pi / 12.0 * d * n / np.cos(lam),
        LENGTH.argument("worm_diameter", worm_diameter, units),
        angle("lead_angle", lead_angle),
        Argument("worm_speed", worm_speed, "rpm", 0.0),
        on_invalid=on_invalid,
        scale=VELOCITY.scale(units),
    )


def pitch_line_velocity(
    wheel_diameter: npt.ArrayLike,
    wheel_speed: npt.ArrayLike,
    *,
    units: Units = "si",
    on_invalid: Invalid = "raise",
) -> Any:
    r"""Velocity of the wheel's pitch line.

    .. math:: V_G = \pi D n_G

    Parameters
    ----------
    wheel_diameter : array_like
        Mean diameter of the wheel :math:`D`, mm [in].
    wheel_speed : array_like
        :math:`n_G`, rpm.
    units, on_invalid
        As in `sliding_velocity`.

    Returns
    -------
    float, ndarray or Masked
        m/s [ft/min].
    """
    return evaluate(
        lambda diameter, n: math.pi / 12.0 * diameter * n,
        LENGTH.argument("wheel_diameter", wheel_diameter, units),
        Argument("wheel_speed", wheel_speed, "rpm", 0.0),
        on_invalid=on_invalid,
        scale=VELOCITY.scale(units),
    )


def friction(
    sliding_velocity: npt.ArrayLike, *, units: Units = "si", on_invalid: Invalid = "raise"
) -> Any:
    r"""Coefficient of friction.

    .. math:: f = \begin{cases} 0.15 & V_s = 0 \\
       0.124\, e^{-0.074 V_s^{0.645}} & 0 < V_s \le 10 \\
       0.103\, e^{-0.110 V_s^{0.450}} + 0.012 & 10 < V_s \end{cases}
       \qquad V_s \text{ in ft/min}

    Parameters
    ----------
    sliding_velocity : array_like
        :math:`V_s`, m/s [ft/min].
    units, on_invalid
        As in `sliding_velocity`.

    Returns
    -------
    float, ndarray or Masked
        :math:`f`, [-].

    Notes
    -----
    AGMA 6034-B92, verified. It jumps at rest and at 10 ft/min, see `jumps`.

    Examples
    --------
    >>> round(friction(1.0), 4), round(friction(5.0), 4)
    (0.0435, 0.0209)
    """
    return evaluate(
        _friction,
        VELOCITY.argument("sliding_velocity", sliding_velocity, units, above=False),
        on_invalid=on_invalid,
    )


def _friction(v: FloatArray) -> FloatArray:
    slow = 0.124 * np.exp(-0.074 * v**0.645)
    fast = 0.103 * np.exp(-0.110 * v**0.450) + 0.012
    return np.where(v == 0.0, 0.15, np.where(v <= 10.0, slow, fast))


def worm_driving_efficiency(
    friction: npt.ArrayLike,
    lead_angle: npt.ArrayLike,
    pressure_angle: npt.ArrayLike,
    *,
    on_invalid: Invalid = "raise",
) -> Any:
    r"""Efficiency of the mesh, the worm driving.

    .. math:: e_W = \frac{\cos\phi_n - f\tan\lambda}{\cos\phi_n + f\cot\lambda}

    Parameters
    ----------
    friction : array_like
        Coefficient of friction :math:`f \ge 0`, [-].
    lead_angle, pressure_angle : array_like
        :math:`\lambda`; normal pressure angle :math:`\phi_n`, rad.
    on_invalid
        As in `sliding_velocity`.

    Returns
    -------
    float, ndarray or Masked
        [-]. Zero or below: the worm cannot drive.

    Notes
    -----
    AGMA 6034-B92, verified; thesis (7).

    Examples
    --------
    >>> import math
    >>> round(worm_driving_efficiency(0.05, math.radians(20), math.radians(20)), 5)
    0.85556
    """
    return evaluate(
        lambda f, lam, phi: _efficiency(f, phi, np.sin(lam), np.cos(lam)),
        *_mesh(friction, lead_angle, pressure_angle),
        on_invalid=on_invalid,
    )


def wheel_driving_efficiency(
    friction: npt.ArrayLike,
    lead_angle: npt.ArrayLike,
    pressure_angle: npt.ArrayLike,
    *,
    on_invalid: Invalid = "raise",
) -> Any:
    r"""Efficiency of the mesh, the wheel driving.

    .. math:: e_G = \frac{\cos\phi_n - f\cot\lambda}{\cos\phi_n + f\tan\lambda}

    Parameters
    ----------
    friction, lead_angle, pressure_angle, on_invalid
        As in `worm_driving_efficiency`.

    Returns
    -------
    float, ndarray or Masked
        [-]. Zero or below: the gearset locks itself.

    Notes
    -----
    AGMA 6034-B92, verified.
    """
    return evaluate(
        lambda f, lam, phi: _efficiency(f, phi, np.cos(lam), np.sin(lam)),
        *_mesh(friction, lead_angle, pressure_angle),
        on_invalid=on_invalid,
    )


def maximum_lead_angle(pressure_angle: npt.ArrayLike, *, on_invalid: Invalid = "raise") -> Any:
    r"""Largest lead angle for a pressure angle.

    16, 25, 35 and 45 degrees for 14.5, 20, 25 and 30 degrees; linear in between.

    Parameters
    ----------
    pressure_angle : array_like
        :math:`\phi_n`, rad.
    on_invalid
        As in `sliding_velocity`.

    Returns
    -------
    float, ndarray or Masked
        :math:`\lambda_{max}`, rad.

    Notes
    -----
    AGMA 6034-B92, from memory.
    """
    return evaluate(
        lambda phi: np.interp(
            phi, np.deg2rad(PRESSURE_ANGLES_DEG), np.deg2rad(_LEAD_ANGLE_LIMITS_DEG)
        ),
        tabulated_pressure_angle(pressure_angle),
        on_invalid=on_invalid,
    )


def tabulated_pressure_angle(pressure_angle: npt.ArrayLike) -> Argument:
    """Return a pressure angle that must lie among `PRESSURE_ANGLES_DEG`."""
    first, last = np.deg2rad(PRESSURE_ANGLES_DEG[0]), np.deg2rad(PRESSURE_ANGLES_DEG[-1])
    # A whole degree turned into radians and back may end a rounding outside.
    return Argument(
        "pressure_angle",
        pressure_angle,
        "rad",
        float(np.nextafter(first, 0.0)),
        float(np.nextafter(last, 1.0)),
        because="AGMA 6034-B92 has values for 14.5 to 30 degrees",
    )


def _efficiency(f: FloatArray, phi: FloatArray, sin: FloatArray, cos: FloatArray) -> Any:
    # Times sine and cosine of the lead angle, so that no tangent grows beyond bounds. With the
    # wheel driving, sine and cosine change places.
    return sin * (np.cos(phi) * cos - f * sin) / (cos * (np.cos(phi) * sin + f * cos))


def _mesh(
    friction: npt.ArrayLike, lead_angle: npt.ArrayLike, pressure_angle: npt.ArrayLike
) -> tuple[Argument, Argument, Argument]:
    return (
        Argument("friction", friction, "", 0.0),
        angle("lead_angle", lead_angle),
        angle("pressure_angle", pressure_angle),
    )

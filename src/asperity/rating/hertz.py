"""Plain Hertz line-contact stress of worm and wheel, beside ISO's mean contact stress.

The thesis prints 778 N/mm2 for gearset 3 under 366 N m without its formula. A cylinder of the
radius of curvature that an involute wheel has at its pitch point, on a plane, over the width of
the wheel's face matches it best; other choices come close, so that this one is inferred.
"""

from typing import Any

import numpy as np
import numpy.typing as npt

from asperity.rating.formula import Argument, FloatArray, Invalid, angle, evaluate, positive
from asperity.sources import Source

SOURCE = Source("Hertz line contact", "verified", "its use for gearset 3 is inferred")


def contact_modulus(
    youngs_modulus_1: npt.ArrayLike,
    poisson_ratio_1: npt.ArrayLike,
    youngs_modulus_2: npt.ArrayLike,
    poisson_ratio_2: npt.ArrayLike,
    *,
    on_invalid: Invalid = "raise",
) -> Any:
    r"""Modulus of a contact of two bodies.

    .. math:: \frac{1}{E^*} = \frac{1 - \nu_1^2}{E_1} + \frac{1 - \nu_2^2}{E_2}

    Parameters
    ----------
    youngs_modulus_1, youngs_modulus_2 : array_like
        :math:`E_1, E_2`, MPa.
    poisson_ratio_1, poisson_ratio_2 : array_like
        :math:`\nu_1, \nu_2`, 0 to 0.5.
    on_invalid : {'raise', 'mask'}
        What to do with elements of arrays that are not allowed.

    Returns
    -------
    float, ndarray or Masked
        :math:`E^*`, MPa; half of ISO/TR 14521's :math:`E_{red}`.

    Examples
    --------
    >>> round(contact_modulus(209e3, 0.3, 120e3, 0.3))
    83770
    """
    return evaluate(
        lambda e1, nu1, e2, nu2: 1.0 / ((1.0 - nu1**2) / e1 + (1.0 - nu2**2) / e2),
        positive("youngs_modulus_1", youngs_modulus_1, "MPa"),
        Argument("poisson_ratio_1", poisson_ratio_1, "", 0.0, 0.5),
        positive("youngs_modulus_2", youngs_modulus_2, "MPa"),
        Argument("poisson_ratio_2", poisson_ratio_2, "", 0.0, 0.5),
        on_invalid=on_invalid,
    )


def line_contact_stress(
    normal_load: npt.ArrayLike,
    radius: npt.ArrayLike,
    length: npt.ArrayLike,
    contact_modulus: npt.ArrayLike,
    *,
    on_invalid: Invalid = "raise",
) -> Any:
    r"""Largest pressure of a cylinder on a plane.

    .. math:: \sigma_c = \sqrt{\frac{W_n E^*}{\pi \rho L}}

    Parameters
    ----------
    normal_load : array_like
        :math:`W_n`, N.
    radius, length : array_like
        Reduced radius of curvature :math:`\rho`; length of contact :math:`L`, mm.
    contact_modulus : array_like
        :math:`E^*`, MPa.
    on_invalid
        As in `contact_modulus`.

    Returns
    -------
    float, ndarray or Masked
        MPa.

    Examples
    --------
    >>> round(line_contact_stress(100.0, 10.0, 10.0, 115384.6))
    192
    """
    return evaluate(
        _pressure,
        Argument("normal_load", normal_load, "N", 0.0),
        positive("radius", radius, "mm"),
        positive("length", length, "mm"),
        positive("contact_modulus", contact_modulus, "MPa"),
        on_invalid=on_invalid,
    )


def worm_contact_stress(
    wheel_torque: npt.ArrayLike,
    wheel_diameter: npt.ArrayLike,
    axial_module: npt.ArrayLike,
    diameter_factor: npt.ArrayLike,
    lead_angle: npt.ArrayLike,
    pressure_angle: npt.ArrayLike,
    contact_modulus: npt.ArrayLike,
    *,
    on_invalid: Invalid = "raise",
) -> Any:
    r"""Line-contact stress of worm and wheel.

    `line_contact_stress` with

    .. math:: W_n = \frac{2 T_2}{d_2 \cos\alpha_n \cos\gamma}, \qquad
       \rho = \frac{d_2}{2} \sin\alpha_n, \qquad L = 2 m \sqrt{q + 1}

    Parameters
    ----------
    wheel_torque : array_like
        :math:`T_2`, N m.
    wheel_diameter, axial_module : array_like
        Pitch diameter of the wheel :math:`d_2`; :math:`m`, mm.
    diameter_factor : array_like
        :math:`q`, [-].
    lead_angle, pressure_angle : array_like
        :math:`\gamma`; normal pressure angle :math:`\alpha_n`, rad.
    contact_modulus : array_like
        :math:`E^*`, MPa.
    on_invalid
        As in `contact_modulus`.

    Returns
    -------
    float, ndarray or Masked
        :math:`\sigma_c`, MPa.
    """
    return evaluate(
        lambda torque, *rest: _pressure(torque / _arm(*rest[:5]), *_shape(*rest)),
        Argument("wheel_torque", wheel_torque, "N m", 0.0),
        *_gearset(
            wheel_diameter,
            axial_module,
            diameter_factor,
            lead_angle,
            pressure_angle,
            contact_modulus,
        ),
        on_invalid=on_invalid,
    )


def wheel_torque_from_contact_stress(
    contact_stress: npt.ArrayLike,
    wheel_diameter: npt.ArrayLike,
    axial_module: npt.ArrayLike,
    diameter_factor: npt.ArrayLike,
    lead_angle: npt.ArrayLike,
    pressure_angle: npt.ArrayLike,
    contact_modulus: npt.ArrayLike,
    *,
    on_invalid: Invalid = "raise",
) -> Any:
    r"""Wheel torque that makes a line-contact stress; the inverse of `worm_contact_stress`.

    .. math:: T_2 = \frac{\pi \rho L \sigma_c^2}{E^*} \frac{d_2}{2} \cos\alpha_n \cos\gamma

    Parameters
    ----------
    contact_stress : array_like
        :math:`\sigma_c`, MPa.
    wheel_diameter, axial_module, diameter_factor, lead_angle, pressure_angle, contact_modulus
        As in `worm_contact_stress`.
    on_invalid
        As in `contact_modulus`.

    Returns
    -------
    float, ndarray or Masked
        N m.
    """
    return evaluate(
        lambda stress, *rest: _load(stress, *_shape(*rest)) * _arm(*rest[:5]),
        Argument("contact_stress", contact_stress, "MPa", 0.0),
        *_gearset(
            wheel_diameter,
            axial_module,
            diameter_factor,
            lead_angle,
            pressure_angle,
            contact_modulus,
        ),
        on_invalid=on_invalid,
    )


def _gearset(
    d2: npt.ArrayLike,
    m: npt.ArrayLike,
    q: npt.ArrayLike,
    lead: npt.ArrayLike,
    pressure: npt.ArrayLike,
    modulus: npt.ArrayLike,
) -> tuple[Argument, ...]:
    return (
        positive("wheel_diameter", d2, "mm"),
        positive("axial_module", m, "mm"),
        positive("diameter_factor", q),
        angle("lead_angle", lead),
        angle("pressure_angle", pressure),
        positive("contact_modulus", modulus, "MPa"),
    )


def _pressure(load: FloatArray, radius: FloatArray, length: FloatArray, e: FloatArray) -> Any:
    return np.sqrt(load * e / (np.pi * radius * length))


def _load(pressure: FloatArray, radius: FloatArray, length: FloatArray, e: FloatArray) -> Any:
    return np.pi * radius * length * pressure**2 / e


def _arm(d2: FloatArray, m: FloatArray, q: FloatArray, lead: FloatArray, phi: FloatArray) -> Any:
    """N m of wheel torque for each N between the flanks."""
    return 0.5e-3 * d2 * np.cos(phi) * np.cos(lead)


def _shape(
    d2: FloatArray,
    m: FloatArray,
    q: FloatArray,
    lead: FloatArray,
    phi: FloatArray,
    modulus: FloatArray,
) -> tuple[FloatArray, FloatArray, FloatArray]:
    return 0.5 * d2 * np.sin(phi), 2.0 * m * np.sqrt(q + 1.0), modulus

"""ISO/TR 14521: mean contact stress and sliding path."""

from typing import Any

import numpy as np
import numpy.typing as npt

from asperity.rating.formula import Argument, FloatArray, Invalid, angle, evaluate, positive
from asperity.rating.iso14521.tables import Edition, Flank, check_words


def contact_parameter(
    starts: npt.ArrayLike,
    wheel_teeth: npt.ArrayLike,
    diameter_factor: npt.ArrayLike,
    axial_module: npt.ArrayLike,
    centre_distance: npt.ArrayLike,
    pressure_angle: npt.ArrayLike,
    profile_shift: npt.ArrayLike = 0.0,
    *,
    wheel_face_width: npt.ArrayLike | None = None,
    edition: Edition = "2010",
    flank: Flank = "ZI",
    on_invalid: Invalid = "raise",
) -> Any:
    r"""Parameter of the mean Hertzian stress.

    .. math::
        p_m^* &= 0.1794 + 0.2389\,\frac{a}{d_{m1}} + 0.0761\, x_2 |x_2|^{3.18} + 0.0536\, q_1
        - 0.00369\, z_2 - 0.01136\, \alpha_0 \\
        &+ 44.9814\,\frac{x_2 + 0.005657}{z_2} \left(\frac{z_1}{q_1}\right)^{2.6872}
        \quad \text{(A, I, N, K)} \\
        p_m^* &= 0.1401 + 0.1866\,\frac{a}{d_{m1}} + 0.0595\, x_2 |x_2|^{3.18} + 0.0419\, q_1
        - 0.00288\, z_2 - 0.0089\, \alpha_0 \\
        &+ 35.1417\,\frac{x_2 + 0.005657}{z_2} \left(\frac{z_1}{q_1}\right)^{2.6872}
        \quad \text{(C)}

    with :math:`\alpha_0` in degrees. Edition 1998, for every flank:

    .. math:: p_m^* = 1.03\left(0.4 + \frac{x_2}{u} + 0.01 z_2 - 0.083\frac{b_{2H}}{m_{x1}}
        + \frac{\sqrt{2 q_1 - 1}}{6.9} + \frac{q_1 + 50 (u+1)/u}{15.9 + 37.5 q_1}\right)

    Parameters
    ----------
    starts, wheel_teeth : array_like
        :math:`z_1`, :math:`z_2`.
    diameter_factor : array_like
        :math:`q_1`.
    axial_module, centre_distance : array_like
        :math:`m_{x1}`, :math:`a`, mm; :math:`d_{m1} = q_1 m_{x1}`.
    pressure_angle : array_like
        :math:`\alpha_0`, rad.
    profile_shift : array_like
        :math:`x_2`.
    wheel_face_width : array_like, optional
        :math:`b_{2H}`, mm, for edition 1998; left out: :math:`2 m_{x1}\sqrt{q_1 + 1}`.
    edition : {'1998', '2010'}
        Family of formulas.
    flank : {'ZA', 'ZI', 'ZN', 'ZK', 'ZC'}
        Of the worm.
    on_invalid : {'raise', 'mask'}
        What to do with elements of arrays that are not allowed, or where the parameter is not
        above zero (a large negative profile shift).

    Returns
    -------
    float, ndarray or Masked
        :math:`p_m^*`.

    Notes
    -----
    Edition 2010: one source. Edition 1998: verified.

    Examples
    --------
    >>> round(contact_parameter(4, 60, 8.2, 2.1962, 74.93, np.radians(20), 0.018), 3)
    1.167
    """
    check_words(edition=edition, flank=flank)
    arguments = [
        positive("starts", starts),
        positive("wheel_teeth", wheel_teeth),
        Argument("diameter_factor", diameter_factor, lower=0.5, above=True),
        positive("axial_module", axial_module, "mm"),
        positive("centre_distance", centre_distance, "mm"),
        angle("pressure_angle", pressure_angle),
        Argument("profile_shift", profile_shift),
    ]
    if wheel_face_width is not None:
        arguments.append(positive("wheel_face_width", wheel_face_width, "mm"))
    formula = _contact_concave if flank == "ZC" else _contact_convex
    return evaluate(
        _contact_1998 if edition == "1998" else formula,
        *arguments,
        on_invalid=on_invalid,
        result="p_m*",
        accept=lambda p: p > 0.0,
        because="it is not above zero for this geometry; bring the profile shift near 0",
    )


def path_parameter(
    ratio: npt.ArrayLike,
    lead_angle: npt.ArrayLike,
    *,
    flank: Flank = "ZI",
    on_invalid: Invalid = "raise",
) -> Any:
    r"""Parameter of the mean sliding path.

    .. math:: s^* = 0.78 + 0.21 u + 5.6/\tan\gamma_{m1} \quad \text{(A, I, N, K)}, \qquad
        s^* = 0.94 + 0.25 u + 6.7/\tan\gamma_{m1} \quad \text{(C)}

    Parameters
    ----------
    ratio : array_like
        :math:`u = z_2/z_1`.
    lead_angle : array_like
        :math:`\gamma_{m1}`, rad.
    flank : {'ZA', 'ZI', 'ZN', 'ZK', 'ZC'}
        Of the worm.
    on_invalid : {'raise', 'mask'}
        What to do with elements of arrays that are not allowed.

    Returns
    -------
    float, ndarray or Masked
        :math:`s^*`.

    Notes
    -----
    Verified.

    Examples
    --------
    >>> round(path_parameter(15, 0.453878), 2)
    15.41
    """
    check_words(flank=flank)
    constant, by_ratio, by_lead = (0.94, 0.25, 6.7) if flank == "ZC" else (0.78, 0.21, 5.6)
    return evaluate(
        lambda u, lead: constant + by_ratio * u + by_lead / np.tan(lead),
        positive("ratio", ratio),
        angle("lead_angle", lead_angle),
        on_invalid=on_invalid,
    )


def reduced_modulus(
    worm_modulus: npt.ArrayLike,
    worm_poisson: npt.ArrayLike,
    wheel_modulus: npt.ArrayLike,
    wheel_poisson: npt.ArrayLike,
    *,
    on_invalid: Invalid = "raise",
) -> Any:
    r"""Equivalent modulus of elasticity of worm and wheel.

    .. math:: E_{red} = \frac{2}{(1-\nu_1^2)/E_1 + (1-\nu_2^2)/E_2}

    Parameters
    ----------
    worm_modulus, wheel_modulus : array_like
        :math:`E_1`, :math:`E_2`, MPa.
    worm_poisson, wheel_poisson : array_like
        :math:`\nu_1`, :math:`\nu_2`, from 0 to 0.5.
    on_invalid : {'raise', 'mask'}
        What to do with elements of arrays that are not allowed.

    Returns
    -------
    float, ndarray or Masked
        MPa.

    Notes
    -----
    Verified.

    Examples
    --------
    >>> round(reduced_modulus(210e3, 0.3, 88300, 0.35))
    140144
    """
    return evaluate(
        lambda e1, nu1, e2, nu2: 2.0 / ((1.0 - nu1**2) / e1 + (1.0 - nu2**2) / e2),
        positive("worm_modulus", worm_modulus, "MPa"),
        Argument("worm_poisson", worm_poisson, lower=0.0, upper=0.5),
        positive("wheel_modulus", wheel_modulus, "MPa"),
        Argument("wheel_poisson", wheel_poisson, lower=0.0, upper=0.5),
        on_invalid=on_invalid,
    )


def contact_stress(
    contact_parameter: npt.ArrayLike,
    wheel_torque: npt.ArrayLike,
    reduced_modulus: npt.ArrayLike,
    centre_distance: npt.ArrayLike,
    *,
    on_invalid: Invalid = "raise",
) -> Any:
    r"""Mean contact stress.

    .. math:: \sigma_{Hm} = \frac{4}{\pi}
        \sqrt{\frac{p_m^*\, T_2\, 10^3\, E_{red}}{a^3}}

    Parameters
    ----------
    contact_parameter : array_like
        :math:`p_m^*`.
    wheel_torque : array_like
        :math:`T_2` with the application factor, N m.
    reduced_modulus : array_like
        :math:`E_{red}`, MPa.
    centre_distance : array_like
        :math:`a`, mm.
    on_invalid : {'raise', 'mask'}
        What to do with elements of arrays that are not allowed.

    Returns
    -------
    float, ndarray or Masked
        MPa.

    Notes
    -----
    Verified.

    Examples
    --------
    >>> round(contact_stress(1.0, 100.0, 140144.0, 100.0))
    151
    """
    return evaluate(
        lambda p, t, e, a: 4.0 / np.pi * np.sqrt(p * t * 1e3 * e / a**3),
        positive("contact_parameter", contact_parameter),
        positive("wheel_torque", wheel_torque, "N m"),
        positive("reduced_modulus", reduced_modulus, "MPa"),
        positive("centre_distance", centre_distance, "mm"),
        on_invalid=on_invalid,
    )


def load_cycles(
    life: npt.ArrayLike,
    worm_speed: npt.ArrayLike,
    ratio: npt.ArrayLike,
    *,
    on_invalid: Invalid = "raise",
) -> Any:
    r"""Turns of the wheel, which are the load cycles of each of its teeth.

    .. math:: N_L = 60\, L_h\, n_1/u

    Parameters
    ----------
    life : array_like
        :math:`L_h`, h.
    worm_speed : array_like
        :math:`n_1`, rpm.
    ratio : array_like
        :math:`u`.
    on_invalid : {'raise', 'mask'}
        What to do with elements of arrays that are not allowed.

    Returns
    -------
    float, ndarray or Masked
        :math:`N_L`.

    Notes
    -----
    A definition.

    Examples
    --------
    >>> load_cycles(25000.0, 1500.0, 15.0)
    150000000.0
    """
    return evaluate(
        lambda hours, n, u: 60.0 * hours * n / u,
        positive("life", life, "h"),
        positive("worm_speed", worm_speed, "rpm"),
        positive("ratio", ratio),
        on_invalid=on_invalid,
    )


def sliding_path(
    path_parameter: npt.ArrayLike,
    contact_stress: npt.ArrayLike,
    centre_distance: npt.ArrayLike,
    reduced_modulus: npt.ArrayLike,
    load_cycles: npt.ArrayLike,
    *,
    on_invalid: Invalid = "raise",
) -> Any:
    r"""Length that the worm slides over a flank of the wheel within its Hertzian width.

    .. math:: s_{Wm} = s^* \frac{\sigma_{Hm}\, a}{E_{red}} N_L

    Parameters
    ----------
    path_parameter : array_like
        :math:`s^*`.
    contact_stress, reduced_modulus : array_like
        :math:`\sigma_{Hm}`, :math:`E_{red}`, MPa.
    centre_distance : array_like
        :math:`a`, mm.
    load_cycles : array_like
        :math:`N_L`.
    on_invalid : {'raise', 'mask'}
        What to do with elements of arrays that are not allowed.

    Returns
    -------
    float, ndarray or Masked
        mm.

    Notes
    -----
    One source.
    """
    return evaluate(
        lambda s, stress, a, modulus, n: s * stress * a / modulus * n,
        positive("path_parameter", path_parameter),
        positive("contact_stress", contact_stress, "MPa"),
        positive("centre_distance", centre_distance, "mm"),
        positive("reduced_modulus", reduced_modulus, "MPa"),
        positive("load_cycles", load_cycles),
        on_invalid=on_invalid,
    )


def _fit(
    numbers: tuple[float, ...],
    z1: FloatArray,
    z2: FloatArray,
    q: FloatArray,
    m: FloatArray,
    a: FloatArray,
    alpha: FloatArray,
    x2: FloatArray,
) -> FloatArray:
    constant, by_distance, by_shift, by_q, by_teeth, by_angle, by_lead = numbers
    return np.asarray(
        constant
        + by_distance * a / (q * m)
        + by_shift * x2 * np.abs(x2) ** 3.18
        + by_q * q
        - by_teeth * z2
        - by_angle * np.degrees(alpha)
        + by_lead * (x2 + 0.005657) / z2 * np.power(z1 / q, 2.6872)
    )


def _contact_convex(*gearset: FloatArray) -> FloatArray:
    return _fit((0.1794, 0.2389, 0.0761, 0.0536, 0.00369, 0.01136, 44.9814), *gearset[:7])


def _contact_concave(*gearset: FloatArray) -> FloatArray:
    return _fit((0.1401, 0.1866, 0.0595, 0.0419, 0.00288, 0.0089, 35.1417), *gearset[:7])


def _contact_1998(
    z1: FloatArray,
    z2: FloatArray,
    q: FloatArray,
    m: FloatArray,
    a: FloatArray,
    alpha: FloatArray,
    x2: FloatArray,
    width: FloatArray | None = None,
) -> FloatArray:
    u = z2 / z1
    relative = 2.0 * np.sqrt(q + 1.0) if width is None else width / m
    return np.asarray(
        1.03
        * (
            0.4
            + x2 / u
            + 0.01 * z2
            - 0.083 * relative
            + np.sqrt(2.0 * q - 1.0) / 6.9
            + (q + 50.0 * (u + 1.0) / u) / (15.9 + 37.5 * q)
        )
    )

"""ISO/TR 14521: the worm's deflection, the shear stress at the wheel's root, and safeties."""

from typing import Any

import numpy as np
import numpy.typing as npt

from asperity.rating.formula import Argument, Invalid, angle, evaluate, positive

STEEL = 206e3
"""Modulus of elasticity for which the standard prints its deflection constant, MPa."""


def safety(
    allowable: npt.ArrayLike, actual: npt.ArrayLike, *, on_invalid: Invalid = "raise"
) -> Any:
    r"""Safety, what is allowable over what is there.

    .. math:: S_W = \frac{\delta_{Wlim,n}}{\delta_{Wn}}, \quad
        S_H = \frac{\sigma_{HG}}{\sigma_{Hm}}, \quad
        S_\delta = \frac{\delta_{lim}}{\delta_m}, \quad
        S_F = \frac{\tau_{FG}}{\tau_F}, \quad
        S_T = \frac{\vartheta_{S,lim}}{\vartheta_S}

    Parameters
    ----------
    allowable, actual : array_like
        Both in the same unit; temperatures in degC.
    on_invalid : {'raise', 'mask'}
        What to do with elements of arrays that are not allowed.

    Returns
    -------
    float, ndarray or Masked
        The least the standard asks for stands in `MINIMUM_SAFETIES`.

    Notes
    -----
    One source; that of the temperature from memory.

    Examples
    --------
    >>> safety(90.0, 60.0)
    1.5
    """
    return evaluate(
        lambda limit, value: limit / value,
        positive("allowable", allowable),
        positive("actual", actual),
        on_invalid=on_invalid,
    )


def worm_deflection(
    wheel_force: npt.ArrayLike,
    lead_angle: npt.ArrayLike,
    mean_friction: npt.ArrayLike,
    pressure_angle: npt.ArrayLike,
    worm_root_diameter: npt.ArrayLike,
    first_span: npt.ArrayLike,
    second_span: npt.ArrayLike,
    modulus: npt.ArrayLike = STEEL,
    *,
    on_invalid: Invalid = "raise",
) -> Any:
    r"""Deflection of the worm's shaft.

    .. math:: \delta_m = \frac{3.2\cdot 10^{-5}\, l_{11}^2\, l_{12}^2\, F_{tm2}
        \sqrt{\tan^2(\gamma_{m1} + \arctan\mu_{zm}) + \tan^2\alpha_0/\cos^2\gamma_{m1}}}
        {(1.1\, d_{f1})^4\,(l_{11} + l_{12})}

    for steel of 206 GPa; in general 6.592/E with E in MPa.

    Parameters
    ----------
    wheel_force : array_like
        :math:`F_{tm2}`, N.
    lead_angle, pressure_angle : array_like
        :math:`\gamma_{m1}`, :math:`\alpha_0`, rad.
    mean_friction : array_like
        :math:`\mu_{zm}`.
    worm_root_diameter : array_like
        :math:`d_{f1}`, mm.
    first_span, second_span : array_like
        From the wheel's axis to either bearing, :math:`l_{11}`, :math:`l_{12}`, mm.
    modulus : array_like
        :math:`E` of the worm, MPa.
    on_invalid : {'raise', 'mask'}
        What to do with elements of arrays that are not allowed, or where lead angle and friction
        angle reach 90 degrees.

    Returns
    -------
    float, ndarray or Masked
        mm.

    Notes
    -----
    One source.
    """
    return evaluate(
        _deflection,
        positive("wheel_force", wheel_force, "N"),
        angle("lead_angle", lead_angle),
        Argument("mean_friction", mean_friction, lower=0.0),
        angle("pressure_angle", pressure_angle),
        positive("worm_root_diameter", worm_root_diameter, "mm"),
        positive("first_span", first_span, "mm"),
        positive("second_span", second_span, "mm"),
        positive("modulus", modulus, "MPa"),
        on_invalid=on_invalid,
        result="delta_m",
        because="lead angle and friction angle reach 90 deg, so the worm cannot drive",
    )


def deflection_limit(axial_module: npt.ArrayLike, *, on_invalid: Invalid = "raise") -> Any:
    r"""Deflection that may be.

    .. math:: \delta_{lim} = 0.04\sqrt{m_{x1}}

    Parameters
    ----------
    axial_module : array_like
        :math:`m_{x1}`, mm.
    on_invalid : {'raise', 'mask'}
        What to do with elements of arrays that are not allowed.

    Returns
    -------
    float, ndarray or Masked
        mm.

    Notes
    -----
    One source.

    Examples
    --------
    >>> deflection_limit(4.0)
    0.08
    """
    return evaluate(
        lambda m: 0.04 * np.sqrt(m),
        positive("axial_module", axial_module, "mm"),
        on_invalid=on_invalid,
    )


def root_thickness(
    axial_module: npt.ArrayLike,
    wheel_pitch_diameter: npt.ArrayLike,
    wheel_root_diameter: npt.ArrayLike,
    pressure_angle: npt.ArrayLike,
    lead_angle: npt.ArrayLike,
    flank_wear: npt.ArrayLike = 0.0,
    *,
    on_invalid: Invalid = "raise",
) -> Any:
    r"""Mean thickness of a wheel's tooth at its root.

    .. math:: s_{ft2} = 1.06\left(\frac{\pi m_{x1}}{2} - \Delta s
        + (d_{m2} - d_{f2})\frac{\tan\alpha_0}{\cos\gamma_{m1}}\right), \qquad
        \Delta s = \frac{\min(\delta_{Wn}, \delta_{Wlim,n})}{\cos\gamma_{m1}}

    Parameters
    ----------
    axial_module : array_like
        :math:`m_{x1}`, mm.
    wheel_pitch_diameter, wheel_root_diameter : array_like
        :math:`d_{m2}`, :math:`d_{f2}`, mm.
    pressure_angle, lead_angle : array_like
        :math:`\alpha_0`, :math:`\gamma_{m1}`, rad.
    flank_wear : array_like
        The smaller of :math:`\delta_{Wn}` and :math:`\delta_{Wlim,n}`, mm.
    on_invalid : {'raise', 'mask'}
        What to do with elements of arrays that are not allowed, or where nothing is left of the
        tooth.

    Returns
    -------
    float, ndarray or Masked
        mm.

    Notes
    -----
    One source.
    """
    return evaluate(
        lambda m, dm, df, alpha, lead, worn: (
            1.06
            * (0.5 * np.pi * m - worn / np.cos(lead) + (dm - df) * np.tan(alpha) / np.cos(lead))
        ),
        positive("axial_module", axial_module, "mm"),
        positive("wheel_pitch_diameter", wheel_pitch_diameter, "mm"),
        positive("wheel_root_diameter", wheel_root_diameter, "mm"),
        angle("pressure_angle", pressure_angle),
        angle("lead_angle", lead_angle),
        Argument("flank_wear", flank_wear, "mm", 0.0),
        on_invalid=on_invalid,
        result="s_ft2",
        accept=lambda thickness: thickness > 0.0,
        because="the wear leaves nothing of the tooth",
    )


def form_factor(
    axial_module: npt.ArrayLike, root_thickness: npt.ArrayLike, *, on_invalid: Invalid = "raise"
) -> Any:
    r"""Form factor of the tooth root.

    .. math:: Y_F = 2.9\, m_{x1}/s_{ft2}

    Parameters
    ----------
    axial_module, root_thickness : array_like
        :math:`m_{x1}`, :math:`s_{ft2}`, mm.
    on_invalid : {'raise', 'mask'}
        What to do with elements of arrays that are not allowed.

    Returns
    -------
    float, ndarray or Masked
        :math:`Y_F`.

    Notes
    -----
    One source.
    """
    return evaluate(
        lambda m, s: 2.9 * m / s,
        positive("axial_module", axial_module, "mm"),
        positive("root_thickness", root_thickness, "mm"),
        on_invalid=on_invalid,
    )


def rim_factor(
    axial_module: npt.ArrayLike, rim_thickness: npt.ArrayLike, *, on_invalid: Invalid = "raise"
) -> Any:
    r"""Rim thickness factor of the tooth root.

    .. math:: Y_K = 1 \quad (s_K \ge 2 m_{x1}), \qquad
        Y_K = 1.043\,\ln(5.218\, m_{x1}/s_K) \quad \text{else}

    Parameters
    ----------
    axial_module, rim_thickness : array_like
        :math:`m_{x1}`, :math:`s_K`, mm.
    on_invalid : {'raise', 'mask'}
        What to do with elements of arrays that are not allowed.

    Returns
    -------
    float, ndarray or Masked
        :math:`Y_K`; jumps by 0.02 % where the rim is two modules thick.

    Notes
    -----
    One source for 5.218; another prints 5.281, with which it would jump by 1.3 %.

    Examples
    --------
    >>> rim_factor(2.0, 4.0), round(rim_factor(2.0, 3.0), 4)
    (1.0, 1.3003)
    """
    return evaluate(
        lambda m, s: np.where(s >= 2.0 * m, 1.0, 1.043 * np.log(5.218 * m / s)),
        positive("axial_module", axial_module, "mm"),
        positive("rim_thickness", rim_thickness, "mm"),
        on_invalid=on_invalid,
    )


def root_shear_stress(
    wheel_force: npt.ArrayLike,
    face_width: npt.ArrayLike,
    axial_module: npt.ArrayLike,
    form_factor: npt.ArrayLike,
    lead_angle: npt.ArrayLike,
    rim_factor: npt.ArrayLike = 1.0,
    contact_factor: npt.ArrayLike = 0.5,
    *,
    on_invalid: Invalid = "raise",
) -> Any:
    r"""Shear stress at the root of the wheel's teeth.

    .. math:: \tau_F = \frac{F_{tm2}}{b_{2H}\, m_{x1}} Y_\varepsilon\, Y_F\, Y_\gamma\, Y_K,
        \qquad Y_\gamma = 1/\cos\gamma_{m1}

    Parameters
    ----------
    wheel_force : array_like
        :math:`F_{tm2}`, N.
    face_width, axial_module : array_like
        :math:`b_{2H}`, :math:`m_{x1}`, mm.
    form_factor : array_like
        :math:`Y_F`.
    lead_angle : array_like
        :math:`\gamma_{m1}`, rad.
    rim_factor, contact_factor : array_like
        :math:`Y_K`; :math:`Y_\varepsilon`, 0.5.
    on_invalid : {'raise', 'mask'}
        What to do with elements of arrays that are not allowed.

    Returns
    -------
    float, ndarray or Masked
        MPa.

    Notes
    -----
    One source.
    """
    return evaluate(
        lambda force, b, m, yf, lead, yk, ye: force / (b * m) * ye * yf / np.cos(lead) * yk,
        positive("wheel_force", wheel_force, "N"),
        positive("face_width", face_width, "mm"),
        positive("axial_module", axial_module, "mm"),
        positive("form_factor", form_factor),
        angle("lead_angle", lead_angle),
        positive("rim_factor", rim_factor),
        positive("contact_factor", contact_factor),
        on_invalid=on_invalid,
    )


def root_shear_limit(
    shear_strength: npt.ArrayLike,
    life_factor: npt.ArrayLike = 1.0,
    *,
    on_invalid: Invalid = "raise",
) -> Any:
    r"""Shear stress at which the wheel's teeth break.

    .. math:: \tau_{FG} = \tau_{FlimT}\, Y_{NL}

    Parameters
    ----------
    shear_strength : array_like
        :math:`\tau_{FlimT}` of the wheel's material, MPa.
    life_factor : array_like
        :math:`Y_{NL}`; 1 from memory.
    on_invalid : {'raise', 'mask'}
        What to do with elements of arrays that are not allowed.

    Returns
    -------
    float, ndarray or Masked
        MPa.

    Notes
    -----
    One source.
    """
    return evaluate(
        lambda stress, y: stress * y,
        positive("shear_strength", shear_strength, "MPa"),
        positive("life_factor", life_factor),
        on_invalid=on_invalid,
    )


def _deflection(
    force: Any, lead: Any, mu: Any, alpha: Any, d: Any, l1: Any, l2: Any, e: Any
) -> Any:
    # Whole angles of 90 degrees have no meaning, but their tangent is a number.
    slope = np.where(lead + np.arctan(mu) < 0.5 * np.pi, np.tan(lead + np.arctan(mu)), np.nan)
    bend = np.sqrt(slope**2 + (np.tan(alpha) / np.cos(lead)) ** 2)
    return 6.592 / e * l1**2 * l2**2 * force * bend / ((1.1 * d) ** 4 * (l1 + l2))

"""ISO/TR 14521: the worm's deflection, the shear stress at the wheel's root, and safeties."""

from typing import Annotated

import numpy as np

from asperity.arrays import Real
from asperity.formulas import Symbol, formula, positive
from asperity.rating.iso14521 import symbols as s

STEEL = 206e3
"""Modulus of elasticity for which the standard prints its deflection constant, MPa."""

_Allowable = Annotated[Real, Symbol("allowable", "", positive)]
_Actual = Annotated[Real, Symbol("actual", "", positive)]


@formula(symbol="S", equation="allowable/actual", source=s.ONE_SOURCE)
def safety(allowable: _Allowable, actual: _Actual) -> Real:
    """Safety, what is allowable over what is there; temperatures in degC (so in MITCalc).

    The least the standard asks for stands in `asperity.rating.demands`.

    Examples
    --------
    >>> safety(90.0, 60.0)
    1.5
    """
    return allowable / actual


@formula(
    symbol="delta_m",
    unit="mm",
    equation="6.592/E_1 l_11^2 l_12^2 F_tm2 sqrt(tan(gamma_m1 + atan(mu_zm))^2 + "
    "tan(alpha_n)^2/cos(gamma_m1)^2)/((1.1 d_f1)^4 (l_11 + l_12))",
    source=s.ONE_SOURCE,
    because="lead angle and friction angle reach 90 deg, so the worm cannot drive",
)
def worm_deflection(
    wheel_force: s.F_tm2,
    lead_angle: s.gamma_m1,
    mean_friction: s.mu_zm,
    pressure_angle: s.alpha_n,
    worm_root_diameter: s.d_f1,
    first_span: s.l_11,
    second_span: s.l_12,
    modulus: s.E_1 = STEEL,
) -> Real:
    """Deflection of the worm's shaft; the spans go from the wheel's axis to either bearing.

    The standard prints 3.2e-5 in place of 6.592/E_1, for steel of 206 GPa.
    """
    angle = lead_angle + np.arctan(mean_friction)
    # Whole angles of 90 degrees have no meaning, but their tangent is a number.
    slope = np.where(angle < 0.5 * np.pi, np.tan(angle), np.nan)
    bend = np.sqrt(slope**2 + (np.tan(pressure_angle) / np.cos(lead_angle)) ** 2)
    stiffness = modulus * (1.1 * worm_root_diameter) ** 4 * (first_span + second_span)
    return 6.592 * first_span**2 * second_span**2 * wheel_force * bend / stiffness


@formula(symbol="delta_lim", unit="mm", equation="0.04 sqrt(m_x1)", source=s.ONE_SOURCE)
def deflection_limit(axial_module: s.m_x1) -> Real:
    """Deflection that may be.

    Examples
    --------
    >>> deflection_limit(4.0)
    0.08
    """
    return 0.04 * np.sqrt(axial_module)


@formula(
    symbol="s_ft2",
    unit="mm",
    equation="1.06 (pi m_x1/2 - min(delta_Wn, delta_Wlim)/cos(gamma_m1) + "
    "(d_m2 - d_f2) tan(alpha_n)/cos(gamma_m1))",
    source=s.ONE_SOURCE,
    result=positive,
    because="the wear leaves nothing of the tooth",
)
def root_thickness(
    axial_module: s.m_x1,
    wheel_mean_diameter: s.d_m2,
    wheel_root_diameter: s.d_f2,
    pressure_angle: s.alpha_n,
    lead_angle: s.gamma_m1,
    flank_wear: s.worn = 0.0,
) -> Real:
    """Mean thickness of a wheel's tooth at its root."""
    height = wheel_mean_diameter - wheel_root_diameter
    across = height * np.tan(pressure_angle) / np.cos(lead_angle)
    return 1.06 * (0.5 * np.pi * axial_module - flank_wear / np.cos(lead_angle) + across)


@formula(symbol="Y_F", equation="2.9 m_x1/s_ft2", source=s.ONE_SOURCE)
def form_factor(axial_module: s.m_x1, root_thickness: s.s_ft2) -> Real:
    """Form factor of the tooth root."""
    return 2.9 * axial_module / root_thickness


@formula(
    symbol="Y_K", equation="1 if s_K >= 2 m_x1 else 1.043 ln(5.218 m_x1/s_K)", source=s.ONE_SOURCE
)
def rim_factor(axial_module: s.m_x1, rim_thickness: s.s_K) -> Real:
    """Rim thickness factor of the tooth root; jumps by 0.02 % at two modules.

    Another source prints 5.281, with which it would jump by 1.3 %.

    Examples
    --------
    >>> rim_factor(2.0, 4.0), round(rim_factor(2.0, 3.0), 4)
    (1.0, 1.3003)
    """
    thin = 1.043 * np.log(5.218 * axial_module / rim_thickness)
    return np.where(rim_thickness >= 2.0 * axial_module, 1.0, thin)


@formula(
    symbol="tau_F",
    unit="MPa",
    equation="F_tm2/(b_2H m_x1) Y_epsilon Y_F Y_K/cos(gamma_m1)",
    source=s.ONE_SOURCE,
)
def root_shear_stress(
    wheel_force: s.F_tm2,
    face_width: s.b_2H,
    axial_module: s.m_x1,
    form_factor: s.Y_F,
    lead_angle: s.gamma_m1,
    rim_factor: s.Y_K = 1.0,
    contact_factor: s.Y_epsilon = 0.5,
) -> Real:
    """Shear stress at the root of the wheel's teeth; 1/cos(gamma_m1) is the standard's Y_gamma."""
    factors = contact_factor * form_factor / np.cos(lead_angle) * rim_factor
    return wheel_force / (face_width * axial_module) * factors


@formula(symbol="tau_FG", unit="MPa", equation="tau_FlimT Y_NL", source=s.ONE_SOURCE)
def root_shear_limit(shear_strength: s.tau_FlimT, life_factor: s.Y_NL = 1.0) -> Real:
    """Shear stress at which the wheel's teeth break; 1 is the factor MITCalc takes."""
    return shear_strength * life_factor

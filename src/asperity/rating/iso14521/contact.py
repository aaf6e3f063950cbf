"""ISO/TR 14521: mean contact stress and sliding path."""

from typing import Annotated

import numpy as np

from asperity.arrays import Real
from asperity.formulas import Bounds, Symbol, formula, positive
from asperity.rating.iso14521 import symbols as s
from asperity.rating.iso14521.tables import Edition, Flank

q_1 = Annotated[Real, Symbol("q_1", "", Bounds(0.5, above=True))]
n_1 = Annotated[Real, Symbol("n_1", "rpm", positive)]

# Constant, and what multiplies a/d_m1, x_2 |x_2|^3.18, q_1, z_2, alpha_n and the lead's term.
_CONVEX = (0.1794, 0.2389, 0.0761, 0.0536, -0.00369, -0.01136, 44.9814)
_CONCAVE = (0.1401, 0.1866, 0.0595, 0.0419, -0.00288, -0.0089, 35.1417)


@formula(
    symbol="p_m*",
    equation="0.1794 + 0.2389 a/(q_1 m_x1) + 0.0761 x_2 |x_2|^3.18 + 0.0536 q_1 - 0.00369 z_2 - "
    "0.01136 alpha_n 180/pi + 44.9814 (x_2 + 0.005657)/z_2 (z_1/q_1)^2.6872",
    source=s.ONE_SOURCE,
    result=positive,
    because="it is not above zero for this geometry; bring the profile shift near 0",
)
def contact_parameter(
    starts: s.z_1,
    wheel_teeth: s.z_2,
    diameter_factor: q_1,
    axial_module: s.m_x1,
    centre_distance: s.a,
    pressure_angle: s.alpha_n,
    profile_shift: s.x_2 = 0.0,
    *,
    wheel_face_width: s.b_2H | None = None,
    edition: Edition = "2010",
    flank: Flank = "ZI",
) -> Real:
    """Parameter of the mean Hertzian stress.

    Shown for flanks A, I, N and K; C has constants of its own. The edition of 1998 (verified) has
    another formula, the same for every flank, and it alone heeds the face width, which is
    2 m_x1 sqrt(q_1 + 1) where it is left out.

    Examples
    --------
    >>> round(contact_parameter(4, 60, 8.2, 2.1962, 74.93, np.radians(20), 0.018), 3)
    1.167
    """
    if edition == "1998":
        ratio = wheel_teeth / starts
        narrow = wheel_face_width is None
        width = 2.0 * np.sqrt(diameter_factor + 1.0) if narrow else wheel_face_width / axial_module
        return 1.03 * (
            0.4
            + profile_shift / ratio
            + 0.01 * wheel_teeth
            - 0.083 * width
            + np.sqrt(2.0 * diameter_factor - 1.0) / 6.9
            + (diameter_factor + 50.0 * (ratio + 1.0) / ratio) / (15.9 + 37.5 * diameter_factor)
        )
    terms = (
        1.0,
        centre_distance / (diameter_factor * axial_module),
        profile_shift * np.abs(profile_shift) ** 3.18,
        diameter_factor,
        wheel_teeth,
        np.degrees(pressure_angle),
        (profile_shift + 0.005657) / wheel_teeth * (starts / diameter_factor) ** 2.6872,
    )
    constants = _CONCAVE if flank == "ZC" else _CONVEX
    return sum(constant * term for constant, term in zip(constants, terms, strict=True))


@formula(symbol="s*", equation="0.78 + 0.21 u + 5.6/tan(gamma_m1)", source=s.VERIFIED)
def path_parameter(ratio: s.u, lead_angle: s.gamma_m1, *, flank: Flank = "ZI") -> Real:
    """Parameter of the mean sliding path.

    Shown for flanks A, I, N and K; C has 0.94 + 0.25 u + 6.7/tan(gamma_m1).

    Examples
    --------
    >>> round(path_parameter(15, 0.453878), 2)
    15.41
    """
    constant, by_ratio, by_lead = (0.94, 0.25, 6.7) if flank == "ZC" else (0.78, 0.21, 5.6)
    return constant + by_ratio * ratio + by_lead / np.tan(lead_angle)


@formula(
    symbol="E_red",
    unit="MPa",
    equation="2/((1 - nu_1^2)/E_1 + (1 - nu_2^2)/E_2)",
    source=s.VERIFIED,
)
def reduced_modulus(
    worm_modulus: s.E_1, worm_poisson: s.nu_1, wheel_modulus: s.E_2, wheel_poisson: s.nu_2
) -> Real:
    """Equivalent modulus of elasticity of worm and wheel.

    Examples
    --------
    >>> round(reduced_modulus(210e3, 0.3, 88300, 0.35))
    140144
    """
    return 2.0 / ((1.0 - worm_poisson**2) / worm_modulus + (1.0 - wheel_poisson**2) / wheel_modulus)


@formula(
    symbol="sigma_Hm",
    unit="MPa",
    equation="4/pi sqrt(p_m* T_2 1000 E_red/a^3)",
    source=s.VERIFIED,
)
def contact_stress(
    contact_parameter: s.p_m_star,
    wheel_torque: s.T_2,
    reduced_modulus: s.E_red,
    centre_distance: s.a,
) -> Real:
    """Mean contact stress; the torque is that with the application factor.

    Examples
    --------
    >>> round(contact_stress(1.0, 100.0, 140144.0, 100.0))
    151
    """
    load = contact_parameter * wheel_torque * 1e3 * reduced_modulus
    return 4.0 / np.pi * np.sqrt(load / centre_distance**3)


@formula(symbol="N_L", equation="60 L_h n_1/u", source=s.DEFINITION)
def load_cycles(life: s.L_h, worm_speed: n_1, ratio: s.u) -> Real:
    """Turns of the wheel, which are the load cycles of each of its teeth.

    Examples
    --------
    >>> load_cycles(25000.0, 1500.0, 15.0)
    150000000.0
    """
    return 60.0 * life * worm_speed / ratio


@formula(symbol="s_Wm", unit="mm", equation="s* sigma_Hm a/E_red N_L", source=s.ONE_SOURCE)
def sliding_path(
    path_parameter: s.s_star,
    contact_stress: s.sigma_Hm,
    centre_distance: s.a,
    reduced_modulus: s.E_red,
    load_cycles: s.N_L,
) -> Real:
    """Length that the worm slides over a flank of the wheel within its Hertzian width."""
    return path_parameter * contact_stress * centre_distance / reduced_modulus * load_cycles

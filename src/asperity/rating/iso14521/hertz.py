"""Plain Hertz line-contact stress of worm and wheel, beside ISO's mean contact stress.

The thesis prints 778 N/mm2 for gearset 3 under 366 N m without its formula. A cylinder of the
radius of curvature that an involute wheel has at its pitch point, on a plane, over the width of
the wheel's face matches it best; other choices come close, so that this one is inferred.
"""

from typing import Annotated

import numpy as np

from asperity.arrays import Real
from asperity.formulas import Symbol, formula, not_negative, positive
from asperity.rating.iso14521 import symbols as s
from asperity.sources import Source

SOURCE = Source("Hertz line contact", "verified", "its use for gearset 3 is inferred")

E_star = Annotated[Real, Symbol("E*", "MPa", positive)]
W_n = Annotated[Real, Symbol("W_n", "N", not_negative)]
rho = Annotated[Real, Symbol("rho", "mm", positive)]
L = Annotated[Real, Symbol("L", "mm", positive)]
T_2 = Annotated[Real, Symbol("T_2", "N m", not_negative)]
d_2 = Annotated[Real, Symbol("d_2", "mm", positive)]


@formula(symbol="E*", unit="MPa", equation="1/((1 - nu_1^2)/E_1 + (1 - nu_2^2)/E_2)", source=SOURCE)
def contact_modulus(
    youngs_modulus_1: s.E_1,
    poisson_ratio_1: s.nu_1,
    youngs_modulus_2: s.E_2,
    poisson_ratio_2: s.nu_2,
) -> Real:
    """Modulus of a contact of two bodies; half of ISO/TR 14521's E_red.

    Examples
    --------
    >>> round(contact_modulus(209e3, 0.3, 120e3, 0.3))
    83770
    """
    first = (1.0 - poisson_ratio_1**2) / youngs_modulus_1
    return 1.0 / (first + (1.0 - poisson_ratio_2**2) / youngs_modulus_2)


@formula(symbol="sigma_c", unit="MPa", equation="sqrt(W_n E*/(pi rho L))", source=SOURCE)
def line_contact_stress(normal_load: W_n, radius: rho, length: L, contact_modulus: E_star) -> Real:
    """Largest pressure of a cylinder of a reduced radius of curvature on a plane.

    Examples
    --------
    >>> round(line_contact_stress(100.0, 10.0, 10.0, 115384.6))
    192
    """
    return np.sqrt(normal_load * contact_modulus / (np.pi * radius * length))


@formula(
    symbol="sigma_c",
    unit="MPa",
    equation="sqrt(W_n E*/(pi rho L)) with W_n = 2000 T_2/(d_2 cos(alpha_n) cos(gamma_m1)), "
    "rho = d_2 sin(alpha_n)/2, L = 2 m_x1 sqrt(q_1 + 1)",
    source=SOURCE,
)
def worm_contact_stress(
    wheel_torque: T_2,
    wheel_diameter: d_2,
    axial_module: s.m_x1,
    diameter_factor: s.q_1,
    lead_angle: s.gamma_m1,
    pressure_angle: s.alpha_n,
    contact_modulus: E_star,
) -> Real:
    """Line-contact stress of worm and wheel, by the wheel's pitch diameter."""
    arm = 0.5e-3 * wheel_diameter * np.cos(pressure_angle) * np.cos(lead_angle)
    radius = 0.5 * wheel_diameter * np.sin(pressure_angle)
    length = 2.0 * axial_module * np.sqrt(diameter_factor + 1.0)
    return np.sqrt(wheel_torque / arm * contact_modulus / (np.pi * radius * length))

"""The heat balance of a housing, which stands beside the sump formula of ISO/TR 14521.

The standard's formula goes by torque, speed, ratio and viscosity and knows neither losses nor
housing; the balance goes by nothing else. One mass takes the heat.
"""

from typing import Annotated

import numpy as np

from asperity.arrays import Real
from asperity.formulas import Bounds, Symbol, formula, not_negative, positive
from asperity.rating.iso14521 import symbols as s
from asperity.sources import Source

AREA = Source("Chirkov and Stavishenko, Calculation of toothed and screw gears", "one source")
RIBBED = Source("Autodesk, Inventor help, worm gears", "one source", "a well ribbed housing")
LEAST = Source("ANSI/AGMA 6034-B92", "one source", "the least that a designer should provide")
STEADY = Source("Jindal, Machine Design, ch. 28", "verified")
ONE_MASS = Source("definition", "verified", "of one mass that is heated and cooled")
MEASURED = Source("own rule of asperity", "own choice", "the exponent is that of P_V0")

A_h = Annotated[Real, Symbol("A_h", "m2", positive)]
k_h = Annotated[Real, Symbol("k_h", "W/(m2 K)", positive)]
psi = Annotated[Real, Symbol("psi", "", not_negative)]
K_h = Annotated[Real, Symbol("K_h", "W/K", positive)]
P_h = Annotated[Real, Symbol("P_h", "W", not_negative)]
C_h = Annotated[Real, Symbol("C_h", "J/K", positive)]
tau = Annotated[Real, Symbol("tau", "s", positive)]
dtheta = Annotated[Real, Symbol("dtheta_h", "K", not_negative)]
t = Annotated[Real, Symbol("t", "s", not_negative)]
ED = Annotated[Real, Symbol("ED", "", Bounds(0.0, 1.0, above=True))]
P_m = Annotated[Real, Symbol("P_m", "W", not_negative)]
n_m = Annotated[Real, Symbol("n_m", "rpm", positive)]


@formula(symbol="A_h", unit="m2", equation="20 (a/1000)^1.7", source=AREA)
def housing_area(centre_distance: s.a) -> Real:
    """Surface of a housing that gives off heat, with half of that of its ribs.

    Examples
    --------
    >>> round(housing_area(100.0), 5), round(housing_area(63.0), 5)
    (0.39905, 0.18193)
    """
    return 20.0 * (centre_distance / 1000.0) ** 1.7


@formula(symbol="A_h", unit="m2", equation="9e-5 a^1.85", source=RIBBED)
def ribbed_area(centre_distance: s.a) -> Real:
    """Surface of a housing that is well ribbed.

    Examples
    --------
    >>> round(ribbed_area(100.0), 5), round(ribbed_area(63.0), 5)
    (0.45107, 0.19188)
    """
    return 9e-5 * centre_distance**1.85


@formula(symbol="A_h", unit="m2", equation="43.2 (a/25.4)^1.7 0.0254^2", source=LEAST)
def least_area(centre_distance: s.a) -> Real:
    """Surface that a housing should have at least, by AGMA 6034.

    Examples
    --------
    >>> round(least_area(100.0), 5), round(least_area(63.0), 5)
    (0.28637, 0.13056)
    """
    return 43.2 * (centre_distance / 25.4) ** 1.7 * 0.0254**2


AREAS = {"half ribbed": housing_area, "well ribbed": ribbed_area, "AGMA minimum": least_area}
"""The rules of a housing's surface, by their name in the table ``[housing]``."""


@formula(symbol="K_h", unit="W/K", equation="k_h A_h (1 + psi)", source=STEADY)
def conductance(heat_transfer: k_h, area: A_h, base: psi = 0.0) -> Real:
    """Heat given off for each kelvin above the air; a bolted metal base adds a share."""
    return heat_transfer * area * (1.0 + base)


@formula(symbol="dtheta_h", unit="K", equation="P_h/K_h", source=STEADY)
def steady_rise(loss: P_h, conductance: K_h) -> Real:
    """Rise of the housing above the air once it is as warm as it gets.

    Examples
    --------
    Jindal's example 28-5, of 1.8 m2 and 16 W/(m2 K); the book has 18.7 K.

    >>> round(steady_rise(539.4, 16.0 * 1.8), 2)
    18.73
    """
    return loss / conductance


@formula(symbol="tau", unit="s", equation="C_h/K_h", source=ONE_MASS)
def time_constant(capacity: C_h, conductance: K_h) -> Real:
    """Time in which the housing covers 63 % of what is left to its steady temperature."""
    return capacity / conductance


@formula(symbol="dtheta_t", unit="K", equation="dtheta_h (1 - exp(-t/tau))", source=ONE_MASS)
def rise_after(steady_rise: dtheta, time: t, time_constant: tau) -> Real:
    """Rise after a time of load from cold: S2.

    Examples
    --------
    >>> round(rise_after(70.016, 900.0, 1587.1), 3)
    30.304
    """
    return steady_rise * (1.0 - np.exp(-time / time_constant))


@formula(
    symbol="dtheta_t",
    unit="K",
    equation="dtheta_h (1 - r_1)/(1 - r_1 r_2), r_1 = exp(-ED t/tau), r_2 = exp(-(1 - ED) t/tau_0)",
    source=ONE_MASS,
)
def rise_in_cycles(
    steady_rise: dtheta, share: ED, cycle: t, time_constant: tau, time_constant_at_rest: tau
) -> Real:
    """Highest rise in equal cycles of load and rest, once they repeat: S3.

    Examples
    --------
    >>> round(rise_in_cycles(70.016, 0.15, 600.0, 1587.1, 1587.1), 3)
    12.261
    """
    on = np.exp(-share * cycle / time_constant)
    off = np.exp(-(1.0 - share) * cycle / time_constant_at_rest)
    return steady_rise * (1.0 - on) / (1.0 - on * off)


@formula(symbol="dtheta_u", unit="K", equation="dtheta_t exp(-(1 - ED) t/tau_0)", source=ONE_MASS)
def rise_before_load(top: dtheta, share: ED, cycle: t, time_constant_at_rest: tau) -> Real:
    """Lowest rise in equal cycles of load and rest, at the end of the rest.

    Examples
    --------
    >>> round(rise_before_load(12.2614, 0.15, 600.0, 1587.1), 3)
    8.892
    """
    return top * np.exp(-(1.0 - share) * cycle / time_constant_at_rest)


@formula(symbol="P_V0", unit="W", equation="P_m (n_1/n_m)^(4/3)", source=MEASURED)
def measured_idle_loss(loss: P_m, measured_at: n_m, worm_speed: s.n_1) -> Real:
    """Loss without load at another speed than that it was measured at."""
    ratio = worm_speed / measured_at
    return loss * ratio * np.cbrt(ratio)


@formula(symbol="P_VD", unit="W", equation="P_m n_1/n_m", source=MEASURED)
def measured_seal_loss(loss: P_m, measured_at: n_m, worm_speed: s.n_1) -> Real:
    """Loss of the seals at another speed than that it was measured at."""
    return loss * worm_speed / measured_at

"""ISO/TR 14521: temperature of the oil sump and of the wheel."""

from typing import Annotated, Literal

import numpy as np

from asperity.arrays import Real
from asperity.formulas import Bounds, Symbol, check, formula, not_negative, once
from asperity.gearset.materials import BaseOilName
from asperity.rating.iso14521 import symbols as s

Immersed = Literal["worm", "wheel"]

T_2 = Annotated[Real, Symbol("T_2", "N m", not_negative)]
a = Annotated[Real, Symbol("a", "mm", Bounds(20.4, above=True))]

_N_1_OF_A_FAN = Symbol("n_1", "rpm", Bounds(13.8, above=True))
_A_OF_A_FAN = Symbol("a", "mm", Bounds(48.0, above=True))
_OIL_CONSTANT = {"mineral": 9.0, "polyalphaolefin": 5.0, "polyglycol": 0.0}


@formula(
    symbol="theta_S",
    unit="degC",
    equation="theta_0 + (c_1 T_2/(a/63)^3 + c_0) c_2",
    source=s.SUMP,
    because="c_2 is not above zero at this ratio and speed; lower the ratio",
)
def sump_temperature(
    wheel_torque: T_2,
    worm_speed: s.n_1,
    ratio: s.u,
    centre_distance: a,
    viscosity_40: s.nu_40,
    ambient_temperature: s.theta_0 = 20.0,
    *,
    base_oil: BaseOilName = "mineral",
    fan: bool = False,
) -> Real:
    """Temperature of the oil sump of a cast-iron housing with splash lubrication.

    With a fan on the worm's shaft the worm must turn faster than 13.8 rpm, and the centre distance
    be above 48 mm; the sign in a + 32 is MITCalc's. The range (a 63 to 400 mm, n_1 60 to 3000 rpm,
    u 10 to 40) is from memory. Without a fan the printed c_0 drops to zero in a sharp dip at
    nu_40 = 220.3 mm2/s.
    """
    if fan:
        worm_speed = check("worm_speed", worm_speed, _N_1_OF_A_FAN)
        centre_distance = check("centre_distance", centre_distance, _A_OF_A_FAN)
    k = _OIL_CONSTANT[base_oil]
    c_0, c_1, c_2 = _of_sump(worm_speed, ratio, centre_distance, viscosity_40, k, fan)
    size = (centre_distance / 63.0) ** 3
    return ambient_temperature + (c_1 * wheel_torque / size + c_0) * c_2


@once
def _of_sump(
    worm_speed: Real, ratio: Real, a: Real, viscosity_40: Real, k: float, fan: bool
) -> tuple[Real, Real, Real]:
    """Return c_0, c_1 and c_2, which know nothing of the torque."""
    n, nu = worm_speed / 60.0, viscosity_40 / 100.0
    if fan:
        c_0 = 0.081 * (n - 0.23) ** 0.7 * nu**0.41 * (a + 32.0) ** 0.63
        c_1 = 0.039 * (n + 2.0) ** 0.34 * nu**-0.17 * ratio**-0.22 * (a - 48.0) ** 0.34
    else:
        c_0 = 0.0523 * (n + 0.28) ** 0.68 * np.abs(nu - 2.203) ** 0.0237 * (a + 22.36) ** 0.915
        c_1 = 0.034 * (n + 0.22) ** 0.43 * (10.8 - nu) ** -0.0636 * ratio**-0.18
        c_1 = c_1 * (a - 20.4) ** 0.26
    below = (0.012 * ratio + 0.092) * np.sqrt(worm_speed) - 0.745 * ratio + 82.877
    c_2 = np.where(below > k, 1.0 - k / below, np.nan)
    return c_0, c_1, c_2


@formula(
    symbol="alpha_L", unit="W/(m2 K)", equation="c_k max(1940 + 15 n_1, 4190)", source=s.ONE_SOURCE
)
def heat_transfer_coefficient(worm_speed: s.n_1, *, immersed: Immersed = "worm") -> Real:
    """Heat transfer from the wheel to the oil; bends at 150 rpm and does not jump.

    c_k is 1 where the worm dips into the oil and 0.8 where the wheel does.

    Examples
    --------
    >>> heat_transfer_coefficient(1000.0)
    16940.0
    """
    share = 1.0 if immersed == "worm" else 0.8
    return share * np.maximum(1940.0 + 15.0 * worm_speed, 4190.0)


@formula(symbol="A_R", unit="m2", equation="1e-6 b_2R d_m2", source=s.ONE_SOURCE)
def cooling_area(rim_width: s.b_2R, wheel_mean_diameter: s.d_m2) -> Real:
    """Surface over which the wheel gives its heat to the oil."""
    return rim_width * wheel_mean_diameter * 1e-6


@formula(
    symbol="theta_M", unit="degC", equation="theta_S + P_Vz/(alpha_L A_R)", source=s.ONE_SOURCE
)
def bulk_temperature(
    sump_temperature: s.theta_S,
    meshing_loss: s.P_Vz,
    heat_transfer_coefficient: s.alpha_L,
    cooling_area: s.A_R,
) -> Real:
    """Temperature of the wheel's teeth under splash lubrication.

    Examples
    --------
    >>> bulk_temperature(60.0, 500.0, 20000.0, 0.0025)
    70.0
    """
    return sump_temperature + meshing_loss / (heat_transfer_coefficient * cooling_area)

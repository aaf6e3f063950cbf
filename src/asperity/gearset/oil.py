"""Viscosity and density of an oil at temperature, by the formulas of ISO/TR 14521."""

import math

import numpy as np

from asperity.arrays import Real
from asperity.formulas import formula
from asperity.gearset.symbols import k_rho, nu_40, nu_100, rho_15, theta
from asperity.sources import Range, Source

FORMULAS = Source("ISO/TR 14521:2010, DIN 3996:2012", "one source")
"""Where the formulas of this module come from."""

TEMPERATURE = Range(
    "oil temperature",
    -20.0,
    150.0,
    "degC",
    Source("usual practice", "own choice", "bounds of our own; ASTM D341 has none"),
)
"""Where an oil follows them: above its pour point and before it boils off."""

VISCOSITY = Range(
    "kinematic viscosity",
    2.0,
    2e7,
    "mm²/s",
    Source("ASTM D341", "from memory", "2 mm²/s by its summary; the upper end has no document"),
)
"""Where the constant 0.7 of the viscosity formula holds."""

_LG_40, _LG_100 = math.log10(313.15), math.log10(373.15)


@formula(
    symbol="nu_M",
    unit="mm²/s",
    equation="lg lg(nu_M + 0.7) linear in lg T through nu_40 and nu_100, at theta",
    source=FORMULAS,
    because="the oil is solid at this temperature, or its viscosity does not fall from 40 to 100 "
    "degC",
)
def kinematic_viscosity(oil_temperature: theta, viscosity_40: nu_40, viscosity_100: nu_100) -> Real:
    r"""Kinematic viscosity at a temperature.

    :math:`\lg\lg(\nu + 0.7) = A \lg T + B` with :math:`T` in K through the two given points. The
    standard rounds its constants to :math:`A = -13.129 \lg[\lg(\nu_{40} + 0.7)/\lg(\nu_{100} +
    0.7)]` and :math:`B = \lg\lg(\nu_{40} + 0.7) - 2.496 A`, and so misses the points themselves by
    about 1 %; here they are met exactly. Valid in `TEMPERATURE` and `VISCOSITY`.

    Examples
    --------
    >>> round(kinematic_viscosity(60.0, 220.0, 19.0), 2)
    78.82
    """
    w_40 = np.log10(np.log10(viscosity_40 + 0.7))
    w_100 = np.log10(np.log10(viscosity_100 + 0.7))
    share = (np.log10(oil_temperature + 273.15) - _LG_40) / (_LG_100 - _LG_40)
    viscosity = 10.0 ** (10.0 ** (w_40 + (w_100 - w_40) * share)) - 0.7
    return np.where(viscosity_40 > viscosity_100, viscosity, np.nan)


@formula(symbol="rho_M", unit="kg/m³", equation="rho_15/(1 + k_rho (theta - 15))", source=FORMULAS)
def density(oil_temperature: theta, density_15: rho_15, density_coefficient: k_rho) -> Real:
    """Density at a temperature, valid in `TEMPERATURE`.

    Examples
    --------
    >>> round(density(60.0, 890.0, 7e-4), 2)
    862.82
    """
    return density_15 / (1.0 + density_coefficient * (oil_temperature - 15.0))

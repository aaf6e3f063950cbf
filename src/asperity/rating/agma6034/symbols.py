"""Symbols of AGMA 6034-B92: the unit of each, in SI and in inches, and what is allowed.

The formulas are written in the standard's inches, pounds and feet a minute; their equations are
shown in SI.
"""

import math
from typing import Annotated

from asperity.arrays import Real
from asperity.formulas import Bounds, Symbol, Unit, acute, not_negative, positive
from asperity.sources import Source

VERIFIED = Source("ANSI/AGMA 6034-B92", "verified")
ONE_SOURCE = Source("ANSI/AGMA 6034-B92", "one source")
SCOPE = Source("ANSI/AGMA 6034-B92 (R2016), scope", "one source")
LEAD_ANGLES = Source("Shigley's Mechanical Engineering Design, table 15-9", "one source")
SHIGLEY = Source("Budynas and Nisbett, Shigley's Mechanical Engineering Design, ch. 15", "verified")

_POUND_FORCE = 0.45359237 * 9.80665
_INCH = 0.0254
_FOOT = 12.0 * _INCH
_MINUTE = 60.0
_FAHRENHEIT = 5.0 / 9.0

MILLIMETRE = Unit("mm", "in", 1e3 * _INCH)
SQUARE_METRE = Unit("m2", "in2", _INCH**2)
METRE_A_SECOND = Unit("m/s", "ft/min", _FOOT / _MINUTE)
NEWTON = Unit("N", "lbf", _POUND_FORCE)
NEWTON_METRE = Unit("N m", "lbf in", _POUND_FORCE * _INCH)
MEGAPASCAL = Unit("MPa", "psi", 1e-6 * _POUND_FORCE / _INCH**2)
WATT = Unit("W", "hp", 550.0 * _FOOT * _POUND_FORCE)
DEGREE = Unit("degC", "degF", _FAHRENHEIT)
"""Of one temperature to which a difference is added: the zero of the scale does not matter."""
HEAT_TRANSFER = Unit(
    "W/(m2 K)",
    "ft lbf/(min in2 degF)",
    _FOOT * _POUND_FORCE / (_MINUTE * _INCH**2 * _FAHRENHEIT),
)

PRESSURE_ANGLES = tuple(math.radians(degrees) for degrees in (14.5, 20.0, 25.0, 30.0))
"""Normal pressure angles the standard has values for, rad; linear in between."""

LARGEST_RATIO = 1.1483 / 0.00658
"""Where the ratio correction factor falls to zero."""

# Geometry
C = Annotated[Real, Symbol("C", MILLIMETRE, positive)]
d = Annotated[Real, Symbol("d", MILLIMETRE, positive)]
D = Annotated[Real, Symbol("D", MILLIMETRE, positive)]
F_G = Annotated[Real, Symbol("F_G", MILLIMETRE, positive)]
p_x = Annotated[Real, Symbol("p_x", MILLIMETRE, positive)]
lambda_ = Annotated[Real, Symbol("lambda", "rad", acute)]
phi_n = Annotated[Real, Symbol("phi_n", "rad", acute)]
phi_n_tabulated = Annotated[
    Real,
    Symbol(
        "phi_n",
        "rad",
        # A whole degree turned into radians and back may end a rounding outside.
        Bounds(math.nextafter(PRESSURE_ANGLES[0], 0.0), math.nextafter(PRESSURE_ANGLES[-1], 1.0)),
        because="AGMA 6034-B92 has values for 14.5 to 30 degrees",
    ),
]
m_G = Annotated[
    Real,
    Symbol(
        "m_G",
        "",
        Bounds(3.0, math.nextafter(LARGEST_RATIO, 0.0)),
        because="AGMA 6034-B92 does not cover other ratios",
    ),
]

# Operation and friction
n_W = Annotated[Real, Symbol("n_W", "rpm", not_negative)]
V_s = Annotated[Real, Symbol("V_s", METRE_A_SECOND, not_negative)]
f = Annotated[Real, Symbol("f", "", not_negative)]

# Loads
C_s = Annotated[Real, Symbol("C_s", "", positive)]
C_m = Annotated[Real, Symbol("C_m", "", positive)]
C_v = Annotated[Real, Symbol("C_v", "", positive)]
F_e = Annotated[Real, Symbol("F_e", MILLIMETRE, positive)]
W_tall = Annotated[Real, Symbol("W_tall", NEWTON, not_negative)]
W_G = Annotated[Real, Symbol("W_G", NEWTON, not_negative)]
W_f = Annotated[Real, Symbol("W_f", NEWTON, not_negative)]
y = Annotated[Real, Symbol("y", "", positive)]

# Heat
t_a = Annotated[Real, Symbol("t_a", DEGREE, Bounds(lower=-459.67))]
H_W = Annotated[Real, Symbol("H_W", WATT, not_negative)]
e = Annotated[Real, Symbol("e", "", Bounds(0.0, 1.0))]
h_CR = Annotated[Real, Symbol("h_CR", HEAT_TRANSFER, positive)]
A = Annotated[Real, Symbol("A", SQUARE_METRE, positive)]

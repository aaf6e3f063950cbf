"""Symbols of AGMA 6034-B92: the unit of each, in SI and in inches, and what is allowed."""

import math
from typing import Annotated

from asperity.arrays import Real
from asperity.formulas import Bounds, Symbol, Unit, acute, not_negative, positive
from asperity.rating.agma6034.units import LENGTH, VELOCITY
from asperity.sources import Source

VERIFIED = Source("ANSI/AGMA 6034-B92", "verified")
ONE_SOURCE = Source("ANSI/AGMA 6034-B92", "one source")
FROM_MEMORY = Source("ANSI/AGMA 6034-B92", "from memory")
SHIGLEY = Source("Budynas and Nisbett, Shigley's Mechanical Engineering Design, ch. 15", "verified")

MILLIMETRE = Unit(LENGTH.si, LENGTH.inch, LENGTH.size)
METRE_A_SECOND = Unit(VELOCITY.si, VELOCITY.inch, VELOCITY.size)

PRESSURE_ANGLES = tuple(math.radians(degrees) for degrees in (14.5, 20.0, 25.0, 30.0))
"""Normal pressure angles the standard has values for, rad; linear in between."""

d = Annotated[Real, Symbol("d", MILLIMETRE, positive)]
D = Annotated[Real, Symbol("D", MILLIMETRE, positive)]
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
n_W = Annotated[Real, Symbol("n_W", "rpm", not_negative)]
n_G = Annotated[Real, Symbol("n_G", "rpm", not_negative)]
V_s = Annotated[Real, Symbol("V_s", METRE_A_SECOND, not_negative)]
f = Annotated[Real, Symbol("f", "", not_negative)]

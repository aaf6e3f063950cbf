"""Symbols of worm gearsets and oils; lengths of a gearset are in one unit of the caller's choice.

They are those of ISO/TR 14521.
"""

from typing import Annotated

from asperity.arrays import Real
from asperity.formulas import Bounds, Symbol, acute, finite, positive

z_1 = Annotated[Real, Symbol("z_1", "", positive)]
z_2 = Annotated[Real, Symbol("z_2", "", positive)]
u = Annotated[Real, Symbol("u", "", positive)]
q_1 = Annotated[Real, Symbol("q_1", "", positive)]
m_x1 = Annotated[Real, Symbol("m_x1", "", positive)]
a = Annotated[Real, Symbol("a", "", positive)]
x_2 = Annotated[Real, Symbol("x_2", "", finite)]
alpha_n = Annotated[Real, Symbol("alpha_n", "rad", acute)]
gamma_m1 = Annotated[Real, Symbol("gamma_m1", "rad", acute)]
gamma_b = Annotated[Real, Symbol("gamma_b", "rad", acute)]
p = Annotated[Real, Symbol("p", "", positive)]
d_m1 = Annotated[Real, Symbol("d_m1", "", positive)]
d_a1 = Annotated[Real, Symbol("d_a1", "", positive)]
d_e2 = Annotated[Real, Symbol("d_e2", "", positive)]

THINNEST = 0.5
"""Viscosity in mm²/s from below which nothing is calculated."""

_FLOWS = Bounds(THINNEST, 2e7)
theta = Annotated[Real, Symbol("theta", "degC", Bounds(-60.0, 300.0))]
nu_40 = Annotated[Real, Symbol("nu_40", "mm²/s", _FLOWS)]
nu_100 = Annotated[Real, Symbol("nu_100", "mm²/s", _FLOWS)]
rho_15 = Annotated[Real, Symbol("rho_15", "kg/m³", positive)]
k_rho = Annotated[Real, Symbol("k_rho", "1/K", Bounds(0.0, 0.01))]

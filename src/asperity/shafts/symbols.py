"""Symbols of shafts and rolling bearings: the unit of each, and what is allowed."""

from typing import Annotated

from asperity.arrays import Real
from asperity.formulas import Bounds, Symbol, finite, not_negative, positive
from asperity.sources import Source

DIN_743 = Source("DIN 743:2012", "one source", "an open student program has the same formulas")
DIN_743_MEMORY = Source("DIN 743:2012", "from memory")
SHIGLEY = Source("Budynas and Nisbett, Shigley's Mechanical Engineering Design, ch. 7", "verified")
ISO_281 = Source("ISO 281", "verified", "makers' catalogues agree")
ISO_281_MEMORY = Source("ISO 281", "from memory")
ISO_76 = Source("ISO 76", "verified", "makers' catalogues agree")
ISO_76_MEMORY = Source("ISO 76", "from memory")
OWN = Source("Asperity's own rule", "own choice", "of no standard")

# Shape of a notch
d = Annotated[Real, Symbol("d", "mm", positive)]
D = Annotated[Real, Symbol("D", "mm", positive)]
r = Annotated[Real, Symbol("r", "mm", positive)]
t = Annotated[Real, Symbol("t", "mm", positive)]
phi = Annotated[Real, Symbol("phi", "", not_negative)]
alpha = Annotated[Real, Symbol("alpha", "", positive)]
beta = Annotated[Real, Symbol("beta", "", positive)]
n_sigma = Annotated[Real, Symbol("n", "", positive)]
gradient = Annotated[Real, Symbol("G", "1/mm", not_negative)]
Rz = Annotated[Real, Symbol("Rz", "um", positive)]

# Strength of a material
sigma_B = Annotated[Real, Symbol("sigma_B", "MPa", Bounds(20.0, above=True))]
sigma_S = Annotated[Real, Symbol("sigma_S", "MPa", positive)]
sigma_W = Annotated[Real, Symbol("sigma_W", "MPa", positive)]
sigma_WK = Annotated[Real, Symbol("sigma_WK", "MPa", positive)]
d_eff = Annotated[Real, Symbol("d_eff", "mm", positive)]
K_1 = Annotated[Real, Symbol("K_1", "", positive)]
K_2 = Annotated[Real, Symbol("K_2", "", positive)]
K_F = Annotated[Real, Symbol("K_F", "", positive)]
K_V = Annotated[Real, Symbol("K_V", "", positive)]
K_sigma = Annotated[Real, Symbol("K_sigma", "", positive)]
K_2F = Annotated[Real, Symbol("K_2F", "", positive)]
gamma_F = Annotated[Real, Symbol("gamma_F", "", positive)]
psi = Annotated[Real, Symbol("psi", "", not_negative)]

# Stresses
sigma_a = Annotated[Real, Symbol("sigma_a", "MPa", positive)]
sigma_mv = Annotated[Real, Symbol("sigma_mv", "MPa", not_negative)]
sigma_zdm = Annotated[Real, Symbol("sigma_zdm", "MPa", finite)]
sigma_bm = Annotated[Real, Symbol("sigma_bm", "MPa", finite)]
tau_m = Annotated[Real, Symbol("tau_m", "MPa", finite)]
M = Annotated[Real, Symbol("M", "N m", not_negative)]
T = Annotated[Real, Symbol("T", "N m", finite)]

# Rolling bearings
F_r = Annotated[Real, Symbol("F_r", "N", not_negative)]
F_a = Annotated[Real, Symbol("F_a", "N", not_negative)]
P = Annotated[Real, Symbol("P", "N", positive)]
C = Annotated[Real, Symbol("C", "N", positive)]
C_0 = Annotated[Real, Symbol("C_0", "N", positive)]
C_u = Annotated[Real, Symbol("C_u", "N", positive)]
n = Annotated[Real, Symbol("n", "rpm", positive)]
p = Annotated[Real, Symbol("p", "", positive)]
D_pw = Annotated[Real, Symbol("D_pw", "mm", positive)]
kappa = Annotated[Real, Symbol("kappa", "", positive)]
e_C = Annotated[Real, Symbol("e_C", "", Bounds(0.0, 1.0))]

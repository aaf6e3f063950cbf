"""Symbols of ISO/TR 14521: the unit of each, and what is allowed.

``alpha_n`` is the standard's alpha_0. Symbols with a star are written without it here.
"""

from typing import Annotated

from asperity.arrays import Real
from asperity.formulas import Bounds, Symbol, acute, finite, not_negative, positive
from asperity.sources import Source

_STANDARD = "ISO/TR 14521:2010, DIN 3996:2012"
VERIFIED = Source(_STANDARD, "verified")
ONE_SOURCE = Source(_STANDARD, "one source")
SUMP = Source(_STANDARD, "one source", "with a fan, a + 32 as MITCalc 1.74 has it")
BALANCE = Source(
    "definition", "own choice", "balance of power; MITCalc divides it by eta_z2_1 besides"
)
DEFINITION = Source("definition", "verified")

# Geometry
z_1 = Annotated[Real, Symbol("z_1", "", positive)]
z_2 = Annotated[Real, Symbol("z_2", "", positive)]
u = Annotated[Real, Symbol("u", "", positive)]
q_1 = Annotated[Real, Symbol("q_1", "", positive)]
m_x1 = Annotated[Real, Symbol("m_x1", "mm", positive)]
a = Annotated[Real, Symbol("a", "mm", positive)]
x_2 = Annotated[Real, Symbol("x_2", "", finite)]
alpha_n = Annotated[Real, Symbol("alpha_n", "rad", acute)]
gamma_m1 = Annotated[Real, Symbol("gamma_m1", "rad", acute)]
d_m1 = Annotated[Real, Symbol("d_m1", "mm", positive)]
d_f1 = Annotated[Real, Symbol("d_f1", "mm", positive)]
d_m2 = Annotated[Real, Symbol("d_m2", "mm", positive)]
d_f2 = Annotated[Real, Symbol("d_f2", "mm", positive)]
b_2H = Annotated[Real, Symbol("b_2H", "mm", positive)]
b_2R = Annotated[Real, Symbol("b_2R", "mm", positive)]
s_K = Annotated[Real, Symbol("s_K", "mm", positive)]
l_11 = Annotated[Real, Symbol("l_11", "mm", positive)]
l_12 = Annotated[Real, Symbol("l_12", "mm", positive)]
Ra_1 = Annotated[Real, Symbol("Ra_1", "um", positive)]

# Materials and oil
E_1 = Annotated[Real, Symbol("E_1", "MPa", positive)]
E_2 = Annotated[Real, Symbol("E_2", "MPa", positive)]
nu_1 = Annotated[Real, Symbol("nu_1", "", Bounds(0.0, 0.5))]
nu_2 = Annotated[Real, Symbol("nu_2", "", Bounds(0.0, 0.5))]
E_red = Annotated[Real, Symbol("E_red", "MPa", positive)]
c_alpha = Annotated[Real, Symbol("c_alpha", "m2/N", positive)]
eta_0M = Annotated[Real, Symbol("eta_0M", "Pa s", positive)]
nu_40 = Annotated[Real, Symbol("nu_40", "mm2/s", Bounds(0.0, 1079.0, above=True))]

# Operation
T_2 = Annotated[Real, Symbol("T_2", "N m", positive)]
n_1 = Annotated[Real, Symbol("n_1", "rpm", not_negative)]
L_h = Annotated[Real, Symbol("L_h", "h", positive)]
N_S = Annotated[Real, Symbol("N_S", "1/h", not_negative)]
n_D = Annotated[Real, Symbol("n_D", "", not_negative)]
k_B = Annotated[Real, Symbol("k_B", "", not_negative)]
theta_0 = Annotated[Real, Symbol("theta_0", "degC", Bounds(-100.0, 300.0))]

# Friction, efficiency and losses
v_gm = Annotated[Real, Symbol("v_gm", "m/s", not_negative)]
h_star = Annotated[Real, Symbol("h*", "", positive)]
mu_0T = Annotated[Real, Symbol("mu_0T", "", not_negative)]
Y_S = Annotated[Real, Symbol("Y_S", "", positive)]
Y_G = Annotated[Real, Symbol("Y_G", "", positive)]
Y_W = Annotated[Real, Symbol("Y_W", "", positive)]
Y_R = Annotated[Real, Symbol("Y_R", "", positive)]
mu_zm = Annotated[Real, Symbol("mu_zm", "", not_negative)]
eta_z1_2 = Annotated[Real, Symbol("eta_z1_2", "", Bounds(0.0, 1.0, above=True))]
eta_z2_1 = Annotated[Real, Symbol("eta_z2_1", "", Bounds(upper=1.0))]
P_2 = Annotated[Real, Symbol("P_2", "W", not_negative)]
P_V = Annotated[Real, Symbol("P_V", "W", not_negative)]
P_Vz = Annotated[Real, Symbol("P_Vz", "W", not_negative)]

# Forces, stresses and safeties
F_tm1 = Annotated[Real, Symbol("F_tm1", "N", positive)]
F_tm2 = Annotated[Real, Symbol("F_tm2", "N", positive)]
p_m_star = Annotated[Real, Symbol("p_m*", "", positive)]
s_star = Annotated[Real, Symbol("s*", "", positive)]
sigma_Hm = Annotated[Real, Symbol("sigma_Hm", "MPa", positive)]
sigma_HlimT = Annotated[Real, Symbol("sigma_HlimT", "MPa", positive)]
Z_h = Annotated[Real, Symbol("Z_h", "", positive)]
k_r = Annotated[Real, Symbol("k_r", "", positive)]
Z_v = Annotated[Real, Symbol("Z_v", "", positive)]
Z_S = Annotated[Real, Symbol("Z_S", "", positive)]
Z_u = Annotated[Real, Symbol("Z_u", "", positive)]
Z_oil = Annotated[Real, Symbol("Z_oil", "", positive)]
s_ft2 = Annotated[Real, Symbol("s_ft2", "mm", positive)]
Y_F = Annotated[Real, Symbol("Y_F", "", positive)]
Y_K = Annotated[Real, Symbol("Y_K", "", positive)]
Y_epsilon = Annotated[Real, Symbol("Y_epsilon", "", positive)]
Y_NL = Annotated[Real, Symbol("Y_NL", "", positive)]
tau_FlimT = Annotated[Real, Symbol("tau_FlimT", "MPa", positive)]

# Wear
h_minm = Annotated[Real, Symbol("h_minm", "um", positive)]
W_S = Annotated[Real, Symbol("W_S", "", positive)]
W_H = Annotated[Real, Symbol("W_H", "", positive)]
K_W = Annotated[Real, Symbol("K_W", "um", positive)]
J_0T = Annotated[Real, Symbol("J_0T", "", positive)]
W_NS = Annotated[Real, Symbol("W_NS", "", positive)]
W_ML = Annotated[Real, Symbol("W_ML", "", positive)]
J_W = Annotated[Real, Symbol("J_W", "", positive)]
N_L = Annotated[Real, Symbol("N_L", "", positive)]
s_Wm = Annotated[Real, Symbol("s_Wm", "mm", positive)]
worn = Annotated[Real, Symbol("delta_W", "mm", not_negative)]

# Temperatures
theta_S = Annotated[Real, Symbol("theta_S", "degC", Bounds(lower=-273.15))]
alpha_L = Annotated[Real, Symbol("alpha_L", "W/(m2 K)", positive)]
A_R = Annotated[Real, Symbol("A_R", "m2", positive)]

"""Two discs that roll and slide on each other: speeds, torques, Hertz contact, film; SI."""

from typing import Annotated

import numpy as np

from asperity.arrays import Real
from asperity.formulas import Bounds, Symbol, formula, not_negative, positive
from asperity.sources import Source

THESIS = Source("thesis 6.3 and 6.4", "verified", "Table 6.3 and Table 6.8 are found again")
HERTZ = Source("Hertz line contact", "verified")
FILM = Source(
    "Dowson and Higginson, line contact, by a program of cam and tappet", "one source",
    "exponents 0.7, 0.54, -0.13",
)  # fmt: skip
RMS = Source("Rq = 1.25 Ra of a Gaussian surface", "one source", "exercises on Hamrock's text")

d = Annotated[Real, Symbol("d", "m", positive)]
omega = Annotated[Real, Symbol("omega", "rad/s")]
v_ps = Annotated[Real, Symbol("v_ps", "m/s")]
v_pa = Annotated[Real, Symbol("v_pa", "m/s")]
mu = Annotated[Real, Symbol("mu", "", not_negative)]
F_N = Annotated[Real, Symbol("F_N", "N", positive)]
T_b = Annotated[Real, Symbol("T_b", "N m")]
T = Annotated[Real, Symbol("T", "N m")]
d_s = Annotated[Real, Symbol("d_s", "m", positive)]
d_a = Annotated[Real, Symbol("d_a", "m", positive)]
D = Annotated[Real, Symbol("D", "m", positive)]
E_s = Annotated[Real, Symbol("E_s", "Pa", positive)]
E_a = Annotated[Real, Symbol("E_a", "Pa", positive)]
_POISSON = Bounds(0.0, 0.5)
nu_s = Annotated[Real, Symbol("nu_s", "", _POISSON)]
nu_a = Annotated[Real, Symbol("nu_a", "", _POISSON)]
b = Annotated[Real, Symbol("b", "m", positive)]
eta_0 = Annotated[Real, Symbol("eta_0", "Pa s", positive)]
alpha = Annotated[Real, Symbol("alpha", "1/Pa", positive)]
v_ro = Annotated[Real, Symbol("v_ro", "m/s", positive)]
E_r = Annotated[Real, Symbol("E'", "Pa", positive)]
R_x = Annotated[Real, Symbol("R'", "m", positive)]
h = Annotated[Real, Symbol("h", "m", not_negative)]
Ra_s = Annotated[Real, Symbol("Ra_s", "m", positive)]
Ra_a = Annotated[Real, Symbol("Ra_a", "m", positive)]


@formula(symbol="v_p", unit="m/s", equation="(62), (63): d omega/2", source=THESIS)
def peripheral_velocity(diameter: d, speed: omega) -> Real:
    """Velocity of a disc's rim.

    Examples
    --------
    >>> round(peripheral_velocity(0.040, 1000 * np.pi / 30), 4)
    2.0944
    """
    return 0.5 * diameter * speed


@formula(symbol="v_sl", unit="m/s", equation="(67): v_ps - v_pa", source=THESIS)
def sliding_velocity(steel: v_ps, bronze: v_pa) -> Real:
    """Velocity of the steel disc's rim over the bronze disc's."""
    return steel - bronze


@formula(symbol="v_ro", unit="m/s", equation="(68): (v_ps + v_pa)/2", source=THESIS)
def rolling_velocity(steel: v_ps, bronze: v_pa) -> Real:
    """Mean velocity of the two rims."""
    return 0.5 * (steel + bronze)


@formula(symbol="R", equation="(69): v_sl/(2 v_ro)", source=THESIS)
def slide_roll_ratio(steel: v_ps, bronze: v_pa) -> Real:
    """Share of sliding: 0 rolling, 1 sliding.

    Examples
    --------
    >>> slide_roll_ratio(1.5, 0.5)
    0.5
    """
    return (steel - bronze) / (steel + bronze)


@formula(symbol="T_s", unit="N m", equation="(65): T_bs + mu F_N d_s/2", source=THESIS)
def steel_torque(friction: mu, load: F_N, diameter: d_s, bearing_torque: T_b = 0.0) -> Real:
    """Torque that the steel disc takes, its bearings' with it."""
    return bearing_torque + 0.5 * friction * load * diameter


@formula(symbol="T_a", unit="N m", equation="(66): T_ba - mu F_N d_a/2", source=THESIS)
def bronze_torque(friction: mu, load: F_N, diameter: d_a, bearing_torque: T_b = 0.0) -> Real:
    """Torque that the bronze disc takes; below zero the steel disc drives it."""
    return bearing_torque - 0.5 * friction * load * diameter


@formula(symbol="mu", equation="(65) solved: 2 (T_s - T_bs)/(F_N d_s)", source=THESIS)
def friction_of_torque(torque: T, load: F_N, diameter: d_s, bearing_torque: T_b = 0.0) -> Real:
    """Coefficient of friction that a torque of the steel disc means."""
    return 2.0 * (torque - bearing_torque) / (load * diameter)


@formula(symbol="b", unit="m", equation="(71)", source=HERTZ)
def contact_half_width(
    load: F_N,
    length: D,
    steel_diameter: d_s,
    bronze_diameter: d_a,
    steel_modulus: E_s,
    bronze_modulus: E_a,
    steel_poisson: nu_s = 0.3,
    bronze_poisson: nu_a = 0.3,
) -> Real:
    r"""Half the width of the contact.

    .. math:: b = \sqrt{\frac{2F_N}{\pi D}
       \frac{(1-\nu_s^2)/E_s + (1-\nu_a^2)/E_a}{1/d_s + 1/d_a}}
    """
    give = (1.0 - steel_poisson**2) / steel_modulus + (1.0 - bronze_poisson**2) / bronze_modulus
    curved = 1.0 / steel_diameter + 1.0 / bronze_diameter
    return np.sqrt(2.0 * load / (np.pi * length) * give / curved)


@formula(symbol="p_max", unit="Pa", equation="(70): 2 F_N/(pi b D)", source=HERTZ)
def contact_pressure(load: F_N, half_width: b, length: D) -> Real:
    """Largest pressure of the contact."""
    return 2.0 * load / (np.pi * half_width * length)


@formula(symbol="E'", unit="Pa", equation="2/((1 - nu_s^2)/E_s + (1 - nu_a^2)/E_a)", source=FILM)
def reduced_modulus(
    steel_modulus: E_s, bronze_modulus: E_a, steel_poisson: nu_s = 0.3, bronze_poisson: nu_a = 0.3
) -> Real:
    """Modulus of the film's theory, twice that of the contact's."""
    give = (1.0 - steel_poisson**2) / steel_modulus + (1.0 - bronze_poisson**2) / bronze_modulus
    return 2.0 / give


@formula(
    symbol="h_min", unit="m", equation="2.65 R' U^0.7 G^0.54 W^-0.13 with U = eta_0 v_ro/(E' R'), "
    "G = alpha E', W = F_N/(E' R' D)", source=FILM,
)  # fmt: skip
def film_thickness(
    viscosity: eta_0,
    pressure_viscosity: alpha,
    rolling: v_ro,
    modulus: E_r,
    radius: R_x,
    load: F_N,
    length: D,
) -> Real:
    """Least thickness of the film between the discs, as if they were smooth."""
    speed = viscosity * rolling / (modulus * radius)
    material = pressure_viscosity * modulus
    pressed = load / (modulus * radius * length)
    return 2.65 * radius * speed**0.7 * material**0.54 * pressed**-0.13


@formula(symbol="lambda", equation="h_min/(1.25 sqrt(Ra_s^2 + Ra_a^2))", source=RMS)
def film_parameter(film: h, steel_roughness: Ra_s, bronze_roughness: Ra_a) -> Real:
    """Film over roughness: below 1 the asperities carry, boundary lubrication."""
    return film / (1.25 * np.hypot(steel_roughness, bronze_roughness))

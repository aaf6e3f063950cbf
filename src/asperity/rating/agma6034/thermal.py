"""AGMA 6034-B92: power lost in the mesh, and heat."""

from asperity.arrays import Real
from asperity.formulas import formula
from asperity.rating.agma6034 import symbols as s


@formula(symbol="H_f", unit=s.WATT, equation="V_s W_f", source=s.ONE_SOURCE)
def friction_power(sliding_velocity: s.V_s, friction_force: s.W_f) -> Real:
    """Power lost in the mesh."""
    return sliding_velocity * friction_force / 33000.0


@formula(
    symbol="h_CR",
    unit=s.HEAT_TRANSFER,
    equation="(n_W/6494 + 0.13) 63.07, with a fan 3939 for 6494",
    source=s.ONE_SOURCE,
)
def heat_transfer_coefficient(worm_speed: s.n_W, *, fan: bool = False) -> Real:
    """Heat transfer from the housing to the air, with or without a fan on the worm's shaft."""
    return worm_speed / (3939.0 if fan else 6494.0) + 0.13


@formula(
    symbol="A_min", unit=s.SQUARE_METRE, equation="43.20 (C/25.4)^1.7 0.0254^2", source=s.ONE_SOURCE
)
def minimum_housing_area(centre_distance: s.C) -> Real:
    """Least area of a housing that a designer should provide."""
    return 43.20 * centre_distance**1.7


@formula(symbol="t_s", unit=s.DEGREE, equation="t_a + (1 - e) H_W/(h_CR A)", source=s.ONE_SOURCE)
def sump_temperature(
    ambient_temperature: s.t_a,
    input_power: s.H_W,
    efficiency: s.e,
    heat_transfer_coefficient: s.h_CR,
    housing_area: s.A,
) -> Real:
    """Temperature of the oil sump."""
    lost = 33000.0 * (1.0 - efficiency) * input_power
    return ambient_temperature + lost / (heat_transfer_coefficient * housing_area)

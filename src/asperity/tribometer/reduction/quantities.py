"""What a segment's levels mean: thesis (73) to (76), and the velocity ratio."""

from typing import Annotated

import numpy as np

from asperity.arrays import Real
from asperity.formulas import Symbol, formula, not_negative, positive
from asperity.sources import Source

THESIS = Source("thesis 6.4.11 and 6.5.2", "verified", "'with' stands first in (73) to (75)")
OWN = Source("this package", "verified", "power past the contact over electrical power")

T_w = Annotated[Real, Symbol("T_w", "N m")]
T_b = Annotated[Real, Symbol("T_b", "N m")]
S_w = Annotated[Real, Symbol("S_w", "rad/s")]
S_b = Annotated[Real, Symbol("S_b", "rad/s")]
T = Annotated[Real, Symbol("T", "N m")]
S = Annotated[Real, Symbol("S", "rad/s")]
V = Annotated[Real, Symbol("V", "V", positive)]
i = Annotated[Real, Symbol("i", "A", positive)]
n = Annotated[Real, Symbol("n", "", positive)]
v_ps = Annotated[Real, Symbol("v_ps", "m/s")]
v_pa = Annotated[Real, Symbol("v_pa", "m/s")]
a = Annotated[Real, Symbol("a", "m/s**2", not_negative)]
f = Annotated[Real, Symbol("f", "Hz", positive)]


@formula(symbol="dT", unit="%", equation="(73): 100 (T_w - T_b)/T_b", source=THESIS)
def torque_change(torque_with: T_w, torque_before: T_b) -> Real:
    """Change of the torque by vibration."""
    return 100.0 * (torque_with / torque_before - 1.0)


@formula(symbol="dP", unit="%", equation="(74): 100 (T_w S_w - T_b S_b)/(T_b S_b)", source=THESIS)
def power_change(torque_with: T_w, speed_with: S_w, torque_before: T_b, speed_before: S_b) -> Real:
    """Change of the power that the steel disc takes."""
    return 100.0 * (torque_with * speed_with / (torque_before * speed_before) - 1.0)


@formula(symbol="eta_s", equation="(75): (V i - T S/n)/(V i)", source=THESIS)
def thesis_efficiency(torque: T, speed: S, voltage: V, current: i, gear_ratio: n) -> Real:
    """What is left of the electrical power after the disc's; losses of motor and gear are useful.

    With the motor's speed in rpm and a gear ratio of 32 it has the printed pi/960.

    Examples
    --------
    >>> round(thesis_efficiency(0.6448, 1500 * np.pi / 30, 1.0, 2.0, 32) * 1e3)
    -583
    """
    return 1.0 - torque * speed / gear_ratio / (voltage * current)


@formula(symbol="eta", equation="T S/(n V i) v_pa/v_ps", source=OWN)
def drive_efficiency(
    torque: T, speed: S, voltage: V, current: i, gear_ratio: n, steel: v_ps, bronze: v_pa
) -> Real:
    """Share of the electrical power that reaches the bronze disc; all else is lost.

    Motor, gear and the friction between the discs lose; the sonotrode's power is not counted.
    """
    return torque * speed / (gear_ratio * voltage * current) * bronze / steel


@formula(symbol="v_a", unit="m/s", equation="(76): a/(2 pi f)", source=THESIS)
def velocity_amplitude(acceleration: a, frequency: f) -> Real:
    """Peak velocity of a vibration, of the peak of its acceleration."""
    return acceleration / (2.0 * np.pi * frequency)

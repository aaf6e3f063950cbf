"""The three sets of simulations of Table 7.2, as far as the text has their conditions."""

import dataclasses
import math

BASE = "drive-thesis"
"""Gearset 3 with its shaft and load; what is set of it is the vibration, speed and load."""

AMPLITUDE, SPEED = 0.16e-3, 1510.8e-3
"""Of set 3: the worm's amplitude, m, and the flanks' sliding speed, m/s; thesis 7.2.4."""

FREQUENCY = 750.0
"""Of sets 1 and 2, Hz."""

RATIOS = (0.1, 0.5, 1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 8.0, 12.0, 20.0)
"""Velocity ratios k_w of a set: eleven from 0.1 to 20; those between are lost, and chosen here."""

UNSHAKEN, SHAKEN, LOAD, RATIO = 33.8, 7.4, 366.0, 15
"""Worm torque without and with vibration at k_w 20, and torque of the wheel, N m; gear ratio."""


@dataclasses.dataclass(frozen=True)
class Condition:
    """One simulation: axial vibration of the worm.

    Attributes
    ----------
    number : int
        Of the set, 1 to 3.
    ratio : float
        Peak velocity of the vibration over the sliding speed, k_w.
    torque : float
        Of the wheel, N m.
    frequency : float
        Hz.
    velocity : float
        Peak velocity of the vibration, m/s.
    """

    number: int
    ratio: float
    torque: float
    frequency: float
    velocity: float

    @property
    def amplitude(self) -> float:
        """Of the worm's axial displacement, m; thesis (12)."""
        return self.velocity / (2.0 * math.pi * self.frequency)

    @property
    def sliding_speed(self) -> float:
        """Of the flanks, m/s."""
        return self.velocity / self.ratio

    @property
    def worm_speed(self) -> float:
        """Turns of the worm, rad/s: that of set 3, 1440 rpm, in proportion to the sliding."""
        return 2.0 * math.pi * 24.0 * self.sliding_speed / SPEED


def conditions(number: int) -> tuple[Condition, ...]:
    """Return the simulations of a set, 1 to 3, by rising velocity ratio."""
    if number == 3:
        return tuple(
            Condition(3, k, LOAD, k * SPEED / (2.0 * math.pi * AMPLITUDE), k * SPEED)
            for k in RATIOS
        )
    velocity = {1: 59e-3, 2: 87e-3}[number]
    return tuple(Condition(number, k, 23.0, FREQUENCY, velocity) for k in RATIOS)

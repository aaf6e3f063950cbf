"""What the simulated discs lose: Archard's wear on the path of one disc on the other."""

import functools
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from asperity.tribometer.parameters import LONGITUDINAL
from asperity.tribometer.twin.chain import disc_velocity
from asperity.tribometer.twin.plant import Plant

_DENSITY = 7850.0  # kg/m3, where the case tells none


class Wearing:
    """The path that simulated discs have slid, and what they weigh.

    The path is that of the bronze disc, shaken as it is driven, on a steel disc that turns evenly.

    Parameters
    ----------
    plant : Plant
        What they are made of.

    Attributes
    ----------
    path : float
        m.
    weighings : int
        So many have been made.
    """

    def __init__(self, plant: Plant) -> None:
        self._plant = plant
        self.path = 0.0
        self.weighings = 0
        twin = plant.twin
        self.wears = not plant.pair.geared and (twin.wear_steel > 0.0 or twin.wear_bronze > 0.0)
        self._speed: Callable[..., float] = functools.lru_cache(maxsize=64)(self._shaken)

    def _shaken(self, mode: str, waveform: str, frequency: float) -> Any:
        return disc_velocity(self._plant.sonotrode, mode, waveform, frequency)

    def sliding(self, state: Any) -> float:
        """Return the sliding velocity of the rims, m/s, of a state of the motion."""
        if not self.wears:
            return 0.0
        motors = float(state["motor_steel"]), float(state["motor_bronze"])
        steel, bronze = self._plant.pair.rims(*motors)
        return float(steel - bronze)

    def state(self) -> dict[str, float | int]:
        """Return path and weighings, for JSON; nothing where nothing wears."""
        return {"path": self.path, "weighings": self.weighings} if self.wears else {}

    def restore(self, state: Mapping[str, Any]) -> None:
        """Go on from there."""
        self.path = float(state.get("path", 0.0))
        self.weighings = int(state.get("weighings", 0))

    def slide(self, velocities: tuple[float, float], seconds: float, drive: Any = None) -> None:
        """Slide for a time.

        Parameters
        ----------
        velocities : (float, float)
            Sliding, at its begin and its end, m/s.
        seconds : float
            How long.
        drive : (str, str, float), optional
            Direction, waveform and frequency of the vibration; None: there is none.
        """
        if not self.wears:
            return
        mean = 0.5 * (velocities[0] + velocities[1])
        speed = 0.5 * (abs(velocities[0]) + abs(velocities[1]))
        if drive is not None:
            cycle = self._speed(*drive)
            apart = mean + cycle if drive[0] == LONGITUDINAL else np.hypot(mean, cycle)
            speed = float(np.abs(apart).mean())
        self.path += speed * seconds

    def weigh(self, disc: str) -> float:
        """Return what a balance shows of a disc, kg."""
        pair, twin = self._plant.pair, self._plant.twin
        of, rate = (
            (pair.steel, twin.wear_steel) if disc == "steel" else (pair.bronze, twin.wear_bronze)
        )
        density = of.density or _DENSITY
        volume = np.pi * of.radius**2 * of.thickness - rate * pair.load * self.path
        if not twin.weighing_noise:
            return float(density * volume)
        self.weighings += 1
        noise = np.random.default_rng((twin.seed, self.weighings)).normal()
        return float(density * volume + twin.weighing_noise * noise)

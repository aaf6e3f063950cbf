"""The rigs of the thesis and the simulated one, each knowing its command."""

import dataclasses
import functools
from typing import ClassVar

from asperity.casefile import Case, read_case
from asperity.tribometer.pair import Pair
from asperity.tribometer.pairs import pair_of
from asperity.tribometer.tables import TABLES
from asperity.tribometer.twin.plant import Plant, SteadyState
from asperity.tribometer.twin.plants import plant_of

TRANSVERSE, LONGITUDINAL = "transverse", "longitudinal"
PLANT = "asperity.tribometer.twin.plant.Plant.steady, on rig-final"


@functools.cache
def case(name: str = "rig-final") -> Case:
    """A configuration that ships."""
    return read_case(name, TABLES)


@functools.cache
def pair(name: str = "rig-final") -> Pair:
    """Its discs."""
    return pair_of(case(name))


@functools.cache
def plant() -> Plant:
    """The simulated rig."""
    return plant_of(case())


@dataclasses.dataclass(frozen=True)
class Settled:
    """Where the simulated rig settles, at a supply in V; without a frequency it is not shaken."""

    bronze: ClassVar[float] = 0.9
    supply: float
    frequency: float = 0.0
    mode: str = TRANSVERSE
    waveform: str = "sine"

    @functools.cached_property
    def state(self) -> SteadyState:
        """Torque and speeds."""
        rig = plant()
        shaken = self.frequency > 0.0
        friction = (
            rig.friction(self.waveform, self.frequency, mode=self.mode)
            if shaken
            else rig.friction()
        )
        return rig.steady(self.supply, self.bronze, friction)

    @property
    def slide_roll(self) -> float:
        """Slide-roll ratio."""
        steel, bronze = pair().rims(self.state.steel, self.state.bronze)
        return float((steel - bronze) / (steel + bronze))

    @property
    def power(self) -> float:
        """Of the steel disc, in units that cancel in ratios."""
        return self.state.torque * self.state.steel


@functools.cache
def settled(
    supply: float, frequency: float = 0.0, mode: str = TRANSVERSE, waveform: str = "sine"
) -> Settled:
    """A state of the simulated rig."""
    return Settled(supply, frequency, mode, waveform)


def reduction(supply: float, frequency: float, mode: str, waveform: str = "sine") -> float:
    """By how much of itself the simulated torque falls."""
    before = settled(supply).state.torque
    return 1.0 - settled(supply, frequency, mode, waveform).state.torque / before

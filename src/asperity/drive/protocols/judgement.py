"""Whether the end of a march is a periodic state, and what is missing where it is not."""

import dataclasses
import math

import numpy as np

from asperity.arrays import FloatArray
from asperity.drive.headline import BALANCED

# Means of three blocks within this of each other, a balanced wheel that turns with the worm to
# this, and no more than so much of the power that goes into store make a state periodic; a march
# ends early only where they agree ten times better.
PERIODIC, STORED, TURNED = 5e-3, 5e-3, 5e-3
_EARLY = 0.1


@dataclasses.dataclass(frozen=True)
class Judgement:
    """Whether the end of a march is a periodic state.

    Attributes
    ----------
    settled : bool
        Three blocks agree, the wheel is balanced and turns with the worm, and next to nothing is
        stored.
    surely : bool
        They agree so well that nothing is gained by going on.
    spread : float
        Of the blocks' mean torques, over the torque without vibration.
    balance : float
        What the mesh gives the wheel beyond the load, over the load, in all three.
    stored : float
        Mean power that goes into store, or out of it where negative, over the largest of the
        powers, in all three.
    turned : float
        What the wheel turns beyond the worm's turn over the ratio, over that; 0 where it need not.
    cycles : int
        In the blocks together.
    nearer : float
        Time until it would have settled if it came nearer as it last did, s; infinite where it did
        not, NaN where it was too short to tell, 0 where that was not asked.
    waited : float
        Time that it was waited for, s.
    scatter : float
        Of twice as many blocks, where they agree by chance alone; 0 else.
    """

    settled: bool
    surely: bool
    spread: float
    balance: float
    stored: float
    turned: float
    cycles: int
    nearer: float = 0.0
    waited: float = 0.0
    scatter: float = 0.0

    @property
    def off(self) -> float:
        """The largest of what is missing, over what is allowed of it."""
        return max(
            self.spread / PERIODIC, abs(self.balance) / BALANCED, abs(self.stored) / STORED,
            abs(self.turned) / TURNED,
        )  # fmt: skip

    @classmethod
    def of(
        cls, spread: float, balance: float, stored: float, turned: float, cycles: int
    ) -> "Judgement":
        """Return that of what was found."""
        found = cls(False, False, spread, balance, stored, turned, cycles)
        return dataclasses.replace(found, settled=found.off <= 1.0, surely=found.off <= _EARLY)

    def said(self, what: str) -> str:
        """Return what shows that it settled, or what is missing; ``what`` is to stay."""
        if self.settled:
            turns = "" if self.turned == 0.0 else " and turns with the worm"
            return (
                f"three blocks of {self.cycles // 3} cycles agree in the {what} to "
                f"{_percent(self.spread)}, and the wheel is in balance{turns} to "
                f"{_percent(max(abs(self.balance), abs(self.turned)))}"
            )
        missing = []
        if self.scatter > 0.0:
            missing.append(
                f"the {what} of three blocks of cycles agrees by chance: of twice as many it goes "
                f"up and down by {_percent(self.scatter)}"
            )
        if not self.spread <= PERIODIC:
            missing.append(
                f"the {what} of three blocks of cycles spreads by {_percent(self.spread)}"
            )
        if not abs(self.balance) <= BALANCED:
            missing.append(f"the wheel is out of balance by {_percent(abs(self.balance))}")
        if not abs(self.stored) <= STORED:
            missing.append(f"{_percent(self.stored)} of the power goes into store")
        if not abs(self.turned) <= TURNED:
            how = "slower" if self.turned < 0.0 else "faster"
            missing.append(f"the wheel turns {_percent(abs(self.turned))} {how} than with the worm")
        if math.isfinite(self.nearer) and self.nearer > 0.0:
            missing.append(f"a solve.duration of {_least(self.waited + self.nearer)} would do")
        elif math.isnan(self.nearer):
            missing.append(
                "too short to tell whether it comes nearer: leave solve.duration out, and it is "
                "marched for as long as it does"
            )
        elif self.nearer > 0.0:
            missing.append("it came no nearer on its way: a longer solve.duration may not do")
        return "; ".join(missing)


def steady_speed(rolled: FloatArray, time: FloatArray) -> float:
    """Return the speed at which a wheel goes on that also rings on its teeth.

    Over a time, the ends of its swing tell more of that than of its creep: they are weighed by
    nothing, and the middle by most.

    Parameters
    ----------
    rolled, time : ndarray
        Of stretches, one after the other, rad and s.
    """
    weights = np.sin(math.pi * (np.arange(time.size) + 0.5) / time.size) ** 2
    return float((weights @ rolled) / (weights @ time))


def _least(seconds: float) -> str:
    """Return a time as it is asked for, rounded up."""
    digit = 10.0 ** (math.floor(math.log10(1e3 * seconds)) - 2)
    return f"{digit * math.ceil(1e3 * seconds / digit):.3g} ms"


def _percent(share: float) -> str:
    return f"{100.0 * share:.2g} %"

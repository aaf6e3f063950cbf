r"""What a vibration saves of the motor's power, and how well a march knows it.

That is a small difference of large powers. What still rings when a state counts as settled moves
the normal force, and with it the torques of worm and wheel alike: their quotient hardly moves, and
at the load it is the torque that lasts, once the worm is in balance too. The error is what three
blocks of cycles differ by, and what goes on as it did from block to block; what steps twice as
long change; what is not known of the drive without vibration; and what the quotient may move by
while the wheel is out of balance.
"""

import dataclasses
import math

import numpy as np

from asperity.arrays import FloatArray
from asperity.drive.protocols.accuracy import StepError, advantage
from asperity.drive.protocols.judgement import Judgement
from asperity.drive.protocols.march import Records, mean
from asperity.drive.protocols.rest import Rest

LEAST = 1e-6
"""Of the power without vibration: less of it is told by no balance."""

_SLOWEST = 0.9  # of a block's change, what the next is taken to change by at most
# Of a saving, what its error is to be where an advice is followed: it may be less than it seems.
_TOLD = 0.25
_MOST_TIMES = 64.0  # as many cycles, or as short a step: what is still advised
_LONGEST_WINDOW = 1000


@dataclasses.dataclass(frozen=True)
class Saving:
    """What a vibration saves of the motor's power.

    Attributes
    ----------
    power : float
        The best guess, W; below 0 where it takes more.
    error : float
        Of it, W.
    actuator_error : float
        Of the actuator's mean power, W.
    of_blocks, of_step : float
        What blocks and step make of the error, W; nothing makes the rest smaller.
    """

    power: float
    error: float
    actuator_error: float
    of_blocks: float
    of_step: float

    @property
    def told(self) -> bool:
        """Whether it is more than its error."""
        return abs(self.power) > self.error

    def per_actuator(self, actuator: float, least: float) -> tuple[float, float] | None:
        """Return what is saved for a watt of the actuator, and its error; None if it is less.

        Parameters
        ----------
        actuator : float
            Its mean power, W.
        least : float
            What it has to be above, W.
        """
        surely = actuator - self.actuator_error
        if not self.told or actuator <= least or surely <= 0.0:
            return None
        ratio = self.power / actuator
        error = (abs(self.power) + self.error) / surely - abs(ratio)
        return (ratio, error) if error < abs(ratio) else None

    def would_tell(self, window: int, step: float) -> str:
        """Return what would tell it, as advice; nothing where that is not foreseen.

        Parameters
        ----------
        window : int
            Cycles of a block.
        step : float
            The longest, s.
        """
        wanted = _TOLD * abs(self.power) - (self.error - self.of_blocks - self.of_step)
        if not wanted > 0.0:
            return ""
        # Each is to make half of it at most.
        finer, longer = 2.0 * self.of_step / wanted, 2.0 * self.of_blocks / wanted
        cycles = math.ceil(window * longer)
        foreseen = max(finer, longer) <= _MOST_TIMES and cycles <= _LONGEST_WINDOW
        if not foreseen:
            return ""
        advice = []
        if longer > 1.0:
            advice.append(f"drive.window = {cycles}")
        if finer > 1.0:
            advice.append(f"solve.step = '{_rounded_down(1e6 * step / finer)} us'")
        return " with ".join(advice)


def saving(
    rows: Records, judged: Judgement, rest: Rest, off: StepError | None, load: float, power: float
) -> Saving:
    """Return what a vibration saves by the blocks that a settled march is judged by.

    Parameters
    ----------
    rows : Records
        Of its cycles.
    judged, rest, off : Judgement, Rest, StepError, optional
        What it was found to be, the drive without vibration, and the step's error.
    load : float
        Torque of the wheel, N m.
    power : float
        Of the motor without vibration, W.
    """
    last = rows[-judged.cycles :]
    blocks = last.reshape(3, -1)
    over = load / rest.torque
    found = power * (1.0 - over * advantage(last))
    of_blocks = left(np.array([power * (1.0 - over * advantage(one)) for one in blocks]))
    of_step = math.inf if off is None else power * over * advantage(last) * off.advantage
    least = LEAST * power
    unknown = abs(judged.balance * found) + rest.spread * power
    by_step = math.inf if off is None else off.actuator
    actuator_error = left(np.array([mean(one, "actuator") for one in blocks])) + by_step
    return Saving(found, of_blocks + of_step + unknown + least, actuator_error, of_blocks, of_step)


def left(means: FloatArray) -> float:
    """Return how far the mean of three blocks may be off what lasts.

    No less than they differ by; where they go one way, what that still comes to if it fades as it
    last did.
    """
    first, second = np.diff(means)
    spread = float(np.ptp(means))
    if first * second <= 0.0:
        return spread
    fades = min(second / first, _SLOWEST)
    lasts = means[-1] + second * fades / (1.0 - fades)
    return max(spread, abs(float(lasts - means.mean())))


def _rounded_down(value: float) -> str:
    digit = 10.0 ** (math.floor(math.log10(value)) - 1)
    return f"{digit * math.floor(value / digit):.2g}"

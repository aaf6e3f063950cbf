"""The drive signal heard by an oscilloscope that nobody else uses at the time."""

from collections.abc import Callable

import numpy as np

from asperity.tribometer.instruments.inputs import volts_a_count
from asperity.tribometer.instruments.protocols import Input, InstrumentError, Listener, Scope
from asperity.tribometer.parameters import Sonotrode

_INTERVAL = 1e-4  # s, or less where a plan is sampled faster
_TOLD = 0.45  # of the samples' frequency, above which what moves may look still
_LASTING, _LONGEST = 0.1, 1.0  # s, for a cycle of the lowest frequency up to the longer
_HEARD, _LOOKS = 0.5, 3  # of that, at least, and looks until so much has come
_STILL = 0.05  # Of the drive signal's swing, which is no vibration.


class ScopeListener(Listener):
    """Opens an oscilloscope, hears the drive signal for a moment, and lets go of it.

    Parameters
    ----------
    inputs : tuple of Input
        What is plugged in where.
    opened : callable
        Opens the oscilloscope, for some of the inputs.
    sonotrode : Sonotrode
        Whose drive signal it is.
    sample_rate : float
        At which a plan is sampled, Hz.
    frequencies : tuple of float
        That the drive is told, Hz.
    """

    def __init__(
        self,
        inputs: tuple[Input, ...],
        sonotrode: Sonotrode,
        opened: Callable[[tuple[Input, ...]], Scope],
        sample_rate: float = 0.0,
        frequencies: tuple[float, ...] = (),
    ) -> None:
        self._interval = 1.0 / max(1.0 / _INTERVAL, sample_rate)
        self._highest = max(frequencies, default=0.0)
        slowest = 1.0 / min(frequencies, default=1.0 / _LASTING)
        self._lasting = min(_LONGEST, max(_LASTING, slowest))
        self.name = "ear at the drive signal"
        self._input = next(one for one in inputs if one.signal == "drive_voltage")
        self._opened = opened
        swing = sonotrode.highest_voltage - sonotrode.lowest_voltage
        self._still = _STILL * swing / sonotrode.amplifier_gain

    def moves(self) -> bool:
        """Return whether the drive signal moves; raises InstrumentError where none is heard."""
        import time

        scope = self._opened((self._input,))
        counts, over = np.empty(0, int), False
        try:
            interval = scope.start(self._interval)
            for _ in range(_LOOKS):
                time.sleep(self._lasting)
                poll = scope.poll()
                counts = np.append(counts, poll.counts[0].astype(int))
                over = over or any(poll.overrange)
                if counts.size * interval >= _HEARD * self._lasting:
                    break
        finally:
            scope.close()
        if counts.size and float(np.ptp(counts)) * volts_a_count(self._input) > self._still:
            return True
        # Nothing moves in a part of a cycle, nor at the end of a range.
        if counts.size * interval < _HEARD * self._lasting:
            raise InstrumentError(
                f"{self.name}: {counts.size} samples have come, too few to tell",
                kind="samples lost or late",
            )
        if self._highest * interval > _TOLD:
            raise InstrumentError(
                f"{self.name}: by {1.0 / interval:g} samples a second nothing is known of "
                f"{self._highest:g} Hz; raise plan.sample_rate",
                kind="samples lost or late",
            )
        if over:
            raise InstrumentError(
                f"{self.name}: the signal is beyond the range of {self._input.range:g} V",
                kind="sensor at its limit",
            )
        return False

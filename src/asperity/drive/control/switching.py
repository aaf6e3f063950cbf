"""Who decides on the vibration: two thresholds, what they are late by, and what they watch."""

import dataclasses
import math

from asperity.drive.control.parameters import Control

FROZEN, TOO_LONG = "frozen", "too long on"


@dataclasses.dataclass
class Switch:
    """A controller, told a reading at a time.

    Attributes
    ----------
    control : Control
        Its thresholds and limits.
    on : bool
        What it says.
    fault : str
        What it has found; from then on the vibration stays off. Empty: nothing.
    fault_time : float
        When it was found, s; NaN before.
    latched : bool
        Whether it fails by not letting go.
    """

    control: Control
    on: bool = False
    fault: str = ""
    fault_time: float = math.nan
    latched: bool = False
    _last: float = math.nan
    _since: float = -math.inf
    _changed: float = -math.inf

    def begin(self, time: float, *, on: bool) -> None:
        """Begin at a time, s, with the vibration on or off."""
        self.on, self._since, self._changed = on, time, time

    def read(self, time: float, reading: float) -> bool:
        """Take a reading at a time, N m and s; return whether the vibration is to be on."""
        control = self.control
        if reading != self._last:
            self._last, self._changed = reading, time
        elif control.frozen_after is not None and time - self._changed > control.frozen_after:
            self._found(FROZEN, time)
        before = self.on
        if reading >= control.on:
            self.on = True
        elif reading <= control.off and not self.latched:
            self.on = False
        if self.on and not before:
            self._since = time
        longest = control.longest_on
        if self.on and longest is not None and time - self._since > longest:
            self._found(TOO_LONG, time)
        if self.fault and not self.latched:
            self.on = False
        return self.on

    def _found(self, fault: str, time: float) -> None:
        if not self.fault:
            self.fault, self.fault_time = fault, time

"""What follows from the levels of torque, speeds and current before and with vibration."""

import dataclasses
import functools
import math
from collections.abc import Callable, Iterator, Mapping, Sequence

import numpy as np

from asperity.arrays import FloatArray
from asperity.tribometer import discs
from asperity.tribometer.calibration import Line
from asperity.tribometer.pair import Pair
from asperity.tribometer.reduction import quantities
from asperity.tribometer.reduction.combined_uncertainty import TORQUE, Joint, Pairs
from asperity.tribometer.uncertainty import Budgeted, Cause, Contribution, Kind

STEEL, BRONZE, CURRENT = "speed_steel", "speed_bronze", "current_steel"
_BEFORE, _WITH = 0, 1

Number = Callable[[Pairs], float]
Efficiency = Callable[[Pairs, int], float]


@dataclasses.dataclass(frozen=True)
class Following:
    """Numbers of one segment.

    Attributes
    ----------
    pair : Pair
        The discs.
    voltage : float
        Of the steel disc's motor, V.
    joint : Joint
        Levels of the file.
    index : int
        Of the segment among those that are reduced.
    confidence : float
        Of intervals.
    lines : mapping of str to Line
        Calibrations.
    seconds : tuple of 2 floats
        That speeds were taken over, before and with vibration.
    hurried : float
        s, in which speeds settle, where windows have no time for it; zero where they have.
    powered : bool
        Whether the current is right in both windows.
    zeros : mapping of str to ndarray, shape (2, 2)
        Of signals whose zero was seen at rest and taken off, what is not known of it.
    left : mapping of str to ndarray, shape (2, 2)
        Of signals whose zero was seen at rest and not taken off, what that may have been.
    """

    pair: Pair
    voltage: float
    joint: Joint
    index: int
    confidence: float
    lines: Mapping[str, Line]
    seconds: tuple[float, float]
    hurried: float = 0.0
    powered: bool = True
    zeros: Mapping[str, FloatArray] = dataclasses.field(default_factory=dict)
    left: Mapping[str, FloatArray] = dataclasses.field(default_factory=dict)

    @property
    def levels(self) -> Pairs:
        """The levels of the segment's two windows."""
        return self.joint.pairs(2 * self.index, 2 * self.index + 1)

    def torque_change(self) -> Budgeted:
        """Return (73), %."""
        return self._interval(
            lambda of: float(quantities.torque_change(of[TORQUE][_WITH], of[TORQUE][_BEFORE]))
        )

    def torque(self, index: int) -> Budgeted:
        """Return it before (0) or with vibration (1), N m."""
        return self._interval(lambda of: float(of[TORQUE][index]))

    def power_change(self) -> Budgeted:
        """Return (74), %."""

        def change(of: Pairs) -> float:
            (before, shaken), (slow, fast) = of[TORQUE], of[STEEL]
            return float(quantities.power_change(shaken, fast, before, slow))

        return self._interval(change)

    def efficiency_change(self) -> Budgeted | None:
        """Return the change of (75), points; None where no current was measured."""
        return self._of_power(lambda of, index: float(
            quantities.thesis_efficiency(
                of[TORQUE][index], of[STEEL][index], self.voltage, of[CURRENT][index],
                self.pair.drives.gear_ratio,
            )
        ))  # fmt: skip

    def full_efficiency_change(self) -> Budgeted | None:
        """Return the change of an efficiency in which motor and gear lose, points."""
        return self._of_power(lambda of, index: float(
            quantities.drive_efficiency(
                of[TORQUE][index], of[STEEL][index], self.voltage, of[CURRENT][index],
                self.pair.drives.gear_ratio, *self.rims(of, index),
            )
        ))  # fmt: skip

    def sliding_velocity(self, index: int) -> Budgeted:
        """Return it before (0) or with vibration (1), m/s."""
        return self._interval(lambda of: float(discs.sliding_velocity(*self.rims(of, index))))

    def slide_roll_ratio(self) -> float:
        """Return the mean of before and with."""
        both = (float(discs.slide_roll_ratio(*self.rims(self.levels, one))) for one in (0, 1))
        return 0.5 * sum(both)

    def velocity_ratio(self, peak: float, amplitude: Cause) -> Budgeted | None:
        """Return v_a, of some uncertainty, over the mean of the sliding velocities."""

        def mean(of: Pairs) -> float:
            found = (float(discs.sliding_velocity(*self.rims(of, one))) for one in (0, 1))
            return 0.5 * sum(found)

        middle = mean(self.levels)
        if middle <= 0.0:
            return None
        beside = Contribution.of(amplitude, ("peak velocity of the vibration",), (1.0 / middle,))
        return self._interval(lambda of: peak / mean(of), (beside,) if beside.variance else ())

    def rims(self, of: Pairs, index: int) -> tuple[float, float]:
        """Return the velocities of both rims, m/s."""
        steel, bronze = self.pair.rims(float(of[STEEL][index]), float(of[BRONZE][index]))
        return float(steel), float(bronze)

    def _of_power(self, efficiency: Efficiency) -> Budgeted | None:
        if not self.powered or CURRENT not in self.levels or self.voltage <= 0.0:
            return None
        if min(self.levels[CURRENT]) <= 0.0:
            return None
        return self._interval(lambda of: 100.0 * (efficiency(of, _WITH) - efficiency(of, _BEFORE)))

    def _interval(self, of: Number, beside: Sequence[Contribution] = ()) -> Budgeted:
        before = 2 * self.index
        return self.joint.interval(of, before, before + 1, self.confidence, self._added, beside)

    @functools.cached_property
    def _added(self) -> Mapping[str, Sequence[Cause]]:
        """What is not known of the levels beside their noise."""
        return {name: tuple(self._causes(name, level)) for name, level in self.levels.items()}

    def _causes(self, name: str, levels: FloatArray) -> Iterator[Cause]:
        """Yield what calibration, zero and the steps of an encoder leave in a signal's levels."""
        line = self.lines[name]
        if name in self.zeros:
            # What the offset of the line was off by went with the zero.
            covariance = np.outer(levels, levels) * (line.gain_deviation / line.gain) ** 2
            yield Cause(f"{name}: zero at rest", "A", self.zeros[name])
        else:
            one, other, both = line.covariance_of_pair(float(levels[0]), float(levels[1]))
            covariance = np.array([[one, both], [both, other]])
        kind: Kind = "B" if line.degrees_of_freedom == math.inf else "A"
        yield Cause(f"{name}: calibration", kind, covariance, line.degrees_of_freedom)
        if name in self.left:
            yield Cause(f"{name}: zero at rest, not taken off", "B", self.left[name])
        for what, most in line.limits:
            yield Cause(f"{name}: {what}", "B", np.diag([most**2 / 3.0] * 2))
        if (told := self.joint.levels[name].steps) is not None:
            here = slice(2 * self.index, 2 * self.index + 2)
            yield Cause(f"{name}: steps of the encoder", "B", told[here, here])
        elif name in (STEEL, BRONZE):
            # A window begins and ends between two pulses: each end is off by a part of one.
            steps = [
                2.0 * math.pi / (self.pair.drives.encoder_pulses * one) for one in self.seconds
            ]
            yield Cause(f"{name}: steps of the encoder", "B", np.diag(np.square(steps) / 6.0))

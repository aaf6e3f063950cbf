"""Whether a block flutters as it slides: looked at before it is marched.

The directions of slip are those of the drive and of the extremes of the vibration. In each the
block is taken to slide steadily with all of its base in contact
(`asperity.contact.motion.stability`); a vibration that turns the slip leaves a growing oscillation
less time than that.
"""

import dataclasses
import math

import numpy as np

from asperity.block.problem import BlockProblem
from asperity.contact.motion.stability import Growth, SlidingMotion, sliding_motion

# Directions whose unit vectors agree to this are one, 2.6 degrees.
_SAME = 0.999

# What grows by less than this factor in the whole march is of no account.
_SEEN = math.e

# Damping holds what is left with this share of its growth; it is found to this share of itself.
_HELD = 0.01
_CLOSE = 0.02
_MOST_RATIO = 0.5


@dataclasses.dataclass(frozen=True)
class Flutter:
    """An oscillation of a sliding block that grows."""

    direction: tuple[float, float]  #: Unit vector of the slip, along x and y
    growth: Growth  #: In time
    #: In the steps of the march; None where their numerical damping holds it
    stepped: Growth | None
    holding: float | None  #: Least ``block.damping_ratio`` that holds it; None where none does


class Stability:
    """Steady sliding of a block, in each direction it slides to.

    Nothing is found where asperities keep their stiffness: their friction falls with the pressure
    at once and rises behind it, which is no linear motion.
    """

    def __init__(self, problem: BlockProblem) -> None:
        self._problem = problem
        system, pressure = problem.system, problem.mean_pressure
        self.motions = tuple(
            sliding_motion(
                system.mechanism, system.surface, system.normal, system.friction, pressure, way
            )
            for way in (slip_directions(problem) if problem.friction.reference == 0.0 else ())
        )

    def flutter(self) -> Flutter | None:
        """Return the oscillation that grows fastest; None where none grows by e in the march."""
        found = [(motion, motion.growth()) for motion in self.motions]
        growing = [(motion, growth) for motion, growth in found if self._seen(growth)]
        if not growing:
            return None
        # What the steps do not hold comes first.
        stepped = [self._in_steps(motion, self._problem.timetable.step) for motion, _ in growing]
        worst = max(range(len(growing)), key=lambda i: (_rate(stepped[i]), _rate(growing[i][1])))
        motion, growth = growing[worst]
        assert growth is not None
        return Flutter(motion.direction, growth, stepped[worst], self._holding(growth))

    def flutters_in_steps(self, step: float) -> bool:
        """Whether an oscillation grows that steps of a length in s do not hold."""
        growing = (motion for motion in self.motions if self._seen(motion.growth()))
        return any(self._in_steps(motion, step) is not None for motion in growing)

    def _in_steps(self, motion: SlidingMotion, step: float) -> Growth | None:
        system = self._problem.system
        return motion.growth(motion.in_steps(step, alpha=system.alpha, impact=system.impact(step)))

    def _seen(self, growth: Growth | None) -> bool:
        table = self._problem.timetable
        return _rate(growth) * table.steps * table.step >= math.log(_SEEN)

    def _holding(self, worst: Growth) -> float | None:
        """Least damping ratio that holds what grows in any direction, rounded up."""
        if not self._problem.block.modes:
            return None
        mechanism = self._problem.system.mechanism
        free = ~mechanism.held
        critical = 2.0 * np.sqrt(np.diag(mechanism.stiffness) * np.diag(mechanism.mass))[free]
        given = self._problem.block.damping_ratio

        def holds(ratio: float) -> bool:
            more = (ratio - given) * critical
            return all(
                _rate(motion.damped(more).growth()) <= _HELD * worst.rate for motion in self.motions
            )

        high = max(2.0 * given, 1e-3)
        while not holds(high):
            if high >= _MOST_RATIO:
                return None
            high = min(2.0 * high, _MOST_RATIO)
        low = max(given, 0.0 if high == 1e-3 else 0.5 * high)
        while high - low > _CLOSE * high:
            middle = 0.5 * (low + high)
            low, high = (low, middle) if holds(middle) else (middle, high)
        digit = 10.0 ** (math.floor(math.log10(high)) - 1)
        return math.ceil(high / digit - 1e-9) * digit


def _rate(growth: Growth | None) -> float:
    return growth.rate if growth is not None else 0.0


def slip_directions(problem: BlockProblem) -> tuple[tuple[float, float], ...]:
    """Return the directions a block slides to, unit vectors along x and y: the drive's first."""
    model = problem.model
    along, across, _ = model.unit_direction
    fastest = model.peak_velocity if model.vibrates else 0.0
    found: list[tuple[float, float]] = []
    for share in (0.0, 1.0, -1.0):
        x = model.slider.drive_velocity - share * fastest * along
        y = 0.0 - share * fastest * across * model.friction.transfer
        speed = math.hypot(x, y)
        if speed > 0.0 and all(x * a + y * b < _SAME * speed for a, b in found):
            found.append((x / speed, y / speed))
    return tuple(found)


def flutter_note(problem: BlockProblem, flutter: Flutter) -> str:
    """Say which oscillation grows, how fast, and what holds it."""
    growth, stepped = flutter.growth, flutter.stepped
    turn = math.degrees(math.atan2(flutter.direction[1], flutter.direction[0])) + 0.0
    way = "along the drive" if abs(turn) < 1.0 else f"at {turn:.0f} degrees to the drive"
    given, step = problem.block.damping_ratio, problem.timetable.step
    text = f"the block flutters as it slides {way}: {_note(growth)}, which "
    if problem.block.modes:
        text += f"a block.damping_ratio of {given:g} does not hold"
    else:
        text += "nothing damps"
    if stepped is None:
        text += (
            f"; the numerical damping of steps of {step:.3g} s holds it, that of shorter ones may "
            "not"
        )
    else:
        text += f"; in steps of {step:.3g} s it grows by {stepped.rate:.4g}/s: mistrust the result"
    if flutter.holding is not None:
        text += f"; one of {flutter.holding:.2g} does, as may other block.modes"
    elif problem.block.modes:
        text += "; none does"
    return text


def _note(growth: Growth) -> str:
    if growth.frequency == 0.0:
        return f"a motion that does not oscillate grows by {growth.rate:.4g}/s"
    return f"an oscillation of {1e-3 * growth.frequency:.4g} kHz grows by {growth.rate:.4g}/s"

r"""Pressure against overclosure: linear, two-stage, hard.

- ``linear``: :math:`p = k\,g` for an overclosure :math:`g > 0`.
- ``two-stage``: stiffness :math:`k_i` up to :math:`g_1`, rising linearly with the overclosure to
  :math:`k` at :math:`g_2`, and :math:`k` from there on: low initial, transition, high final
  stiffness as in the thesis's Figure 5.3. Pressure and stiffness are continuous.
- ``hard``: an augmented Lagrangian, :math:`p = \lambda + k\,g`, with multipliers
  :math:`\lambda \ge 0` at the nodes that grow until the overclosure, averaged about each node, is
  nil. A contact much narrower than an element is open on the average about every node, and bears
  on :math:`k` alone: resolve it.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, NamedTuple

import numpy as np

from asperity.errors import InputError, choices
from asperity.kernels.compiled import kernel

# A first stage softer than that is none, and what the last one needs is lost in its digits.
_LEAST_INITIAL = 1e-6

LINEAR = 0
TWO_STAGE = 1
HARD = 2
NORMALS = {"linear": LINEAR, "two-stage": TWO_STAGE, "hard": HARD}


class PressureLaw(NamedTuple):
    """What the kernels know of a `NormalLaw`; the attributes are its, and ``code`` its name."""

    code: int
    stiffness: float
    initial: float
    start: float
    end: float


@kernel
def pressure(over, multiplier, law):
    """Contact pressure, Pa, and its slope, Pa/m, for an overclosure in m; both 0 where it is open.

    ``multiplier`` is the augmented Lagrangian's pressure at the point, Pa; 0 for the other laws.
    """
    stiffness = law.stiffness
    if law.code == TWO_STAGE:
        if over <= 0.0:
            return 0.0, 0.0
        soft = law.initial
        first = law.start
        last = law.end
        if over <= first:
            return soft * over, soft
        rise = (stiffness - soft) / (last - first)
        if over < last:
            way = over - first
            return soft * over + 0.5 * rise * way * way, soft + rise * way
        way = last - first
        return soft * last + 0.5 * rise * way * way + stiffness * (over - last), stiffness
    value = multiplier + stiffness * over
    if value <= 0.0:
        return 0.0, 0.0
    return value, stiffness


@kernel
def augmented_overclosure(aim, augmentation, multiplier, law):
    """Overclosure at which pressure plus r times it is ``aim``, m.

    The law is monotone, so there is one for any augmentation r > 0, Pa/m.
    """
    if law.code == TWO_STAGE:
        if aim <= 0.0:
            return aim / augmentation
        # Convex: Newton's method comes down from above without overshoot.
        over = aim / (augmentation + law.initial)
        for _ in range(50):
            value, slope = pressure(over, 0.0, law)
            change = (value + augmentation * over - aim) / (slope + augmentation)
            over -= change
            if abs(change) <= 1e-15 * over:
                break
        return over
    if aim <= -augmentation * multiplier / law.stiffness:
        return aim / augmentation
    return (aim - multiplier) / (law.stiffness + augmentation)


@dataclass(frozen=True)
class NormalLaw:
    """How pressure grows with overclosure."""

    name: Literal["linear", "two-stage", "hard"] = "linear"  #: See the module
    #: Pa/m: of the line, of the final stage, or the penalty of the augmented Lagrangian
    stiffness: float = 0.0
    initial: float = 0.0  #: ``two-stage``: initial stiffness, Pa/m
    #: start, end: ``two-stage``: overclosures between which the stiffness rises, m
    start: float = 0.0
    end: float = 0.0

    def __post_init__(self) -> None:
        if self.name not in NORMALS:
            raise InputError(f"normal law is {self.name!r}; allowed: {choices(NORMALS)}")
        if not (np.isfinite(self.stiffness) and self.stiffness > 0.0):
            raise InputError(
                f"contact stiffness is {self.stiffness:g} Pa/m; it must be positive and finite"
            )
        if self.name == "two-stage":
            if not _LEAST_INITIAL * self.stiffness <= self.initial <= self.stiffness:
                raise InputError(
                    f"initial contact stiffness is {self.initial:g} Pa/m; it must be at least "
                    f"{_LEAST_INITIAL * self.stiffness:g} Pa/m, a millionth of the final one, and "
                    f"at most that, {self.stiffness:g} Pa/m"
                )
            if not (0.0 <= self.start < self.end and np.isfinite(self.end)):
                raise InputError(
                    f"the contact stiffness rises from an overclosure of {self.start:g} m to one "
                    f"of {self.end:g} m; the second must be greater than the first, and that at "
                    "least 0"
                )

    @classmethod
    def two_stage(cls, stiffness: float, length: float) -> NormalLaw:
        """Two stages by the edge of an element in contact in m.

        A tenth of the final stiffness, Pa/m, up to 1 % of the edge; it rises to the whole at 3 %.
        """
        if not length > 0.0:
            raise InputError(f"length is {length:g} m; it must be positive")
        return cls("two-stage", stiffness, 0.1 * stiffness, 0.01 * length, 0.03 * length)

    def overclosure(self, value: float) -> float:
        """Overclosure at a pressure in Pa, m; 0 for hard contact, and where nothing presses."""
        if self.name == "hard" or value <= 0.0:
            return 0.0
        if self.name == "linear":
            return value / self.stiffness
        bends = [float(pressure(over, 0.0, self.numbers)[0]) for over in (self.start, self.end)]
        if value <= bends[0]:
            return value / self.initial
        if value >= bends[1]:
            return self.end + (value - bends[1]) / self.stiffness
        rise = (self.stiffness - self.initial) / (self.end - self.start)
        beyond = value - bends[0]
        root = np.sqrt(self.initial**2 + 2.0 * rise * beyond)
        return self.start + 2.0 * beyond / (self.initial + float(root))

    def slope_at(self, value: float) -> float:
        """Slope of the pressure over the overclosure at a pressure in Pa, Pa/m.

        Of hard contact it is the slope of the penalty.
        """
        if self.name != "two-stage":
            return self.stiffness
        return float(pressure(self.overclosure(value), 0.0, self.numbers)[1]) or self.initial

    @property
    def numbers(self) -> PressureLaw:
        """The law as kernels take it."""
        sizes = self.stiffness, self.initial, self.start, self.end
        return PressureLaw(NORMALS[self.name], *map(float, sizes))

r"""The equations of one increment for given multipliers, and what they leave.

The residual is the difference between the nodal forces the body answers to and those of the
tractions, over the norm of the forces. Positions are known to so many digits, and a stiff contact
makes forces of the last of them: forces below that floor are those of touching and no more, and
nothing is asked of them, so that a contact may begin and end in any increment.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
import numpy.typing as npt

from asperity.arrays import FloatArray
from asperity.contact.increment.iterations import reach_of
from asperity.contact.increment.problem import IncrementProblem
from asperity.contact.interface.counter_motion import MotionNumbers
from asperity.contact.interface.records import Committed, ContactPoints
from asperity.contact.interface.tractions import tractions


@dataclass(frozen=True, eq=False)
class Trial:
    """The contact at one displacement of its nodes."""

    assumed: FloatArray  #: (3n,): Forces the body answers to, N
    response: FloatArray  #: (3n,): Its answer to them, ``A assumed``, m
    u: FloatArray  #: (3n,): Displacement, m
    force: FloatArray  #: (3n,): Forces of the tractions, N
    points: ContactPoints  #: The contact at its points
    floor: float  #: `Increment.floor`, N
    #: (q, 3, 3): Derivative of the tractions by the displacement, Pa/m; empty without a tangent
    stiffness: FloatArray = field(default_factory=lambda: np.empty((0, 3, 3)))

    @property
    def touching(self) -> npt.NDArray[np.bool_]:
        """Points in contact."""
        touching: npt.NDArray[np.bool_] = self.points.pressure > 0.0
        return touching

    @property
    def only_touches(self) -> bool:
        """Whether all forces are below the floor."""
        return self._scale <= self.floor

    @property
    def _scale(self) -> float:
        return max(float(np.linalg.norm(self.force)), float(np.linalg.norm(self.assumed)))

    @property
    def residual(self) -> float:
        """Relative difference between the forces assumed and those of the tractions."""
        if self.only_touches:
            return 0.0
        return float(np.linalg.norm(self.assumed - self.force)) / self._scale


@dataclass(frozen=True, eq=False)
class Increment:
    """What is given of one increment."""

    problem: IncrementProblem  #: What stays the same
    free: FloatArray  #: (3n,): :math:`u^*`, displacement without contact, m
    motion: MotionNumbers  #: Of the counter-surface
    committed: Committed  #: Where it starts from, and the multipliers of hard contact

    def evaluate(self, assumed: FloatArray, response: FloatArray) -> Trial:
        """Evaluate the contact where nodal forces lead to, with its tangent."""
        count = self.problem.points
        trial = Trial(
            assumed, response, self.free + response, np.empty_like(self.free),
            ContactPoints.empty(count), self.floor, np.empty((count, 3, 3)),
        )  # fmt: skip
        tractions(
            trial.u, self.committed, self.problem.interface, self.motion, trial.force,
            trial.points, trial.stiffness, True,
        )  # fmt: skip
        return trial

    def response(self, force: FloatArray) -> FloatArray:
        """Return what the body answers to nodal forces, ``A f``, m."""
        flexibility, there = self.problem.flexibility, np.flatnonzero(force)
        if 2 * len(there) <= len(force):
            flexibility, force = flexibility[:, there], force[there]
        out: FloatArray = flexibility @ force
        return out

    def nodal(self, tractions: FloatArray) -> FloatArray:
        """Return the nodal forces of tractions at the points, N."""
        surface = self.problem.surface
        by_face = tractions.reshape(*surface.weights.shape, 3)
        forces: FloatArray = surface.to_forces(by_face).ravel()
        return forces

    @cached_property
    def floor(self) -> float:
        """Forces that the last digits of the positions make, N."""
        reach: float = reach_of(self.problem.reach, self.free, self.motion.translation)
        return reach * self.problem.by_digits

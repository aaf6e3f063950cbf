"""How a counter-surface moves over an increment, and the slip its motion makes."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from asperity.arrays import FloatArray
from asperity.contact.interface.rigid import Pose


class MotionNumbers(NamedTuple):
    """What the kernels know of a `SurfaceMotion`, whose attributes these are."""

    rotation: FloatArray
    translation: FloatArray
    shift_1: FloatArray
    turn_1: FloatArray
    shift_2: FloatArray
    turn_2: FloatArray
    body_1: FloatArray
    body_2: FloatArray
    one_sided: bool


@dataclass(frozen=True, eq=False)
class Drift:
    """Displacement of the counter-surface's material over an increment, ``shift + turn @ x``."""

    shift: FloatArray = field(default_factory=lambda: np.zeros(3))  #: (3,): m
    #: (3, 3): On the position at the increment's end; of a rotation ``I - R_0 R_1^T``
    turn: FloatArray = field(default_factory=lambda: np.zeros((3, 3)))

    @classmethod
    def between(cls, before: Pose, after: Pose) -> Drift:
        """Whole displacement from one pose to another."""
        back = before.rotation @ after.rotation.T
        shift = back @ after.translation - before.translation
        return cls(shift, np.eye(3) - back)


@dataclass(frozen=True, eq=False)
class SurfaceMotion:
    """Where the counter-surface stands at the end of an increment, and what slip it makes.

    The slip of the body on the surface is ``v_j = body_j @ (u - u_committed) - base_j(x)`` in its
    two parts j = 1, 2, brought into the tangent plane. Usually the body moves in the first part
    alone, the base's x motion stands in the first and its transferred y motion in the second.
    """

    pose: Pose = field(default_factory=Pose)  #: At the end
    #: base_1, base_2: The two parts of the surface's displacement, as the contact sees them
    #: (transferred)
    base_1: Drift = field(default_factory=Drift)
    base_2: Drift = field(default_factory=Drift)
    #: body_1, body_2 (3, 3): What each part sees of the body's own displacement
    body_1: FloatArray = field(default_factory=lambda: np.eye(3))
    body_2: FloatArray = field(default_factory=lambda: np.zeros((3, 3)))
    #: Two-phase scheme: the increment ends no later than the vibration starts
    one_sided: bool = False

    def numbers(self) -> MotionNumbers:
        """The motion as kernels take it."""
        return MotionNumbers(
            _own(self.pose.rotation), _own(self.pose.translation),
            _own(self.base_1.shift), _own(self.base_1.turn),
            _own(self.base_2.shift), _own(self.base_2.turn),
            _own(self.body_1), _own(self.body_2), self.one_sided,
        )  # fmt: skip


def _own(values: FloatArray) -> FloatArray:
    # Kernels are compiled for one layout alone.
    return np.ascontiguousarray(values, dtype=np.float64)

"""What resolved pressures are told by: those of a tooth, and those at one angle of the worm."""

from __future__ import annotations

import dataclasses
from typing import NamedTuple

import numpy as np

from asperity.arrays import FloatArray
from asperity.drive.resolved.strip import ZONES, Strip

CLOSE = 0.05
"""Relative change of a peak from one strip to the next finer one."""


@dataclasses.dataclass(frozen=True, eq=False)
class ToothPressure:
    """The pressure on one tooth."""

    number: int  #: Of the tooth, as `Action.teeth` has them
    strip: Strip
    pressure: FloatArray  #: (N,): Pa, 0 beside what bears
    force: FloatArray  #: (N,): Normal forces of the patches, N

    @property
    def normal(self) -> float:
        """Normal force of the tooth, N."""
        return float(self.force.sum())

    @property
    def area(self) -> float:
        """Area that bears, m^2."""
        return float(self.strip.area[self.force > 0.0].sum())

    def extent(self) -> tuple[float, float]:
        """Return length and width of what bears, m.

        The length is that of all places along the contact at which it bears anywhere across, the
        width the largest across one of them: so of an ellipse as of a band. Both are taken along
        the patches and turned by the angle at which the contact lies to these. That is meant for
        contacts which lie along them, as strips are laid: a band that is turned by 0.2 rad is told
        a twentieth too long, by its width times the angle's tangent, an ellipse less. Spots with a
        gap between them add up to one length.
        """
        frame = self.strip.frame
        on = (self.force > 0.0).reshape(frame.shape)
        i, j = np.nonzero(on)
        places = np.array([frame.x[i], frame.y[j]])
        if places.shape[1] < 2:
            return 0.0, 0.0
        across, along = np.linalg.eigh(np.cov(places, bias=True))[1][:, -1]
        if abs(along) < abs(across):
            on, along, spacing = on.T, across, frame.spacing[::-1]
        else:
            spacing = frame.spacing
        stations = on.sum(axis=0)
        length = spacing[1] * int((stations > 0).sum()) / abs(float(along))
        return length, spacing[0] * int(stations.max()) * abs(float(along))

    def peaks(self) -> FloatArray:
        """Return the largest pressure of each of `ZONES`, Pa; 0 where it bears nothing."""
        return np.array([self._of(self.pressure, k).max(initial=0.0) for k in range(len(ZONES))])

    def forces(self) -> FloatArray:
        """Return the normal force of each of `ZONES`, N."""
        return np.array([self._of(self.force, k).sum() for k in range(len(ZONES))])

    def _of(self, values: FloatArray, zone: int) -> FloatArray:
        return np.asarray(values[self.strip.zone == zone])


class Change(NamedTuple):
    """A peak that the finest strip still changes by more than `CLOSE`."""

    tooth: int  #: Its number
    zone: int  #: In `ZONES`
    share: float  #: Of the change, in the larger of both


@dataclasses.dataclass(frozen=True, eq=False)
class Resolved:
    """The pressures at one angle of the worm."""

    teeth: tuple[ToothPressure, ...]  #: Those that bear
    approach: float  #: Turn of the wheel towards the worm beyond the condensed teeth's, rad
    depth: float  #: By which patches at the pressure of plastic flow were pressed in, at most, m
    iterations: int
    residual: float
    sink: float = 0.0  #: Of the half-spaces, mean by normal force, as a turn of the wheel, rad
    changes: tuple[Change, ...] = ()  #: What finer strips would still change; none: resolved

"""Where a flank bears over a pitch, and how hard: the largest resolved pressures at its points.

A phase shows contacts where they stand; between two phases they pass over what lies between. There
the crests of what bears are led from the one to the other, place by place along them, so that a
picture of them has no stripes.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from asperity.arrays import FloatArray
from asperity.drive.resolved.contact import ResolvedContact
from asperity.drive.resolved.pressures import Resolved, ToothPressure
from asperity.drive.resolved.strip import FLANK, ZONES
from asperity.drive.static.equilibrium import Balance
from asperity.drive.static.pressure import resolved

# Places along a crest, and of its way over the flank how far one place goes at most from phase to
# phase, in shares of the height: further it is no longer known where it went.
_PLACES, _FAR = 121, 0.15
# Patches without force within a crest, from which on there are two.
_APART = 3

_Crests = dict[tuple[int, int], list[FloatArray]]


class Pattern:
    """The largest resolved pressures of a pitch over the flank, on the grid of the exact flank."""

    def __init__(self, owner: ResolvedContact) -> None:
        self.owner = owner
        self.mesh_errors: list[float] = []  #: What points of the mesh hold the wheel ahead by, rad
        self._largest = np.zeros(owner.flank.nodes)
        self._first: _Crests = {}
        self._last: _Crests = {}

    def evaluate(self, _number: int, balance: Balance) -> None:
        """Keep what a balance presses, resolved by its first strips alone."""
        self.add(resolved(self.owner, balance, finer=False))

    def add(self, found: Resolved) -> None:
        """Keep what was resolved at the next phase."""
        flank = self.owner.flank
        crests: _Crests = {}
        for tooth in found.teeth:
            on, spacing = tooth.force > 0.0, tooth.strip.frame.spacing
            along = spacing[1] * tooth.strip.frame.axes[1]
            # Patches are as long as the grid is wide: their middles alone would leave points out.
            # Across an edge a part of one beside its middle would put its pressure on the flank.
            for part in (-0.4, 0.0, 0.4):
                some = on & (tooth.strip.zone == FLANK) if part else on
                points = tooth.strip.points[some] + part * along
                self._put(flank.share_at(points), points[:, 2], tooth.pressure[some])
            for zone in range(len(ZONES)):
                crests[tooth.number, zone] = list(_crests(tooth, zone))
                for crest in crests[tooth.number, zone] if zone != FLANK else ():
                    self._put(*crest)
        if not self.mesh_errors:
            self._first = crests
        self._pass(self._largest, self._last, crests)
        self._last = crests
        self.mesh_errors.append(self.owner.mesh_error(found))

    def _put(self, share: FloatArray, z: FloatArray, pressure: FloatArray) -> None:
        np.maximum.at(self._largest, self.owner.flank.nearest(share, z), pressure)

    @property
    def largest(self) -> FloatArray:
        """Largest pressures at the points of the grid, Pa; from the last phase on to the first."""
        largest = self._largest.copy()
        # A pitch later each tooth stands where the one before it stood.
        self._pass(largest, self._last, {(n - 1, zone): c for (n, zone), c in self._first.items()})
        return largest

    def _pass(self, largest: FloatArray, before: _Crests, after: _Crests) -> None:
        """Put in what crests press on their way from one phase to the next."""
        flank = self.owner.flank
        for key in before.keys() & after.keys():
            if len(before[key]) != len(after[key]):
                continue
            for one, two in zip(before[key], after[key], strict=True):
                way = np.abs(two - one)
                if way[0].max() > _FAR:
                    continue
                rows = way[0].max() * flank.rows
                steps = math.ceil(max(rows, way[1].max() / flank.least_reach))
                part = (np.arange(1, 2 * steps) / (2.0 * steps))[:, None, None]
                share, z, pressure = np.moveaxis((1.0 - part) * one + part * two, 1, 0)
                np.maximum.at(largest, flank.nearest(share, z), pressure)


def _crests(tooth: ToothPressure, zone: int) -> Iterator[FloatArray]:
    """Yield shares of the flank's height, places along the face, m, and pressures, Pa, (3, k).

    Along each stretch of the contact that bears in a zone, where the pressure across is largest.
    """
    strip = tooth.strip
    shape = strip.frame.shape
    pressure = np.where(strip.zone == zone, tooth.pressure, 0.0).reshape(shape)
    stations = np.flatnonzero(pressure.any(axis=0))
    if not len(stations):
        return
    across = pressure.argmax(axis=0)
    for run in np.split(stations, np.flatnonzero(np.diff(stations) > _APART) + 1):
        at = np.ravel_multi_index((across[run], run), shape)
        values = strip.share[at], strip.points[at, 2], tooth.pressure[at]
        places = np.linspace(run[0], run[-1], _PLACES)
        yield np.array([np.interp(places, run, each) for each in values])

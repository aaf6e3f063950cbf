"""Worm and wheel in mesh: where each stands, and threads that leave the wheel room.

The worm is at phase 0, and the wheel in the middle of its play. The frame is the gearset's own.
"""

import dataclasses

import numpy as np

from asperity.arrays import FloatArray
from asperity.flanks.meshing.analysis import Analysis
from asperity.flanks.meshing.backlash import set_backlash
from asperity.flanks.wheel.flank import RESOLVED
from asperity.flanks.worm.setting import Pair


@dataclasses.dataclass(frozen=True, eq=False)
class Assembly:
    """A pair in mesh.

    Attributes
    ----------
    pair : Pair
        The worm's threads are those that are made.
    thinned : float
        By how much they are thinner for that than what was analysed, along the axis, mm.
    wheel_angle : float
        How far the wheel stands turned about its axis, rad.
    """

    pair: Pair
    thinned: float
    wheel_angle: float

    @classmethod
    def of(cls, analysis: Analysis, *, made: bool) -> "Assembly":
        """Return worm and wheel as they were analysed.

        As they are ``made``, threads that would cut into the wheel are as thin as leaves no play.

        Raises
        ------
        InputError, ConvergenceError
            There are no such threads.
        """
        meshes = {side: flank.transmission for side, flank in analysis.flanks.items()}
        if made and min(analysis.play.normal.values()) < -RESOLVED:
            meshes = set_backlash(meshes, 0.0)
        pair = meshes[1].search.pair
        # A flank touches where its lead and the turn of the wheel make up for each other.
        plus, minus = (
            float(np.interp(0.0, mesh.wheel_angle, mesh.lead, period=mesh.search.pitch))
            for mesh in (meshes[1], meshes[-1])
        )
        return cls(
            pair=pair,
            thinned=2.0 * (pair.worm.half_space - analysis.pair.worm.half_space),
            wheel_angle=(minus - plus) / (2.0 * pair.ratio),
        )

    @property
    def worm_rotation(self) -> FloatArray:
        """The matrix that turns the worm from its own frame into the gearset's."""
        mirror = np.diag([1.0, 1.0, float(self.pair.mirror)])
        return mirror @ self.pair.mounting.axes.T @ mirror

    @property
    def worm_place(self) -> FloatArray:
        """Where the worm's middle stands, mm."""
        return self.pair.mounting.origin * [1.0, 1.0, self.pair.mirror]

    @property
    def shaft_turn(self) -> FloatArray:
        """How the wheel's shaft is turned on it: by itself it goes along z from its driving end.

        That end is where z of the forces points, which go along the worm to its driven end and
        from the wheel to the worm.
        """
        driven = self.worm_rotation @ [0.0, 0.0, float(self.pair.mirror)]
        ahead = np.cross(driven, self.worm_place)[2] > 0.0
        return np.eye(3) if ahead else np.diag([1.0, -1.0, -1.0])

    @property
    def wheel_rotation(self) -> FloatArray:
        """The matrix that turns the wheel to where it stands."""
        cosine, sine = np.cos(self.wheel_angle), np.sin(self.wheel_angle)
        return np.array([[cosine, -sine, 0.0], [sine, cosine, 0.0], [0.0, 0.0, 1.0]])

"""A shipped gearset's worm and wheel in mesh, on one flank."""

import dataclasses
import functools
import math

import numpy as np

from asperity.arrays import FloatArray
from asperity.flanks.meshing.contact_lines import contact_lines
from asperity.flanks.meshing.kinematics import Kinematics, kinematics
from asperity.flanks.meshing.lubrication import Load, LoadedLines, loaded_lines
from asperity.flanks.meshing.transmission import Transmission, transmission
from asperity.flanks.parameters import Disc, Hob, Modification, Mount
from asperity.flanks.tables import TABLES as FLANKS_TABLES
from asperity.flanks.wheel.enveloped import FlankGrid, Wheel
from asperity.flanks.worm.distance import distances
from asperity.flanks.worm.setting import Pair
from asperity.gearset import Gearset
from asperity.rating import Operation
from asperity.rating.tables import TABLES as RATING_TABLES
from asperity.thesis.cases import Shipped

_ROWS, _COLUMNS = 41, 61
_SIDE = 1
# Only the oil film depends on it, which is not drawn; K.
_OIL = 353.15


_TABLES = {**RATING_TABLES, **FLANKS_TABLES}


class Gear(Shipped):
    """A shipped gearset with flanks."""

    verb = "flank"
    known = _TABLES


def pair_of(gear: Gear) -> Pair:
    """Return worm and wheel of a gearset as its tables say."""
    case = gear.read()

    return Pair.of(
        case.require(Gearset),
        case.get(Hob),
        case.get(Mount),
        case.get(Modification),
        case.get(Disc),
    )


def stood(points: FloatArray, angle: float) -> FloatArray:
    """Return points of the wheel in the standing frame where it has turned by an angle, mm."""
    x, y, z = np.moveaxis(points, -1, 0)
    cosine, sine = math.cos(angle), math.sin(angle)
    return np.stack([cosine * x - sine * y, sine * x + cosine * y, z], axis=-1)


@dataclasses.dataclass(frozen=True, eq=False)
class Meshing:
    """The mesh on the flank s = +1, on a grid of its points."""

    gear: Gear
    wheel: Wheel
    transmission: Transmission
    grid: FlankGrid
    motion: Kinematics

    @property
    def pitch(self) -> float:
        """Turn of the worm from one tooth to the next, rad."""
        return 2.0 * math.pi / self.wheel.pair.geometry.starts

    def in_worm(self, worm_angle: float) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return the flank against the worm at an angle of it.

        Over the grid: distance to the worm and from its axis, mm; place along the thread, rad.
        """
        pair = self.wheel.pair
        angle = worm_angle / pair.ratio + self.transmission.ahead
        place = pair.mounting.to_helicoid(stood(self.grid.points, angle))
        radius = np.hypot(place[..., 0], place[..., 1])
        thread = np.arctan2(place[..., 1], place[..., 0]) - worm_angle
        # A turn of a helicoid is a shift along its axis.
        place[..., 2] += pair.worm.reduced_lead * worm_angle
        return distances(place, pair.worm, _SIDE), radius, thread

    def loaded(self, angles: int) -> list[LoadedLines]:
        """Return the contact lines under the rated torque at even angles of a pitch."""
        case = self.gear.read()
        load = Load.of(case.require(Gearset), case.require(Operation), _OIL)
        starts = self.wheel.pair.geometry.starts
        return [
            loaded_lines(
                self.transmission,
                contact_lines(self.motion, self.grid, starts, self.pitch * number / angles),
                load,
            )
            for number in range(angles)
        ]


@functools.cache
def meshing(gear: Gear) -> Meshing:
    """Return the mesh of a gearset; its worm has threads of nominal thickness."""
    wheel = Wheel.cut(pair_of(gear))
    flank = wheel.flank(_SIDE)
    found = transmission(wheel.pair, flank)
    grid = flank.grid(_ROWS, _COLUMNS)
    motion = kinematics(wheel.pair, grid, _SIDE, ahead=found.ahead)
    return Meshing(gear, wheel, found, grid, motion)

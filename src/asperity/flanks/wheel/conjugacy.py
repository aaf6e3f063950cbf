"""How well points of a wheel's flank satisfy the law that made them."""

import numpy as np

from asperity.arrays import FloatArray
from asperity.flanks.wheel.enveloped import FlankGrid, WheelFlank
from asperity.flanks.worm.distance import distances


def conjugacy_residual(flank: WheelFlank, grid: FlankGrid) -> FloatArray:
    """Return the distances of points to the hob at the phase at which it cuts them, mm.

    They are zero but for the rounding of floats and, for the flanks of grinding discs, for the
    table their profile is in. Shaped as the grid; negative inside the hob.
    """
    pair = flank.pair
    angle = grid.phase / pair.ratio
    cosine, sine = np.cos(angle), np.sin(angle)
    x, y, z = np.moveaxis(grid.points, -1, 0)
    stood = np.stack([cosine * x - sine * y, sine * x + cosine * y, z], axis=-1)
    place = pair.cutting.to_helicoid(stood)
    # A turn of a helicoid is a shift along its axis.
    place[..., 2] += pair.hob.reduced_lead * grid.phase
    return distances(place, pair.hob, flank.side)

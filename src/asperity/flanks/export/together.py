"""Worm and wheel as they run together."""

import math

import numpy as np

from asperity.flanks.export.patch import Body, Patch
from asperity.flanks.export.tooth import tooth_body
from asperity.flanks.export.worm import worm_body
from asperity.flanks.wheel.enveloped import Wheel
from asperity.flanks.wheel.frame import turned


def centred_teeth(wheel: Wheel, teeth: int) -> Body:
    """Return teeth on both sides of the one that stands in the worm's thread space."""
    angle = -2.0 * math.pi * (teeth // 2) / wheel.pair.geometry.wheel_teeth
    return tooth_body(wheel, teeth).moved(turned(angle))


def mounted_worm(wheel: Wheel) -> Body:
    """Return the worm at phase 0 where it runs, in the frame of the gearset's wheel, mm."""
    pair = wheel.pair
    mirror = np.diag([1.0, 1.0, pair.mirror])
    worm = worm_body(pair).moved(mirror)
    return Body(
        worm.name,
        [Patch(pair.mounting.to_wheel(patch.points)) for patch in worm.patches],
        [[pair.mounting.to_wheel(row) for row in ring] for ring in worm.rings],
    ).moved(mirror)

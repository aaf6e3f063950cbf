"""What a segment of a gear rig tells beside that of discs."""

import math
from typing import Any

import numpy as np

from asperity.tribometer.pair import Pair
from asperity.tribometer.reduction.blocks import Blocks
from asperity.tribometer.reduction.segments import Segment


def geared_numbers(
    pair: Pair, blocks: Blocks, segment: Segment, worm_motor: float
) -> dict[str, Any]:
    """Return the worm's speed, rpm, and the wheel's torque, N m, with vibration."""
    found: dict[str, Any] = {"worm_speed": worm_motor / pair.drives.gear_ratio * 30.0 / math.pi}
    if "torque_bronze" in blocks.means:
        window = slice(segment.shaken.first, segment.shaken.last + 1)
        found["wheel_torque"] = abs(float(np.nanmean(blocks.means["torque_bronze"][window])))
    return found

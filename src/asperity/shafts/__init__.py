"""The shafts of a worm gearset and their rolling bearings: loads, deflection, strength, life."""

from asperity.shafts.bearing import RollingBearing
from asperity.shafts.options import BearingOptions
from asperity.shafts.parameters import (
    ShaftBearing,
    ShaftLoad,
    ShaftSection,
    WheelShaft,
    WormShaft,
)
from asperity.shafts.steel import ShaftSteel

__all__ = [
    "BearingOptions",
    "RollingBearing",
    "ShaftBearing",
    "ShaftLoad",
    "ShaftSection",
    "ShaftSteel",
    "WheelShaft",
    "WormShaft",
]

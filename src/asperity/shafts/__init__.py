"""The shafts of a worm gearset and their rolling bearings: loads, deflection, strength, life.

:Entry: `study`, the command `asperity shafts`; `study.beside_rating` adds to a rating.
:Data: `[worm_shaft]`, `[wheel_shaft]`, `[bearings]` (`parameters`, `options`); bearings and steels
    of data files.
:Where: `statics` (reactions), `beam` (deflection), `strength` (DIN 743, Goodman, Gerber), `rolling`
    (ISO 281, ISO 76), `loads` (cases and spectra), `compliance` (what the mesh gives way).
:Tests: `unit/test_shafts*`, `literature/test_shafts*`, `acceptance/test_cli_shafts`.
"""

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

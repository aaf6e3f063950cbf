"""What a worm gearset is: macro-geometry, materials, lubricants and bearings.

:Entry: `Gearset`, whose `geometry` is a `Geometry` in mm and rad, as rating and flanks use it.
:Data: `[gearset]` (`parameters`); materials, oils and bearings of `data/*.toml` or a user's file
    (`library`).
:Where: `relations` and `macro` (the numbers), `proportions` (tooth heights), `threads`, `sizing`
    (standard modules), `oil`, `drawing`.
:Tests: `unit/test_gearset_*`, `property/test_gearset`, `literature/test_gearsets_2_3`.
"""

from asperity.gearset.geometry import Geometry
from asperity.gearset.parameters import Gearset

__all__ = ["Gearset", "Geometry"]

"""Friction laws: Coulomb, Dahl with any exponent, LuGre; one update for bodies and for contact.

:Entry: `update` and its like: deflection, slips and limit in; deflection, share and tangent out,
    compiled.
:Data: `[friction]` (`parameters`).
:Where: a law a file: `coulomb`, `dahl`, `lugre`, `return_mapping`, `springs`, `two_phase` (the
    thesis's); `loaded` under a normal force that changes; `tangent` and its like for implicit
    contact; `lanes` for many bodies side by side.
:Tests: `unit/test_friction`, `unit/test_lugre_update`, `unit/test_loaded_friction`,
    `literature/test_friction`, `literature/test_lugre*`, `property/test_friction`.
"""

from asperity.friction.dahl import LAWS, SPLIT, UNSPLIT, VECTOR
from asperity.friction.loaded import KEEPS, advance_loaded, friction_loss
from asperity.friction.lugre import lugre_update
from asperity.friction.parameters import Friction
from asperity.friction.tangent import update

__all__ = [
    "KEEPS",
    "LAWS",
    "SPLIT",
    "UNSPLIT",
    "VECTOR",
    "Friction",
    "advance_loaded",
    "friction_loss",
    "lugre_update",
    "update",
]

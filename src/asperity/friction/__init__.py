"""Friction laws: Coulomb, Dahl with any exponent, LuGre; one update for bodies and for contact."""

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

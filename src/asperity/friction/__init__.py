"""Friction laws: Coulomb, Dahl with any exponent, LuGre; one update for bodies and for contact."""

from asperity.friction.dahl import LAWS, SPLIT, UNSPLIT, VECTOR
from asperity.friction.lugre import lugre_update
from asperity.friction.parameters import Friction
from asperity.friction.tangent import update

__all__ = ["LAWS", "SPLIT", "UNSPLIT", "VECTOR", "Friction", "lugre_update", "update"]

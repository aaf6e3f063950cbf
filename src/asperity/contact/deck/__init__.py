"""Input decks for Abaqus and CalculiX, and the friction subroutine Abaqus needs for our laws."""

from asperity.contact.deck.fric import FricSubroutine, fric_subroutine

__all__ = ["FricSubroutine", "fric_subroutine"]

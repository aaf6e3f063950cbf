"""Input decks for Abaqus and CalculiX, and the friction subroutine Abaqus needs for our laws."""

from asperity.block.deck.abaqus import abaqus_files
from asperity.block.deck.calculix import calculix_files
from asperity.block.deck.fric import FricSubroutine, fric_subroutine
from asperity.block.deck.setup import BlockSetup

WRITERS = {"abaqus": abaqus_files, "calculix": calculix_files}
"""Functions from a `BlockSetup` to the text of each file, by program."""

__all__ = [
    "WRITERS",
    "BlockSetup",
    "FricSubroutine",
    "abaqus_files",
    "calculix_files",
    "fric_subroutine",
]

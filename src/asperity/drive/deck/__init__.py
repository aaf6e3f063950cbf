"""Input decks of a loaded sector of teeth for Abaqus and CalculiX."""

from collections.abc import Callable, Mapping

from asperity.drive.deck.abaqus import abaqus_files
from asperity.drive.deck.calculix import calculix_files
from asperity.drive.deck.setup import TeethSetup

WRITERS: Mapping[str, Callable[[TeethSetup], dict[str, str]]] = {
    "abaqus": abaqus_files,
    "calculix": calculix_files,
}
"""Functions from a `TeethSetup` to the text of each file, by program."""

__all__ = ["WRITERS", "TeethSetup", "abaqus_files", "calculix_files"]

"""How people are shown what a command comes to: their units and their language."""

import contextlib
from collections.abc import Iterator
from pathlib import Path
from typing import get_args

from asperity.casefile.project import Project
from asperity.errors import InputError, one_of
from asperity.results.language import Catalogue, catalogue_of, spoken
from asperity.results.unit_systems import System, shown_in


def check_shown(units: str, language: str) -> None:
    """Refuse units and a language that there are not."""
    if units not in ("", *get_args(System)):
        raise InputError(f"--units {units}: {one_of(get_args(System), units)}")
    catalogue_of(language)


def shown_as(
    project: Project, folder: Path, units: str = "", language: str = ""
) -> contextlib.AbstractContextManager[None]:
    """Return what shows, as it is asked for or else as a project has it, what is shown within it.

    A language that there is not is refused at once.

    Parameters
    ----------
    project : Project
        The table ``[project]`` of a case.
    folder : path
        Of the case, beside which a file of sentences stands that it names.
    units : str
        ``si`` or ``us``; empty: the project's.
    language : str
        ``en``, ``de`` or a file of sentences; empty: the project's.
    """
    own = project.language
    words = catalogue_of(language or (str(folder / own) if own.endswith(".toml") else own))
    system: System = "us" if (units or project.units) == "us" else "si"
    return _within(system, words)


@contextlib.contextmanager
def _within(system: System, words: Catalogue | None) -> Iterator[None]:
    with shown_in(system), spoken(words):
        yield

"""What is swept: a kind of problem, how many of them are solved, and what is kept of each."""

import importlib
from collections.abc import Container, Mapping, Sequence
from typing import Any, ClassVar

import numpy as np

from asperity.casefile import Case, Table
from asperity.errors import AsperityError
from asperity.results import Result
from asperity.results.quantity import Entry

_ELSE = "asperity.sweep.bodies:BODY"
# By the first of these tables that a case has; a sliding body where it has none of them. A room
# above this one is named and not imported.
_BY_TABLE = {
    "drive": "asperity.drive.swept:DRIVE",
    "slider": _ELSE,
    "gearset": "asperity.sweep.gearsets:GEARSET",
}


class Subject:
    """A kind of problem that can be swept.

    Attributes
    ----------
    name : str
        By which a worker finds it, see `named`.
    what : str
        One of its kind, as a message has it.
    title, heading : str
        Of a sweep's answer, and of the number that is shown.
    verb : str
        The command that tells everything of one of its kind.
    shown : str
        The variable that is shown.
    column : str
        Its heading in a table.
    beside : mapping of str to str
        What that is never shown without, by its heading in a table.
    tables : mapping of str to type of Table
        Whose keys may be axes.
    variables : tuple of Entry
        What is kept of each point.
    whole : bool
        Whether JSON has all of them, and not only what is shown.
    gaps : bool
        Whether a point that cannot be leaves a gap with its reason; the sweep is refused if not.
    unsolved : str
        What is said of points without an answer.
    flag : str
        The same in a word, for the status in a file.
    """

    name: ClassVar[str]
    what: ClassVar[str]
    title: ClassVar[str]
    heading: ClassVar[str]
    verb: ClassVar[str] = "slide"
    shown: ClassVar[str]
    column: ClassVar[str] = "ratio"
    beside: ClassVar[Mapping[str, str]]
    tables: ClassVar[Mapping[str, type[Table]]]
    variables: ClassVar[tuple[Entry, ...]]
    whole: ClassVar[bool] = False
    gaps: ClassVar[bool] = False
    unsolved: ClassVar[str] = "did not converge"
    flag: ClassVar[str] = "not_converged"

    @property
    def module(self) -> str:
        """Module that its answers follow from."""
        return type(self).__module__

    def prepare(self, case: Case) -> Any:
        """Return the problem of a point; raises InputError where it cannot be solved."""
        raise NotImplementedError

    def kind(self, problem: Any) -> tuple[object, ...]:
        """Return what two problems must share to be solved together."""
        raise NotImplementedError

    def task_size(self, problem: Any) -> int:
        """Return how many like it are solved before they are kept."""
        return 1

    def solve(
        self, problems: Sequence[Any], stop: np.ndarray | None
    ) -> Sequence[Result | AsperityError]:
        """Solve a few; the exception of one that could not be solved stands in its place."""
        raise NotImplementedError

    def scalars(self, answer: Result) -> dict[str, Any]:
        """Return what an answer has of the variables, by name; None where there is none."""
        found = answer.to_json()
        kept = {entry.name: found[entry.key] for entry in self.variables if entry.key in found}
        return {
            name: float(value) if isinstance(value, bool) else value for name, value in kept.items()
        }

    def seconds(self, problem: Any) -> float:
        """Return what a problem may take on one core, s."""
        raise NotImplementedError

    def inputs(self, problem: Any) -> Mapping[str, Any]:
        """Return what was asked: values in SI and texts by ``table.key``."""
        raise NotImplementedError


def named(name: str) -> Subject:
    """Return the subject of a table's name, or that of sliding bodies."""
    module, _, place = _BY_TABLE.get(name, _ELSE).partition(":")
    found: Subject = getattr(importlib.import_module(module), place)
    return found


def subject_of(tables: Container[object]) -> Subject:
    """Return what a case with such tables describes."""
    return named(next((name for name in _BY_TABLE if name in tables), ""))

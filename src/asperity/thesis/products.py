"""What making an exhibit gives: a figure with its numbers, a table, or the finding on a claim."""

import dataclasses
import json
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, Protocol, get_args

from asperity import __version__
from asperity.files.store import write_atomically, write_dataset, write_text
from asperity.results.files import csv_text
from asperity.thesis.said import exhibit_entry

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

Cell = str | float | int
"""A cell of a table; one without a value is an empty text."""

Plain = dict[str, Any]
"""Words and numbers as they stand in JSON."""

Verdict = Literal["reproduced", "differs", "fitted", "arithmetic", "not testable"]
REPRODUCED, DIFFERS, FITTED, ARITHMETIC, NOT_TESTABLE = get_args(Verdict)
VERDICTS: Mapping[str, tuple[str, str]] = {
    REPRODUCED: ("✓", "computed from what the claim does not contain, and it could have failed"),
    DIFFERS: ("≠", "a sentence of the thesis does not hold here; which one is quoted"),
    FITTED: (
        "≈",
        "an input of ours was made from it, or from what fixes it, so that it tests nothing",
    ),
    ARITHMETIC: (
        "=",
        "it follows from printed numbers or equations alone, and could hardly be otherwise",
    ),
    NOT_TESTABLE: (
        "?",
        "what it is about is lost, too little of it is told, or what decides is ours; what we get "
        "stands beside",
    ),
}
"""Each kind of verdict: its mark, and what it means."""

_DOTS_PER_INCH = 150


class Commanded(Protocol):
    """Something that knows its command line."""

    def command(self) -> str:
        """As a user gives it."""


How = str | Commanded
"""How a number is come by: a command, or a function of this package."""


def _lines(how: Iterable[How]) -> list[str]:
    return [one if isinstance(one, str) else one.command() for one in how]


@dataclasses.dataclass(frozen=True)
class Drawn:
    """A figure, the numbers in it, and the commands and functions that give them."""

    figure: "Figure"
    dataset: "xr.Dataset"
    how: Sequence[str]

    @classmethod
    def by(
        cls, draw: "Callable[[xr.Dataset], Figure]", dataset: "xr.Dataset", how: Iterable[How]
    ) -> "Drawn":
        """Draw a dataset."""
        return cls(draw(dataset), dataset, _lines(how))

    def write(self, stem: Path, words: Mapping[str, Any]) -> tuple[Plain, list[Path]]:
        """Write picture and numbers; returns what is shown beside them, and the files."""
        picture, numbers = (stem.with_name(f"{stem.name}{suffix}") for suffix in (".png", ".nc"))
        labels = {"Software": f"asperity {__version__}", "Title": words["title"]}
        write_atomically(
            picture,
            lambda path: self.figure.savefig(path, dpi=_DOTS_PER_INCH, metadata=labels),
        )
        how = json.dumps(list(self.how))
        write_dataset(self.dataset.assign_attrs(**words, asperity=__version__, how=how), numbers)
        return {"how": list(self.how)}, [picture, numbers]


@dataclasses.dataclass(frozen=True)
class Grid:
    """A table's columns and rows, and the commands and functions that give its numbers."""

    columns: tuple[str, ...]
    rows: tuple[tuple[Cell, ...], ...]
    how: tuple[str, ...]

    def __post_init__(self) -> None:
        for row in self.rows:
            if len(row) != len(self.columns):
                raise ValueError(f"{row[0]!r} has {len(row)} cells for {len(self.columns)} columns")

    @classmethod
    def of(
        cls, things: Iterable[Any], columns: Mapping[str, Callable[[Any], Any]], *how: How
    ) -> "Grid":
        """Return a row for each of some things, by columns that say what they hold of one.

        None in a column is an empty cell.
        """
        rows = tuple(
            tuple("" if cell is None else cell for cell in (of(one) for of in columns.values()))
            for one in things
        )
        return cls(tuple(columns), rows, tuple(_lines(how)))

    @classmethod
    def listed(cls, number: str, *how: How) -> "Grid":
        """Return a table of words alone, as it is listed by its number."""
        found = exhibit_entry(f"table {number}")
        rows = tuple(map(tuple, found["rows"]))
        return cls(tuple(found["columns"]), rows, tuple(_lines(how)))

    def to_csv(self) -> str:
        """As text, numbers to the last digit."""
        return csv_text((self.columns, *self.rows))

    def write(self, stem: Path, words: Mapping[str, Any]) -> tuple[Plain, list[Path]]:
        """Write the table as CSV and JSON; returns what is shown, and the files."""
        table, beside = (stem.with_name(f"{stem.name}{suffix}") for suffix in (".csv", ".json"))
        write_text(table, self.to_csv())
        plain = dataclasses.asdict(self)
        labels = {**words, "asperity": __version__, **plain}
        write_text(beside, json.dumps(labels, indent=1, allow_nan=False))
        return plain, [table, beside]


@dataclasses.dataclass(frozen=True)
class Finding:
    """What the computation of a claim gave, and the commands and functions that give it."""

    ours: str  # the numbers in a phrase
    verdict: Verdict
    held: tuple[str, ...]  # parts of the claim
    failed: tuple[str, ...]  # parts that do not hold, in the thesis's words
    reason: str  # why it differs, or how closely it agrees
    assumed: str  # of ours, that decides
    numbers: Mapping[str, float]  # each named with its unit
    how: Sequence[str]

    @classmethod
    def judged(
        cls,
        parts: Mapping[str, bool],
        ours: str,
        reason: str,
        numbers: Mapping[str, float],
        how: Iterable[How],
        *,
        verdict: Verdict = REPRODUCED,
        assumed: str = "",
    ) -> "Finding":
        """Judge by the parts of a claim: one that fails makes it differ.

        Parameters
        ----------
        parts : mapping of str to bool
            Parts of the claim, and whether each holds; one that may fail is said in the words of
            the thesis, in quotation marks.
        ours : str
            The numbers in a phrase.
        reason : str
            Why it differs, or how closely it agrees; begins with the two sentences that matter.
        numbers : mapping of str to float
            Named in words or symbols, which underscores join.
        how : iterable
            Commands and functions that give the numbers.
        verdict : str
            What it is where no part fails. What is not testable stays so.
        assumed : str
            What of ours decides: inertia, damping, bounds, yardstick.
        """
        failed = tuple(part for part, holds in parts.items() if not holds)
        held = tuple(part for part, holds in parts.items() if holds)
        differs = failed and verdict != NOT_TESTABLE
        named = {re.sub(r"[ ,-]+", "_", name): value for name, value in numbers.items()}
        found: Verdict = DIFFERS if differs else verdict
        return cls(ours, found, held, failed, reason, assumed, named, _lines(how))

    def write(self, stem: Path, words: Mapping[str, Any]) -> tuple[Plain, list[Path]]:
        """Return what is shown; the ledger is written of all claims together."""
        return dataclasses.asdict(self), []

"""What making an exhibit gives: a figure with its numbers, a table, or the finding on a claim."""

import csv
import dataclasses
import io
import json
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, Protocol

from asperity import __version__
from asperity.store import write_atomically, write_dataset, write_text

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

Cell = str | float | int
"""A cell of a table; one without a value is an empty text."""

Plain = dict[str, Any]
"""Words and numbers as they stand in JSON."""

Verdict = Literal["reproduced", "fitted", "differs"]

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

    def write(self, stem: Path, words: Mapping[str, str]) -> tuple[Plain, list[Path]]:
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

    def to_csv(self) -> str:
        """As text, numbers to the last digit."""
        text = io.StringIO()
        csv.writer(text, lineterminator="\n").writerows((self.columns, *self.rows))
        return text.getvalue()

    def write(self, stem: Path, words: Mapping[str, str]) -> tuple[Plain, list[Path]]:
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
    verdict: Verdict  # whether every part of the claim holds, and of itself
    reason: str  # why it differs, or how closely it agrees
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
        fitted: bool = False,
    ) -> "Finding":
        """Judge by the parts of a claim; if one fails, the reason begins with what holds or not.

        What holds because a model was fitted to it is "fitted".

        Numbers are named in words or symbols, which underscores join.
        """
        failed = [part for part, holds in parts.items() if not holds]
        held = [part for part, holds in parts.items() if holds]
        if failed:
            reason = f"Does not hold: {'; '.join(failed)}. {reason}"
        if failed and held:
            reason = f"Holds: {'; '.join(held)}. {reason}"
        holds: Verdict = "fitted" if fitted else "reproduced"
        verdict: Verdict = "differs" if failed else holds
        named = {re.sub(r"[ ,-]+", "_", name): value for name, value in numbers.items()}
        return cls(ours, verdict, reason, named, _lines(how))

    def write(self, stem: Path, words: Mapping[str, str]) -> tuple[Plain, list[Path]]:
        """Return what is shown; the ledger is written of all claims together."""
        return dataclasses.asdict(self), []


def labelled(**variables: tuple[Sequence[str], Any, str, str]) -> "xr.Dataset":
    """Variables given as (dimensions, values, units, long name); a dimension's own is a coord."""
    import xarray as xr

    named = {
        name: (dims, values, {"units": units, "long_name": long_name})
        for name, (dims, values, units, long_name) in variables.items()
    }
    dimensions = {dim for dims, *_ in variables.values() for dim in dims}
    return xr.Dataset(named).set_coords(sorted(dimensions & set(named)))

"""The command ``asperity rig look``: what is understood of a file, before anything is written."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from asperity.arrays import FloatArray
from asperity.casefile import Case
from asperity.errors import plain
from asperity.results import Result, quantity
from asperity.results.table import Table, table_of
from asperity.runs import Run
from asperity.tribometer.importing.columns import Columns, placed
from asperity.tribometer.importing.files import read_joined, told_of

_FIRST = 3  # values shown


class Looked(Result):
    """What a file holds, as it is understood.

    Attributes
    ----------
    headings, units : tuple of str
        A column each, without the time.
    """

    title = "A file, looked at"
    stem = "look"

    headings: tuple[str, ...]
    units: tuple[str, ...]
    source: str = quantity("", "", "file")
    program: str = quantity("", "", "written by, or kind")
    samples: int = quantity("", "", "samples of each channel")
    sample_interval: float = quantity("dt", "s", "time between samples")
    start: float = quantity("t_0", "s", "time of the first sample")
    duration: float = quantity("t", "s", "duration")
    gaps: int = quantity("", "", "rows missing by the times")
    least: FloatArray = quantity("", "", "least of each column", dims=("column",))
    largest: FloatArray = quantity("", "", "largest of each column", dims=("column",))
    mean: FloatArray = quantity("", "", "mean of each column", dims=("column",))
    missing: FloatArray = quantity("", "", "values missing in each column", dims=("column",))
    first: FloatArray = quantity("", "", "first values", dims=("column", "row"))

    def to_json(self) -> dict[str, Any]:
        """Return what was understood, with the columns' names and units."""
        return super().to_json() | {"columns": list(self.headings), "units": list(self.units)}

    def tables(self) -> tuple[Table, ...]:
        """Return the file in a few lines, and a row a column."""
        rows = [
            (
                heading, unit or "(V)", *(f"{one:.4g}" for one in self.first[place]),
                f"{self.least[place]:.4g}", f"{self.mean[place]:.4g}", f"{self.largest[place]:.4g}",
                f"{self.missing[place]:.0f}",
            )
            for place, (heading, unit) in enumerate(zip(self.headings, self.units, strict=True))
        ]  # fmt: skip
        firsts = [f"row {n + 1}" for n in range(self.first.shape[1])]
        heads = ("column", "unit", *firsts, "least", "mean", "largest", "missing")
        listed = Table.of(heads, rows, left=2)
        return table_of(self), Table(listed.columns, listed.rows, remarks=self.notes)


def read(
    case: str, known: Mapping[str, Any], settings: Sequence[str], *, files: Sequence[str], **_: Any
) -> Case:
    """Return a case of nothing: a file is looked at without one."""
    return Case(plain(files[0]), Path(), {}, {}, known)


def prepare(
    case: Case, *, files: Sequence[str], rate: str = "", columns: str = "", units: str = ""
) -> tuple[str, Columns]:
    """Read the files; refuses what cannot be read, with the reason and what to export instead."""
    name = " and ".join(plain(Path(one).name) for one in files)
    return name, read_joined(files, told_of(rate, columns, units))


# Bytes that were changed may be numbers that signal when they are touched.
@np.errstate(all="ignore")
def answer(problem: tuple[str, Columns], run: Run) -> Looked:
    """Tell what was understood."""
    name, columns = problem
    rows = max(len(one) for one in columns.values)
    interval, _, length = placed(columns, rows, name)
    finite = [np.asarray(one, dtype=float)[np.isfinite(one)] for one in columns.values]
    shown = [one if one.size else np.zeros(1) for one in finite]
    first = np.zeros((len(columns.values), min(_FIRST, rows)))
    for place, one in enumerate(columns.values):
        values = np.nan_to_num(np.asarray(one[:_FIRST], dtype=float))
        first[place, : len(values)] = values
    return Looked(
        headings=columns.headings, units=columns.units, source=name, program=columns.program,
        samples=rows, sample_interval=interval, start=columns.start, duration=length * interval,
        gaps=length - rows, least=np.array([one.min() for one in shown]),
        largest=np.array([one.max() for one in shown]),
        mean=np.array([float(one.mean()) for one in shown]),
        missing=np.array([float(rows - one.size) for one in finite]),
        first=first, notes=columns.notes,
    )  # fmt: skip

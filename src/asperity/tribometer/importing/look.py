"""The command ``asperity rig look``: what is understood of a file, before anything is written."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, ClassVar

import numpy as np

from asperity.arrays import FloatArray
from asperity.casefile import Case
from asperity.errors import plain
from asperity.results import Result, quantity
from asperity.results.table import Table, table_of
from asperity.runs import Run
from asperity.tribometer.importing.columns import Columns, placed
from asperity.tribometer.importing.files import declaration_of, read_joined

_FIRST = 3  # values shown
_PARTS = 600  # of a picture's width


class FileContents(Result):
    """What a file holds, as it is understood.

    Attributes
    ----------
    headings, units : tuple of str
        A column each, without the time.
    """

    title = "A file, looked at"
    stem = "look"

    drawings: ClassVar[Mapping[str, str]] = {"look": "asperity.tribometer.plots:plot_columns"}

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
    time: FloatArray = quantity("t", "s", "begin of each part of the picture", dims=("part",))
    low: FloatArray = quantity("", "", "least of each part", dims=("column", "part"))
    high: FloatArray = quantity("", "", "largest of each part", dims=("column", "part"))
    name: Any = quantity("", "", "heading and unit", dims=("column",))

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
        return table_of(self), Table.of(heads, rows, left=2, remarks=self.notes)


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
    return name, read_joined(files, declaration_of(rate, columns, units))


# Bytes that were changed may be numbers that signal when they are touched.
@np.errstate(all="ignore")
def answer(problem: tuple[str, Columns], run: Run) -> FileContents:
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
    low, high, edges = _courses(columns, rows)
    return FileContents(
        headings=columns.headings, units=columns.units, source=name, program=columns.program,
        samples=rows, sample_interval=interval, start=columns.start, duration=length * interval,
        gaps=length - rows, least=np.array([one.min() for one in shown]),
        largest=np.array([one.max() for one in shown]),
        mean=np.array([float(one.mean()) for one in shown]),
        missing=np.array([float(rows - one.size) for one in finite]),
        first=first, time=columns.start + interval * edges, low=low, high=high,
        name=np.array(
            [f"{a} ({b or 'V'})" for a, b in zip(columns.headings, columns.units, strict=True)]
        ),
        notes=columns.notes,
    )  # fmt: skip


def _courses(columns: Columns, rows: int) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return least and largest of each column in parts of equal length, and where parts begin."""
    edges = np.unique(np.linspace(0, rows, min(_PARTS, rows) + 1).astype(int)[:-1])
    low, high = (np.zeros((len(columns.values), edges.size)) for _ in range(2))
    for place, one in enumerate(columns.values):
        values = np.full(rows, np.nan)
        values[: len(one)] = one
        values[~np.isfinite(values)] = np.nan
        known = np.isfinite(values)
        middle = values[known].mean() if known.any() else 0.0
        values[~known] = middle
        low[place] = np.minimum.reduceat(values, edges)
        high[place] = np.maximum.reduceat(values, edges)
    return low, high, edges.astype(float)

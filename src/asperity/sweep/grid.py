"""The points of a grid: their validated models, and the keys their results are kept under."""

import dataclasses
import functools
import math
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from asperity.casefile import Case, Table
from asperity.errors import AsperityError, InputError
from asperity.runs.key import code_key, key
from asperity.sweep.axis import Axis, spanned
from asperity.sweep.subject import subject_of

# Enough for the inner axis of a large grid; more would let memory grow with the grid.
_KEPT_TABLES = 4096

_SOLVER = "asperity.sweep.tasks"


@dataclasses.dataclass(frozen=True)
class Point:
    """One point of a grid, ready to be solved."""

    index: int
    model: Any  # the problem, of the kind that is swept; why there is none, where that is a gap
    key: str  # its result is kept under: of the tables and of the sources it follows from
    kind: tuple[object, ...]  # what two points must share to be marched in one batch


class Grid:
    """The case at every combination of the axes' values, the last axis running fastest.

    Models are made when asked for and not kept, so that a grid costs no memory.
    """

    def __init__(self, case: Case, axes: Sequence[Axis]) -> None:
        if not axes:
            raise InputError(
                "the sweep has no axis; give one, as in --over friction.mu=0.1,0.2, or --points"
            )
        self.case = case
        self.subject = subject_of(case)
        self.axes = tuple(axes)
        self.shape, self._runs = spanned(axes)
        self.size = math.prod(self.shape)
        self._table = functools.lru_cache(maxsize=_KEPT_TABLES)(self._make_table)
        self._members = {
            name: tuple(place for place, axis in enumerate(axes) if axis.table == name)
            for name in dict.fromkeys(axis.table for axis in axes)
        }
        self._fixed = {
            name: self._canonical(name, table)
            for name, table in case.tables.items()
            if name in self.subject.tables and name not in self._members
        }

    def describe(self, index: int) -> str:
        """Return the point in words: ``vibration.direction=45 deg, friction.law=split``."""
        places = np.unravel_index(index, self.shape)
        at = [int(places[run]) for run in self._runs]
        return ", ".join(axis.text(place) for axis, place in zip(self.axes, at, strict=True))

    def points(self, indices: Sequence[int]) -> Iterator[Point]:
        """Yield points by index.

        Raises
        ------
        InputError
            A point cannot be, and is no gap: one line that names it.
        """
        places = np.stack(np.unravel_index(np.asarray(indices), self.shape), axis=1)
        places = places[:, self._runs]
        for index, row in zip(indices, places.tolist(), strict=True):
            try:
                yield self._point(index, row)
            except AsperityError as error:
                # A word that is not known is a slip; numbers within their bounds may not agree.
                if not (self.subject.gaps and all(axis.numeric for axis in self.axes)):
                    why = str(error).removeprefix(f"{self.case.source}: ")
                    raise InputError(f"{self.describe(index)}: {why}") from None
                name = key(self.subject.name, self.describe(index), str(error))
                yield Point(index, error, name, ())

    def _point(self, index: int, places: list[int]) -> Point:
        tables = dict(self.case.tables)
        texts = dict(self._fixed)
        for name, members in self._members.items():
            tables[name], texts[name] = self._table(name, tuple(places[m] for m in members))
        model = self.subject.prepare(dataclasses.replace(self.case, tables=tables))
        solver = code_key(_SOLVER, self.subject.module)
        name = key(solver, *(texts[name] for name in sorted(texts)))
        return Point(index, model, name, self.subject.kind(model))

    def _make_table(self, name: str, places: tuple[int, ...]) -> tuple[Table, str]:
        axes = (self.axes[member] for member in self._members[name])
        values = {axis.path: axis.values[at] for axis, at in zip(axes, places, strict=True)}
        table = self.case.replace_values(values).tables[name]
        return table, self._canonical(name, table)

    def _canonical(self, name: str, table: Table) -> str:
        return dataclasses.replace(self.case, tables={name: table}).canonical()

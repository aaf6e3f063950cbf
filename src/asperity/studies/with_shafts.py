"""An optimum whose shafts and bearings hold: what they come to as constraints of the search.

What shafts bear takes too long to find for a search that asks about thousands of designs. So the
best design is sought without them, and where it fails them it is sought again from a few starts,
with each of their rows as a constraint beside all others.
"""

import dataclasses
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from asperity.arrays import FloatArray
from asperity.errors import InputError
from asperity.gearset.parameters import Gearset
from asperity.rating.rated import Rated
from asperity.rating.verdict_rows import Row
from asperity.studies.constraints import Limit

Optimum = Any
"""A `asperity.studies.optimise.Optimum`, whose module imports this one."""

RowsOf = Callable[[Gearset], tuple[Row, ...]]

_LEAST = -10.0
_ABOVE = 1e-9
_ACTIVE = 1e-6
_ROOM = 1e-7
_NEAR = 0.02
_STEP = 1e-4
_TRIED = 40


class Borne(NamedTuple):
    """What shafts and bearings must have of what is asked of them.

    Attributes
    ----------
    rows_of : callable
        What they come to with a gearset.
    least : tuple of float
        Least margin of each row.
    """

    rows_of: RowsOf
    least: tuple[float, ...]

    def room(self, gearset_at: Callable[[FloatArray], Gearset], points: FloatArray) -> FloatArray:
        """Return how much each row has beyond its least, as a share; NaN without an answer.

        Parameters
        ----------
        gearset_at : callable
            The gearset at a point.
        points : ndarray, shape (designs, variables)

        Returns
        -------
        ndarray, shape (designs, rows)
            ``1 - least / margin``: not below zero where it holds.
        """
        found = np.full((len(points), len(self.least)), np.nan)
        for place, point in enumerate(points):
            try:
                rows = self.rows_of(gearset_at(point))
            except InputError:
                continue
            if len(rows) == len(self.least):
                margins = np.array([row.margin for row in rows])
                with np.errstate(divide="ignore"):
                    room = 1.0 - (1.0 + _ABOVE) * np.array(self.least) / margins
                found[place] = np.maximum(room, _LEAST)
        return found

    def first_of(
        self,
        gearset_at: Callable[[FloatArray], Gearset],
        point: FloatArray,
        others: FloatArray,
    ) -> int | None:
        """Return the place of the first of other points near one that holds; None: none does.

        Those that fail by the slopes at the point are passed over.
        """
        if not len(others):
            return None
        steps = np.where(point + _STEP <= 1.0, _STEP, -_STEP)
        around = self.room(gearset_at, np.vstack([point, point + np.diag(steps)]))
        slopes = (around[1:] - around[0]) / steps[:, None]
        guessed = around[0] + (np.asarray(others) - point) @ slopes
        likely = np.flatnonzero(np.all(guessed >= -_NEAR, axis=1))[:_TRIED]
        for place in likely:
            if np.all(self.room(gearset_at, others[place][None]) >= 0.0):
                return int(place)
        return None


def with_shafts(
    best: Optimum,
    rows_of: RowsOf,
    again: Callable[[Borne], Optimum],
    safety: float = 1.0,
) -> Optimum:
    """Return an optimum with what its shafts come to, and one whose shafts hold where it can be.

    A row that holds goes on to hold; where one does not as it is, a design is sought in which all
    hold, and where there is none one in which it falls no further.

    Parameters
    ----------
    best : Optimum
        As it was found without them.
    rows_of : callable
        What shafts and bearings come to with a gearset.
    again : callable
        Searches with shafts and bearings among the constraints; raises InputError where no design
        keeps them.
    safety : float
        Times what each row of shafts and bearings asks. Above 1 every row must have that, also
        where it has not as it is.

    Raises
    ------
    InputError
        Nothing within the bounds has the safety that is required.
    """
    found = _judged(best, rows_of)
    if _holds(found, safety):
        return _with_notes(found)
    margins = [row.margin for row in found.before.rows]
    asked = [(safety,) * len(margins)]
    if safety <= 1.0 and min(margins) < 1.0:
        asked.append(tuple(min(margin * (1.0 - _ROOM), 1.0) for margin in margins))
    for least in asked:
        try:
            kept = _judged(again(Borne(rows_of, least)), rows_of)
        except InputError:
            # No design has so much.
            continue
        return _with_notes(_under_shafts(kept, found, safety))
    if safety <= 1.0:
        return _with_notes(found)
    designs = [found.after, *([found.made] if found.made else [])]
    row = min((row for one in designs for row in one.rows), key=lambda row: row.margin)
    raise InputError(
        f"no design within the bounds gives shafts and bearings {safety:g} times what is "
        f"asked, requirements.safety; {row.name} by {row.standard} of the best design: {row.stands}"
    )


def _under_shafts(borne: Optimum, bare: Optimum, safety: float) -> Optimum:
    """Return an optimum under its shafts, with them among its limits and what they cost."""
    limits = [
        Limit(
            f"{row.name} ({row.standard})", row.name, ">=", safety * row.asked, row.value,
            abs(row.margin / min(safety, before.margin) - 1.0) < _ACTIVE
            or abs(row.margin / safety - 1.0) < _ACTIVE,
        )
        for row, before in zip(borne.after.rows, borne.before.rows, strict=True)
    ]  # fmt: skip
    note = (
        "shafts and bearings are kept; without them the efficiency of the teeth were "
        f"{100.0 * bare.after.iso14521['eta_z1_2']:.1f} %"
    )
    return dataclasses.replace(borne, limits=(*borne.limits, *limits), notes=(*borne.notes, note))


def _judged(best: Optimum, rows_of: RowsOf) -> Optimum:
    def judged(rated: Rated) -> Rated:
        return dataclasses.replace(rated, rows=(*rated.rows, *rows_of(rated.gearset)))

    made = None if best.made is None else judged(best.made)
    return dataclasses.replace(
        best, before=judged(best.before), after=judged(best.after), made=made
    )


def _holds(best: Optimum, safety: float) -> bool:
    designs = [best.after, *([best.made] if best.made else [])]
    return all(row.margin >= safety for rated in designs for row in rated.rows)


def _with_notes(best: Optimum) -> Optimum:
    """Return an optimum with a note for each part that does not hold."""
    notes = [
        f"{row.name} by {row.standard} does not hold: {row.stands}; no design within the bounds "
        "was found in which shafts and bearings hold"
        for row in (best.made or best.after).rows
        if not row.holds
    ]
    return dataclasses.replace(best, notes=(*best.notes, *notes))

"""An optimum whose shafts and bearings hold as they did: a thicker worm where the best is too thin.

What shafts bear takes too long to find for a search that asks about thousands of designs. A worm
gets more efficient as it gets thinner, and that is what its shaft bears least: where the best
design fails it, the least diameter factor is halved down to what holds, each time with a search of
its own for all that is free besides.
"""

import dataclasses
from collections.abc import Callable
from typing import Any

from asperity.errors import InputError
from asperity.gearset.parameters import Gearset
from asperity.rating.rate import Rated
from asperity.rating.verdict_rows import Row
from asperity.studies.design import ASSUMED, Bounds

Optimum = Any
"""A `asperity.studies.optimise.Optimum`, whose module imports this one."""

RowsOf = Callable[[Gearset], tuple[Row, ...]]

_HALVED = 5
"""Times: the diameter factor that holds is met to a thirty-second of its way."""


def with_shafts(
    best: Optimum,
    rows_of: RowsOf,
    bounds: Bounds | None,
    again: Callable[[Bounds], Optimum],
    safety: float = 1.0,
) -> Optimum:
    """Return an optimum with what its shafts come to, and one whose shafts hold where it can be.

    What is required of them is kept or refused: a worm may get thicker than that of the gearset.

    Parameters
    ----------
    best : Optimum
        As it was found without them.
    rows_of : callable
        What shafts and bearings come to with a gearset.
    bounds : Bounds or None
        That were searched; None: those that are assumed.
    again : callable
        Searches within other bounds.
    safety : float
        Times what each row of shafts and bearings asks. Above 1 every row must have that, also
        where it has not as it is.

    Raises
    ------
    InputError
        Nothing within the bounds has the safety that is required.
    """
    found = _judged(best, rows_of)
    thin, thick = (one.geometry.diameter_factor for one in (best.after, best.before))
    free = bounds is None or bounds.diameter_factor[0] < bounds.diameter_factor[1]
    span, kept = bounds or Bounds(), None
    held = all(row.margin >= safety for row in found.before.rows)
    if safety > 1.0 and not held:
        thick, held = max(thick, span.diameter_factor[1]), True
    if _holds(found, safety):
        return _told(found)
    if not held or not free or thin >= thick:
        return _told_of(found, safety)
    for _ in range(_HALVED):
        middle = 0.5 * (thin + thick)
        within = middle, max(middle, span.diameter_factor[1])
        try:
            other = _judged(again(dataclasses.replace(span, diameter_factor=within)), rows_of)
        except InputError:
            # Nothing so thick keeps all that is asked.
            break
        if _holds(other, safety):
            kept, thick = other, middle
        else:
            thin = middle
    if kept is None:
        return _told_of(found, safety)
    note = (
        f"q_1 is held at {thick:.4g} and above, where shafts and bearings hold; without that the "
        f"efficiency of the teeth were {100.0 * found.after.iso14521['eta_z1_2']:.1f} %"
    )
    # The other bounds are still those that were assumed.
    before = [] if bounds is not None else [f"the bounds are assumed: {ASSUMED.note}"]
    return dataclasses.replace(kept, notes=(*before, *kept.notes, note))


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


def _told_of(best: Optimum, safety: float) -> Optimum:
    """Return an optimum that does not hold, with notes; refuse it where a safety is required."""
    if safety <= 1.0:
        return _told(best)
    designs = [best.after, *([best.made] if best.made else [])]
    row = min((row for one in designs for row in one.rows), key=lambda row: row.margin)
    raise InputError(
        f"no thicker worm within the bounds gives shafts and bearings {safety:g} times what is "
        f"asked, requirements.safety; {row.name} by {row.standard} of the best design: {row.stands}"
    )


def _told(best: Optimum) -> Optimum:
    """Return an optimum with a note for each part that does not hold."""
    notes = [
        f"{row.name} by {row.standard} does not hold: {row.stands}, which the search does not keep"
        for row in (best.made or best.after).rows
        if not row.holds
    ]
    return dataclasses.replace(best, notes=(*best.notes, *notes))

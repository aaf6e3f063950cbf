"""Which of many designs are shown: those that no other beats, once others have judged them too.

Some judge one design at a time and take long: whether shafts and bearings bear it, whether a hob
cuts its wheel. They can only take from a design, never give, so that it is enough to ask them about
those that nothing beats before; what they take makes room for others, which are asked in turn.
"""

from collections.abc import Callable, Mapping, Sequence
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from asperity.arrays import FloatArray
from asperity.errors import InputError
from asperity.rating.verdict_rows import Row

Keys = Mapping[str, Any]
"""What a ``[gearset]`` table has of a design."""


class Borne(NamedTuple):
    """What shafts and bearings of a design come to.

    Attributes
    ----------
    rows : tuple of Row
        By what is judged.
    bearings : dict of str to str
        Names of those that are chosen, by where they stand in the case.
    lacking : tuple of str
        What is to be said of what is not judged.
    """

    rows: tuple[Row, ...] = ()
    bearings: Mapping[str, str] = MappingProxyType({})
    lacking: tuple[str, ...] = ()


class Judges(NamedTuple):
    """Who judges one design at a time.

    Attributes
    ----------
    keys : callable
        What a design, by its number, has in its table.
    cut : callable, optional
        Whether a hob cuts its wheel.
    borne : callable, optional
        What its shafts and bearings come to; raises InputError where they cannot be judged.
    """

    keys: Callable[[int], Keys]
    cut: Callable[[Keys], bool] | None = None
    borne: Callable[[Keys], Borne] | None = None


class Chosen(NamedTuple):
    """What is shown.

    Attributes
    ----------
    shown : ndarray of int
        Their numbers.
    borne : dict of int to Borne
        What shafts and bearings come to, of all that were asked about.
    uncut : int
        How many would be shown but for their wheel, which no hob cuts.
    weak : tuple of Row
        Of each that would be shown but for its shafts or bearings, the row that is farthest off.
    refused : dict of int to str
        Why shafts of others could not be judged.
    """

    shown: npt.NDArray[np.int_]
    borne: dict[int, Borne]
    uncut: int
    weak: tuple[Row, ...]
    refused: dict[int, str]


def choose(
    kept: npt.NDArray[np.int_],
    margins: FloatArray,
    best: Callable[[npt.NDArray[np.int_]], npt.NDArray[np.int_]],
    judges: Judges,
    least: float | None,
    known: Mapping[int, Borne] | None = None,
) -> Chosen:
    """Return the best of what is kept.

    Parameters
    ----------
    kept : ndarray of int
        Numbers of designs.
    margins : ndarray
        Of all designs; changed in place where shafts and bearings leave less.
    best : callable
        Which of numbers are shown, by the margins as they are.
    judges : Judges
        Who else is asked.
    least : float or None
        Margin that a design must have; None where all fall short and the nearest are wanted.
    known : mapping of int to Borne, optional
        What shafts and bearings of some come to, by which their margins are already.

    Returns
    -------
    Chosen
        None are shown where no design is left.
    """
    borne = dict(known or {})
    cut: dict[int, bool] = {}
    weak: list[Row] = []
    refused: dict[int, str] = {}
    while len(kept):
        shown = best(kept)
        lost = set[int]()
        new = [int(n) for n in shown if n not in borne] if judges.borne else []
        for n in new:
            assert judges.borne is not None
            try:
                borne[n] = judges.borne(judges.keys(n))
            except InputError as error:
                refused[n], borne[n] = str(error), Borne()
                lost.add(n)
                continue
            margins[n] = min(margins[n], *(row.margin for row in borne[n].rows), np.inf)
            if least is not None and margins[n] < least:
                weak.append(weakest(borne[n].rows))
                lost.add(n)
        if not new and judges.cut is not None:
            asked = [int(n) for n in shown if n not in cut]
            cut |= {n: judges.cut(judges.keys(n)) for n in asked}
            lost = {n for n in asked if not cut[n]}
        if not new and not lost:
            break
        kept = np.array([n for n in kept if n not in lost], dtype=int)
    shown = best(kept) if len(kept) else kept
    uncut = sum(not good for good in cut.values())
    return Chosen(shown, borne, uncut, tuple(weak), refused)


def weakest(rows: Sequence[Row]) -> Row:
    """Return the row with the least of what is asked."""
    return min(rows, key=lambda row: row.margin)


def undominated(worth: FloatArray) -> npt.NDArray[np.bool_]:
    """Return whether no other row is at least as high in everything and higher in something."""
    above = np.all(worth[:, None] >= worth[None], axis=-1)
    higher = np.any(worth[:, None] > worth[None], axis=-1)
    beaten: npt.NDArray[np.bool_] = np.any(above & higher, axis=0)
    return ~beaten

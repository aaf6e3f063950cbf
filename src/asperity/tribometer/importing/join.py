"""Several files of one recording, a file a channel: joined by their times."""

import dataclasses
import re
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from asperity.arrays import FloatArray
from asperity.errors import InputError
from asperity.tribometer.importing.columns import Columns, even

_SAME_RATE = 1e-6
_MOST_APART = 100.0  # times as long a joint recording as the longest file


def joined(parts: Sequence[tuple[str, Columns]]) -> Columns:
    """Return the columns of several files on the time they have in common.

    What one file lacks that another has is missing there. Headings that stand in several files get
    their file's name in front.

    Parameters
    ----------
    parts : sequence of (str, Columns)
        What messages call a file, and its columns.

    Raises
    ------
    InputError
        The files are of different rates, or lie apart in time.
    """
    if len(parts) == 1:
        return parts[0][1]
    grids = [_grid(name, columns) for name, columns in parts]
    interval = grids[0][0]
    for (name, _), (own, *_) in zip(parts, grids, strict=True):
        if abs(own - interval) > _SAME_RATE * interval * max(len(grids[0][2]), 2):
            raise InputError(
                f"{name} has a sample every {own:.6g} s, {parts[0][0]} every {interval:.6g} s; "
                "files of one recording have one rate"
            )
    start = min(first for _, first, _ in grids)
    shifts = [round((first - start) / interval) for _, first, _ in grids]
    length = max(
        shift + int(places[-1]) + 1 for shift, (*_, places) in zip(shifts, grids, strict=True)
    )
    longest = max(len(places) for *_, places in grids)
    if length > _MOST_APART * longest:
        raise InputError(
            f"{parts[0][0]} and the others lie {length * interval:.4g} s apart in time; they are "
            "no one recording"
        )
    named = [heading for _, columns in parts for heading in columns.headings]
    headings, values, notes = [], [], []
    for (name, columns), shift, (*_, places) in zip(parts, shifts, grids, strict=True):
        for heading, one in zip(columns.headings, columns.values, strict=True):
            twice = named.count(heading) > 1
            headings.append(f"{re.sub(r'[.][^.]*$', '', name)} {heading}" if twice else heading)
            values.append(_spread(one, places + shift, length))
        notes += [one for one in columns.notes if one not in notes]
        if shift:
            notes.append(f"{name} begins {shift * interval:.4g} s after the first file")
    units = [unit for _, columns in parts for unit in columns.units]
    return Columns(
        tuple(headings), tuple(units), tuple(values), interval=interval, start=start,
        notes=tuple(notes), program=parts[0][1].program,
        began=next((one.began for _, one in parts if one.began is not None), None),
    )  # fmt: skip


def _grid(name: str, columns: Columns) -> tuple[float, float, NDArray[np.intp]]:
    """Return interval, first time, and the place of each row."""
    rows = max(len(one) for one in columns.values)
    if columns.times is None:
        return columns.interval, columns.start, np.arange(rows)
    times: FloatArray = columns.times
    if len(times) < 2 or not np.all(np.isfinite(times)) or np.any(np.diff(times) <= 0.0):
        raise InputError(f"{name}: its times do not rise from row to row")
    interval, _ = even(times)
    return interval, float(times[0]), np.rint((times - times[0]) / interval).astype(np.intp)


@np.errstate(all="ignore")  # as numbers that signal when they are touched
def _spread(values: NDArray[np.generic], places: NDArray[np.intp], length: int) -> FloatArray:
    made = np.full(length, np.nan)
    made[places[: len(values)]] = values
    return made


def renamed(columns: Columns, stem: str) -> Columns:
    """Return a file's only channel under the file's name, where its heading says nothing."""
    if len(columns.headings) != 1 or columns.headings[0].casefold() not in _NOTHING:
        return columns
    return dataclasses.replace(columns, headings=(stem,))


_NOTHING = frozenset(("", "ampl", "value", "volt", "voltage", "y", "wert"))

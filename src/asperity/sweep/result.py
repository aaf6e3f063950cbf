"""The answer of a sweep: arrays over the grid, as JSON, dataset, file and picture."""

import itertools
import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np
import numpy.typing as npt

from asperity.arrays import FloatArray
from asperity.errors import ConvergenceError
from asperity.results import Result, quantity
from asperity.results.settled import MARK, marked
from asperity.results.table import Table
from asperity.slider.cycle_map import UNSTABLE
from asperity.sweep.axis import Axis, spanned
from asperity.sweep.subject import Subject, named

if TYPE_CHECKING:
    import xarray as xr

    from asperity.results.report import Picture

SOLVED = 0
NOT_CONVERGED = 1
_MOST_REASONS = 100
MOST_AXES = 2
_MOST_ROWS = 60
_MOST_COLUMNS = 9
_SETTLED, _STEP_ERROR, _FROM_REST = "settled", "step_error", "ratio_from_rest"


class SweepResult(Result):
    """What a sweep found.

    Attributes
    ----------
    source : str
        The case.
    axes : tuple of Axis
        The grid, the last axis running fastest.
    arrays : dict of str to ndarray, shape of the grid
        Every variable over the grid in SI, NaN where there is none.
    status : ndarray of int8, shape of the grid
        0 solved, 1 not.
    failures : dict of str to str
        The first points that did not converge, and why.
    shared : mapping of str to float or str
        What all points share, by ``table.key`` in SI.
    cached : int
        Points that were known from before.
    seconds : float
        Time the sweep took.
    file : pathlib.Path or None
        Where it is written.
    subject : str
        What was swept, by name; sliding bodies if left out.
    """

    title: ClassVar[str] = "Sliding body over a grid"
    stem: ClassVar[str] = "sweep"
    drawings: ClassVar[Mapping[str, str]] = {"sweep": "asperity.sweep.plots:plot_sweep"}

    source: str
    axes: tuple[Axis, ...]
    arrays: dict[str, FloatArray]
    status: npt.NDArray[np.int8]
    failures: dict[str, str]
    shared: Mapping[str, Any]
    cached: int = quantity("", "", "points known from before", shown=False)
    seconds: float = quantity("", "s", "time it took", key="seconds", shown=False)
    file: Path | None = None
    subject: str = ""

    @property
    def _of(self) -> Subject:
        return named(self.subject)

    @property
    def inputs(self) -> Mapping[str, Any]:
        """What all points share, by ``table.key`` in SI."""
        return self.shared

    @property
    def points(self) -> int:
        """Number of points."""
        return self.status.size

    @property
    def failed(self) -> int:
        """Number of points without an answer: not converged, refused, or not rated."""
        return int(np.count_nonzero(self.status != SOLVED))

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the axes: the last part of the path, the whole where that is shared."""
        keys = [axis.key for axis in self.axes]
        return tuple(
            axis.key if keys.count(axis.key) == 1 else f"{axis.table}_{axis.key}"
            for axis in self.axes
        )

    @property
    def dims(self) -> tuple[str, ...]:
        """Names of the dimensions: of their axis, or that which several change along."""
        return tuple(dict.fromkeys(self._along))

    @property
    def _along(self) -> tuple[str, ...]:
        """Name of the dimension that each axis runs along."""
        return tuple(axis.along or name for axis, name in zip(self.axes, self.names, strict=True))

    @property
    def beside(self) -> tuple[str, ...]:
        """What the ratio is never shown without, as far as it is there."""
        return tuple(name for name in self._of.beside if name in self.arrays)

    @property
    def loose(self) -> npt.NDArray[np.bool_]:
        """Which points were solved and have not settled: their numbers are no predictions."""
        if _SETTLED not in self.arrays:
            return np.zeros(self.status.shape, dtype=bool)
        settled = self.arrays[_SETTLED] > 0.0
        found: npt.NDArray[np.bool_] = ~settled & (self.status == SOLVED)
        return found

    @property
    def aperiodic(self) -> int:
        """Number of points that were solved and are in no stable periodic state that is known.

        Marches that were asked for are none.
        """
        if "period" not in self.arrays:
            return 0
        growth = self.arrays["multiplier"]
        unstable = ~(growth <= UNSTABLE)
        if self.shared.get("solve.method") != "periodic":
            unstable &= np.isfinite(growth)
        return int(np.count_nonzero(unstable & (self.status == SOLVED)))

    @property
    def failure(self) -> ConvergenceError | None:
        """What keeps it from being whole: points that did not converge."""
        if not self.failed:
            return None
        point, why = next(iter(self.failures.items()))
        return ConvergenceError(
            f"{self.failed} of {self.points} points {self._of.unsolved}, the first at {point}: "
            f"{why}"
        )

    def to_dataset(self) -> "xr.Dataset":
        """The variables over the grid, each with ``units`` and ``long_name``.

        Coordinates are in the units the axes were written in, everything else in SI.
        """
        import xarray as xr

        variables: dict[str, Any] = {
            variable.name: (
                self.dims,
                self.arrays[variable.name],
                {"units": variable.label.unit or "1", "long_name": variable.label.meaning},
            )
            for variable in self._of.variables
            if variable.name in self.arrays
        }
        flags = {
            "units": "1",
            "long_name": "whether the point was solved",
            "flag_values": np.array([SOLVED, NOT_CONVERGED], dtype=np.int8),
            "flag_meanings": f"solved {self._of.flag}",
        }
        variables["status"] = (self.dims, self.status, flags)
        coordinates: dict[str, Any] = {
            axis.along: (
                axis.along,
                np.arange(1, len(axis.shown) + 1),
                {"units": "1", "long_name": f"number of the {axis.along}"},
            )
            for axis in self.axes
            if axis.along
        }
        coordinates |= {
            name: (
                dim,
                np.array(axis.shown, dtype=float if axis.numeric else object),
                {"units": axis.unit or "1", "long_name": axis.key.replace("_", " ")},
            )
            for name, dim, axis in zip(self.names, self._along, self.axes, strict=True)
        }
        attributes = {
            "title": self._of.title,
            "case": self.source,
            "failures": "; ".join(f"{point}: {why}" for point, why in self.failures.items()),
            "notes": "; ".join(self.notes),
        }
        return xr.Dataset(variables, coordinates, attributes | dict(self.shared))

    def to_json(self) -> dict[str, Any]:
        """The ratio over the grid, None where there is none, and what was done for it."""
        always = [name for name in (_SETTLED, _STEP_ERROR) if name in self.arrays]
        told = self.arrays if self._of.whole else (self._of.shown, *self.beside, *always)
        return {
            "dims": list(dict.fromkeys(axis.along or axis.path for axis in self.axes)),
            "coords": {axis.path: list(axis.shown) for axis in self.axes},
            "units": {axis.path: axis.unit for axis in self.axes},
            **{name: _listed(self.arrays[name]) for name in told},
            "points": self.points,
            "failed": self.failed,
            "cached": self.cached,
            "seconds": self.seconds,
            "file": None if self.file is None else str(self.file),
            "notes": list(self.notes),
        }

    def heading(self) -> str:
        """Return the case and what is shown of it."""
        return self._of.heading

    def tables(self) -> tuple[Table, ...]:
        """Return the ratio over the grid: a matrix where it fits, a list where not."""
        known = f", {self.cached} known from before" if self.cached else ""
        remark = f"{self.points} points{known}, {self.seconds:.3g} s"
        remarks: tuple[str, ...] = (remark,)
        if self.aperiodic:
            remarks += (
                f"{self.aperiodic} points are marches, or states that are unstable: `slide` says "
                "of each what is known",
            )
        loose = self.loose
        if loose.any():
            count = int(np.count_nonzero(loose))
            told = "1 point has" if count == 1 else f"{count} points have"
            remarks += (
                f"{MARK} {told} not settled: no prediction; `{self._of.verb}` says of each what is "
                "missing",
            )
        remarks += self._other_states() + self.notes
        beside = {self._of.beside[name]: self.arrays[name] for name in self.beside}
        columns = {self._of.column: self.arrays[self._of.shown], **beside}
        return (_table(self.axes, columns, remarks, loose),)

    def _other_states(self) -> tuple[str, ...]:
        """Say how many points settle elsewhere from rest, and where that stands."""
        rest = self.arrays.get(_FROM_REST, np.empty(0))
        found = rest[np.isfinite(rest)]
        if not found.size:
            return ()
        points = "1 point settles" if found.size == 1 else f"{found.size} points settle"
        least, most = f"{found.min():.5g}", f"{found.max():.5g}"
        ratios = f"a ratio of {least}" if least == most else f"ratios of {least} to {most}"
        column = self._of.beside[_FROM_REST]
        return (
            f"{points} in another state from rest, at {ratios}: column '{column}', {_FROM_REST} in "
            "the files of --out",
        )

    def write(self, folder: Path, *, pictures: str = "png") -> list[str]:
        """Write JSON, netCDF and, of one or two axes, a picture."""
        return super().write(folder, pictures=pictures if self._drawable else "")

    def pictures(self, folder: Path | None = None) -> "tuple[Picture, ...]":
        """Return its picture, of one or two axes."""
        return super().pictures(folder) if self._drawable else ()

    @property
    def _drawable(self) -> bool:
        return len(self.dims) <= MOST_AXES


class Answers:
    """Room for the scalars of every point, filled as they come."""

    def __init__(self, size: int, subject: str = "") -> None:
        self._size = size
        self._subject = named(subject)
        self._arrays: dict[str, FloatArray] = {}
        self.status = np.zeros(size, dtype=np.int8)
        self.reasons: dict[int, str] = {}

    def put(self, index: int, row: dict[str, float | str | None], failed: str | None) -> None:
        """Fill in one point."""
        if failed is not None:
            self.status[index] = NOT_CONVERGED
            if len(self.reasons) < _MOST_REASONS:
                self.reasons[index] = failed
            return
        for name, value in row.items():
            if name not in self._arrays:
                self._arrays[name] = np.full(self._size, math.nan)
            if isinstance(value, int | float):
                self._arrays[name][index] = value

    @property
    def arrays(self) -> dict[str, FloatArray]:
        """The scalars that any point has, in their order; the ratio at least."""
        found = self._arrays or {self._subject.shown: np.full(self._size, math.nan)}
        variables = self._subject.variables
        return {entry.name: found[entry.name] for entry in variables if entry.name in found}


def _listed(values: FloatArray) -> list[Any]:
    """Return numbers as lists, None where there is none."""
    found = values.astype(object)
    found[np.isnan(values)] = None
    listed: list[Any] = found.tolist()
    return listed


def _table(
    axes: Sequence[Axis],
    variables: Mapping[str, FloatArray],
    remarks: tuple[str, ...],
    loose: npt.NDArray[np.bool_],
) -> Table:
    """Return variables by heading over a grid, of at most some rows; the first ones marked."""
    values = next(iter(variables.values()))
    shape, runs = spanned(axes)
    plain = len(variables) == 1 and len(shape) == len(axes) == 2
    matrix = plain and len(axes[1].shown) <= _MOST_COLUMNS
    if matrix:
        headings = [" \\ ".join(map(_heading, axes)), *map(_text, axes[1].shown)]
        shown = [marked(*row) for row in zip(values.tolist(), loose.tolist(), strict=True)]
        rows = [[place, *row] for place, row in zip(axes[0].shown, shown, strict=True)]
    else:
        headings = [*map(_heading, axes), *variables]
        places = (
            [axis.shown[at[run]] for axis, run in zip(axes, runs, strict=True)]
            for at in np.ndindex(*shape)
        )
        first, *others = (each.ravel().tolist() for each in variables.values())
        columns = zip(marked(first, loose.ravel().tolist()), *others, strict=True)
        pairs = zip(places, columns, strict=True)
        rows = [[*place, *numbers] for place, numbers in itertools.islice(pairs, _MOST_ROWS + 1)]
    more = len(axes[0].shown) if matrix else values.size
    if more > _MOST_ROWS:
        left = f"... and {more - _MOST_ROWS} more rows; the files of --out, and --json, hold all"
        remarks = (left, *remarks)
    return Table.of(headings, rows[:_MOST_ROWS], remarks=remarks)


def _heading(axis: Axis) -> str:
    return f"{axis.key} ({axis.unit})" if axis.unit else axis.key


def _text(value: object) -> str:
    return f"{value:.5g}" if isinstance(value, float) else str(value)

"""The periodic state of a sliding body along one axis, followed there and back."""

import dataclasses
import time
from collections.abc import Mapping, Sequence
from typing import Any, ClassVar

import numpy as np
import numpy.typing as npt

from asperity.arrays import FloatArray
from asperity.casefile import Case
from asperity.errors import ConvergenceError, InputError
from asperity.results import Result, quantity
from asperity.results.settled import MARK, marked, smaller_step
from asperity.results.table import Table
from asperity.runs import Run
from asperity.runs.key import code_key, key
from asperity.runs.tree import Tree
from asperity.slider.continuation import Walk
from asperity.slider.cost import time_of_cycles
from asperity.slider.from_rest import ratio_of
from asperity.slider.march import march_key
from asperity.slider.model import Model
from asperity.slider.orders import power_of
from asperity.slider.periodic import SOFT, cycle_steps
from asperity.slider.result import SlideResult, inputs
from asperity.slider.slide import beside_march
from asperity.slider.step_error import NOTED, WANTED, allowed_of
from asperity.sweep.axes import parse_axes
from asperity.sweep.axis import Axis
from asperity.sweep.bodies import Bodies
from asperity.sweep.grid import Grid

_WAYS = ("there", "back")
_DIMS = ("way", "value")
_OF_BODY = ("ratio", "settled", "step_error", "ratio_from_rest")
# Of mu W: two states nearer to each other than this are one.
_APART = 1e-4
_CYCLES = 40  # of a state, in most cases
_ELSEWHERE = "a march from rest has come neither to a state that is shown nor to another: it has "


class Branches(Result):
    r"""Stable periodic states along an axis, each sought from the one before, there and back.

    Where both ways have the same state there is one, as far as they can tell; where they differ the
    body has two, and which it is in follows from where it comes from.

    Attributes
    ----------
    source : str
        The case.
    axis : Axis
        What changes, in the order of the way there.
    value : ndarray, shape (n,)
        Its values in its unit.
    ratio, ratio_mean_load, penetration_swing, open_share, normal_min, normal_max, period,
    multiplier, settled, step_error
        ndarray, shape (2, n), there and back; NaN where no state was found that repeats itself
        after 1, 2, 4 or 8 cycles. What is normal to the plane is NaN without ``[normal]``.
    ratio_from_rest : ndarray, shape (n,)
        Of a body from rest that comes to another state than that on the way there, or settles at
        another ratio where that is unstable; NaN elsewhere.
    missing : int
        States that were not found.
    """

    title: ClassVar[str] = "Periodic states of a sliding body, there and back"
    stem: ClassVar[str] = "branches"
    drawings: ClassVar[Mapping[str, str]] = {"branches": "asperity.sweep.plots:plot_branches"}
    labels: ClassVar[Mapping[str, tuple[Sequence[str | float], str]]] = {
        "way": (_WAYS, "from the first value to the last, or back")
    }

    source: str
    axis: Axis
    shared: Mapping[str, Any]
    value: FloatArray = quantity("", "", "value of the axis", dims=("value",), coordinate=True)
    ratio: FloatArray = quantity("F/mu W", "", "mean drive force over mu W", dims=_DIMS)
    ratio_mean_load: FloatArray = quantity(
        "F/mu N", "", "mean drive force over mu times mean load", dims=_DIMS
    )
    penetration_swing: FloatArray = quantity("d^", "m", "swing of the penetration", dims=_DIMS)
    open_share: FloatArray = quantity("", "", "share of the time without contact", dims=_DIMS)
    normal_min: FloatArray = quantity("N_min", "N", "least normal force", dims=_DIMS)
    normal_max: FloatArray = quantity("N_max", "N", "greatest normal force", dims=_DIMS)
    period: FloatArray = quantity("", "", "cycles until the state repeats itself", dims=_DIMS)
    multiplier: FloatArray = quantity("", "", "growth of a disturbance over it", dims=_DIMS)
    settled: FloatArray = quantity("", "", "1 where the state stays, 0 where not", dims=_DIMS)
    step_error: FloatArray = quantity("", "", "error of the ratio from the step", dims=_DIMS)
    ratio_from_rest: FloatArray = quantity(
        "F/mu W", "", "ratio from rest, where it is another", dims=("value",)
    )
    missing: int = quantity("", "", "states not found")
    seconds: float = quantity(
        "", "s", "time it took", key="seconds", only="json", shown=False, default=0.0
    )

    @property
    def inputs(self) -> Mapping[str, Any]:
        """What all states share, by ``table.key`` in SI, and the axis."""
        return {**self.shared, "axis": self.axis.path, "axis_unit": self.axis.unit}

    @property
    def two(self) -> FloatArray:
        """Values at which the ways differ in states that both stay, in the axis's unit."""
        there, back = self.ratio
        found: FloatArray = self.value[self._both & (np.abs(there - back) > _APART)]
        return found

    @property
    def beside(self) -> FloatArray:
        """Values at which a body from rest comes to a third state, in the axis's unit."""
        known = np.abs(self.ratio - self.ratio_from_rest) <= _APART
        found: FloatArray = self.value[np.isfinite(self.ratio_from_rest) & ~known.any(axis=0)]
        return found

    @property
    def _both(self) -> npt.NDArray[np.bool_]:
        """Whether a state that stays was found both ways, at each value."""
        stays: npt.NDArray[np.bool_] = (np.isfinite(self.ratio) & (self.settled != 0.0)).all(axis=0)
        return stays

    @property
    def failure(self) -> ConvergenceError | None:
        """What keeps it from being whole: states that were not found."""
        if not self.missing:
            return None
        return ConvergenceError(
            f"{self.missing} of {self.ratio.size} states were not found: nothing stable repeats "
            "itself there after 1, 2, 4 or 8 cycles; solve.method 'march' shows what the body does"
        )

    def to_json(self) -> dict[str, Any]:
        """What was found along the axis, None where nothing was."""
        arrays: dict[str, list[Any]] = {
            entry.key: [[None if np.isnan(v) else v for v in way] for way in entry.value.tolist()]
            for entry in self.entries()
            if entry.label.dims == _DIMS and not np.isnan(entry.value).all()
        }
        ends = {"dims": ["way", self.axis.path], "unit": self.axis.unit, "ways": list(_WAYS)}
        if self.beside.size:
            rest = self.ratio_from_rest.tolist()
            arrays["ratio_from_rest"] = [None if np.isnan(each) else each for each in rest]
        return {**ends, "values": self.value.tolist(), **arrays, **super().to_json()}

    def heading(self) -> str:
        """Return where there are two states that stay, and where a body from rest has another."""
        if not self.beside.size:
            return self._of_the_ways()
        return f"{self._of_the_ways()}; from rest another {self._between(self.beside)}"

    def _between(self, values: FloatArray) -> str:
        low, high = self.axis_text(values.min()), self.axis_text(values.max())
        return f"at {low}" if low == high else f"between {low} and {high}"

    def _of_the_ways(self) -> str:
        found, both = np.isfinite(self.ratio), self._both
        if not found.any():
            return "no stable periodic state found"
        loose = (found & (self.settled == 0.0)).any()
        if not both.any():
            return f"no value with a {'settled ' if loose else ''}state both ways"
        if not self.two.size:
            which = "settled states both ways" if loose else "both"
            many = f", at the {both.sum()} of {both.size} values with {which}"
            where = "" if both.all() else many
            return f"the same states both ways{where}"
        return f"two stable states {self._between(self.two)}, by where the body comes from"

    def axis_text(self, value: float) -> str:
        """Return a value of the axis with its unit."""
        return f"{value:.6g} {self.axis.unit}".rstrip()

    def tables(self) -> tuple[Table, ...]:
        """Return ratio, load, flight and period, a table each way."""
        shown = {
            "ratio": self.ratio, "F/mu N": self.ratio_mean_load, "N_min (N)": self.normal_min,
            "open": self.open_share, "period": self.period, "growth": self.multiplier,
        }  # fmt: skip
        if self.beside.size:
            shown["from rest"] = np.stack([self.ratio_from_rest] * 2)
        shown = {name: values for name, values in shown.items() if not np.isnan(values).all()}
        unit = f" ({self.axis.unit})" if self.axis.unit else ""
        headings = [f"value{unit}", *shown]
        tables = []
        for way, title in enumerate(_WAYS):
            loose = self.settled[way] == 0.0
            ratio, *others = (values[way].tolist() for values in shown.values())
            columns = self.value.tolist(), marked(ratio, loose.tolist()), *others
            remarks = [f"{MARK} not settled, no prediction"] if loose.any() else []
            remarks += self.notes if way == len(_WAYS) - 1 else []
            tables.append(
                Table.of(
                    headings, list(zip(*columns, strict=True)),
                    title=f"{title}: {self.axis.path}", remarks=remarks,
                )
            )  # fmt: skip
        return tuple(tables)


def prepare(case: Case, *, over: Sequence[str]) -> tuple[Case, Axis, list[Model]]:
    """Return the bodies along an axis, refused if they cannot be followed.

    Raises
    ------
    InputError
        Naming the axis, or the point.
    """
    axes = parse_axes(over, case)
    if len(axes) != 1 or not axes[0].numeric or len(axes[0].values) < 2:
        given = " ".join(f"--over {text}" for text in over)
        raise InputError(
            f"{given}: states are followed along one axis of two numbers or more, as in "
            "--over 'vibration.frequency=2000:5000:50 Hz'"
        )
    grid = Grid(case, axes)
    if not isinstance(grid.subject, Bodies):
        raise InputError(f"this is a case of {grid.subject.what}; branches are of a sliding body")
    models = [point.model for point in grid.points(range(grid.size))]
    for model in models:
        if not model.vibrates:
            raise InputError("nothing vibrates; a periodic state needs a [vibration]")
        if model.solve.scheme == "two-phase":
            raise InputError(
                "solve.scheme is 'two-phase', which has no periodic states; leave it out"
            )
        cycle_steps(model)
    return case, axes[0], models


def answer(problem: tuple[Case, Axis, list[Model]], run: Run) -> Branches:
    """Follow the states there and back, going on from where the same walk was interrupted."""
    began = time.perf_counter()
    case, axis, models = problem
    bodies = [*models, *reversed(models)]
    names = [entry.name for entry in Branches.declared() if entry.label.dims == _DIMS]
    of_row = *names, "ratio_from_rest"
    walk = Walk()
    rows: list[FloatArray] = []
    notes: list[str] = []

    def standing() -> Tree:
        return {"rows": rows, "notes": notes, "walk": walk.tree()}

    asked = (march_key(model, history=False) for model in models)
    kept = run.resume(key(code_key(__name__), *asked))
    if kept is not None:
        rows += kept["rows"]
        notes += kept["notes"]
        walk.restore(bodies[len(rows) - 1], kept["walk"])
    with run.interruptible():
        run.forecast(sum(time_of_cycles(body, _CYCLES) for body in bodies), f"{len(bodies)} states")
        for body in bodies[len(rows) :]:
            state = walk.to(body)
            if len(rows) < len(models):
                state = _and_from_rest(walk, state, axis.text(len(rows)))
            rows.append(np.array([_of(state, name) for name in of_row]))
            if not isinstance(state, ConvergenceError):
                notes += [
                    note for note in state.notes if note not in notes and not note.startswith(NOTED)
                ]
            run.checkpoint(len(rows), len(bodies), standing, what="states")
    there, back = np.split(np.array(rows), 2)
    ways = np.stack([there, back[::-1]])
    numbers: dict[str, Any] = {name: ways[..., place] for place, name in enumerate(names)}
    return Branches(
        source=case.source,
        axis=axis,
        shared={path: value for path, value in inputs(models[0]).items() if path != axis.path},
        value=np.array(axis.shown, dtype=float),
        **numbers,
        ratio_from_rest=there[:, -1],
        missing=int(np.isnan(numbers["ratio"]).sum()),
        seconds=time.perf_counter() - began,
        notes=_together(notes) + _of_the_step(models, numbers["ratio"], numbers["step_error"]),
    )


def _and_from_rest(
    walk: Walk, state: SlideResult | ConvergenceError, where: str
) -> SlideResult | ConvergenceError:
    """Return the last state with the ratio of a body from rest, if that settles at another."""
    if isinstance(state, ConvergenceError):
        return state
    if not state.settled:
        return beside_march(state)
    other = walk.from_rest()
    if other is None and walk.takes_too_long():
        return dataclasses.replace(state, notes=(*state.notes, SOFT))
    if other is None:
        return state
    if other.state is None:
        note = f"{_ELSEWHERE}{other.ratio:.5g} at {where}"
        return dataclasses.replace(state, notes=(*state.notes, note))
    return dataclasses.replace(state, ratio_from_rest=ratio_of(other.state))


def _together(notes: list[str]) -> tuple[str, ...]:
    """Return notes, those of a body that goes elsewhere from rest as one."""
    elsewhere = [note.removeprefix(_ELSEWHERE) for note in notes if note.startswith(_ELSEWHERE)]
    others = [note for note in notes if not note.startswith(_ELSEWHERE)]
    if elsewhere:
        others.append(f"{_ELSEWHERE}{', '.join(elsewhere)}; see solve.method 'march'")
    return tuple(others)


def _of_the_step(models: list[Model], ratio: FloatArray, error: FloatArray) -> tuple[str, ...]:
    """Return a note on the states of which the step makes more of an error than it may."""
    over = error / allowed_of(ratio)
    great = over > 1.0
    if not great.any():
        return ()
    advice = "steps that are finer were tried"
    if models[0].solve.step is not None:
        steps = np.array([model.step / model.substeps for model in models])
        does = steps / np.where(great, over, 1.0) ** (1.0 / power_of(models[0]))
        advice = smaller_step(float(does[great].min()), 1.0)
    return (
        f"{NOTED} {error[great].max():.2g} in a ratio, and of more than {WANTED:g} of it in "
        f"{great.sum()} of {ratio.size} states: {advice}",
    )


def _of(state: SlideResult | ConvergenceError, name: str) -> float:
    """A number of a state, NaN where it has none."""
    if isinstance(state, ConvergenceError):
        return np.nan
    holder = state if name in _OF_BODY else state.normal
    value = getattr(holder, name, None)
    return np.nan if value is None else float(value)

"""The command ``asperity fit``: measurements and a case to parameters with intervals."""

import dataclasses
import math
import time
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

from asperity.arrays import BoolArray, FloatArray
from asperity.casefile import Case
from asperity.errors import ConvergenceError, InputError
from asperity.friction.dahl import LAWS
from asperity.runs import Run
from asperity.slider.parameters import Slider
from asperity.tribometer.fit.data import Measurements, Value, read_measurements
from asperity.tribometer.fit.design import proposals
from asperity.tribometer.fit.estimate import Estimate, Fit
from asperity.tribometer.fit.forward import BLOCK, DRIVE, SLIDE, Predictor, prepared
from asperity.tribometer.fit.free import Free
from asperity.tribometer.fit.outliers import Spoilt, spoilt
from asperity.tribometer.fit.problem import FitProblem
from asperity.tribometer.fit.result import FitResult, Law, Proposed
from asperity.tribometer.fit.words import improbable, notes, outlier_row, parameter_of
from asperity.tribometer.parameters import Rig

_LAW = "friction.law"
# Tables of which one makes a case that a model solves; a disc of a rig is a body, too.
_BODIES = {SLIDE: ("slider", Rig.table), BLOCK: ("block",), DRIVE: ("drive",)}
_STEP = 1e-3  # of an uncertain condition, for its slope
_LEAST = 1e-4  # deviation that is estimated, of what is assumed
_OUTSIDE = 0.05  # of what is, of intervals
_AN_END = 30  # evaluations of the data set, for an end of an interval
_DEEPER = 3  # times that intervals are begun anew
_LOWER = 0.02  # of the rise to an end, by which another fit is better
_STRIKING = 2.0  # deviations
_ALIKE = 0.01  # of chi-square, by which laws do not differ


def prepare(
    case: Case,
    *,
    data: str,
    free: str,
    law: str = "",
    next: int = 0,  # noqa: A002
    model: str = SLIDE,
) -> FitProblem:
    """Read the measurements and look whether they go with the case; refuses at no cost.

    Parameters
    ----------
    case : Case
        With what neither a column nor a free key gives.
    data : str
        A CSV file.
    free : str
        Keys, separated by commas.
    law : {'', 'split', 'unsplit', 'vector', 'all'}
        Which are fitted; empty: the case's.
    next : int
        How many measurements to make are named.
    model : {'slide', 'block', 'drive'}
        Whose answer it is.
    """
    measured = read_measurements(Path(data), case)
    _see_kind(case, model, measured)
    if model == SLIDE and Slider.table not in case and Rig.table in case:
        # A disc of a rig is a body on a rigid drive, under the rig's load.
        measured = measured.everywhere({"slider.normal_force": case.require(Rig).load})
    ready = prepared(case, model)
    keys = [key.strip() for key in free.split(",") if key.strip()]
    if not keys:
        raise InputError("--free is empty; name keys, as in --free friction.max_deflection")
    found = tuple(Free.of(key, ready, measured) for key in keys)
    if len({one.key for one in found}) < len(found):
        raise InputError(f"--free {free}: a key is there twice; name each once")
    points = len(measured.values)
    if points == len(found) and not measured.weighed:
        raise InputError(
            f"{measured.name} has no column sd, and {points} measurements for {len(found)} free "
            "parameters leave no residuals that would show their deviation; give sd, free fewer, "
            "or measure more"
        )
    if points < len(found):
        raise InputError(
            f"{measured.name} holds {points} measurements, fewer than the {len(found)} free "
            "parameters; free fewer, or measure more"
        )
    return FitProblem(measured, ready, found, _laws(law, ready), next, model)


def _see_kind(case: Case, model: str, measured: Measurements) -> None:
    """Refuse a case without the body that a model solves."""
    there = {*case.tables, *(key.partition(".")[0] for key in measured.keys)}
    able = [one for one, tables in _BODIES.items() if there.intersection(tables)]
    if model in able:
        return
    if able:
        raise InputError(
            f"{case.source}: it has no [{_BODIES[model][0]}], which --model {model} needs; give "
            f"--model {able[0]}"
        )
    bodies = ", ".join(f"[{name}]" for tables in _BODIES.values() for name in tables)
    raise InputError(
        f"{case.source}: it is a case of another kind, without one of {bodies}, which asperity fit "
        f"needs; asperity check {case.source} tells which commands take it"
    )


def _laws(given: str, case: Case) -> tuple[str, ...]:
    if given == "all":
        return tuple(LAWS)
    if given:
        return (given,)
    own = case.raw.get("friction", {}).get("law", "vector")
    return (str(own),)


class _Data:
    """The rows that have an answer, and what is left of each at some parameters."""

    def __init__(self, problem: FitProblem, predict: Predictor, law: str) -> None:
        self.problem, self._predict, self.law = problem, predict, law
        self.deviations = problem.data.deviations
        values, why = predict(problem.data.conditions, self.given(self.start))
        self.answered: BoolArray = np.isfinite(values)
        self.left_out = tuple(why.items())
        self.failed = tuple(
            {"row": problem.data.rows[index], "law": law, "why": reason}
            for index, reason in why.items()
        )
        if self.answered.sum() < len(problem.free):
            raise ConvergenceError(
                f"the model answers {int(self.answered.sum())} of {len(values)} measurements, "
                f"fewer than there are free parameters: {next(iter(why.values()))}"
            )

    @property
    def start(self) -> FloatArray:
        """Logarithms of the parameters that the case has."""
        return np.log([one.start for one in self.problem.free])

    def given(self, point: FloatArray) -> dict[str, Value]:
        """Return the parameters' values, with the law."""
        values: dict[str, Value] = {
            one.key: one.value(float(value))
            for one, value in zip(self.problem.free, point, strict=True)
        }
        if "friction" in self.problem.case and self._has_law():
            values[_LAW] = self.law
        return values

    def _has_law(self) -> bool:
        return self.problem.case.raw.get("friction", {}).get("model", "dahl") in ("dahl", "lugre")

    def predicted(self, point: FloatArray) -> FloatArray:
        """Return what the model says of the rows that have an answer."""
        rows = [
            row for row, kept in zip(self.problem.data.conditions, self.answered, strict=True)
            if kept
        ]  # fmt: skip
        given = self.given(point)
        try:
            values, why = self._predict(rows, given)
        except InputError as error:
            came = ", ".join(f"{f.key} = {f.text(float(given[f.key]))}" for f in self.problem.free)
            raise InputError(
                f"the fit comes to {came}, where {error}; free that too, or give it another value"
            ) from None
        if why:
            raise ConvergenceError(next(iter(why.values())))
        return values

    def residuals(self, point: FloatArray) -> FloatArray:
        """Return measured less predicted, over the deviations."""
        left = self.problem.data.values[self.answered] - self.predicted(point)
        weighed: FloatArray = left / self.deviations[self.answered]
        return weighed

    def carry(self, point: FloatArray) -> None:
        """Add to the deviations what uncertain conditions do at a point."""
        data = self.problem.data
        variance = data.deviations**2
        rows = [row for row, kept in zip(data.conditions, self.answered, strict=True) if kept]
        here = self.predicted(point)
        for key, deviation in data.uncertain.items():
            slope = np.full(len(rows), math.nan)
            for side in (_STEP, -_STEP):
                moved = [{**row, key: _moved(row[key], side)} for row in rows]
                values, why = self._predict(moved, self.given(point))
                steps = [_moved(row[key], side) - float(row[key]) for row in rows]
                slope = np.where(np.isnan(slope), (values - here) / np.array(steps), slope)
                if not why:
                    break
            if np.isnan(slope).any():
                raise ConvergenceError(next(iter(why.values())))
            variance[self.answered] += (slope * deviation[self.answered]) ** 2
        self.deviations = np.sqrt(variance)


def _moved(value: Value, step: float) -> float:
    return float(value) * (1.0 + step) if value else step


@dataclasses.dataclass(frozen=True)
class _Fitted:
    data: _Data
    fit: Fit
    best: Estimate


def answer(problem: FitProblem, run: Run) -> FitResult:
    """Fit the parameters under each law, and follow their profiles under the best.

    Raises
    ------
    ConvergenceError
        No law's fit converges, or the model answers fewer measurements than there are parameters.
    """
    total, done = len(problem.laws) + 2 * len(problem.free), 0

    def looked() -> None:
        run.checkpoint(done, total, what="fits and ends of intervals")

    predict = Predictor(problem.case, problem.by, problem.data.forces, looked)
    fitted: dict[str, _Fitted] = {}
    failed: dict[str, ConvergenceError] = {}
    with run.interruptible():
        for law in problem.laws:
            start = next(iter(fitted.values())).best.point if fitted else None
            try:
                fitted[law] = _fit(problem, predict, law, start)
            except ConvergenceError as error:
                failed[law] = error
            done += 1
        if not fitted:
            raise next(iter(failed.values()))
        law = _chosen(problem, fitted)
        if not problem.data.weighed:
            fitted = _by_residuals(fitted, law)
        # The first ones may have compiled what they need, and tell of no other.
        began = time.monotonic()
        fitted[law].fit.residuals(fitted[law].best.point)
        each = time.monotonic() - began
        ends_of = 2 * len(problem.free)
        run.forecast(each * _AN_END * ends_of, f"{ends_of} ends of intervals")
        for _ in range(_DEEPER):
            ends = []
            done = len(problem.laws)
            for index in range(len(problem.free)):
                both = []
                for side in (-1, 1):
                    both.append(fitted[law].fit.end(fitted[law].best, index, side))
                    done += 1
                ends.append((both[0], both[1]))
            if not _deeper(fitted, law):
                break
    evaluations = sum(one.fit.evaluations for one in fitted.values())
    ruined = _ruined(problem, fitted[law])
    found = _result(problem, predict, fitted, law, ends, evaluations, ruined)
    if not failed:
        return found
    return dataclasses.replace(
        found,
        failed=(*found.failed, *({"row": None, "law": law, "why": str(error)}
                                 for law, error in failed.items())),
        notes=(*found.notes, *(f"law {law} is not fitted: {error}"
                               for law, error in failed.items())),
    )  # fmt: skip


def _chosen(problem: FitProblem, fitted: Mapping[str, _Fitted]) -> str:
    """Return the law that meets the data best; the case's own of equals."""
    best = min(fitted, key=lambda one: fitted[one].best.chi2)
    (own,) = _laws("", problem.case)
    if own in fitted and fitted[own].best.chi2 - fitted[best].best.chi2 < _ALIKE:
        return own
    return best


def _freedom(fitted: _Fitted) -> int:
    return int(fitted.data.answered.sum()) - fitted.best.point.size


def _fit(problem: FitProblem, predict: Predictor, law: str, start: FloatArray | None) -> _Fitted:
    data = _Data(problem, predict, law)
    lower, upper = np.array([one.bounds for one in problem.free]).T
    fit = Fit(data.residuals, lower, upper)
    best = fit.least(data.start if start is None else start)
    if problem.data.uncertain:
        data.carry(best.point)
        best = fit.least(best.point)
    return _Fitted(data, fit, best)


def _by_residuals(fitted: Mapping[str, _Fitted], law: str) -> dict[str, _Fitted]:
    """Take for the deviation of every measurement what the residuals under a law show."""
    from scipy.stats import t

    freedom = _freedom(fitted[law])
    if freedom < 1:
        raise ConvergenceError(
            "as many measurements have an answer as there are free parameters, which leaves no "
            "residuals that would show their deviation; give a column sd, or free fewer"
        )
    scale = max(math.sqrt(fitted[law].best.chi2 / freedom), _LEAST)
    found = {}
    for name, one in fitted.items():
        one.data.deviations = one.data.deviations * scale
        one.fit.rise = float(t.isf(0.5 * _OUTSIDE, freedom)) ** 2
        best = one.fit.least(one.best.point) if name == law else one.best.scaled(scale)
        found[name] = dataclasses.replace(one, best=best)
    return found


def _deeper(fitted: dict[str, _Fitted], law: str) -> bool:
    """Fit again from where the way to an end has met a lower chi-square; whether it has."""
    one = fitted[law]
    lowest = one.fit.lowest
    if lowest is None or lowest.chi2 > one.best.chi2 - _LOWER * one.fit.rise:
        return False
    fitted[law] = dataclasses.replace(one, best=one.fit.least(lowest.point))
    one.fit.lowest = None
    one.fit.walls.clear()
    return True


def _ruined(problem: FitProblem, fitted: _Fitted) -> Spoilt | None:
    """Return which rows spoil a fit, where it is not as it should be."""
    weighed = problem.data.weighed
    if weighed and not improbable(fitted.best.chi2, _freedom(fitted)):
        return None
    if not weighed and float(np.abs(fitted.best.residuals).max()) < _STRIKING:
        return None
    return spoilt(fitted.fit, fitted.best, fitted.data.start, weighed)


def _result(
    problem: FitProblem,
    predict: Predictor,
    fitted: Mapping[str, _Fitted],
    law: str,
    ends: Sequence[tuple[float | None, float | None]],
    evaluations: int,
    ruined: Spoilt | None,
) -> FitResult:
    chosen = fitted[law]
    data, best = chosen.data, chosen.best
    least = min(one.best.chi2 for one in fitted.values())
    correlation = best.correlation
    values = problem.data.values[data.answered]
    deviations = data.deviations[data.answered]
    answered = np.flatnonzero(data.answered).tolist()
    outliers = ruined.outliers if ruined is not None else ()
    proposed: list[Proposed] = []
    if problem.further:
        proposed = proposals(
            problem.data, predict, best, data.given, [one.key for one in problem.free],
            float(np.median(deviations)), problem.further,
        )  # fmt: skip
    return FitResult(
        parameters=tuple(
            parameter_of(problem, best, correlation, ends, chosen.fit.walls, index)
            for index in range(len(ends))
        ),
        correlation=correlation,
        laws=tuple(
            Law(name, one.best.chi2, _freedom(one), one.best.chi2 - least)
            for name, one in fitted.items()
        ),
        proposed=tuple(proposed),
        failed=tuple(row for one in fitted.values() for row in one.data.failed),
        law=law, points=len(values), chi2=best.chi2, dof=_freedom(chosen), solves=predict.solves,
        evaluations=evaluations, marched=predict.marched, measured=values, deviation=deviations,
        predicted=values - best.residuals * deviations, residuals=best.residuals,
        outliers=tuple(outlier_row(problem, answered[far.measurement], far, deviations)
                       for far in outliers),
        deviation_known=problem.data.weighed,
        notes=tuple(notes(problem, predict, best, answered, data.left_out, ruined, deviations)),
    )  # fmt: skip

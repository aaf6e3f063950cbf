"""What a fit says of itself: of each parameter, of its data, of its law."""

import math
from collections.abc import Sequence

import numpy as np

from asperity.arrays import FloatArray
from asperity.results import interval
from asperity.tribometer.fit.estimate import Estimate
from asperity.tribometer.fit.forward import SLIDE, Predictor
from asperity.tribometer.fit.outliers import Outlier, Spoilt
from asperity.tribometer.fit.problem import FitProblem
from asperity.tribometer.fit.result import Parameter

_CORRELATED, _AS_ONE = 0.95, 0.999
_UNLIKELY = 0.05
_ABOVE = 3.0  # deviations by which a ratio lies above what a law can give
_MANY = 5  # rows that are named one by one

Ends = Sequence[interval.Ends]
Walls = dict[tuple[int, int], tuple[float, str]]


def parameter_of(
    problem: FitProblem, best: Estimate, correlation: FloatArray, ends: Ends, walls: Walls,
    index: int,
) -> Parameter:  # fmt: skip
    """Return a parameter with its interval, and what the data do not tell of it."""
    one = problem.free[index]
    found = interval.Interval(float(best.point[index]), *ends[index]).mapped(math.exp)
    others = np.abs(correlation[index])
    others[index] = 0.0
    partner = int(np.argmax(others)) if len(others) > 1 else index
    with_it = float(correlation[index, partner]) if partner != index else 0.0
    why = ""
    if float(np.abs(best.slopes[:, index]).max()) <= 1e-9:
        why = "the data do not depend on it at all"
        if one.key == "friction.mu" and not problem.data.forces:
            why += ": a ratio of a rigid drive has no mu in it, forces have"
    elif abs(with_it) > _AS_ONE:
        why = f"only together with {problem.free[partner].key}: the data see one number of both"
    elif stopped := [walls[index, side] for side in (-1, 1) if (index, side) in walls]:
        (reached, reason), *_ = stopped
        why = f"the model answers no further than {one.text(math.exp(reached))}: {reason}"
    elif found.ends == (None, None):
        why = "chi-square does not rise by 3.84 on either side"
    elif found.width is None:
        side = "below" if found.low is None else "above"
        why = f"the data do not bound it {side}"
    elif abs(with_it) > _CORRELATED:
        why = f"goes with {problem.free[partner].key}: correlation {with_it:+.2f}"
    closed = found.width is not None and abs(with_it) <= _AS_ONE
    return Parameter(
        found.value, *found.ends, key=one.key, units=one.quantity.unit, identifiable=closed,
        why=why, written=one.written,
    )  # fmt: skip


def row_of(problem: FitProblem, index: int) -> str:
    """Return what a measurement is called."""
    count = index + 1
    end = {1: "st", 2: "nd", 3: "rd"}.get(count % 10 if count % 100 not in (11, 12, 13) else 0)
    return f"the {count}{end or 'th'} measurement (row {problem.data.rows[index]})"


def notes(
    problem: FitProblem, predict: Predictor, best: Estimate, answered: Sequence[int],
    left_out: Sequence[tuple[int, str]], ruined: Spoilt | None, deviations: FloatArray,
) -> list[str]:  # fmt: skip
    """Return what a reader of a fit should know, the gravest first.

    Parameters
    ----------
    problem : FitProblem
        What was asked.
    predict : Predictor
        How often its model was solved, and how.
    best : Estimate
        Where the fit ended.
    answered : sequence of int
        Places of the measurements that are fitted.
    left_out : sequence of (index, why)
        Those that are not.
    ruined : Spoilt, optional
        Those that spoil it.
    deviations : ndarray
        Of those that are fitted.
    """
    data = problem.data
    found = []
    what, unit = ("force", " N") if data.forces else ("ratio", "")
    for one in ruined.outliers if ruined is not None else ():
        index = answered[one.measurement]
        value = data.values[index]
        by = value - one.by_others * deviations[one.measurement]
        found.append(
            f"{row_of(problem, index)} spoils the fit: by the others its {what} is {by:.4g}{unit}, "
            f"measured {value:.4g}{unit}, {one.residual:+.3g} deviations off; look at it, or leave "
            "it out"
        )
    if ruined is not None:
        them = "them" if len(ruined.outliers) > 1 else "it"
        values = ", ".join(
            f"{one.key} {one.text(math.exp(value))}"
            for one, value in zip(problem.free, ruined.point, strict=True)
        )
        found.append(
            f"without {them} chi-square is {ruined.chi2:.3g} with {_degrees(ruined.freedom)} "
            f"of freedom, and {values}"
        )
    found += _beyond(problem, answered, deviations)
    found += _improbable(problem, best, ruined)
    for index, why in left_out[:_MANY]:
        found.append(f"{row_of(problem, index)} has no answer and is left out: {why}")
    if len(left_out) > _MANY:
        found.append(f"{len(left_out)} measurements have no answer and are left out")
    if predict.marched:
        found.append(
            f"{predict.marched} of {predict.solves} bodies had no periodic state and were marched"
        )
    if predict.rigid:
        found.append(
            f"{predict.rigid} of {predict.solves} bodies are as good as rigid: their ratios lie "
            "between rigid friction's closed form and the stiffest contact for which it holds"
        )
    return found


def outlier_row(
    problem: FitProblem, index: int, outlier: Outlier, deviations: FloatArray
) -> dict[str, float | int]:
    """Return a row that spoils a fit, as JSON has it."""
    value = float(problem.data.values[index])
    return {
        "row": problem.data.rows[index],
        "measurement": index + 1,
        "measured": value,
        "by_the_others": value - outlier.by_others * float(deviations[outlier.measurement]),
        "standardised_residual": outlier.residual,
    }


def chance(chi2: float, freedom: int) -> float:
    """Return in how many cases chi-square is as large, if all is as it is taken to be."""
    from scipy.stats import chi2 as distribution

    return float(distribution.sf(chi2, freedom)) if freedom > 0 else 1.0


def improbable(chi2: float, freedom: int) -> bool:
    """Return whether chi-square says that something is not as it is taken to be."""
    return chance(chi2, freedom) < _UNLIKELY


def _improbable(problem: FitProblem, best: Estimate, ruined: Spoilt | None) -> list[str]:
    freedom = best.residuals.size - best.point.size
    if not problem.data.weighed:
        return [
            "without sd all measurements weigh the same, and their deviation is what the "
            f"residuals show with {_degrees(freedom)} of freedom: chi-square says nothing of the "
            "law"
        ]
    if freedom == 0:
        told = "as many parameters as measurements leave nothing that would show a wrong law"
        if best.chi2 > 1.0:
            told = (
                f"chi-square is {best.chi2:.3g} with 0 degrees of freedom, where it should be 0: "
                "no values of the parameters meet the data; the law is another one, or the rest "
                "of the case"
            )
        return [told]
    if not improbable(best.chi2, freedom):
        return []
    told = (
        f"chi-square is {best.chi2:.3g} with {_degrees(freedom)} of freedom, or more in "
        f"{chance(best.chi2, freedom):.1g} of cases if the law and the deviations are right: one "
        "of them may not be, and the intervals too narrow"
    )
    if ruined is None:
        worst = int(np.argmax(np.abs(best.residuals)))
        told += (
            f"; no few rows account for it, the largest residual is {best.residuals[worst]:+.3g}"
        )
    return [told]


def _degrees(count: int) -> str:
    return f"{count} degree{'' if count == 1 else 's'}"


def _beyond(problem: FitProblem, answered: Sequence[int], deviations: FloatArray) -> list[str]:
    """Tell of ratios that no law can give, however its parameters are chosen."""
    data = problem.data
    if problem.by != SLIDE or data.forces or "normal" in problem.case:
        return []
    friction = problem.case.raw.get("friction", {})
    keys = {*data.keys, *(one.key for one in problem.free)}
    if friction.get("static_mu") is not None or {"friction.static_mu", "friction.model"} & keys:
        return []
    if any(key.startswith("normal.") for key in keys):
        return []
    above = [
        index for n, index in enumerate(answered)
        if data.values[index] - 1.0 > _ABOVE * deviations[n]
    ]  # fmt: skip
    if not above:
        return []
    names = ", ".join(str(data.rows[index]) for index in above[:_MANY])
    more = f" and {len(above) - _MANY} more" if len(above) > _MANY else ""
    one, lie = ("ratios of rows", "lie") if len(above) > 1 else ("ratio of row", "lies")
    return [
        f"the {one} {names}{more} {lie} above 1 by more than {_ABOVE:g} deviations: no "
        "law here gives that, under which vibration in the plane of the contact cannot raise "
        "friction; look at what was measured, or at what the ratio refers to"
    ]

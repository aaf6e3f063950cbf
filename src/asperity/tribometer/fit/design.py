"""What to measure next: conditions that would narrow the intervals most."""

import itertools
from collections.abc import Callable, Iterator, Sequence

import numpy as np

from asperity.arrays import FloatArray
from asperity.errors import InputError
from asperity.tribometer.fit.data import Measurements, Value, numeric
from asperity.tribometer.fit.estimate import Estimate
from asperity.tribometer.fit.forward import Predictor
from asperity.tribometer.fit.result import Proposed

_VALUES, _FEWEST = 17, 3  # along a condition that differs between the measurements
_STEP = 2e-3
_MOST = 2000  # conditions; the more of them differ, the coarser is the grid
_FAINT = 1e-8  # information that stands in where there is none


def proposals(
    data: Measurements,
    predict: Predictor,
    best: Estimate,
    parameters_of: Callable[[FloatArray], dict[str, Value]],
    keys: Sequence[str],
    deviation: float,
    count: int,
) -> list[Proposed]:
    """Return measurements, one after the other that which lowers the product of variances most.

    Parameters
    ----------
    data : Measurements
        Whose conditions span those that are looked at: each number between its least and its
        largest value, each word as it occurs.
    predict : Predictor
        The model.
    best : Estimate
        The fit.
    parameters_of : callable
        Parameters of the model at a point.
    keys : sequence of str
        Of the parameters.
    deviation : float
        Of a measurement to come.
    count : int
        How many.
    """
    looked_at = list(candidates(data))
    here, _ = predict(looked_at, parameters_of(best.point))
    slopes = np.empty((len(looked_at), best.point.size))
    for place in range(best.point.size):
        moved = best.point.copy()
        moved[place] -= _STEP
        slopes[:, place] = (here - predict(looked_at, parameters_of(moved))[0]) / (
            _STEP * deviation
        )
    slopes[~np.isfinite(slopes).all(axis=1)] = 0.0
    information = best.slopes.T @ best.slopes
    information += _FAINT * np.eye(len(information))
    found = []
    for _ in range(count):
        # Of each candidate the variances that would be left, by one more row of slopes.
        inverse = np.linalg.inv(information)
        turned = slopes @ inverse
        gain = turned**2 / (1.0 + np.einsum("ij,ij->i", turned, slopes))[:, None]
        left = np.log(np.maximum(np.diag(inverse) - gain, 1e-300)).sum(axis=1)
        place = int(np.argmin(left))
        information += np.outer(slopes[place], slopes[place])
        deviations = np.sqrt(np.diag(np.linalg.inv(information)))
        found.append(Proposed(looked_at[place], dict(zip(keys, deviations.tolist(), strict=True))))
    return found


def candidates(data: Measurements) -> Iterator[dict[str, Value]]:
    """Yield what may be measured: of each set of words and fixed numbers a grid of what differs."""
    varied = [key for key in numeric(data) if len({row[key] for row in data.conditions}) > 2]
    groups: dict[tuple[Value, ...], list[dict[str, Value]]] = {}
    for row in data.conditions:
        groups.setdefault(tuple(row[key] for key in row if key not in varied), []).append(row)
    sizes = [n for n in range(_FEWEST, _VALUES + 1) if n ** len(varied) * len(groups) <= _MOST]
    if not sizes:
        raise InputError(
            f"--next: {', '.join(varied)} all differ between the measurements, which makes more "
            f"than {_MOST} conditions to look at: give fewer columns that differ"
        )
    axes = []
    for key in varied:
        values = np.array([float(row[key]) for row in data.conditions])
        low, high = float(values.min()), float(values.max())
        spaced = np.geomspace if low > 0.0 else np.linspace
        axes.append(spaced(low, high, sizes[-1]))
    for rows in groups.values():
        for point in itertools.product(*axes):
            yield {**rows[0], **dict(zip(varied, map(float, point), strict=True))}

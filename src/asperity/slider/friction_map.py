"""Mean friction over the mean velocity and one value of the case: homogenised laws together."""

import dataclasses
from collections.abc import Sequence
from typing import overload

import numpy as np

from asperity.arrays import FloatArray
from asperity.errors import InputError
from asperity.runs import Run
from asperity.slider.cost import estimate
from asperity.slider.cycle_mean_law import HomogenisedLaw, homogenise
from asperity.slider.model import Model


@dataclasses.dataclass(frozen=True, eq=False)
class FrictionMap:
    """Cycle-mean friction :math:`F(v, a)`; of one law, a curve :math:`F(v)`.

    Between two values the forces of their laws are interpolated linearly; beyond the first and the
    last value their own law holds.

    Attributes
    ----------
    laws : sequence of HomogenisedLaw
        One for each value.
    values : ndarray, shape (n,)
        Of ``key``, in SI, rising.
    key : str
        ``table.key`` that differs; empty for one law.
    unit : str
        Of the values; empty for a ratio.
    """

    laws: Sequence[HomogenisedLaw]
    values: FloatArray = dataclasses.field(default_factory=lambda: np.zeros(1))
    key: str = ""
    unit: str = ""

    def __post_init__(self) -> None:
        if len(self.laws) != len(self.values) or not np.all(np.diff(self.values) > 0.0):
            raise InputError(
                f"a map has {len(self.laws)} laws at {list(self.values)}; give one for each value, "
                "and values that rise"
            )

    @overload
    def __call__(self, velocity: float, value: float = ...) -> float: ...
    @overload
    def __call__(self, velocity: FloatArray, value: FloatArray | float = ...) -> FloatArray: ...
    def __call__(
        self, velocity: float | FloatArray, value: float | FloatArray = 0.0
    ) -> float | FloatArray:
        """Mean friction force in N at mean velocities in m/s and values of ``key`` in SI."""
        v, at = np.broadcast_arrays(np.asarray(velocity, float), np.asarray(value, float))
        if not np.all(np.isfinite(at)):
            raise InputError(f"{self.key} is not finite; give finite values in SI")
        last = len(self.laws) - 1
        below = np.clip(np.searchsorted(self.values, at, side="right") - 1, 0, max(last - 1, 0))
        above = np.minimum(below + 1, last)
        wide = np.where(above > below, self.values[above] - self.values[below], 1.0)
        share = np.clip((at - self.values[below]) / wide, 0.0, 1.0)
        force = np.empty(v.shape)
        for place in np.unique(below):
            here = below == place
            low = self.laws[place](v[here])
            high = self.laws[min(place + 1, last)](v[here])
            force[here] = (1.0 - share[here]) * low + share[here] * high
        return float(force) if force.ndim == 0 else force


def tabulate(
    models: Sequence[Model],
    values: Sequence[float] = (0.0,),
    key: str = "",
    unit: str = "",
    run: Run | None = None,
) -> FrictionMap:
    """Return the mean friction of bodies that differ in one value.

    Parameters
    ----------
    models : sequence of Model
        One for each value.
    values : sequence of float
        Of ``key``, in SI, rising.
    key, unit : str
        ``table.key`` and its unit; empty for one body.
    run : Run, optional
        Who is told how far it is.

    Raises
    ------
    InputError, ConvergenceError
        As `homogenise`.
    """
    doing = Run() if run is None else run
    doing.forecast(sum(map(estimate, models)), f"{len(models)} laws")
    laws = []
    with doing.interruptible():
        for done, model in enumerate(models):
            doing.checkpoint(done, len(models), what="laws")
            laws.append(homogenise(model))
    return FrictionMap(laws, np.array(values, float), key, unit)

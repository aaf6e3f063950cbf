"""The answer of ``asperity fit``: parameters with their intervals, laws, what to measure next."""

import dataclasses
import itertools
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from asperity.arrays import FloatArray
from asperity.results import Result, quantity
from asperity.results.interval import Interval
from asperity.results.quantity import plain
from asperity.results.table import Table
from asperity.units import to_si

if TYPE_CHECKING:
    import xarray as xr


@dataclasses.dataclass(frozen=True, kw_only=True)
class Parameter(Interval):
    """A fitted parameter, in SI.

    Attributes
    ----------
    key, units : str
        ``table.key``, and the unit of the numbers.
    identifiable : bool
        Whether both ends are closed.
    why : str
        What the data do not tell of it, or what it goes with; may be empty.
    written : str
        The case's unit, in which tables show it.
    """

    key: str
    units: str
    identifiable: bool
    why: str
    written: str

    def to_json(self) -> dict[str, Any]:
        """Return what is in SI."""
        return {
            "key": self.key, "value": self.value, "units": self.units,
            "ci95": self.ends, "identifiable": self.identifiable, "why": self.why,
        }  # fmt: skip

    def row(self) -> tuple[str | float, ...]:
        """Return key, value, ends, unit and why in short, in the case's unit."""
        zero, one = (to_si(f"{n} {self.written}", self.units) for n in (0, 1))
        shown = self.mapped(lambda value: (value - zero) / (one - zero))
        ends = ("open" if end is None else end for end in shown.ends)
        return self.key, shown.value, *ends, self.written, self._parted[0]

    @property
    def rest(self) -> str:
        """What the row has no room for."""
        return self._parted[1]

    @property
    def _parted(self) -> tuple[str, str]:
        """The first clause of a long reason, and what follows it."""
        if len(self.why) <= _ROOM:
            return self.why, ""
        head, _, rest = self.why.partition(": ")
        return head, rest


@dataclasses.dataclass(frozen=True)
class Law:
    """How well a friction law meets the data."""

    law: str
    chi2: float
    dof: int
    delta_chi2: float


@dataclasses.dataclass(frozen=True)
class Proposed:
    """A measurement that would narrow the intervals, and to what deviations it would bring them."""

    conditions: Mapping[str, float | str]
    relative_deviations: Mapping[str, float]


class FitResult(Result):
    """Parameters of a law, fitted to measurements."""

    title = "Friction law fitted to measurements"
    stem = "fit"
    drawings: ClassVar[Mapping[str, str]] = {"fit": "asperity.tribometer.plots:plot_fit"}

    parameters: tuple[Parameter, ...]
    correlation: FloatArray
    laws: tuple[Law, ...]
    proposed: tuple[Proposed, ...]
    failed: tuple[dict[str, Any], ...]
    outliers: tuple[dict[str, Any], ...]
    law: str = quantity("", "", "friction law")
    points: int = quantity("", "", "measurements that were fitted")
    chi2: float = quantity("chi2", "", "sum of squared residuals over their deviations")
    dof: int = quantity("", "", "degrees of freedom")
    solves: int = quantity("", "", "bodies solved")
    evaluations: int = quantity("", "", "evaluations of the data set")
    marched: int = quantity("", "", "bodies marched, for lack of a periodic state")
    deviation_known: bool = quantity(
        "", "", "whether standard deviations were given, or are what the residuals show"
    )
    measured: FloatArray = quantity("", "", "measured", dims=("row",))
    deviation: FloatArray = quantity("", "", "standard deviation of it", dims=("row",))
    predicted: FloatArray = quantity("", "", "by the fitted law", dims=("row",))
    residuals: FloatArray = quantity(
        "", "", "measured less predicted, over the deviation", dims=("row",)
    )

    def to_json(self) -> dict[str, Any]:
        """Return parameters, their correlation, laws, residuals and what to measure next."""
        own = {
            "parameters": [one.to_json() for one in self.parameters],
            "correlation": self.correlation,
            "laws": [dataclasses.asdict(one) for one in self.laws],
            "residuals": self.residuals,
            "next": [
                {"conditions": dict(one.conditions),
                 "relative_deviations": dict(one.relative_deviations)}
                for one in self.proposed
            ],
            "failed": list(self.failed),
            "outliers": list(self.outliers),
        }  # fmt: skip
        told: dict[str, Any] = plain(own)
        return super().to_json() | told

    def to_dataset(self) -> "xr.Dataset":
        """Return measured and predicted values, and the parameters along a dimension."""
        dataset = super().to_dataset()
        names = np.array([one.key for one in self.parameters], dtype=object)
        dataset = dataset.assign_coords(
            parameter=("parameter", names, {"units": "1", "long_name": "parameter, in SI"})
        )
        for name, meaning in (("value", "value"), ("low", "lower end"), ("high", "upper end")):
            described = {"units": "1", "long_name": f"{meaning} of a parameter, in its SI unit"}
            values = [_or_nan(getattr(one, name)) for one in self.parameters]
            dataset[name] = ("parameter", np.array(values), described)
        return dataset

    def tables(self) -> tuple[Table, ...]:
        """Return parameters, laws, and what to measure next."""
        rows = [one.row() for one in self.parameters]
        headings = "parameter", "value", "from", "to", "unit", ""
        rest = [f"{one.key}: {one.rest}" for one in self.parameters if one.rest]
        remarks = *rest, *self.notes
        found = Table.of(headings, rows, title=f"Law {self.law}", remarks=remarks)
        laws = Table.of(
            ("law", "chi2", "degrees of freedom", "more than the best"),
            [(one.law, one.chi2, str(one.dof), one.delta_chi2) for one in self.laws],
        )
        shown = found, laws, *self._strong()
        if not self.proposed:
            return shown
        keys = list(self.proposed[0].conditions)
        further = [
            (*(one.conditions[key] for key in keys),
             *("open" if value > _WIDE else 100.0 * value
               for value in one.relative_deviations.values()))
            for one in self.proposed
        ]  # fmt: skip
        heads = (*keys, *(f"{key} %" for key in self.proposed[0].relative_deviations))
        title = "What to measure next, one after the other, in SI units, and the deviations then"
        conditions = [one.conditions for one in self.proposed]
        again = any(one in conditions[:place] for place, one in enumerate(conditions))
        remarks = ("the same conditions again are one measurement, repeated",) if again else ()
        return *shown, Table.of(heads, further, title=title, left=0, remarks=remarks)

    def _strong(self) -> tuple[Table, ...]:
        """Return the table of parameters that go together, if any do."""
        keys = [one.key for one in self.parameters]
        rows = [
            (keys[one], keys[other], f"{self.correlation[one, other]:+.3f}")
            for one, other in itertools.combinations(range(len(keys)), 2)
            if abs(self.correlation[one, other]) > _STRONG
        ]
        heads = "parameter", "goes with", "correlation"
        return (Table.of(heads, rows, left=2),) if rows else ()


_ROOM = 96  # characters of a reason, in a row
_STRONG = 0.9  # correlation
_WIDE = 3.0  # relative deviation that tells nothing


def _or_nan(value: float | None) -> float:
    return float("nan") if value is None else value

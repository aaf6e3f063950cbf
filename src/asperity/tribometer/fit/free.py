"""A parameter that is fitted: a key of the case with its bounds, and where the search starts."""

import dataclasses
import math
from typing import Self

from asperity.casefile import Case, naming_source
from asperity.errors import InputError, nearest
from asperity.tribometer.fit.data import Measurements
from asperity.tribometer.fit.estimate import WIDEST
from asperity.units import Quantity, quantity_of, split_unit, to_si


@dataclasses.dataclass(frozen=True)
class Free:
    """A parameter that is fitted.

    Attributes
    ----------
    key : str
        ``table.key``.
    quantity : Quantity
        Its unit and bounds.
    start : float
        SI.
    written : str
        In which tables show it.
    """

    key: str
    quantity: Quantity
    start: float
    written: str

    @classmethod
    def of(cls, key: str, case: Case, data: Measurements) -> Self:
        """Return a key of a case as a parameter; InputError where it cannot be one."""
        table, _, own = key.partition(".")
        with naming_source(case):
            if table not in case.known or not own:
                raise InputError(
                    f"--free {key}: it must be table.key, as in friction.max_deflection"
                )
            fields = case.known[table].own_keys()
            if own not in fields:
                raise InputError(f"--free {key} is not a key of [{table}]{nearest(own, fields)}")
        quantity = quantity_of(case.known[table], own)
        if quantity is None:
            raise InputError(f"--free {key}: it is no number, which alone can be fitted")
        if key in data.keys:
            raise InputError(
                f"--free {key}: it is a column of {data.name}, and so given for each row"
            )
        start = getattr(case.require(table), own)
        if start is None or not start > 0.0:
            raise InputError(
                f"--free {key}: the case must have a value above zero to start from, such as "
                f"'{quantity.example}'"
            )
        return cls(
            key, quantity, float(start), _written(case.raw.get(table, {}).get(own), quantity)
        )

    def text(self, value: float) -> str:
        """Return a value in SI as text in the unit of the tables, to four digits."""
        zero, one = (to_si(f"{n} {self.written}".strip(), self.quantity.unit) for n in (0, 1))
        return f"{float(f'{(value - zero) / (one - zero):.4g}'):.12g} {self.written}".rstrip()

    def value(self, logarithm: float) -> float:
        """Return the value of a logarithm: that of a bound is within the bounds."""
        q = self.quantity
        lower = q.ge if q.gt is None else math.nextafter(q.gt, math.inf)
        upper = q.le if q.lt is None else math.nextafter(q.lt, -math.inf)
        value = math.exp(logarithm)
        value = value if upper is None else min(value, upper)
        return value if lower is None else max(value, lower)

    @property
    def bounds(self) -> tuple[float, float]:
        """Logarithms of the least and the largest value."""
        lower = self.quantity.ge if self.quantity.gt is None else self.quantity.gt
        upper = self.quantity.le if self.quantity.lt is None else self.quantity.lt
        middle = math.log(self.start)
        low = math.log(lower) if lower is not None and lower > 0.0 else middle - 2.0 * WIDEST
        return low, math.log(upper) if upper is not None else middle + 2.0 * WIDEST


def _written(value: object, quantity: Quantity) -> str:
    """Return the unit that a value is given in, or that of the example where it is in SI."""
    for text in (value, quantity.example):
        parts = split_unit(text) if isinstance(text, str) else None
        if parts is not None and parts[1] != quantity.unit:
            return parts[1]
    return quantity.unit

"""Numbers that remember how they were found, as formulas of a spreadsheet.

A calculation that is given traced numbers returns traced numbers: each has its value and the
operation that made it. What is written of them follows from the calculation itself, so that there
is no second copy of a formula.
"""

import functools
import math
import operator
from collections.abc import Callable, Iterable, Mapping
from typing import Any

import numpy as np

_OPERATIONS: Mapping[str, str] = {
    "add": "({}+{})", "subtract": "({}-{})", "multiply": "({}*{})", "divide": "({}/{})",
    "power": "({}^{})", "negative": "(-{})", "square": "({}^2)", "cbrt": "({}^(1/3))",
    "absolute": "ABS({})", "sqrt": "SQRT({})", "exp": "EXP({})", "log": "LN({})",
    "log10": "LOG10({})", "sin": "SIN({})", "cos": "COS({})", "tan": "TAN({})",
    "arcsin": "ASIN({})", "arccos": "ACOS({})", "arctan": "ATAN({})",
    # A spreadsheet takes the abscissa first.
    "arctan2": "ATAN2({1},{0})",
    "degrees": "DEGREES({})", "radians": "RADIANS({})", "deg2rad": "RADIANS({})",
    "minimum": "MIN({},{})", "maximum": "MAX({},{})",
    "less": "({}<{})", "less_equal": "({}<={})", "greater": "({}>{})",
    "greater_equal": "({}>={})", "equal": "({}={})",
}  # fmt: skip
_FUNCTIONS: dict[Any, Callable[..., Any]] = {}
# What stands in for numbers is nothing that its annotations know.
_np: Any = np


class Traced:
    """A number and how it was found.

    It takes part in arithmetic, in numpy's functions of numbers and in formulas. It has no float,
    so that nothing drops its origin unnoticed.

    Parameters
    ----------
    value : float or bool
        What it is.
    operation : str
        A template of a spreadsheet's formula with a place for each argument; empty for a number
        that only a place in a sheet can stand for.
    arguments : sequence of Traced or float
        What it was found from.
    """

    # What makes floats of numbers leaves arrays alone, and a traced number with them.
    ndim = 1

    def __init__(self, value: Any, operation: str = "", *arguments: Any) -> None:
        self.value, self.operation, self.arguments = value, operation, arguments

    def __repr__(self) -> str:
        return f"Traced({self.value!r})"

    def formula(self, places: Mapping[int, str]) -> str:
        """Return the spreadsheet's formula.

        Parameters
        ----------
        places : mapping of int to str
            Where numbers stand in a sheet, by their ``id``; the formula goes back as far as these.
        """
        written = (_written(one, places) for one in self.arguments)
        return self.operation.format(*written)

    def whole_formula(self, places: Mapping[int, str]) -> str:
        """Return the same without brackets around all of it."""
        text = self.formula(places)
        return text[1:-1] if self.operation.startswith("(") else text

    def __array_ufunc__(self, ufunc: Any, method: str, *inputs: Any, **options: Any) -> Any:
        """Numpy's functions of numbers."""
        if method != "__call__" or options:
            return NotImplemented
        values = [_value(one) for one in inputs]
        if ufunc is np.isnan:
            return np.isnan(values[0])
        if ufunc in (np.minimum, np.maximum) and not np.all(np.isfinite(values)):
            # What has no bound is none.
            return next(one for one in inputs if isinstance(one, Traced))
        return Traced(ufunc(*values), _OPERATIONS[ufunc.__name__], *inputs)

    def __array_function__(self, function: Any, types: Any, args: Any, kwargs: Any) -> Any:
        """Numpy's other functions."""
        return _FUNCTIONS[function](*args, **kwargs)

    def __bool__(self) -> bool:
        return bool(self.value)

    def __add__(self, other: Any) -> Any:
        return _np.add(self, other)

    def __radd__(self, other: Any) -> Any:
        return _np.add(other, self)

    def __sub__(self, other: Any) -> Any:
        return _np.subtract(self, other)

    def __rsub__(self, other: Any) -> Any:
        return _np.subtract(other, self)

    def __mul__(self, other: Any) -> Any:
        return _np.multiply(self, other)

    def __rmul__(self, other: Any) -> Any:
        return _np.multiply(other, self)

    def __truediv__(self, other: Any) -> Any:
        return _np.divide(self, other)

    def __rtruediv__(self, other: Any) -> Any:
        return _np.divide(other, self)

    def __pow__(self, other: Any) -> Any:
        return _np.power(self, other)

    def __rpow__(self, other: Any) -> Any:
        return _np.power(other, self)

    def __neg__(self) -> Any:
        return _np.negative(self)

    def __abs__(self) -> Any:
        return _np.absolute(self)

    def __lt__(self, other: Any) -> Any:
        return _np.less(self, other)

    def __le__(self, other: Any) -> Any:
        return _np.less_equal(self, other)

    def __gt__(self, other: Any) -> Any:
        return _np.greater(self, other)

    def __ge__(self, other: Any) -> Any:
        return _np.greater_equal(self, other)

    def __eq__(self, other: object) -> Any:
        return _np.equal(self, other)

    __hash__ = object.__hash__


def number(value: Any) -> Any:
    """Return a float, or a traced number as it is."""
    return value if isinstance(value, Traced) else float(value)


def total(values: Iterable[Any]) -> Any:
    """Return the sum of numbers, exact to the last digit unless one of them is traced."""
    every = list(values)
    if any(isinstance(one, Traced) for one in every):
        return functools.reduce(operator.add, every)
    return math.fsum(every)


def _value(one: Any) -> Any:
    return one.value if isinstance(one, Traced) else one


def _written(one: Any, places: Mapping[int, str]) -> str:
    if isinstance(one, Traced):
        place = places.get(id(one))
        return one.formula(places) if place is None else place
    number = float(one)
    if np.isnan(number):
        return "NA()"
    return f"({number!r})" if number < 0.0 else f"{number!r}".upper().removesuffix(".0")


def _where(condition: Any, yes: Any, no: Any) -> Any:
    if not isinstance(condition, Traced):
        return yes if condition else no
    chosen = _value(yes) if condition.value else _value(no)
    return Traced(chosen, "IF({},{},{})", condition, yes, no)


def _interp(x: Any, places: Any, values: Any) -> Any:
    """Straight lines between points: the sum of what each piece adds, up to where ``x`` lies."""
    slopes = np.diff(values) / np.diff(places)
    operation = _written(values[0], {})
    for begin, end, slope in zip(places[:-1], places[1:], slopes, strict=True):
        begin, end, slope = (_written(number, {}) for number in (begin, end, slope))
        operation += f"+{slope}*(MIN(MAX({{0}},{begin}),{end})-{begin})"
    return Traced(np.interp(x.value, places, values), f"({operation})", x)


_FUNCTIONS |= {
    np.where: _where,
    np.interp: _interp,
    np.ndim: lambda one: one.ndim,
    np.shape: lambda one: (),
    np.ones_like: lambda one: 1.0,
}

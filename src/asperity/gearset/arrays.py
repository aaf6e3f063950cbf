"""Relations between positive numbers, applied to numbers or arrays."""

import functools
import inspect
import math
from collections.abc import Callable
from typing import Any, ParamSpec, TypeAlias

import numpy as np
import numpy.typing as npt

from asperity.errors import InputError

P = ParamSpec("P")
FloatArray = npt.NDArray[np.float64]
Real: TypeAlias = Any
"""A number, or an array of numbers."""

_SIGNED = {"profile_shift"}


def plain(value: Any) -> Any:
    """Return an array as it is, and anything without dimensions as a Python float."""
    return value if np.ndim(value) else float(value)


def checked(name: str, value: Real) -> FloatArray:
    """Return an argument as an array of floats; raises InputError where it is not allowed.

    Everything is positive but a profile shift, and an angle (``..._angle``, rad) is below 90 deg.
    """
    try:
        array = np.asarray(value, dtype=np.float64)
    except (TypeError, ValueError):
        raise InputError(f"{name} is {str(value)[:60]!r}; it must be a number") from None
    lower = -math.inf if name in _SIGNED else 0.0
    upper = math.pi / 2.0 if name.endswith("_angle") else math.inf
    inside = (array > lower) & (array < upper)
    if not inside.all():
        allowed = {
            (0.0, math.inf): "positive",
            (-math.inf, math.inf): "finite",
        }.get((lower, upper), "an angle between 0 and 90 deg, in rad")
        raise InputError(f"{name} is {array[~inside].flat[0]:g}; it must be {allowed}")
    return array


def relation(formula: Callable[P, Any]) -> Callable[P, Any]:
    """Make a formula over arrays take numbers or arrays, and check its arguments.

    It returns a float for numbers. A result that is not finite is an InputError.
    """
    signature = inspect.signature(formula)
    unchecked: Callable[..., Any] = formula

    @functools.wraps(formula)
    def apply(*args: P.args, **kwargs: P.kwargs) -> Any:
        bound = signature.bind(*args, **kwargs)
        given = {name: checked(name, value) for name, value in bound.arguments.items()}
        try:
            with np.errstate(all="ignore"):
                result = unchecked(**given)
        except ValueError:
            shapes = ", ".join(f"{name} {array.shape}" for name, array in given.items())
            raise InputError(f"the shapes {shapes} do not go together; make them equal") from None
        if not np.isfinite(result).all():
            raise InputError(
                f"{formula.__name__} is not defined for the numbers given; they are too large or "
                "too small together"
            )
        return plain(result)

    return apply

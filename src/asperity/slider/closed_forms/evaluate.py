"""Formulas applied to numbers or arrays that may hold nonsense."""

from collections.abc import Callable
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from asperity.arrays import FloatArray
from asperity.errors import InputError

Invalid = Literal["raise", "mask"]

NOT_FINITE = 1
TOO_SMALL = 2
TOO_LARGE = 3
POSITIVE = float(np.nextafter(0.0, 1.0))

# The formulas hold fourth powers of a velocity ratio, which are to stay among the floats.
_LARGEST = 1e50


def evaluate(
    formula: Callable[..., FloatArray], on_invalid: Invalid, **given: tuple[npt.ArrayLike, float]
) -> Any:
    """Apply a formula to numbers or arrays, each with its least allowed value."""
    if on_invalid not in ("raise", "mask"):
        raise InputError(f"on_invalid is {on_invalid!r}; it must be 'raise' or 'mask'")
    arrays: list[FloatArray] = []
    for name, (value, _) in given.items():
        try:
            arrays.append(np.asarray(value, dtype=np.float64))
        except (TypeError, ValueError):
            raise InputError(
                f"{name} is {str(value)[:60]!r}; it must be a number or an array"
            ) from None
    try:
        arrays = list(np.broadcast_arrays(*arrays))
    except ValueError:
        shapes = ", ".join(f"{name} {a.shape}" for name, a in zip(given, arrays, strict=True))
        raise InputError(f"the shapes {shapes} do not go together; make them equal") from None
    reason = np.zeros(arrays[0].shape, dtype=np.int8)
    for (name, (_, least)), array in zip(given.items(), arrays, strict=True):
        here = np.select(
            [~np.isfinite(array), array < least, array > _LARGEST],
            [NOT_FINITE, TOO_SMALL, TOO_LARGE],
            0,
        )
        if (on_invalid == "raise" or array.ndim == 0) and here.any():
            bound = {0.0: "zero or positive", POSITIVE: "positive"}.get(least, "finite")
            if here[here > 0].flat[0] == TOO_LARGE:
                bound = f"at most {_LARGEST:g}"
            raise InputError(f"{name} is {array[here > 0].flat[0]:g}; it must be {bound}")
        reason = np.where(reason == 0, here, reason)
    valid = reason == 0
    values = np.empty(reason.shape)
    values[valid] = formula(*(array[valid] for array in arrays))
    if values.ndim == 0:
        return float(values)
    if on_invalid == "raise":
        return values
    values[~valid] = reason[~valid]
    return np.ma.MaskedArray(values, mask=~valid)

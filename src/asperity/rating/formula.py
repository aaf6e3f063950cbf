"""Formulas of a standard applied to numbers, or to arrays that may hold nonsense."""

import dataclasses
import math
from collections.abc import Callable
from typing import Any

import numpy as np
import numpy.typing as npt

from asperity.arrays import FloatArray
from asperity.errors import InputError
from asperity.formulas import Invalid, Masked, current_mask

__all__ = ["Argument", "FloatArray", "Invalid", "Masked", "angle", "evaluate", "positive"]

NOT_A_RESULT = 1
"""Reason code of an element whose arguments are each allowed, but not together."""


@dataclasses.dataclass(frozen=True)
class Argument:
    """An argument of a formula, with what is allowed.

    Parameters
    ----------
    name : str
        The parameter as a message begins with it.
    value : array_like
        What was given.
    unit : str
        Its unit; ``""`` for a ratio.
    lower, upper : float
        Bounds in this unit, both included.
    above : bool
        Whether the lower bound itself is excluded.
    because : str
        Who sets the bounds, or what to do about it; stands at the end of the message.
    scale : float
        The formula gets the value times this.
    error : type of InputError
        What to raise.
    """

    name: str
    value: npt.ArrayLike
    unit: str = ""
    lower: float = -math.inf
    upper: float = math.inf
    above: bool = False
    because: str = ""
    scale: float = 1.0
    error: type[InputError] = InputError

    def array(self) -> FloatArray:
        """Return the values as floats."""
        given = np.asarray(self.value)
        if given.dtype.kind not in "fiu":
            raise InputError(f"{self.name} is {str(self.value)[:60]!r}; it must be a number")
        return given.astype(np.float64, copy=False)

    def allowed(self) -> str:
        """Return what is allowed, as the end of a sentence."""
        unit = f" {self.unit}" if self.unit else ""
        if math.isinf(self.upper):
            if self.lower == 0.0:
                text = "positive" if self.above else "zero or positive"
            elif math.isinf(self.lower):
                text = "finite"
            else:
                text = f"{'above' if self.above else 'at least'} {self.lower:.6g}{unit}"
        elif math.isinf(self.lower):
            text = f"at most {self.upper:.6g}{unit}"
        elif self.above:
            text = f"above {self.lower:.6g} and at most {self.upper:.6g}{unit}"
        else:
            text = f"from {self.lower:.6g} to {self.upper:.6g}{unit}"
        return f"it must be {text}{'; ' if self.because else ''}{self.because}"

    def outside(self, values: FloatArray) -> npt.NDArray[np.bool_]:
        """Return where values are not allowed."""
        above_lower = values > self.lower if self.above else values >= self.lower
        # Comparisons with NaN are false, so that NaN lies outside too.
        inside: npt.NDArray[np.bool_] = above_lower & (values <= self.upper) & np.isfinite(values)
        return ~inside


def positive(name: str, value: npt.ArrayLike, unit: str = "", scale: float = 1.0) -> Argument:
    """Return an argument that must be above zero."""
    return Argument(name, value, unit, 0.0, above=True, scale=scale)


def angle(name: str, value: npt.ArrayLike) -> Argument:
    """Return an argument between 0 and 90 degrees, given in radians."""
    below = float(np.nextafter(math.pi / 2.0, 0.0))
    return Argument(name, value, "rad", 0.0, below, above=True)


def _evaluate(
    formula: Callable[..., Any],
    *arguments: Argument,
    on_invalid: Invalid = "raise",
    scale: float = 1.0,
    result: str = "the result",
    accept: Callable[[FloatArray], npt.NDArray[np.bool_]] = np.isfinite,
    because: str = "the numbers given are too large or too small together",
) -> Any:
    """Apply a formula to numbers or arrays.

    Parameters
    ----------
    formula : callable
        Takes arrays of floats, one for each argument.
    *arguments : Argument
        What was given.
    on_invalid : {'raise', 'mask'}
        What to do with elements of arrays that are not allowed. A number always raises.
    scale : float
        The result is the formula's value times this.
    result : str
        The result as a message begins with it.
    accept : callable
        Which values of the formula are results.
    because : str
        The end of the message about those that are not.

    Returns
    -------
    float, ndarray or Masked
        A float for numbers, else an array of the common shape; with ``on_invalid="mask"`` the
        array and its reasons.

    Raises
    ------
    InputError
        Something given is not a number or not allowed.
    """
    if on_invalid not in ("raise", "mask"):
        raise InputError(f"on_invalid is {on_invalid!r}; it must be 'raise' or 'mask'")
    arrays = [argument.array() for argument in arguments]
    try:
        shape = np.broadcast_shapes(*(array.shape for array in arrays))
    except ValueError:
        shapes = ", ".join(f"{a.name} {v.shape}" for a, v in zip(arguments, arrays, strict=True))
        raise InputError(f"the shapes {shapes} do not go together; make them equal") from None
    masking = on_invalid == "mask" and shape != ()
    reason = np.zeros(shape if masking else (), dtype=np.int16)
    for code, (argument, array) in enumerate(zip(arguments, arrays, strict=True), NOT_A_RESULT + 1):
        outside = argument.outside(array)
        if not outside.any():
            continue
        if not masking:
            unit = f" {argument.unit}" if argument.unit else ""
            given = f"{array[outside].flat[0]:.6g}{unit}"
            raise argument.error(f"{argument.name} is {given}; {argument.allowed()}")
        reason = np.where((reason == 0) & outside, code, reason).astype(np.int16)
    valid = reason == 0
    if not valid.all():
        arrays = [np.broadcast_to(array, shape)[valid] for array in arrays]
    given_to = [
        array if argument.scale == 1.0 else array * argument.scale
        for argument, array in zip(arguments, arrays, strict=True)
    ]
    with np.errstate(all="ignore"):
        values = np.asarray(formula(*given_to), dtype=np.float64) * scale
        accepted = np.isfinite(values) & accept(values)
    if not masking:
        if not accepted.all():
            raise InputError(f"{result} is not defined: {because}")
        if shape == ():
            return float(values)
        return values if values.shape == shape else np.broadcast_to(values, shape).copy()
    everything = np.full(shape, np.nan)
    where = ... if valid.all() else valid
    everything[where] = np.where(accepted, values, np.nan)
    reason[where] = np.where(accepted, 0, NOT_A_RESULT)
    legend = {NOT_A_RESULT: f"{result} is not defined: {because}"}
    for code, argument in enumerate(arguments, NOT_A_RESULT + 1):
        legend[code] = f"{argument.name} is not allowed; {argument.allowed()}"
    return Masked(everything, reason, legend)


def evaluate(formula: Callable[..., Any], *arguments: Argument, **options: Any) -> Any:
    """Apply a formula to numbers or arrays; within `asperity.formulas.masking` without raising."""
    mask = current_mask()
    if mask is None or options.get("on_invalid") == "mask":
        return _evaluate(formula, *arguments, **options)
    numbers = [argument.value for argument in arguments if not np.ndim(argument.value)]
    if mask.legend and any(number != number for number in numbers):
        return math.nan
    try:
        answer = _evaluate(formula, *arguments, **{**options, "on_invalid": "mask"})
    except InputError as error:
        mask.refuse(True, str(error))
        return math.nan
    if not isinstance(answer, Masked):
        return answer
    for code in np.unique(answer.reason[answer.reason != 0]):
        mask.refuse(answer.reason == code, answer.legend[int(code)])
    return answer.values

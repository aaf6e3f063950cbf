"""Formulas applied one after another, to one gearset or to arrays that may hold nonsense."""

from collections.abc import Callable
from typing import Any

import numpy as np
import numpy.typing as npt

from asperity.errors import InputError
from asperity.gearset import oil
from asperity.rating.formula import Masked

Reasons = npt.NDArray[np.int16]


def directly(formula: Callable[..., Any], *arguments: Any, **options: Any) -> Any:
    """Apply a formula to numbers; what is not allowed raises."""
    return formula(*arguments, **options)


def smaller(one: Any, other: Any) -> Any:
    """Return the smaller of two numbers, or of each pair of two arrays."""
    least = np.minimum(one, other)
    return least if np.ndim(least) else float(least)


class Masking:
    """Apply formulas to arrays, and remember why the first of them that has no answer has none.

    Parameters
    ----------
    shape : tuple of int
        Of the variants.

    Attributes
    ----------
    reason : ndarray of int
        0 where there is an answer, else a code.
    legend : dict of int to str
        The codes as sentences.
    """

    def __init__(self, shape: tuple[int, ...]) -> None:
        self.reason: Reasons = np.zeros(shape, dtype=np.int16)
        self.legend: dict[int, str] = {}

    def copy(self) -> "Masking":
        """Return another that goes on from here."""
        other = Masking(self.reason.shape)
        other.reason, other.legend = self.reason.copy(), dict(self.legend)
        return other

    def mask(self, where: npt.ArrayLike, sentence: str) -> None:
        """Give a reason where there is none yet."""
        new = np.broadcast_to(np.asarray(where), self.reason.shape) & (self.reason == 0)
        if new.any():
            code = next((c for c, known in self.legend.items() if known == sentence), None)
            if code is None:
                code = len(self.legend) + 1
                self.legend[code] = sentence
            self.reason[new] = code

    def __call__(self, formula: Callable[..., Any], *arguments: Any, **options: Any) -> Any:
        """Return what a formula gives, NaN where it has no answer."""
        try:
            answer = formula(*arguments, on_invalid="mask", **options)
        except InputError as error:
            # Only numbers that are the same for all variants raise.
            self.mask(True, str(error))
            return np.nan
        return self.unwrap(answer)

    def unwrap(self, answer: Any) -> Any:
        """Return the values of an answer, and take over its reasons."""
        if not isinstance(answer, Masked | oil.Masked):
            return answer
        for code in np.unique(answer.reason[answer.reason != 0]):
            self.mask(answer.reason == code, answer.legend[int(code)])
        return answer.values

    def spread(self, value: Any) -> npt.NDArray[np.float64]:
        """Return a value for every variant, NaN where there is no answer."""
        everywhere = np.array(np.broadcast_to(value, self.reason.shape), dtype=np.float64)
        everywhere[self.reason != 0] = np.nan
        return everywhere

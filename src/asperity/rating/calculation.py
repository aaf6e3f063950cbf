"""Formulas applied one after another, to one gearset or to arrays that may hold nonsense."""

from collections.abc import Callable, Mapping
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


class Collecting:
    """Apply formulas to numbers, go on without those that have no answer, and remember why.

    Attributes
    ----------
    notes : list of str
        Why a formula has no answer; nothing about those that would have needed it.
    """

    def __init__(self) -> None:
        self.notes: list[str] = []

    def __call__(self, formula: Callable[..., Any], *arguments: Any, **options: Any) -> Any:
        """Return what a formula gives, NaN where it has no answer."""
        if any(isinstance(argument, float) and argument != argument for argument in arguments):
            return np.nan
        try:
            return formula(*arguments, **options)
        except InputError as error:
            self.notes.append(str(error))
            return np.nan


def smaller(one: Any, other: Any) -> Any:
    """Return the smaller of two numbers, or of each pair of two arrays."""
    least = np.minimum(one, other)
    return least if np.ndim(least) else float(least)


class Masking:
    """Apply formulas to arrays, and remember which was the first without an answer.

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
        # A single variant too is an array here, because numbers raise.
        self.reason: Reasons = np.zeros(shape or (1,), dtype=np.int16)
        self.legend: dict[int, str] = {}

    def copy(self) -> "Masking":
        """Return another that goes on from here."""
        other = Masking(self.shape)
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
        """Return what a formula gives, NaN where it has no answer or gets none."""
        try:
            answer = formula(*arguments, on_invalid="mask", **options)
        except InputError as error:
            # Only numbers that are the same for all variants raise.
            self.mask(True, str(error))
            return np.nan
        if isinstance(answer, Masked | oil.Masked):
            self.take_over(answer.reason, answer.legend)
            return answer.values
        return answer

    def take_over(self, reason: npt.ArrayLike | None, legend: Mapping[int, str]) -> None:
        """Take over the reasons of an answer."""
        codes = np.asarray(0 if reason is None else reason)
        for code in np.unique(codes[codes != 0]):
            self.mask(codes == code, legend[int(code)])

    @property
    def shape(self) -> tuple[int, ...]:
        """Of the reasons."""
        return self.reason.shape

"""Where a number comes from, how far it can be trusted, and where a formula stops being valid."""

import dataclasses
import math
from typing import Literal, get_args

import numpy as np
import numpy.typing as npt

from asperity.errors import InputError, is_plain, one_of, shown

Confidence = Literal["verified", "one source", "own choice", "from memory"]

CONFIDENCES: tuple[str, ...] = get_args(Confidence)
"""How far a number can be trusted, the surest first."""


@dataclasses.dataclass(frozen=True)
class Source:
    """Where a number or a formula comes from.

    Parameters
    ----------
    name : str
        The document, such as ``"ISO/TR 14521:2010"``.
    confidence : {'verified', 'one source', 'own choice', 'from memory'}
        Agreed upon by two public sources or by a reproduced number; found in one public source;
        a bound, default or rule of our own, which needs no document; not checked against any.
    note : str, optional
        What else a reader should know, such as a value taken from a similar thing.

    Examples
    --------
    >>> print(Source("BS 721-2:1983", "from memory"))
    BS 721-2:1983 (from memory)
    """

    name: str
    confidence: Confidence
    note: str = ""

    def __post_init__(self) -> None:
        if not self.name:
            raise InputError("the source has no name; name the document a number comes from")
        for key, text in (("name", self.name), ("note", self.note)):
            if not (isinstance(text, str) and is_plain(text)):
                raise InputError(f"{key} is {shown(text)}; it must be one line of text")
        if self.confidence not in CONFIDENCES:
            raise InputError(
                f"confidence is {shown(self.confidence)}; {one_of(CONFIDENCES, self.confidence)}"
            )

    def __str__(self) -> str:
        return f"{self.name} ({self.confidence}{'; ' if self.note else ''}{self.note})"


def weakest(*sources: Source) -> Source:
    """Return the source that can be trusted least, the first one of equals."""
    return max(sources, key=lambda source: CONFIDENCES.index(source.confidence))


@dataclasses.dataclass(frozen=True)
class Range:
    """Where a formula or a table is valid.

    Parameters
    ----------
    name : str
        The quantity as a sentence begins with it, such as ``"centre distance a"``.
    lower, upper : float
        Bounds, both included; infinite where there is none.
    unit : str
        Unit of the bounds; ``""`` for a ratio.
    source : Source
        Who says so.

    Examples
    --------
    >>> span = Range("centre distance a", 65, 250, "mm", Source("ISO/TR 14521:2010", "one source"))
    >>> span.violation(60.17)
    'centre distance a is 60.17 mm; ISO/TR 14521:2010 is valid from 65 to 250 mm'
    >>> span.violation(100) is None
    True
    """

    name: str
    lower: float
    upper: float
    unit: str
    source: Source

    def __post_init__(self) -> None:
        if not self.lower < self.upper:
            raise InputError(
                f"{self.name}: the lower bound is {self.lower:g}; it must be below the upper, "
                f"{self.upper:g}"
            )

    def holds(self, value: npt.ArrayLike) -> npt.NDArray[np.bool_]:
        """Return where the values lie inside."""
        given = np.asarray(value)
        inside: npt.NDArray[np.bool_] = (given >= self.lower) & (given <= self.upper)
        return inside

    def violation(self, value: float) -> str | None:
        """Return a sentence that says how a value lies outside; None inside."""
        if self.holds(value):
            return None
        unit = f" {self.unit}" if self.unit else ""
        if math.isinf(self.upper):
            allowed = f"from {self.lower:g}{unit}"
        elif math.isinf(self.lower):
            allowed = f"up to {self.upper:g}{unit}"
        else:
            allowed = f"from {self.lower:g} to {self.upper:g}{unit}"
        return f"{self.name} is {value:g}{unit}; {self.source.name} is valid {allowed}"

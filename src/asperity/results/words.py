"""Texts with numbers in them that keep all their digits and their keys."""

from collections.abc import Iterable
from typing import Any, Self

_DIGITS = 5


class Number(str):
    """A number as it is shown, which knows all its digits and its key in JSON.

    What is shown may be so many ``times`` as large, as percent are.
    """

    value: float
    key: str
    times: float

    def __new__(cls, text: str, value: float, key: str = "", times: float = 1.0) -> Self:
        """Return a text that stands for a value."""
        made = super().__new__(cls, text)
        made.value, made.key, made.times = value, key, times
        return made

    @classmethod
    def of(cls, value: float, form: str, key: str = "", times: float = 1.0) -> Self:
        """Return a value by a format."""
        return cls(format(times * value, form), float(value), key, times)


class Sentence(str):
    """A text with numbers in it, which pages mark as such."""

    parts: tuple[str, ...]

    def __new__(cls, *parts: str) -> Self:
        """Return texts and numbers as one text."""
        made = super().__new__(cls, "".join(parts))
        made.parts = tuple(p for part in parts for p in getattr(part, "parts", (part,)))
        return made

    @classmethod
    def joined(cls, parts: Iterable[str], between: str = ", ") -> Self:
        """Return texts with another one between them."""
        found = [piece for part in parts for piece in (between, part)]
        return cls(*found[1:])


def text_of(value: Any, resolution: float = 0.0, key: str = "") -> str:
    """Return a value as a table shows it.

    Parameters
    ----------
    value : object
        A number, text, truth, a list of them or None.
    resolution : float
        A number that is not larger is rounding: it is shown as zero within that.
    key : str
        In JSON, for a number.
    """
    if isinstance(value, str):
        return value
    if value is None:
        return "-"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        if value != value:
            return "-"
        if abs(value) <= resolution and value:
            return Sentence("0 within ", Number(f"{resolution:.0g}", resolution))
        return Number(f"{value + 0.0:.{_DIGITS}g}", float(value), key)
    if isinstance(value, int):
        return Number(str(value), value, key)
    if isinstance(value, list | tuple):
        return Sentence.joined(
            text_of(entry, resolution, f"{key}.{place}" if key else "")
            for place, entry in enumerate(value)
        )
    return str(value)

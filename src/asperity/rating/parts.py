"""What parts beside the gearset come to, as shafts and bearings: a row each below the verdict."""

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

from asperity.rating.standing import wrapped
from asperity.results.quantity import Number, Sentence


class PartRow(NamedTuple):
    """What there is of what is asked.

    Attributes
    ----------
    name : str
        Of the part.
    standard : str
        By which.
    value, asked : float
        A safety, or a life in h.
    unit : str
        ``"h"`` of a life.
    by : str
        Where and in which case.
    """

    name: str
    standard: str
    value: float
    asked: float
    unit: str
    by: str

    @property
    def holds(self) -> bool:
        """Whether it is enough."""
        return self.value >= self.asked

    def to_json(self) -> dict[str, Any]:
        """Return it by key."""
        key = "life_h" if self.unit else "safety"
        return {
            "name": self.name,
            "standard": self.standard,
            key: self.value if math.isfinite(self.value) else None,
            f"asked{'_h' if self.unit else ''}": self.asked,
            "holds": self.holds,
            "by": self.by,
        }

    def said(self, key: str = "") -> Sentence:
        """Return it in a line; its number by where it stands in an answer's JSON."""
        unit = f" {self.unit}" if self.unit else ""
        number = Number.of(self.value, ".3g", key and f"{key}.{'life_h' if unit else 'safety'}")
        fails = "" if self.holds else "  FAILS"
        return Sentence(
            f"{self.standard} {self.name}: ", number, f"{unit} of {self.asked:g}{unit}{fails}; ",
            self.by,
        )  # fmt: skip


def part_lines(rows: Sequence[PartRow]) -> list[str]:
    """Return what parts come to in lines for a terminal; none without a row."""
    if not rows:
        return []
    failing = [row.name for row in rows if not row.holds]
    verdict = f"do not hold: {', '.join(failing)}" if failing else "hold"
    lines = wrapped(f"shafts and bearings {verdict}")
    return lines + [line for row in rows for line in wrapped(f"- {row.said()}")]

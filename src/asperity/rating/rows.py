"""A row of the verdict that comes from outside the three standards: a shaft, a bearing."""

import math
from typing import Any, NamedTuple

from asperity.results.language import Spoken, said


class Row(NamedTuple):
    """What there is of what is asked.

    Attributes
    ----------
    name, standard : str
        Of what, and by which standard.
    value, asked : float
        A safety, or a life in h.
    unit : str
        ``"h"`` of a life; empty of a safety.
    by : str
        What decides on it.
    """

    name: str
    standard: str
    value: float
    asked: float
    unit: str = ""
    by: str = ""

    @property
    def margin(self) -> float:
        """What there is over what is asked."""
        return self.value / self.asked

    @property
    def holds(self) -> bool:
        """Whether it is enough."""
        return self.value >= self.asked

    @property
    def line(self) -> str:
        """It in a line of the screen."""
        fails = "" if self.holds else f"  {said('FAILS')}"
        stands = f"{self.value:.3g}{self._unit} {said('of')} {self.asked:.4g}{fails}"
        by = f"; {said(self.by)}" if self.by else ""
        return Spoken(f"{f'{self.standard} {said(self.name)}':24} {stands}{by}")

    @property
    def stands(self) -> str:
        """What there is of what is asked."""
        return f"{self.value:.3g}{self._unit} of the {self.asked:.4g} asked"

    @property
    def _unit(self) -> str:
        return f" {self.unit}" if self.unit else ""

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

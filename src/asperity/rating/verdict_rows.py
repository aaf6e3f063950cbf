"""A row of the verdict that comes from outside the three standards: a shaft, a bearing."""

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol

from asperity.results.language import Spoken, said
from asperity.results.table import Column, Table
from asperity.results.words import Number, Sentence, text_of

if TYPE_CHECKING:
    from asperity.gearset.answer import Views
    from asperity.rating.inputs import Inputs, Values
    from asperity.results.formula_sheets import Cells


class Shafts(Protocol):
    """What others than the standards know of the shafts of the same gearbox."""

    @property
    def lacking(self) -> tuple[str, ...]:
        """What is to be said of what they lack."""

    def both_views(self) -> "Views":
        """Return both views of the gearset with its shafts, each as SVG with its caption."""

    def sheets(
        self, cells: "Cells", inputs: "Inputs", iso: "Values"
    ) -> Mapping[str, list[tuple[Any, ...]]]:
        """Return the rows of a sheet for each shaft, its numbers found from traced inputs."""


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
        return Spoken(f"{f'{said(self.standard)} {said(self.name)}':24} {stands}{by}")

    @property
    def stands(self) -> str:
        """What there is of what is asked."""
        return f"{self.value:.3g}{self._unit} of the {self.asked:.4g} asked"

    def nearest(self, key: str = "") -> Sentence:
        """Return in a sentence that it is what is nearest to its limit, or fails first.

        Parameters
        ----------
        key : str
            Where it stands in JSON.
        """
        value = f"{key}.{'life_h' if self.unit else 'safety'}" if key else ""
        asked = f"{key}.asked{'_h' if self.unit else ''}" if key else ""
        return Sentence(
            f"{'nearest to its limit' if self.holds else 'first to fail'}: {self.name} by "
            f"{self.standard}, ", Number.of(self.value, ".3g", value), f"{self._unit} of the ",
            Number.of(self.asked, ".4g", asked), " asked",
        )  # fmt: skip

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


def beside(rows: Sequence[Row]) -> list[Table]:
    """Return what stands besides the standards as a table; none where there is nothing.

    Parameters
    ----------
    rows : sequence of Row
        Of a verdict, in its order.
    """
    if not rows:
        return []
    made = []
    for place, row in enumerate(rows):
        key = f"verdict.rows.{place}.{'life_h' if row.unit else 'safety'}"
        value = text_of(row.value, key=key) if math.isfinite(row.value) else "-"
        name = Spoken(f"{said(row.standard)} {said(row.name)}")
        stands = "holds" if row.holds else "FAILS"
        made.append((name, value, f"{row.asked:.4g}", row.unit, row.by, stands))
    columns = (
        Column("besides the standards"), Column("value", right=True), Column("asked", right=True),
        Column("unit"), Column("by", folds=True), Column(""),
    )  # fmt: skip
    return [Table(columns, tuple(made))]

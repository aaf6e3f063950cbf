"""Answers about a worm gearset, whose reports begin with a drawing of it to scale."""

from pathlib import Path
from typing import Any

from asperity.gearset.drawing import along_the_wheel, through_the_wheel
from asperity.gearset.geometry import Geometry
from asperity.results import Result
from asperity.results.report import Picture, Section

Views = tuple[tuple[str, str], tuple[str, str]]
"""Two views of a gearset, each as SVG with its caption."""


class Drawn(Result):
    """Base of answers about a worm gearset: they tell its geometry, and draw it."""

    @property
    def geometry(self) -> Geometry:
        """What follows from the gearset's numbers."""
        raise NotImplementedError

    @property
    def hand(self) -> str:
        """Of the worm: right or left."""
        raise NotImplementedError

    def to_json(self) -> dict[str, Any]:
        """Return the scalars by key, each key with its unit, the notes and the geometry."""
        return super().to_json() | {"geometry": self.geometry.to_json()}

    def both_views(self) -> Views:
        """Return both views of it, each as SVG with its caption."""
        return views_of(self.geometry, self.hand)

    def sections(self, folder: Path | None = None) -> tuple[Section, ...]:
        """Return what its report says, the gearset drawn to scale ahead of the results."""
        heading, *others = super().sections(folder)
        return heading, drawn(self.both_views()), *others


def views_of(g: Geometry, hand: str = "right") -> Views:
    """Return both views of a gearset without its shafts."""
    return along_the_wheel(g, hand), through_the_wheel(g)


def drawn(views: Views) -> Section:
    """Return the part of a report that draws a gearset along and through its wheel."""
    return Section("The gearset", pictures=tuple(Picture("", svg=v, caption=c) for v, c in views))

"""Answers about a worm gearset, whose reports begin with a drawing of it to scale."""

from pathlib import Path
from typing import Any

from asperity.gearset.drawing import along_the_wheel, through_the_wheel
from asperity.gearset.geometry import Geometry
from asperity.results import Result
from asperity.results.report import Picture, Section


class Drawn(Result):
    """Base of answers about a worm gearset: they tell its geometry, and draw it."""

    @property
    def geometry(self) -> Geometry:
        """What follows from the gearset's numbers."""
        raise NotImplementedError

    def to_json(self) -> dict[str, Any]:
        """Return the scalars by key, each key with its unit, the notes and the geometry."""
        return super().to_json() | {"geometry": self.geometry.to_json()}

    def sections(self, folder: Path | None = None) -> tuple[Section, ...]:
        """Return what its report says, the gearset drawn to scale ahead of the results."""
        heading, *others = super().sections(folder)
        return heading, drawn(self.geometry), *others


def drawn(g: Geometry) -> Section:
    """Return the part of a report that draws a gearset along and through its wheel."""
    views = (along_the_wheel(g), through_the_wheel(g))
    return Section("The gearset", pictures=tuple(Picture("", svg=v, caption=c) for v, c in views))

"""Arrangements of the worm's bearings."""

from collections.abc import Mapping
from typing import Annotated, ClassVar

from pydantic import Field

from asperity.casefile import Table
from asperity.gearset.library import GIVEN, Files, find
from asperity.sources import Source
from asperity.units import Quantity


class Bearings(Table):
    r"""Arrangement of the worm's bearings.

    Parameters
    ----------
    name : str
        As it appears in results.
    loss_coefficient : float
        Factor of :math:`P_2 a^{0.44} u/d_{m2}` (W, mm) in the bearing loss of ISO/TR 14521.
    sources : mapping of str to Source
        Where each value comes from, by key.
    """

    table: ClassVar[str] = "bearings"

    name: str = ""
    loss_coefficient: Annotated[float, Quantity("", what="a factor", example="0.013", gt=0)]
    sources: Annotated[Mapping[str, Source], Field(exclude=True)] = {}

    def source(self, key: str) -> Source:
        """Return where a value comes from."""
        return self.sources.get(key, GIVEN)


def bearings(name: str, files: Files = ()) -> Bearings:
    """Return an arrangement by name, ``fixed-floating`` or ``preloaded`` or your own."""
    return find("bearings", name, Bearings, files)

"""Arrangements of the worm's bearings."""

from typing import Annotated, ClassVar

from asperity.gearset.library import Sourced
from asperity.units import Quantity


class Bearings(Sourced):
    r"""Arrangement of the worm's bearings, by name ``fixed-floating`` or ``preloaded``.

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
    section: ClassVar[str] = "bearings"

    loss_coefficient: Annotated[float, Quantity("", what="a factor", example="0.013", gt=0)]

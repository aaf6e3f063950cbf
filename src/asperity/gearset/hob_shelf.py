"""Hobs that somebody has: what of a gearset each of them settles."""

import math
from collections.abc import Iterable
from typing import Annotated, ClassVar, Literal, NamedTuple

from pydantic import Field

from asperity.errors import InputError
from asperity.gearset.geometry import Flank
from asperity.gearset.library import Sourced, every
from asperity.gearset.parameters import Gearset
from asperity.sources import Source
from asperity.units import Quantity

_Length = Annotated[float, Quantity("m", what="a length", example="4 mm", gt=0, le=1)]
_Angle = Annotated[float, Quantity("rad", what="an angle", example="20 deg", gt=0, lt=0.7853981)]
_SAME = 1e-6

PAIRS = {
    1.25: (20.0, 22.4), 1.6: (20.0, 28.0), 2.0: (22.4, 35.5), 2.5: (28.0, 45.0),
    3.15: (35.5, 56.0), 4.0: (40.0, 71.0), 5.0: (50.0, 90.0), 6.3: (63.0, 112.0),
    8.0: (80.0, 140.0), 10.0: (90.0, 160.0), 12.5: (112.0, 200.0), 16.0: (140.0, 250.0),
}  # fmt: skip
"""Axial modules and reference diameters of worms, mm, as DIN 3976 pairs them (from memory)."""

PAIRS_SOURCE = Source("DIN 3976", "from memory", "modules and diameters of worms in pairs")


class ShelfHob(Sourced):
    """A hob: it settles what the worm must have that meshes with what it cuts.

    Parameters
    ----------
    name : str
        As it appears in results.
    axial_module : float or str
        Of the worm it stands for, m.
    worm_pitch_diameter : float or str
        Reference diameter of that worm, m.
    starts : int, optional
        Left out: there is one for each number of starts.
    pressure_angle : float or str, optional
        In the normal section, rad. Left out: any.
    flank : {'ZI', 'ZA', 'ZN', 'ZK', 'ZC'}, optional
        Left out: any.
    hand : {'right', 'left'}, optional
        Left out: either.
    sources : mapping of str to Source
        Where each value comes from, by key.
    """

    table: ClassVar[str] = "hob"
    section: ClassVar[str] = "hob"

    axial_module: _Length
    worm_pitch_diameter: _Length
    starts: Annotated[int, Field(strict=True, ge=1, le=20)] | None = None
    pressure_angle: _Angle | None = None
    flank: Flank | None = None
    hand: Literal["right", "left"] | None = None

    def cuts(self, gearset: Gearset) -> bool:
        """Whether it has a gearset's angle, flank and hand."""
        angle = self.pressure_angle
        return (
            (angle is None or abs(angle - gearset.pressure_angle) < _SAME)
            and self.flank in (None, gearset.flank)
            and self.hand in (None, gearset.hand)
        )


class Blank(NamedTuple):
    """What a hob settles: module in mm, diameter factor, and starts, None of any number."""

    name: str
    module: float
    factor: float
    starts: int | None


def shelf(which: str, gearset: Gearset) -> tuple[Blank, ...] | None:
    """Return the hobs that a gearset may be cut with; None where any may be.

    Parameters
    ----------
    which : {'any', 'standard', 'own'}
        Any hob; those of the standard's pairs of module and diameter; those of data files.
    gearset : Gearset
        Whose pressure angle, flank and hand they must have.

    Raises
    ------
    InputError
        There is none on the shelf that has them.
    """
    if which == "any":
        return None
    if which == "standard":
        return tuple(
            Blank(f"{module:g} x {diameter:g}", module, diameter / module, None)
            for module, diameters in PAIRS.items()
            for diameter in diameters
        )
    owned = every(ShelfHob)
    if not owned:
        raise InputError(
            'requirements.hobs is "own", but no data file has a hob: name one with tables such as '
            '[hob."4 x 40"], as asperity --materials FILE size'
        )
    found = tuple(
        Blank(hob.name, 1e3 * hob.axial_module, hob.worm_pitch_diameter / hob.axial_module,
              hob.starts)
        for hob in owned
        if hob.cuts(gearset)
    )  # fmt: skip
    if not found:
        raise InputError(
            f'requirements.hobs is "own", but none of the {len(owned)} has the pressure angle, '
            f"flank {gearset.flank} and {gearset.hand} hand of the gearset: change it, or the shelf"
        )
    return found


def hob_of(hobs: Iterable[Blank], starts: int, module: float, factor: float) -> str:
    """Return the name of the hob that has a module in mm and a diameter factor, "" without one."""
    return next(
        (
            hob.name
            for hob in hobs
            if hob.starts in (None, starts)
            and math.isclose(hob.module, module)
            and math.isclose(hob.factor, factor)
        ),
        "",
    )

"""The tables that say how flanks are made and mounted: hob, grinding disc, modification, mount."""

import math
from typing import Annotated, ClassVar, Literal

from pydantic import BeforeValidator

from asperity.casefile import Table
from asperity.errors import InputError
from asperity.sources import Source
from asperity.units import Quantity, split_unit, to_si

_MILLIMETRES = 1e3
_LEAST_ROUNDING = 0.01

DISC_DIAMETER = 0.5
"""Diameter of the grinding disc of ZK and ZC, m, where none is given."""
DISC_PROFILE_RADIUS = 6.0
"""Radius of the disc's profile of ZC, in axial modules, where none is given."""
HOB_TIP_RADIUS = 0.25
"""Tip rounding of the hob, in axial modules, where none is given."""

SOURCES = {
    "disc.diameter": Source(
        "common practice",
        "from memory",
        "a new disc; one of 200 mm changes the flank of a worm of module 2 by a hundredth of a mm",
    ),
    "disc.profile_radius": Source("ISO/TR 10828", "from memory", "5 to 7 modules are common"),
    "hob.tip_radius": Source("common practice", "from memory"),
}
"""Where the values come from that are assumed when none is given."""


def _size(value: object) -> str:
    """Return a size in modules or a length, as one text whatever way it was written."""
    expected = "it must be a number of modules such as '0.25', or a length such as '0.5 mm'"
    parts = split_unit(value) if isinstance(value, str) else None
    try:
        if parts is not None and parts[1] not in ("", "%"):
            size, text = to_si(value, "m"), "{!r} m"
        else:
            size, text = to_si(value, ""), "{!r}"
    except InputError:
        raise InputError(expected) from None
    least = _LEAST_ROUNDING if text == "{!r}" else 0.0
    if not least <= size <= 1.0 or size == 0.0:
        raise InputError(
            f"it must be positive, and from {_LEAST_ROUNDING:g} to 1 in modules or at most 1 m"
        )
    return text.format(size)


_InModules = Annotated[
    float, Quantity("", what="a number", example="0.25", ge=_LEAST_ROUNDING, le=1.0)
]
_AsLength = Annotated[float, Quantity("m", what="a length", example="0.5 mm", gt=0, le=1.0)]
Size = Annotated[str, BeforeValidator(_size, json_schema_input_type=_InModules | _AsLength)]


def size_in_mm(size: str, module: float) -> float:
    """Return a size of a case file in mm, where it may be given in modules (mm)."""
    parts = split_unit(size)
    if parts is not None and parts[1]:
        return to_si(size, "m") * _MILLIMETRES
    return float(size) * module


def _angle(example: str, most: float) -> Quantity:
    """An angle of up to so many degrees to either side."""
    most = math.radians(most)
    return Quantity("rad", what="an angle", example=example, ge=-most, le=most)


def _length(example: str, **bounds: float) -> Quantity:
    return Quantity("m", what="a length", example=example, **bounds)


class Hob(Table):
    r"""The hob that cuts the wheel; left out, it is the worm with a longer thread.

    Parameters
    ----------
    oversize : float
        Ratio of the pitch diameters of hob and worm; 1 if left out. The centre distance at which
        the hob cuts follows.
    rule : {'normal-module', 'axial-module'}
        What an oversized hob has in common with the worm. With the normal module (left out) the
        lead angle becomes smaller; with the axial module the wheel bears near a face edge.
    tilt : float or str
        Angle that the hob is turned by about the common normal of the axes, rad ("2 deg" in a
        file); positive adds to its lead angle, for either hand.
    tip_radius : str, optional
        Rounding of its thread in the axial section: a number of axial modules ("0.25") or a length
        ("0.5 mm"). Left out: 0.25 modules, or as much as the thread's tip has room for.
    """

    table: ClassVar[str] = "hob"

    oversize: Annotated[
        float, Quantity("", what="a ratio of diameters", example="1.12", ge=1.0, le=2.0)
    ] = 1.0
    rule: Literal["normal-module", "axial-module"] = "normal-module"
    tilt: Annotated[float, _angle("2 deg", 20.0)] = 0.0
    tip_radius: Size | None = None


class Disc(Table):
    r"""The disc that grinds a ZK or ZC worm, straight-sided or with a convex arc as profile.

    Its axis stands at the worm's lead angle, and its middle plane cuts the worm in the normal
    section of the thread space. The hob's flanks are made with the same disc.

    Parameters
    ----------
    diameter : float or str
        Where the disc touches the pitch cylinder, m; 500 mm if left out.
    profile_radius : float or str, optional
        Radius of the arc of ZC, m. Left out: 6 axial modules.
    """

    table: ClassVar[str] = "disc"

    diameter: Annotated[float, _length("500 mm", gt=0, le=5.0)] = DISC_DIAMETER
    profile_radius: Annotated[float, _length("13 mm", gt=0, le=5.0)] | None = None


class Modification(Table):
    r"""How the worm's flanks deviate from those of its type, both alike; the hob's do not.

    Parameters
    ----------
    lead_correction : float or str
        Added to the lead angle at the pitch radius, rad ("0.05 deg" in a file). The pitch follows.
    tip_relief : float or str
        What is taken off at the tip, normal to the flank, m ("10 um" in a file).
    tip_relief_start : float
        Where the relief begins, as a fraction of the addendum: 0 at the pitch radius (the
        modification of a worm that drives a yielding wheel), 0.5 if left out. It grows with the
        third power of the distance from there, so that no edge arises.
    root_relief : float or str
        What is taken off at the root, normal to the flank, m ("10 um" in a file).
    root_relief_start : float, optional
        Where that begins, as a fraction of the dedendum: 0 at the pitch radius. Left out: as far
        out as the wheel's tips reach at the ends of its face, 0.5 at most. It begins and ends
        smoothly, with no step of slope or curvature: most of it is there where the wheel's throat
        reaches in mid-face, little where teeth end on its outside cylinder.
    tip_rounding : str
        Rounding of the thread's tip: a number of axial modules or a length; 0.05 modules if left
        out.
    """

    table: ClassVar[str] = "modification"

    lead_correction: Annotated[float, _angle("0.05 deg", 5.0)] = 0.0
    tip_relief: Annotated[float, _length("10 um", ge=0.0, le=1e-2)] = 0.0
    tip_relief_start: Annotated[
        float, Quantity("", what="a fraction of the addendum", example="0.5", ge=0.0, le=0.95)
    ] = 0.5
    root_relief: Annotated[float, _length("10 um", ge=0.0, le=1e-2)] = 0.0
    root_relief_start: (
        Annotated[
            float, Quantity("", what="a fraction of the dedendum", example="0.1", ge=0.0, le=0.95)
        ]
        | None
    ) = None
    tip_rounding: Size = "0.05"


class Mount(Table):
    r"""How the worm stands in the mesh; left out, where it should.

    Parameters
    ----------
    centre_distance_error : float or str
        Added to the centre distance, m.
    axial_offset : float or str
        Offset of the worm along the wheel's axis, m.
    shaft_angle_error : float or str
        Angle that the worm's axis is turned by about the common normal, rad, from the wheel's
        tangent towards the wheel's axis.
    backlash : float or str, optional
        Least play between worm and wheel, normal to the flanks, m; it is made by the thickness of
        the worm's threads. Left out: what hob and worm of nominal thickness leave.
    """

    table: ClassVar[str] = "mount"

    centre_distance_error: Annotated[float, _length("0.05 mm", ge=-0.01, le=0.01)] = 0.0
    axial_offset: Annotated[float, _length("0.1 mm", ge=-0.01, le=0.01)] = 0.0
    shaft_angle_error: Annotated[float, _angle("0.1 deg", 5.0)] = 0.0
    backlash: Annotated[float, _length("0.05 mm", ge=0.0, le=0.01)] | None = None


class MeasuringOptions(Table):
    r"""How worm and wheel are measured, and how far their teeth may be thinner than they should.

    Parameters
    ----------
    pin_diameter : float or str, optional
        Of the three pins over which the worm is measured, m. Left out: of a usual series, next to
        the one that touches the flanks at the reference diameter.
    ball_diameter : float or str, optional
        Of the balls over which the wheel is measured, m. Left out: of the same series, next to the
        one that touches the flanks at the mean circle.
    thread_tolerance : float or str, optional
        By how much the worm's threads may be thinner, normal to them, m. Left out: by the worm's
        reference diameter.
    tooth_tolerance : float or str, optional
        By how much the wheel's teeth may be thinner, normal to them, m. Left out: by the wheel's
        mean diameter.
    """

    table: ClassVar[str] = "measuring"

    pin_diameter: Annotated[float, _length("3.5 mm", gt=0, le=0.5)] | None = None
    ball_diameter: Annotated[float, _length("3.5 mm", gt=0, le=0.5)] | None = None
    thread_tolerance: Annotated[float, _length("0.03 mm", ge=0.0, le=0.01)] | None = None
    tooth_tolerance: Annotated[float, _length("0.05 mm", ge=0.0, le=0.01)] | None = None

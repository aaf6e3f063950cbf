"""What a wheel is beside its teeth: rim, web, hub and bore; and the table `[blank]` of both.

A section is points of radius and z, mm. The outside of a body lies to the left of the way along it,
seen with the radius to the right and the axis upwards.
"""

import dataclasses
import math
from typing import Annotated, ClassVar, Literal, Self

import numpy as np

from asperity.arrays import FloatArray
from asperity.casefile import Table
from asperity.errors import InputError
from asperity.gearset.geometry import Geometry
from asperity.units import Quantity

_MILLIMETRES = 1e3
_SAME = 1e-9

BORE = 0.4
"""Bore of the wheel where none is given, in centre distances."""
HUB_DIAMETER = 1.6
"""Diameter of the hub where none is given, in bores."""
WEB = 0.5
"""Width of the web where none is given, in face widths."""
CHAMFER = 0.05
"""Chamfer where none is given, in diameters of bore and shaft."""
_LARGEST_CHAMFER = 1.0
_LARGEST_BORE, _LARGEST_HUB = 0.5, 0.85


def _length(example: str, **bounds: float) -> Quantity:
    return Quantity("m", what="a length", example=example, **bounds)


class Blanks(Table):
    r"""What wheel and worm are beside their teeth.

    It counts in their solids and pictures, and under load with ``drive.wheel_body = "web"``.

    Parameters
    ----------
    bore : float or str, optional
        Diameter of the wheel's bore, m. Left out: 0.4 centre distances, at most half the inside of
        the rim.
    hub_diameter : float or str, optional
        Outside diameter of the wheel's hub, m. Left out: 1.6 bores, or all the inside of the rim
        where that leaves no web.
    hub_width : float or str, optional
        Length of the hub along the axis, m, its middle in mid-face. Left out: the face width, or
        the bore where that is more.
    web_width : float or str, optional
        Thickness of the disc between hub and rim, m. Left out: half the face width.
    shaft_diameter : float or str, optional
        Diameter of the worm's shaft on both sides of the thread, m, less than its root diameter.
        Left out: nine tenths of that.
    drive_end : float or str, optional
        Length of the shaft beyond the thread at the end where it is driven, m; 0 for none. Left
        out: that of the free end and two shaft diameters.
    free_end : float or str, optional
        The same at the other end, m. Left out: to half a shaft diameter beyond bearings that stand
        1.5 centre distances apart.
    chamfer : float or str, optional
        Chamfer of the bore and of the shaft's ends, m; 0 for none. Left out: a twentieth of their
        diameter, at most 1 mm.
    keyways : {'none', 'wheel', 'worm', 'both'}
        Which have a keyway of DIN 6885-1 in STEP: the wheel's bore, the worm's driven end.
    """

    table: ClassVar[str] = "blank"

    bore: Annotated[float, _length("30 mm", gt=0, le=10.0)] | None = None
    hub_diameter: Annotated[float, _length("50 mm", gt=0, le=10.0)] | None = None
    hub_width: Annotated[float, _length("30 mm", gt=0, le=10.0)] | None = None
    web_width: Annotated[float, _length("10 mm", gt=0, le=10.0)] | None = None
    shaft_diameter: Annotated[float, _length("12 mm", gt=0, le=10.0)] | None = None
    drive_end: Annotated[float, _length("60 mm", ge=0.0, le=10.0)] | None = None
    free_end: Annotated[float, _length("40 mm", ge=0.0, le=10.0)] | None = None
    chamfer: Annotated[float, _length("1 mm", ge=0.0, le=0.1)] | None = None
    keyways: Literal["none", "wheel", "worm", "both"] = "none"


def rim_radius(geometry: Geometry) -> float:
    """Return the radius of the inside of the wheel's rim, mm."""
    return geometry.wheel_root_diameter / 2.0 - geometry.rim_thickness


def wheel_sizes(geometry: Geometry, blanks: Blanks | None = None) -> dict[str, float]:
    """Return what a wheel has of the sizes of `Blanks`, given or assumed, mm.

    Raises
    ------
    InputError
        A size leaves no room for another.
    """
    given = sizes_given(blanks)
    rim, face = rim_radius(geometry), geometry.wheel_face_width
    if rim <= 0.0:
        raise InputError(
            f"gearset.rim_thickness is {geometry.rim_thickness:.4g} mm; the wheel's root radius is "
            f"{geometry.wheel_root_diameter / 2.0:.4g} mm: take a thinner rim"
        )
    usual = min(BORE * geometry.centre_distance, _LARGEST_BORE * 2.0 * rim)
    bore = given.get("bore", rounded(usual))
    _below("bore", bore, 2.0 * rim, "the inside of the rim", "take a smaller bore or a thinner rim")
    hub = given.get("hub_diameter", min(HUB_DIAMETER * bore, 2.0 * rim))
    if "hub_diameter" not in given and hub > _LARGEST_HUB * 2.0 * rim:
        hub = 2.0 * rim
    _below("bore", bore, hub, "the hub", "take a smaller bore or a larger blank.hub_diameter")
    if hub > 2.0 * rim * (1.0 + _SAME):
        raise InputError(
            f"blank.hub_diameter is {hub:g} mm; the inside of the rim has {2.0 * rim:.4g} mm: take "
            "a smaller one"
        )
    width = given.get("hub_width", max(face, bore))
    web = given.get("web_width", min(WEB * face, width))
    if web > min(face, width) * (1.0 + _SAME):
        raise InputError(
            f"blank.web_width is {web:g} mm; the wheel's face is {face:.4g} mm wide and its hub "
            f"{width:.4g} mm: take a narrower web"
        )
    chamfer = chamfer_of(given, bore, min(0.5 * (hub - bore), 0.5 * width))
    return {
        "bore": bore,
        "hub_diameter": hub,
        "hub_width": width,
        "web_width": web,
        "bore_chamfer": chamfer,
    }


@dataclasses.dataclass(frozen=True)
class WheelBody:
    """What is between the rim's inside and what holds the wheel.

    Attributes
    ----------
    web_width : float
        Of the web, mm.
    hub_radius : float
        Where it is held, mm; the rim's inside or more: the rim stands on the hub.
    """

    web_width: float
    hub_radius: float

    @classmethod
    def of(cls, geometry: Geometry, blanks: Blanks | None) -> Self:
        """Return that of a wheel, by `[blank]` or what is usual."""
        sizes = wheel_sizes(geometry, blanks)
        return cls(sizes["web_width"], 0.5 * sizes["hub_diameter"])


def wheel_section(geometry: Geometry, blanks: Blanks | None = None) -> FloatArray:
    """Return the section of a wheel below its rim, (k, 2), from the lower face to the upper one.

    Errors as in `wheel_sizes`.
    """
    bore, hub, width, web, chamfer = wheel_sizes(geometry, blanks).values()
    rim, face = rim_radius(geometry), geometry.wheel_face_width
    upper = [
        (0.5 * bore, 0.5 * width - chamfer),
        (0.5 * bore + chamfer, 0.5 * width),
        (0.5 * hub, 0.5 * width),
        (0.5 * hub, 0.5 * web),
        (rim, 0.5 * web),
        (rim, 0.5 * face),
    ]
    lower = [(radius, -z) for radius, z in reversed(upper)]
    return np.array([*lower, *upper])


def sizes_given(blanks: Blanks | None) -> dict[str, float]:
    """Return the sizes that are given, mm."""
    given = (blanks or Blanks()).model_dump(exclude_none=True, exclude={"keyways"})
    return {key: float(f"{value * _MILLIMETRES:.12g}") for key, value in given.items()}


def rounded(size: float) -> float:
    """Return a size as it is made: whole mm, tenths of what is small."""
    step = 1.0 if size >= 10.0 else 0.1
    return max(math.floor(size / step) * step, 0.5 * size)


def chamfer_of(given: dict[str, float], diameter: float, room: float) -> float:
    """Return the chamfer of a bore or shaft, mm, as given or as usual.

    Raises
    ------
    InputError
        There is no room for it.
    """
    usual = min(CHAMFER * diameter, _LARGEST_CHAMFER, 0.5 * room)
    chamfer = given.get("chamfer", usual)
    if chamfer > room * (1.0 + _SAME):
        raise InputError(
            f"blank.chamfer is {chamfer:g} mm; there is room for at most {room:.4g} mm: take a "
            "smaller one"
        )
    return chamfer


def _below(key: str, value: float, most: float, what: str, remedy: str) -> None:
    if not value < most * (1.0 - 1e-3):
        raise InputError(f"blank.{key} is {value:g} mm; {what} has {most:.4g} mm: {remedy}")

"""What is turned of wheel and worm: rim, web, hub and bore; shaft ends.

A section is points of radius and z, mm. The outside of a body lies to the left of the way along it,
seen with the radius to the right and the axis upwards.
"""

import math

import numpy as np

from asperity.arrays import FloatArray
from asperity.errors import InputError
from asperity.flanks.parameters import Blanks
from asperity.flanks.worm.setting import Pair
from asperity.gearset import Geometry

_MILLIMETRES = 1e3
_SAME = 1e-9

BORE = 0.4
"""Bore of the wheel where none is given, in centre distances."""
HUB_DIAMETER = 1.6
"""Diameter of the hub where none is given, in bores."""
WEB = 0.5
"""Width of the web where none is given, in face widths."""
SHAFT = 0.9
"""Diameter of the worm's shaft where none is given, in root diameters of the worm."""
SPAN = 1.5
"""Distance between the worm's bearings, in centre distances, that its shaft is made for."""
JOURNAL = 2.0
"""What the drive end is longer than the free end where none is given, in shaft diameters."""
CHAMFER = 0.05
"""Chamfer where none is given, in diameters of bore and shaft."""
_LARGEST_CHAMFER = 1.0
_LARGEST_BORE, _LARGEST_HUB = 0.5, 0.85
_LARGEST_SHAFT = 0.98


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
    given = _millimetres(blanks)
    rim, face = rim_radius(geometry), geometry.wheel_face_width
    if rim <= 0.0:
        raise InputError(
            f"gearset.rim_thickness is {geometry.rim_thickness:.4g} mm; the wheel's root radius is "
            f"{geometry.wheel_root_diameter / 2.0:.4g} mm: take a thinner rim"
        )
    usual = min(BORE * geometry.centre_distance, _LARGEST_BORE * 2.0 * rim)
    bore = given.get("bore", _rounded(usual))
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
    chamfer = _chamfer(given, bore, min(0.5 * (hub - bore), 0.5 * width))
    return {
        "bore": bore,
        "hub_diameter": hub,
        "hub_width": width,
        "web_width": web,
        "bore_chamfer": chamfer,
    }


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


def shaft_sizes(pair: Pair, blanks: Blanks | None = None) -> dict[str, float]:
    """Return what a worm has of the sizes of `Blanks`, given or assumed, mm.

    Raises
    ------
    InputError
        The shaft is thicker than the worm's root, or a chamfer has no room.
    """
    given = _millimetres(blanks)
    root = 2.0 * pair.worm.root_radius
    diameter = given.get("shaft_diameter", _rounded(SHAFT * root))
    if diameter > _LARGEST_SHAFT * root:
        raise InputError(
            f"blank.shaft_diameter is {diameter:g} mm; the worm's root diameter is {root:.4g} mm, "
            f"and the thread ends on the shaft: take at most {_LARGEST_SHAFT * root:.4g} mm"
        )
    bearing = 0.5 * (SPAN * pair.geometry.centre_distance - pair.geometry.worm_face_width)
    free = given.get("free_end", _rounded(max(bearing, 0.0) + 0.5 * diameter))
    drive = given.get("drive_end", free + JOURNAL * diameter)
    ends = [end for end in (free, drive) if end > 0.0]
    return {
        "shaft_diameter": diameter,
        "drive_end": drive,
        "free_end": free,
        "shaft_chamfer": _chamfer(given, diameter, min([0.5 * diameter, *ends])),
    }


def shaft_sections(pair: Pair, blanks: Blanks | None = None) -> list[FloatArray]:
    """Return the sections of a worm's shaft ends, the drive end where z is positive, (k, 2).

    Errors as in `shaft_sizes`.
    """
    diameter, drive, free, chamfer = shaft_sizes(pair, blanks).values()
    thread = 0.5 * pair.geometry.worm_face_width
    sections = []
    for side, beyond in ((1.0, drive), (-1.0, free)):
        if beyond == 0.0:
            continue
        end = thread + beyond
        profile = np.array(
            [
                (0.0, end),
                (0.5 * diameter - chamfer, end),
                (0.5 * diameter, end - chamfer),
                (0.5 * diameter, thread),
            ]
        )
        sections.append(merged(profile if side > 0.0 else (profile * [1.0, -1.0])[::-1]))
    return sections


def merged(section: FloatArray) -> FloatArray:
    """Return a section without steps of no length, nor what lies in the planes where it ends.

    What goes on in one direction is one piece.
    """
    points = [section[0]]
    for point in section[1:]:
        if np.abs(point - points[-1]).max() > _SAME:
            points.append(point)
    kept = [points[0]]
    for before, point, after in zip(points, points[1:], points[2:], strict=False):
        first, second = point - before, after - point
        if abs(first[0] * second[1] - first[1] * second[0]) > _SAME:
            kept.append(point)
    kept.append(points[-1])
    for _ in range(2):
        # A ring's plane face goes on in the section's: it is one face, with a smaller hole.
        if kept[0][0] > 0.0 and len(kept) > 2 and abs(kept[1][1] - kept[0][1]) <= _SAME:
            kept = kept[1:]
        kept = kept[::-1]
    return np.array(kept)


def volume(section: FloatArray) -> float:
    """Return the volume between a section and the axis that is missing, mm^3, by Pappus's rule.

    It is negative where there is material: between a shaft end and its axis.
    """
    (r0, z0), (r1, z1) = section[:-1].T, section[1:].T
    return float(np.sum(math.pi / 3.0 * (r0 * r0 + r0 * r1 + r1 * r1) * (z1 - z0)))


def _millimetres(blanks: Blanks | None) -> dict[str, float]:
    """The sizes that are given, mm."""
    given = (blanks or Blanks()).model_dump(exclude_none=True, exclude={"keyways"})
    return {key: float(f"{value * _MILLIMETRES:.12g}") for key, value in given.items()}


def _rounded(size: float) -> float:
    """A size as it is made: whole mm, tenths of what is small."""
    step = 1.0 if size >= 10.0 else 0.1
    return max(math.floor(size / step) * step, 0.5 * size)


def _chamfer(given: dict[str, float], diameter: float, room: float) -> float:
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

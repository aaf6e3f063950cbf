"""What is turned of a worm: its shaft's ends; and what all turned sections have in common.

A section is points of radius and z, mm. The outside of a body lies to the left of the way along it,
seen with the radius to the right and the axis upwards.
"""

import math

import numpy as np

from asperity.arrays import FloatArray
from asperity.errors import InputError
from asperity.flanks.worm.setting import Pair
from asperity.gearset.blanks import Blanks, chamfer_of, rounded, sizes_given

_SAME = 1e-9

SHAFT = 0.9
"""Diameter of the worm's shaft where none is given, in root diameters of the worm."""
SPAN = 1.5
"""Distance between the worm's bearings, in centre distances, that its shaft is made for."""
JOURNAL = 2.0
"""What the drive end is longer than the free end where none is given, in shaft diameters."""
_LARGEST_SHAFT = 0.98


def shaft_sizes(pair: Pair, blanks: Blanks | None = None) -> dict[str, float]:
    """Return what a worm has of the sizes of `Blanks`, given or assumed, mm.

    Raises
    ------
    InputError
        The shaft is thicker than the worm's root, or a chamfer has no room.
    """
    given = sizes_given(blanks)
    root = 2.0 * pair.worm.root_radius
    diameter = given.get("shaft_diameter", rounded(SHAFT * root))
    if diameter > _LARGEST_SHAFT * root:
        raise InputError(
            f"blank.shaft_diameter is {diameter:g} mm; the worm's root diameter is {root:.4g} mm, "
            f"and the thread ends on the shaft: take at most {_LARGEST_SHAFT * root:.4g} mm"
        )
    bearing = 0.5 * (SPAN * pair.geometry.centre_distance - pair.geometry.worm_face_width)
    free = given.get("free_end", rounded(max(bearing, 0.0) + 0.5 * diameter))
    drive = given.get("drive_end", free + JOURNAL * diameter)
    ends = [end for end in (free, drive) if end > 0.0]
    return {
        "shaft_diameter": diameter,
        "drive_end": drive,
        "free_end": free,
        "shaft_chamfer": chamfer_of(given, diameter, min([0.5 * diameter, *ends])),
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

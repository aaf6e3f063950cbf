"""What worm and wheel are beside their teeth: shafts as a case describes them, or as assumed.

A section is points of radius and z, mm. The outside of a body lies to the left of the way along it,
seen with the radius to the right and the axis upwards.
"""

import math
from typing import NamedTuple

import numpy as np

from asperity.arrays import FloatArray
from asperity.casefile import Case
from asperity.errors import InputError
from asperity.flanks.worm.setting import Pair
from asperity.gearset.answer import Views
from asperity.gearset.blanks import Blanks, chamfer_of, rounded, sizes_given, wheel_sizes
from asperity.gearset.geometry import Geometry
from asperity.gearset.keys import key_of
from asperity.shafts.drawing import views_of
from asperity.shafts.parameters import WheelShaft, WormShaft
from asperity.shafts.shape import FROM_END, LENGTH, Keyway, Shape, on_shaft, require_once, shape_of

_SAME = 1e-9

SHAFT = 0.9
"""Diameter of the worm's shaft where none is given, in root diameters of the worm."""
SPAN = 1.5
"""Distance between the worm's bearings, in centre distances, that its shaft is made for."""
JOURNAL = 2.0
"""What the drive end is longer than the free end where none is given, in shaft diameters."""
_LARGEST_SHAFT = 0.98


class Bodies(NamedTuple):
    """What both are beside their teeth.

    Attributes
    ----------
    blanks : Blanks or None
        As the table ``[blank]`` has it, of the wheel that sits on its shaft.
    worm, wheel : Shape or None
        Shafts, where a case describes them.
    """

    blanks: Blanks | None = None
    worm: Shape | None = None
    wheel: Shape | None = None

    @classmethod
    def of(cls, case: Case, pair: Pair) -> "Bodies":
        """Return those of a case.

        Raises
        ------
        InputError
            Two tables say the same, or there is no such body.
        """
        blanks, g = case.get(Blanks), pair.geometry
        tables = case.get(WormShaft), case.get(WheelShaft)
        worm, wheel = (None if table is None else shape_of(table, g) for table in tables)
        require_once(blanks, worm, wheel)
        made = cls(blanks if wheel is None else on_shaft(blanks, wheel), worm, wheel)
        try:
            wheel_sizes(g, made.blanks)
        except InputError as error:
            if wheel is None:
                raise
            said = "the wheel's bore is as [wheel_shaft] is thick at its mesh"
            raise InputError(f"{said}: {error}") from None
        worm_shape(pair, made)
        return made

    def both_views(self, g: Geometry, hand: str) -> Views | None:
        """Return both views of a gearset with its shafts; None where no shaft is described."""
        if self.worm is None and self.wheel is None:
            return None
        return views_of(g, hand, self.worm, self.wheel, self.blanks)


Beside = Blanks | Bodies | None
"""What both are beside their teeth: nothing where all is assumed."""


def blanks_of(beside: Beside) -> Blanks | None:
    """Return what a wheel is beside its teeth."""
    return beside.blanks if isinstance(beside, Bodies) else beside


def worm_shape(pair: Pair, beside: Beside = None) -> Shape:
    """Return the worm's shaft, as it is described or assumed.

    Raises
    ------
    InputError
        As of `shaft_sizes`.
    """
    if isinstance(beside, Bodies) and beside.worm is not None:
        return beside.worm
    blanks = blanks_of(beside)
    diameter, drive, free, chamfer = shaft_sizes(pair, blanks).values()
    thread, radius = pair.geometry.worm_face_width, 0.5 * diameter
    end = drive + thread + free
    profiles = []
    if drive > 0.0:
        profiles.append(((0.0, 0.0), (0.0, radius - chamfer), (chamfer, radius), (drive, radius)))
    if free > 0.0:
        profiles.append(
            ((drive + thread, radius), (end - chamfer, radius), (end, radius - chamfer), (end, 0.0))
        )
    keyways: tuple[Keyway, ...] = ()
    if blanks is not None and blanks.keyways in ("worm", "both"):
        key = key_of(diameter, "blank.shaft_diameter")
        if drive <= 0.0:
            raise InputError(
                f"blank.keyways is {blanks.keyways!r}; the worm has no shaft at its driven end: "
                "give blank.drive_end"
            )
        start = FROM_END * drive
        keyways = (Keyway(start, start + LENGTH * drive, key.width, key.in_shaft, diameter),)
    mesh = drive + 0.5 * thread
    return Shape(tuple(profiles), end, mesh, (drive, drive + thread), keyways, (), diameter)


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


def shaft_sections(pair: Pair, beside: Beside = None) -> list[FloatArray]:
    """Return the sections of a worm's shaft ends, the drive end where z is positive, (k, 2).

    Each ends on the threads; one that is thicker than their root there is closed, and ends on the
    axis at both ends. Errors as in `worm_shape`.
    """
    most = _LARGEST_SHAFT * pair.worm.root_radius * (1.0 + _SAME)
    shape = worm_shape(pair, beside)
    made = []
    for section in sections_of(shape):
        whole = section
        if section[0][0] > most:
            whole = np.vstack([[0.0, section[0][1]], whole])
        if section[-1][0] > most:
            whole = np.vstack([whole, [0.0, section[-1][1]]])
        made.append(whole)
    return made


def sections_of(shape: Shape) -> list[FloatArray]:
    """Return the sections of a shaft, its mesh at z = 0 and its first end where z is positive."""
    return [
        merged(np.array([(radius, shape.mesh - place) for place, radius in profile]))
        for profile in shape.profiles
    ]


def threads_of(pair: Pair, beside: Beside = None) -> tuple[float, float]:
    """Return from where to where a worm's threads go, mm along z."""
    shape = worm_shape(pair, beside)
    assert shape.threads is not None
    start, end = shape.threads
    return shape.mesh - end, shape.mesh - start


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

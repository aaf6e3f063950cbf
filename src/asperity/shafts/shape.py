"""The shape of a shaft as a case describes it: what drawings show and solids are made of.

Positions go along the shaft from its end, mm. A profile is points of position and radius.
"""

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

from asperity.errors import InputError
from asperity.gearset.blanks import Blanks, chamfer_of
from asperity.gearset.geometry import Geometry
from asperity.gearset.keys import key_of
from asperity.rating.inputs import scaled
from asperity.shafts.parameters import ShaftBearing, ShaftSection, WheelShaft, WormShaft

Profile = tuple[tuple[float, float], ...]

_ARC = math.radians(5.0)  # between the points of a fillet
FROM_END, LENGTH = 0.1, 0.7
"""Where a keyway begins in the section at a shaft's end, and how long it is, as shares of it."""
_WITHIN = 0.8  # of another section
_BELOW_ROOT = 0.98  # of the threads' root, where a shaft meets them


class Keyway(NamedTuple):
    """A keyway of DIN 6885-1.

    Attributes
    ----------
    start, end : float
        Along the shaft, mm.
    width, depth, diameter : float
        Of the keyway, and of the shaft there, mm.
    """

    start: float
    end: float
    width: float
    depth: float
    diameter: float


class Seat(NamedTuple):
    """A bearing on a shaft.

    Attributes
    ----------
    at : float
        Its middle, mm.
    bore, outside, width : float
        Of one bearing, mm.
    kind : str
        As of `asperity.shafts.bearing.RollingBearing`.
    angles : tuple of float
        Contact angle of each that stands there, rad: positive where its contact lines meet the axis
        nearer to the shaft's end that positions start from.
    """

    at: float
    bore: float
    outside: float
    width: float
    kind: str
    angles: tuple[float, ...]

    @property
    def rings(self) -> tuple[tuple[float, float, float], ...]:
        """Start, end and contact angle of each bearing that stands there."""
        first = self.at - 0.5 * len(self.angles) * self.width
        return tuple(
            (first + n * self.width, first + (n + 1) * self.width, angle)
            for n, angle in enumerate(self.angles)
        )


class Shape(NamedTuple):
    """A shaft.

    Attributes
    ----------
    profiles : tuple of tuple
        What is turned, from one end to the other: one piece, or one at either side of the threads.
    length, mesh : float
        Of all of it, and where its gear is, mm.
    threads : tuple of float or None
        Between which positions a worm's threads are, mm.
    keyways : tuple of Keyway
        In it.
    seats : tuple of Seat
        Of bearings whose dimensions are known.
    bore : float
        Diameter where the gear is, mm.
    notes : tuple of str
        What is not shown, and why.
    sections : tuple of tuple
        Start, end and diameter of each part that is described and turned, mm; not of threads.
    """

    profiles: tuple[Profile, ...]
    length: float
    mesh: float
    threads: tuple[float, float] | None
    keyways: tuple[Keyway, ...]
    seats: tuple[Seat, ...]
    bore: float
    notes: tuple[str, ...] = ()
    sections: tuple[tuple[float, float, float], ...] = ()

    @property
    def largest(self) -> float:
        """Greatest diameter of what is turned, and of its bearings, mm."""
        turned = [2.0 * radius for profile in self.profiles for _, radius in profile]
        return max([*turned, *(seat.outside for seat in self.seats)])

    @property
    def keyed_at_mesh(self) -> bool:
        """Whether a keyway holds the gear."""
        return any(way.start < self.mesh < way.end for way in self.keyways)


def shape_of(table: WormShaft | WheelShaft, geometry: Geometry) -> Shape:
    """Return the shape of a shaft of a case.

    Raises
    ------
    InputError
        A fillet is longer than the section that it is in.
    """
    worm = isinstance(table, WormShaft)
    root = _BELOW_ROOT * float(geometry.worm_root_diameter)
    ends = [0.0]
    for section in table.section:
        ends.append(ends[-1] + scaled(section.length, 1e3))
    mesh = scaled(table.mesh, 1e3)
    threads = _threads(table, ends, mesh, geometry) if worm else None
    sizes = [
        root if section.diameter is None else scaled(section.diameter, 1e3)
        for section in table.section
    ]
    spans = [(0.0, ends[-1])]
    if threads is not None:
        spans = [(0.0, threads[0]), (threads[1], ends[-1])]
    profiles = tuple(
        _profile(table, ends, sizes, span, threads is not None)
        for span in spans
        if span[1] - span[0] > 1e-9
    )
    keyways, notes = _keyways(table, ends, sizes)
    here = next(place for place, end in enumerate(ends[1:]) if mesh <= end + 1e-9)
    seats = tuple(
        _seat(place, number)
        for number, place in enumerate(sorted(table.bearing, key=lambda one: one.at))
        if place.bearing is not None
    )
    sections = tuple(
        (start, end, scaled(section.diameter, 1e3))
        for section, start, end in zip(table.section, ends, ends[1:], strict=False)
        if section.diameter is not None
    )
    return Shape(profiles, ends[-1], mesh, threads, keyways, seats, sizes[here], notes, sections)


def _threads(
    table: Any, ends: Sequence[float], mesh: float, geometry: Geometry
) -> tuple[float, float]:
    """Return where the threads are: the sections without a diameter round the mesh, or b_1."""
    bare = [section.diameter is None for section in table.section]
    here = next(place for place, end in enumerate(ends[1:]) if mesh <= end + 1e-9)
    if not bare[here]:
        half = 0.5 * float(geometry.worm_face_width)
        return max(mesh - half, 0.0), min(mesh + half, ends[-1])
    low = high = here
    while low > 0 and bare[low - 1]:
        low -= 1
    while high + 1 < len(bare) and bare[high + 1]:
        high += 1
    return ends[low], ends[high + 1]


def _profile(
    table: Any,
    ends: Sequence[float],
    sizes: Sequence[float],
    span: tuple[float, float],
    threaded: bool,
) -> Profile:
    """Return the profile between two positions; at a shaft's end it goes down to the axis."""
    low, high = span
    inside = [n for n in range(len(sizes)) if ends[n + 1] > low + 1e-9 and ends[n] < high - 1e-9]
    points: list[tuple[float, float]] = []
    for n in inside:
        start, end, radius = max(ends[n], low), min(ends[n + 1], high), 0.5 * sizes[n]
        begins, stops = [(start, radius)], [(end, radius)]
        if start <= 0.0:
            begins = _chamfered(start, radius, end - start, 1.0)
        elif n > 0 and start > low:
            begins = _fillet(table, n, -1, start, sizes, end - start) or begins
        if end >= ends[-1]:
            stops = _chamfered(end, radius, end - start, -1.0)[::-1]
        elif end < high or threaded:
            stops = _fillet(table, n, 1, end, sizes, end - start) or stops
        points += [*begins, *_groove(table.section[n], start, end, radius), *stops]
    return tuple(p for n, p in enumerate(points) if n == 0 or math.dist(p, points[n - 1]) > 1e-9)


def _chamfered(at: float, radius: float, room: float, way: float) -> list[tuple[float, float]]:
    """Return the end of a shaft from the axis on, with the chamfer that is usual."""
    chamfer = chamfer_of({}, 2.0 * radius, min(0.5 * radius, 0.5 * room))
    return [(at, 0.0), (at, radius - chamfer), (at + way * chamfer, radius)]


def _fillet(
    table: Any, n: int, to: int, at: float, sizes: Sequence[float], room: float
) -> list[tuple[float, float]]:
    """Return the fillet of a section towards the next (1) or the one before (-1), if it is in it.

    A fillet is in the thinner of two sections, and ends where it meets the surface of the other.
    """
    other = n + to
    if not 0 <= other < len(sizes) or sizes[other] <= sizes[n] + 1e-9:
        return []
    owner = table.section[min(n, other)]
    if owner.fillet is None:
        return []
    radius, height = scaled(owner.fillet, 1e3), 0.5 * (sizes[other] - sizes[n])
    turn = math.acos(max(1.0 - height / radius, 0.0))
    long = radius * math.sin(turn)
    if long > room + 1e-9:
        raise InputError(
            f"{table.table}.section.fillet is {radius:g} mm; the section of {sizes[n]:g} mm "
            f"diameter has {room:g} mm beside it: take a smaller fillet"
        )
    low = 0.5 * sizes[n]
    steps = max(math.ceil(turn / _ARC), 1)
    arc = []
    for step in range(steps + 1):
        angle = turn * step / steps
        along = long - radius * math.sin(angle)
        arc.append((at - to * along, low + radius * (1.0 - math.cos(angle))))
    if height > radius * (1.0 + 1e-9):
        arc.append((at, low + height))
    return arc if to > 0 else arc[::-1]


def _groove(
    section: ShaftSection, start: float, end: float, radius: float
) -> list[tuple[float, float]]:
    """Return a round groove in the middle of its section."""
    if section.groove_depth is None or section.groove_radius is None:
        return []
    deep, round_ = scaled(section.groove_depth, 1e3), scaled(section.groove_radius, 1e3)
    turn = math.acos(max(1.0 - deep / round_, 0.0))
    half = round_ * math.sin(turn)
    if 2.0 * half > end - start:
        raise InputError(
            f"section.groove_radius is {round_:g} mm; its groove is {2.0 * half:.4g} mm wide in a "
            f"section of {end - start:g} mm: take a smaller one"
        )
    middle, steps = 0.5 * (start + end), max(math.ceil(turn / _ARC), 1)
    centre = radius - deep + round_
    angles = [turn * step / steps for step in range(-steps, steps + 1)]
    arc = [(middle + round_ * math.sin(a), centre - round_ * math.cos(a)) for a in angles]
    return [(middle - half, radius), *arc, (middle + half, radius)]


def _keyways(
    table: Any, ends: Sequence[float], sizes: Sequence[float]
) -> tuple[tuple[Keyway, ...], tuple[str, ...]]:
    made, notes = [], []
    for n, section in enumerate(table.section):
        if section.notch != "keyway":
            continue
        try:
            key = key_of(sizes[n], f"{table.table}.section.diameter", "it is drawn without one")
        except InputError as error:
            notes.append(str(error))
            continue
        start, long = ends[n], ends[n + 1] - ends[n]
        first, share = 0.5 * (1.0 - _WITHIN), _WITHIN
        if n == 0:
            first, share = FROM_END, LENGTH
        elif n == len(sizes) - 1:
            first, share = 1.0 - FROM_END - LENGTH, LENGTH
        low = start + first * long
        made.append(Keyway(low, low + share * long, key.width, key.in_shaft, sizes[n]))
    return tuple(made), tuple(notes)


def _seat(bearing: ShaftBearing, number: int) -> Seat:
    rolling = bearing.bearing
    assert rolling is not None
    angle = rolling.contact_angle or 0.0
    if rolling.kind == "taper" and rolling.e is not None:
        angle = math.atan(rolling.e / 1.5)
    # Back to back the contact lines of a pair part outwards, face to face they meet.
    outer = -angle if "face-to-face" in bearing.arrangement else angle
    # What pushes the shaft towards its end leans on the outer ring's shoulder there.
    angles: tuple[float, ...] = (-angle if bearing.takes == "towards end" else angle,)
    if bearing.opposed:
        angles = (outer, -outer)
    elif bearing.pair:
        angles = (angles[0], angles[0])
    elif bearing.adjusted:
        angles = (outer if number == 0 else -outer,)
    bore, outside, width = (
        scaled(each, 1e3) for each in (rolling.bore, rolling.outside_diameter, rolling.width)
    )
    return Seat(scaled(bearing.at, 1e3), bore, outside, width, rolling.kind, angles)


def on_shaft(blanks: Blanks | None, shape: Shape) -> Blanks:
    """Return what a wheel is beside its teeth on its shaft, whose diameter its bore has."""
    own = blanks or Blanks()
    keyed = "none"
    if shape.keyed_at_mesh:
        keyed = "both" if own.keyways in ("worm", "both") else "wheel"
    elif own.keyways == "worm":
        keyed = "worm"
    return own.model_copy(update={"bore": 1e-3 * shape.bore, "keyways": keyed}, units="SI")


def require_once(blanks: Blanks | None, worm: Shape | None, wheel: Shape | None) -> None:
    """Refuse what [blank] says of shafts otherwise than their own tables.

    Raises
    ------
    InputError
        Both say something of a shaft.
    """
    if blanks is None:
        return
    given = blanks.model_fields_set
    for key in ("shaft_diameter", "drive_end", "free_end"):
        if worm is not None and key in given:
            raise InputError(
                f"blank.{key} and [worm_shaft] both say how long or thick the worm's shaft is: "
                f"leave blank.{key} out"
            )
    wanted = blanks.keyways
    if wanted in ("worm", "both") and worm is not None and not worm.keyways:
        raise InputError(
            f"blank.keyways is {wanted!r}; no section of [worm_shaft] has notch = 'keyway': give "
            "it there"
        )
    if wheel is None:
        return
    if blanks.bore is not None and abs(1e3 * blanks.bore - wheel.bore) > 1e-6:
        raise InputError(
            f"blank.bore is {1e3 * blanks.bore:g} mm; [wheel_shaft] is {wheel.bore:g} mm thick at "
            "its mesh: leave blank.bore out"
        )
    if wanted in ("wheel", "both") and not wheel.keyed_at_mesh:
        raise InputError(
            f"blank.keyways is {wanted!r}; the section of [wheel_shaft] at its mesh has no notch = "
            "'keyway': give it there"
        )

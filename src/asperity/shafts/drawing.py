"""Drawings of a worm gearset with its shafts and bearings, to scale, as the case describes them.

Shafts are drawn from outside, wheel and bearings in section. The driven end of the worm's shaft and
the driving end of the wheel's are on the right.
"""

import math
from collections.abc import Callable, Iterator

from asperity.errors import InputError
from asperity.gearset.blanks import Blanks, wheel_section, wheel_sizes
from asperity.gearset.drawing import Pen, draw_along, draw_through
from asperity.gearset.geometry import Geometry
from asperity.gearset.keys import key_of
from asperity.results.svg import Drawing, Point, scale_for, scale_text
from asperity.shafts.shape import Keyway, Profile, Seat, Shape, on_shaft

_WIDEST, _HIGHEST = 120.0, 130.0
_EDGE = math.radians(15.0)  # between two lines, from where on they have an edge between them
_ELEMENT = 0.3  # diameter of a ball over what is between bore and outside
_ROLLER = 0.7  # length of a roller over the bearing's width


def views_of(
    g: Geometry, hand: str, worm: Shape | None, wheel: Shape | None, blanks: Blanks | None = None
) -> tuple[tuple[str, str], tuple[str, str]]:
    """Return both views of a gearset with its shafts as SVG, and what each shows.

    Parameters
    ----------
    g : Geometry
        Of the gearset.
    hand : {'right', 'left'}
        Of the worm.
    worm, wheel : Shape or None
        The shafts, of which one may be missing.
    blanks : Blanks, optional
        What the wheel is beside its teeth; its bore is its shaft's.

    Returns
    -------
    along, through : tuple of str
        Along the wheel's axis, and through it: SVG and its caption.
    """
    s = scale_with(g, worm, wheel)
    along = Drawing("Worm gearset with the worm's shaft, seen along the wheel's axis")
    along_with_shafts(along, g, s, hand, worm, wheel)
    through = Drawing("Section of the worm gearset through the wheel's axis, with its shaft")
    hub = None if wheel is None else _hub(g, wheel, blanks)
    through_with_shafts(through, g, s, wheel, hub)
    said = "Along the wheel's axis, the worm's driven end on the right, scale"
    if worm is None:
        said = "Along the wheel's axis, without the worm's shaft, scale"
    other = "Section through the wheel's axis, the end that drives on the right, scale"
    if wheel is None:
        other = "Section through the wheel's axis, without hub and shaft, scale"
    elif hub is None:
        other = (
            "Section through the wheel's axis, the end that drives on the right, without the hub, "
            "which has no room, scale"
        )
    return (
        (along.svg(), f"{said} {scale_text(s)}, lengths in mm"),
        (through.svg(), f"{other} {scale_text(s)}"),
    )


def scale_with(g: Geometry, worm: Shape | None, wheel: Shape | None) -> float:
    """Return the scale that both views are drawn at."""
    high = g.wheel_outside_diameter / 2.0 + g.centre_distance
    high += max(g.worm_tip_diameter, 0.0 if worm is None else worm.largest) / 2.0
    wide = [g.worm_face_width, g.wheel_throat_diameter]
    wide += [shape.length for shape in (worm, wheel) if shape is not None]
    return scale_for(max(wide), high, _WIDEST, _HIGHEST)


def along_with_shafts(
    drawing: Pen, g: Geometry, s: float, hand: str, worm: Shape | None, wheel: Shape | None
) -> None:
    """Draw the view along the wheel's axis at a scale, the axis at (0, 0)."""
    threads, reach = None, (0.0, 0.0)
    if worm is not None:
        reach = s * (worm.length - worm.mesh), s * worm.mesh
        if worm.threads is not None:
            threads = worm.mesh - worm.threads[1], worm.mesh - worm.threads[0]
    draw_along(drawing, g, s, hand, threads, reach)
    if worm is not None:
        draw_shaft(drawing, worm, s, -s * g.centre_distance)
    if wheel is not None:
        drawing.circle((0.0, 0.0), 0.5 * s * wheel.bore)


def through_with_shafts(
    drawing: Pen, g: Geometry, s: float, wheel: Shape | None, blanks: Blanks | None = None
) -> None:
    """Draw the section through the wheel's axis at a scale, the middle of the axis at (0, 0).

    Without blanks the wheel is drawn without its hub.
    """
    reach = (0.0, 0.0)
    if wheel is not None:
        reach = s * (wheel.length - wheel.mesh), s * wheel.mesh
    draw_through(drawing, g, s, reach)
    if blanks is not None:
        for side in (-1.0, 1.0):
            blank = [(s * z, side * s * r) for r, z in wheel_section(g, blanks)]
            drawing.line(blank, closed=True)
            drawing.hatch(blank)
        if blanks.keyways in ("wheel", "both"):
            sizes = wheel_sizes(g, blanks)
            half, bore = 0.5 * s * sizes["hub_width"], sizes["bore"]
            top = -s * (0.5 * bore + key_of(bore, "blank.bore").in_hub)
            drawing.line([(-half, top), (half, top)], "narrow")
    if wheel is not None:
        draw_shaft(drawing, wheel, s, 0.0)


def _hub(g: Geometry, wheel: Shape, blanks: Blanks | None) -> Blanks | None:
    """Return what a wheel is beside its teeth on its shaft; None where that leaves no wheel."""
    fitted = on_shaft(blanks, wheel)
    try:
        wheel_sizes(g, fitted)
    except InputError:
        return None
    return fitted


def draw_shaft(drawing: Pen, shape: Shape, s: float, axis: float) -> None:
    """Draw a shaft and its bearings, its mesh at 0 and its axis at a height, mm of paper."""

    def at(position: float, radius: float) -> Point:
        return s * (shape.mesh - position), axis - s * radius

    for profile in shape.profiles:
        upper = [at(p, r) for p, r in profile]
        drawing.line([*upper, *(at(p, -r) for p, r in reversed(profile))], closed=True)
        for p, r in _edges(profile):
            drawing.line([at(p, r), at(p, -r)])
    for way in shape.keyways:
        drawing.line([at(*point) for point in _slot(way)], closed=True)
    for seat in shape.seats:
        _draw_bearing(drawing, seat, at, s)
    ends = at(-4.0 / s, 0.0), at(shape.length + 4.0 / s, 0.0)
    drawing.line(list(ends), "chain")


def _edges(profile: Profile) -> Iterator[Point]:
    """Yield where a profile has an edge that is seen from the side."""
    for before, here, after in zip(profile, profile[1:], profile[2:], strict=False):
        first = math.atan2(here[1] - before[1], here[0] - before[0])
        second = math.atan2(after[1] - here[1], after[0] - here[0])
        turn = abs((second - first + math.pi) % (2.0 * math.pi) - math.pi)
        if turn > _EDGE and here[1] > 0.0:
            yield here


def _slot(way: Keyway) -> list[Point]:
    """Return a keyway as it is seen from above, with round ends; across the shaft for radius."""
    half = min(0.5 * way.width, 0.5 * (way.end - way.start))
    points = []
    for middle, first in ((way.start + half, 90.0), (way.end - half, -90.0)):
        for step in range(13):
            angle = math.radians(first + 15.0 * step)
            points.append((middle + half * math.cos(angle), half * math.sin(angle)))
    return points


def _draw_bearing(drawing: Pen, seat: Seat, at: Callable[[float, float], Point], s: float) -> None:
    low, high = 0.5 * seat.bore, 0.5 * seat.outside
    middle, size = 0.5 * (low + high), _ELEMENT * (seat.outside - seat.bore)
    for start, end, angle in seat.rings:
        centre = 0.5 * (start + end)
        for side in (-1.0, 1.0):
            ring = [(start, low), (end, low), (end, high), (start, high)]
            drawing.line([at(p, side * r) for p, r in ring], closed=True)
            if seat.kind in ("taper", "cylindrical"):
                long = 0.5 * _ROLLER * seat.width
                box = [(-long, -size / 2.0), (long, -size / 2.0), (long, size / 2.0),
                       (-long, size / 2.0)]  # fmt: skip
                turned = [_turned(point, angle) for point in box]
                drawing.line([at(centre + p, side * (middle + r)) for p, r in turned], closed=True)
            else:
                radius = 0.5 * min(size, 0.9 * seat.width)
                drawing.circle(at(centre, side * middle), s * radius)
            if angle:
                reach = middle - low
                run = min(reach * math.tan(abs(angle)), 0.5 * seat.width)
                tilt = math.copysign(run, angle)
                line = [(centre - tilt, low), (centre + tilt, high)]
                drawing.line([at(p, side * r) for p, r in line], "narrow")


def _turned(point: Point, angle: float) -> Point:
    """Turn a point of a roller so that its axis is across the contact line."""
    cosine, sine = math.cos(angle), math.sin(angle)
    p, r = point
    return cosine * p + sine * r, -sine * p + cosine * r

"""Drawings of a worm gearset to scale: along the wheel's axis, and a section through it.

The worm's flanks are drawn straight in its axial section, and the wheel's teeth in mid-plane as
their conjugates, which are involutes; a curved profile departs from that by less than a line.
"""

import itertools
import math
from collections.abc import Iterator, Sequence
from typing import Protocol

from asperity.gearset.geometry import Geometry
from asperity.results.svg import Drawing, Point, Words, scale_for, scale_text
from asperity.results.words import text_of


class Pen(Protocol):
    """What draws, in mm of paper with y downwards: `asperity.results.svg.Drawing`, or another."""

    def line(self, points: Sequence[Point], pen: str = "wide", *, closed: bool = False) -> None:
        """Draw straight lines through points."""

    def circle(self, centre: Point, radius: float, pen: str = "wide") -> None:
        """Draw a circle."""

    def dimension(self, one: Point, other: Point, at: float, words: Words) -> None:
        """Draw a dimension between two points."""

    def hatch(self, corners: Sequence[Point]) -> None:
        """Hatch a polygon that is cut."""


_WIDEST, _HIGHEST = 82.0, 115.0
_GAP = 7.0
_STEPS = 5


def scale_of(g: Geometry) -> float:
    """Return the scale that both views are drawn at."""
    high = g.wheel_outside_diameter / 2.0 + g.centre_distance + g.worm_tip_diameter / 2.0
    wide = max(g.worm_face_width, g.wheel_throat_diameter)
    return scale_for(wide, high, _WIDEST, _HIGHEST)


def along_the_wheel(g: Geometry, hand: str = "right") -> tuple[str, str]:
    """Return the view along the wheel's axis, the worm above it, as SVG; and what it shows."""
    s = scale_of(g)
    drawing = Drawing("Worm gearset seen along the wheel's axis")
    draw_along(drawing, g, s, hand)
    return drawing.svg(), f"Along the wheel's axis, scale {scale_text(s)}, lengths in mm"


def draw_along(
    drawing: Pen, g: Geometry, s: float, hand: str = "right",
    threads: tuple[float, float] | None = None, reach: tuple[float, float] = (0.0, 0.0),
) -> None:  # fmt: skip
    """Draw the view along the wheel's axis at a scale, the axis at (0, 0).

    Parameters
    ----------
    drawing : Pen
        What draws.
    g : Geometry
        The gearset.
    s : float
        mm of paper for a mm.
    hand : {'right', 'left'}
        Of the worm.
    threads : tuple of float, optional
        From where to where they go along the worm, from its middle, mm. Left out: b_1.
    reach : tuple of float
        How far to the left and right something else goes that dimensions keep off, mm of paper.
    """
    a = s * g.centre_distance
    wheel = [(s * x, s * y) for x, y in _wheel_teeth(g)]
    drawing.line(wheel, closed=True)
    drawing.circle((0.0, 0.0), s * g.wheel_mean_diameter / 2.0, "chain")
    tip = s * g.worm_tip_diameter / 2.0
    low, high = threads or (-g.worm_face_width / 2.0, g.worm_face_width / 2.0)
    draw_threads(drawing, g, s, hand, low, high)
    first, last = s * low, s * high
    drawing.line([(first - 4.0, -a), (last + 4.0, -a)], "chain")
    pitch_line = -a + s * g.worm_pitch_diameter / 2.0
    drawing.line([(first - 4.0, pitch_line), (last + 4.0, pitch_line)], "chain")
    outer = s * g.wheel_throat_diameter / 2.0
    drawing.line([(0.0, outer + 4.0), (0.0, -a - tip - 4.0)], "chain")
    drawing.line([(-outer - 3.0, 0.0), (outer + 3.0, 0.0)], "chain")
    right = max(last, outer, reach[1]) + _GAP
    drawing.dimension((last, -a), (0.0, 0.0), right, _named(g, "centre_distance"))
    left = min(first, -outer, -reach[0]) - _GAP
    d = s * g.wheel_mean_diameter / 2.0
    drawing.dimension((0.0, -d), (0.0, d), left, _named(g, "wheel_mean_diameter"))
    top = -a - tip - _GAP
    words = _named(g, "worm_face_width")
    if abs(high - low - g.worm_face_width) > 1e-6:
        words = ("", f"{high - low:.5g}")
    drawing.dimension((first, -a - tip), (last, -a - tip), top, words)
    bottom = outer + _GAP
    drawing.dimension((-outer, 0.0), (outer, 0.0), bottom, _named(g, "wheel_throat_diameter"))


def draw_threads(drawing: Pen, g: Geometry, s: float, hand: str, low: float, high: float) -> None:
    """Draw a worm's threads between two places along its axis: outline, and edges in front."""
    a, tip = s * g.centre_distance, g.worm_tip_diameter / 2.0
    towards = list(_worm_thread(g, low, high))
    away = list(_worm_thread(g, low, high, 0.5 * g.lead))
    outline = [(s * x, -a + s * y) for x, y in towards]
    outline += [(s * x, -a - s * y) for x, y in reversed(away)]
    drawing.line(outline, closed=True)
    pitch, half = g.axial_pitch, 0.5 * _land(g)
    # A right-handed thread goes half a lead to the right from top to bottom, in front.
    along = 0.5 * g.lead * (1.0 if hand == "right" else -1.0)
    for number in range(math.floor(low / pitch) - g.starts - 1, math.ceil(high / pitch) + g.starts):
        for edge in (-half, half):
            bottom = (number + 0.5) * pitch + edge
            ends = _clipped(bottom - along, bottom, low, high)
            if ends is not None:
                line = [
                    (s * (bottom - along * (1.0 - share)), s * tip * (2.0 * share - 1.0) - a)
                    for share in ends
                ]
                drawing.line(line, "narrow")


def _clipped(top: float, bottom: float, low: float, high: float) -> tuple[float, float] | None:
    """Return from which to which share of a line from top to bottom it is between two places."""
    if top == bottom:
        return (0.0, 1.0) if low <= top <= high else None
    shares = sorted(((low - top) / (bottom - top), (high - top) / (bottom - top)))
    first, last = max(shares[0], 0.0), min(shares[1], 1.0)
    return (first, last) if last > first else None


def _land(g: Geometry) -> float:
    """Return the width of a thread at its tip, mm."""
    slope = math.tan(g.axial_pressure_angle)
    beyond = 0.5 * (g.worm_tip_diameter - g.worm_pitch_diameter)
    return 2.0 * max(g.axial_pitch / 4.0 - beyond * slope, 0.0)


def through_the_wheel(g: Geometry) -> tuple[str, str]:
    """Return the section through the wheel's axis, across the worm's, as SVG; and what it shows."""
    s = scale_of(g)
    drawing = Drawing("Section of the worm gearset through the wheel's axis")
    draw_through(drawing, g, s)
    said = "Section through the wheel's axis, without hub and shafts"
    return drawing.svg(), f"{said}, scale {scale_text(s)}"


def draw_through(
    drawing: Pen, g: Geometry, s: float, reach: tuple[float, float] = (0.0, 0.0)
) -> None:
    """Draw the section through the wheel's axis at a scale, the middle of the axis at (0, 0).

    To the left and right something else may reach so far, mm of paper, that dimensions keep off.
    """
    a = s * g.centre_distance
    for name, pen in (("tip", "wide"), ("pitch", "chain"), ("root", "narrow")):
        drawing.circle((0.0, -a), s * getattr(g, f"worm_{name}_diameter") / 2.0, pen)
    for side in (-1.0, 1.0):
        rim = [(s * x, side * s * y) for x, y in _rim(g)]
        drawing.line(rim, closed=True)
        drawing.hatch(rim)
        root = s * g.wheel_root_diameter / 2.0
        half = s * g.wheel_face_width / 2.0
        drawing.line([(-half, side * root), (half, side * root)], "narrow")
    tip, half = s * g.worm_tip_diameter / 2.0, s * g.wheel_face_width / 2.0
    outer = s * g.wheel_outside_diameter / 2.0
    wide = max(tip, half) + 3.0
    drawing.line([(min(-wide, -reach[0]), 0.0), (max(wide, reach[1]), 0.0)], "chain")
    drawing.line([(-wide, -a), (wide, -a)], "chain")
    drawing.line([(0.0, -a - tip - 3.0), (0.0, outer + 3.0)], "chain")
    right = wide + _GAP
    drawing.dimension((0.0, -a - tip), (0.0, -a + tip), right, _named(g, "worm_tip_diameter"))
    root = s * g.worm_root_diameter / 2.0
    drawing.dimension(
        (0.0, -a - root), (0.0, -a + root), right + _GAP, _named(g, "worm_root_diameter")
    )
    drawing.dimension((half, -outer), (half, outer), min(-wide, -reach[0]) - _GAP,
                      _named(g, "wheel_outside_diameter"))  # fmt: skip
    drawing.dimension((-half, outer), (half, outer), outer + _GAP, _named(g, "wheel_face_width"))


def _named(g: Geometry, name: str) -> Words:
    symbol = Geometry.__dataclass_fields__[name].metadata["symbol"]
    sign = "⌀" if "diameter" in name else ""
    return f"{symbol} {sign}", text_of(float(getattr(g, name)), key=f"geometry.{name}_mm")


def _worm_thread(g: Geometry, low: float, high: float, ahead: float = 0.0) -> Iterator[Point]:
    """Yield the worm's axial section from one place to another, mm; the radius downwards.

    Towards the wheel a space stands over its tooth; on the other side all is half a lead ahead.
    """
    pitch = g.axial_pitch
    tip, root = g.worm_tip_diameter / 2.0, g.worm_root_diameter / 2.0
    mean, slope = g.worm_pitch_diameter / 2.0, math.tan(g.axial_pressure_angle)
    at_tip = 0.5 * _land(g)
    at_root = min(pitch / 4.0 + (mean - root) * slope, pitch / 2.0)
    count = int(max(abs(low), abs(high)) / pitch) + 1 + g.starts
    corners: list[Point] = []
    for number in range(-count, count + 1):
        middle = (number + 0.5) * pitch + ahead
        corners += [(middle - at_root, root), (middle - at_tip, tip),
                    (middle + at_tip, tip), (middle + at_root, root)]  # fmt: skip

    def at(position: float) -> float:
        for (x0, y0), (x1, y1) in itertools.pairwise(corners):
            if x0 <= position <= x1:
                return y0 if x1 == x0 else y0 + (y1 - y0) * (position - x0) / (x1 - x0)
        return root

    yield low, at(low)
    yield from (corner for corner in corners if low < corner[0] < high)
    yield high, at(high)


def _wheel_teeth(g: Geometry) -> list[Point]:
    """Return the wheel's outline in mid-plane, a tooth towards the worm, mm, y downwards."""
    angle = g.axial_pressure_angle
    reference = g.wheel_reference_diameter / 2.0
    base = reference * math.cos(angle)
    tip, root = g.wheel_throat_diameter / 2.0, g.wheel_root_diameter / 2.0
    thick = math.pi / 2.0 + 2.0 * g.profile_shift * math.tan(angle)
    half = thick / g.wheel_teeth + math.tan(angle) - angle
    low = max(base, root)
    flank = []
    for step in range(_STEPS + 1):
        radius = low + (tip - low) * step / _STEPS
        pressure = math.acos(min(base / radius, 1.0))
        flank.append((radius, max(half - math.tan(pressure) + pressure, 0.0)))
    if root < low:
        flank.insert(0, (root, min(flank[0][1], math.pi / g.wheel_teeth)))
    points = []
    for tooth in range(g.wheel_teeth):
        middle = 2.0 * math.pi * tooth / g.wheel_teeth
        sides = [(r, middle - w) for r, w in flank] + [(r, middle + w) for r, w in flank[::-1]]
        points += [(r * math.sin(turn), -r * math.cos(turn)) for r, turn in sides]
    return points


def _rim(g: Geometry) -> list[Point]:
    """Return the section of teeth and rim, throat and outside diameter, mm, y away from the axis.

    The first point is at the inside.
    """
    half, outer = g.wheel_face_width / 2.0, g.wheel_outside_diameter / 2.0
    inner = max(g.wheel_root_diameter / 2.0 - g.rim_thickness, 0.0)
    radius, a = g.wheel_throat_radius, g.centre_distance
    reach = min(half, radius)
    throat = []
    for step in range(-12, 13):
        z = reach * step / 12.0
        throat.append((z, min(a - math.sqrt(max(radius**2 - z**2, 0.0)), outer)))
    return [(-half, inner), (-half, throat[0][1]), *throat, (half, throat[-1][1]), (half, inner)]

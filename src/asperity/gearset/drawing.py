"""Drawings of a worm gearset to scale: along the wheel's axis, and a section through it.

The worm's flanks are drawn straight in its axial section, and the wheel's teeth in mid-plane as
their conjugates, which are involutes; a curved profile departs from that by less than a line.
"""

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


def along_the_wheel(g: Geometry) -> tuple[str, str]:
    """Return the view along the wheel's axis, the worm above it, as SVG; and what it shows."""
    s = scale_of(g)
    drawing = Drawing("Worm gearset seen along the wheel's axis")
    draw_along(drawing, g, s)
    return drawing.svg(), f"Along the wheel's axis, scale {scale_text(s)}, lengths in mm"


def draw_along(drawing: Pen, g: Geometry, s: float) -> None:
    """Draw the view along the wheel's axis at a scale, the axis at (0, 0)."""
    a = s * g.centre_distance
    wheel = [(s * x, s * y) for x, y in _wheel_teeth(g)]
    drawing.line(wheel, closed=True)
    drawing.circle((0.0, 0.0), s * g.wheel_mean_diameter / 2.0, "chain")
    tip, half = s * g.worm_tip_diameter / 2.0, s * g.worm_face_width / 2.0
    thread = [(s * x, -a + s * y) for x, y in _worm_thread(g)]
    outline = [*thread, (half, -a), (half, -a - tip), (-half, -a - tip), (-half, -a)]
    drawing.line(outline, closed=True)
    reach = half + 4.0
    drawing.line([(-reach, -a), (reach, -a)], "chain")
    pitch_line = -a + s * g.worm_pitch_diameter / 2.0
    drawing.line([(-reach, pitch_line), (reach, pitch_line)], "chain")
    outer = s * g.wheel_throat_diameter / 2.0
    drawing.line([(0.0, outer + 4.0), (0.0, -a - tip - 4.0)], "chain")
    drawing.line([(-outer - 3.0, 0.0), (outer + 3.0, 0.0)], "chain")
    right = max(half, outer) + _GAP
    drawing.dimension((half, -a), (0.0, 0.0), right, _named(g, "centre_distance"))
    left = -max(half, outer) - _GAP
    d = s * g.wheel_mean_diameter / 2.0
    drawing.dimension((0.0, -d), (0.0, d), left, _named(g, "wheel_mean_diameter"))
    top = -a - tip - _GAP
    drawing.dimension((-half, -a - tip), (half, -a - tip), top, _named(g, "worm_face_width"))
    bottom = outer + _GAP
    drawing.dimension((-outer, 0.0), (outer, 0.0), bottom, _named(g, "wheel_throat_diameter"))


def through_the_wheel(g: Geometry) -> tuple[str, str]:
    """Return the section through the wheel's axis, across the worm's, as SVG; and what it shows."""
    s = scale_of(g)
    drawing = Drawing("Section of the worm gearset through the wheel's axis")
    draw_through(drawing, g, s)
    said = "Section through the wheel's axis, without hub and shafts"
    return drawing.svg(), f"{said}, scale {scale_text(s)}"


def draw_through(drawing: Pen, g: Geometry, s: float) -> None:
    """Draw the section through the wheel's axis at a scale, the middle of the axis at (0, 0)."""
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
    drawing.line([(-wide, 0.0), (wide, 0.0)], "chain")
    drawing.line([(-wide, -a), (wide, -a)], "chain")
    drawing.line([(0.0, -a - tip - 3.0), (0.0, outer + 3.0)], "chain")
    right = wide + _GAP
    drawing.dimension((0.0, -a - tip), (0.0, -a + tip), right, _named(g, "worm_tip_diameter"))
    root = s * g.worm_root_diameter / 2.0
    drawing.dimension(
        (0.0, -a - root), (0.0, -a + root), right + _GAP, _named(g, "worm_root_diameter")
    )
    drawing.dimension((half, -outer), (half, outer), -wide - _GAP,
                      _named(g, "wheel_outside_diameter"))  # fmt: skip
    drawing.dimension((-half, outer), (half, outer), outer + _GAP, _named(g, "wheel_face_width"))


def _named(g: Geometry, name: str) -> Words:
    symbol = Geometry.__dataclass_fields__[name].metadata["symbol"]
    sign = "⌀" if "diameter" in name else ""
    return f"{symbol} {sign}", text_of(float(getattr(g, name)), key=f"geometry.{name}_mm")


def _worm_thread(g: Geometry) -> Iterator[Point]:
    """Yield the worm's axial section towards the wheel, from its left to its right, mm."""
    half, pitch = g.worm_face_width / 2.0, g.axial_pitch
    tip, root = g.worm_tip_diameter / 2.0, g.worm_root_diameter / 2.0
    mean, slope = g.worm_pitch_diameter / 2.0, math.tan(g.axial_pressure_angle)
    # A space of the worm stands over a tooth of the wheel.
    at_tip = max(pitch / 4.0 - (tip - mean) * slope, 0.0)
    at_root = min(pitch / 4.0 + (mean - root) * slope, pitch / 2.0)
    count = int(half / pitch) + 1
    corners: list[Point] = []
    for number in range(-count, count + 1):
        middle = (number + 0.5) * pitch
        corners += [(middle - at_root, root), (middle - at_tip, tip),
                    (middle + at_tip, tip), (middle + at_root, root)]  # fmt: skip
    inside = [corner for corner in corners if abs(corner[0]) <= half]
    yield -half, inside[0][1] if inside else root
    yield from inside
    yield half, inside[-1][1] if inside else root


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

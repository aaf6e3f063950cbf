"""A drawing of worm and wheel as DXF: two views with dimensions, and the data of both.

It is of R2010, in mm and at full size; letters and arrows are as large as on paper at the scale of
the sheet. Outlines, narrow lines, centre lines, hatches, dimensions and texts have a layer each.
"""

import io
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from asperity.files.store import write_text
from asperity.flanks.export.extras import require_draw
from asperity.flanks.export.turned import Beside, Bodies, blanks_of, worm_shape
from asperity.flanks.measuring.drawing import Datum, on_drawing
from asperity.flanks.worm.setting import Pair
from asperity.gearset.blanks import Blanks, wheel_sizes
from asperity.results.language import said
from asperity.results.svg import Point, Words, scale_text
from asperity.shafts.drawing import along_with_shafts, scale_with, through_with_shafts
from asperity.shafts.shape import Shape

NAME = "gearset.dxf"
"""Of the file."""

_LETTERS, _ARROW, _LINE = 3.0, 2.0, 1.7
_LAYERS = {"wide": "OUTLINE", "narrow": "NARROW", "chain": "CENTRE"}
_WEIGHTS = {
    "OUTLINE": 50, "NARROW": 25, "CENTRE": 25, "HATCH": 13, "DIMENSIONS": 25, "TEXT": 25,
}  # fmt: skip
_STYLE = "ASPERITY"
_CHAIN, _LEVEL = 16.0, 8.0  # of dimensions of shafts, mm of paper
_APART, _BLOCK, _COLUMNS = 45.0, 156.0, (0.0, 92.0, 112.0, 134.0)
_PARTS = {"worm": "Worm", "wheel": "Worm wheel", "both": "Gearset"}


class Sheet:
    """A sheet that draws as `asperity.results.svg.Drawing` does, in an entity for each line.

    Parameters
    ----------
    scale : float
        Of the sheet: mm of paper for a mm.
    deviation : float
        Of the centre distance to either side, mm; 0 for none.
    """

    def __init__(self, scale: float, deviation: float = 0.0) -> None:
        require_draw()
        import ezdxf

        self.scale, self.deviation, self.origin = scale, deviation, (0.0, 0.0)
        self.reach = 0.0
        self._document: Any = ezdxf.new("R2010", setup=["linetypes"])
        self._document.header["$INSUNITS"] = 4
        self._document.header["$MEASUREMENT"] = 1
        self._document.header["$LTSCALE"] = 0.5 / scale
        for name, weight in _WEIGHTS.items():
            line = "CENTER" if name == "CENTRE" else "CONTINUOUS"
            self._document.layers.add(name, lineweight=weight, linetype=line)
        self._document.styles.add("LETTERS", font="arial.ttf")
        own = self._document.dimstyles.new(_STYLE)
        own.dxf.dimtxt, own.dxf.dimasz = _LETTERS / scale, _ARROW / scale
        own.dxf.dimexe, own.dxf.dimexo, own.dxf.dimgap = 1.0 / scale, 0.5 / scale, 0.8 / scale
        own.dxf.dimdec, own.dxf.dimzin, own.dxf.dimtad = 3, 8, 1
        own.dxf.dimdsep = ord(".")
        own.dxf.dimtxsty, own.dxf.dimscale = "LETTERS", 1.0
        self._space = self._document.modelspace()

    def _at(self, point: Point) -> Point:
        x = (self.origin[0] + point[0]) / self.scale
        self.reach = max(self.reach, self.origin[0] + point[0])
        return x, -(self.origin[1] + point[1]) / self.scale

    def line(self, points: Sequence[Point], pen: str = "wide", *, closed: bool = False) -> None:
        """Draw straight lines through points."""
        self._space.add_lwpolyline(
            [self._at(point) for point in points], close=closed, dxfattribs={"layer": _LAYERS[pen]}
        )

    def circle(self, centre: Point, radius: float, pen: str = "wide") -> None:
        """Draw a circle."""
        self._at((centre[0] + radius, centre[1]))
        self._space.add_circle(
            self._at(centre), radius / self.scale, dxfattribs={"layer": _LAYERS[pen]}
        )

    def hatch(self, corners: Sequence[Point]) -> None:
        """Hatch a polygon that is cut."""
        made = self._space.add_hatch(dxfattribs={"layer": "HATCH"})
        made.set_pattern_fill("ANSI31", scale=0.5 / self.scale)
        made.paths.add_polyline_path([self._at(point) for point in corners], is_closed=True)

    def dimension(self, one: Point, other: Point, at: float, words: Words) -> None:
        """Draw a dimension that measures what is between two points."""
        upright = abs(one[0] - other[0]) < 1e-9 or (abs(one[0] - other[0]) < abs(one[1] - other[1]))
        said = str(words[0]) if words else ""
        text = "%%c<>" if "\u2300" in said else "<>"
        if said.split()[:1] == ["a"] and self.deviation:
            text += f" %%p{self.deviation:.4g}"
        base = self._at((at, one[1]) if upright else (one[0], at))
        self._space.add_linear_dim(
            base=base, p1=self._at(one), p2=self._at(other), angle=90.0 if upright else 0.0,
            dimstyle=_STYLE, text=text, dxfattribs={"layer": "DIMENSIONS"},
        ).render()  # fmt: skip

    def text(self, at: Point, words: str, height: float = _LETTERS) -> None:
        """Write a text from a point to the right."""
        attributes = {"layer": "TEXT", "style": "LETTERS", "height": height / self.scale}
        self._space.add_text(words, dxfattribs=attributes).set_placement(self._at(at))

    def content(self) -> str:
        """Return the file's text."""
        stream = io.StringIO()
        self._document.write(stream)
        return stream.getvalue()


def write_dxf(
    folder: Path,
    pair: Pair,
    data: Sequence[Datum],
    *,
    beside: Beside = None,
    deviation: float = 0.0,
    name: str = "",
) -> str:
    """Write the drawing to a folder that exists, whole or not at all; return its name.

    Parameters
    ----------
    folder : path
        Where to.
    pair : Pair
        Worm and wheel.
    data : sequence of Datum
        What stands beside the views.
    beside : Blanks or Bodies, optional
        What both are beside their teeth.
    deviation : float
        Of the centre distance to either side, mm.
    name : str
        Of the gearset.

    Raises
    ------
    MissingExtraError
        The ``draw`` extra is not installed.
    """
    g, blanks = pair.geometry, blanks_of(beside) or Blanks()
    worm = worm_shape(pair, beside)
    wheel = beside.wheel if isinstance(beside, Bodies) else None
    s = scale_with(g, worm, wheel)
    sheet = Sheet(s, deviation)
    along_with_shafts(sheet, g, s, pair.hand, worm, wheel)
    _turned(sheet, worm, s, -s * g.centre_distance, -1.0)
    sheet.origin = (sheet.reach + _APART, 0.0)
    if wheel is not None:
        sheet.origin = (sheet.origin[0] + s * (wheel.length - wheel.mesh), 0.0)
    left = sheet.origin[0]
    through_with_shafts(sheet, g, s, wheel, blanks)
    if wheel is not None:
        _turned(sheet, wheel, s, 0.0, 1.0, 0.5 * g.wheel_outside_diameter)
    sizes = wheel_sizes(g, blanks)
    beyond = 0.0 if wheel is None else wheel.mesh
    wide = s * max(0.5 * g.worm_tip_diameter, 0.5 * sizes["hub_width"], beyond)
    for step, key in enumerate(("bore", "hub_diameter"), 1):
        high = s * 0.5 * sizes[key]
        edge = s * 0.5 * sizes["hub_width"]
        sheet.dimension((edge, -high), (edge, high), wide + 10.0 * step + 8.0, ("\u2300",))
    sheet.origin = (max(sheet.reach, left) + _APART / 2.0, 0.0)
    if worm is not None and worm.threads is not None:
        # The data have the threads that are drawn.
        low, high = worm.threads
        data = [one._replace(value=high - low) if one.symbol == "b_1" else one for one in data]
    _block(sheet, data, s * (g.centre_distance + 0.5 * g.worm_tip_diameter))
    sheet.origin = (0.0, 0.0)
    below = s * 0.5 * g.wheel_outside_diameter + 25.0
    sheet.text((-s * 0.5 * g.wheel_throat_diameter, below), f"{name}  {scale_text(s)}  mm", 5.0)
    write_text(folder / NAME, sheet.content())
    return NAME


def _turned(
    sheet: Sheet, shape: Shape, s: float, axis: float, side: float, beyond: float = 0.0
) -> None:
    """Draw the dimensions of a shaft's sections, lengths above the axis (side -1) or below it.

    Diameters stand in their sections; what is ``beyond`` the shaft, mm, is kept off.
    """
    if not shape.sections:
        return
    ends = sorted({place for start, end, _ in shape.sections for place in (start, end)})
    high = axis + side * (s * max(0.5 * shape.largest, beyond) + _CHAIN)

    def at(position: float, radius: float = 0.0) -> Point:
        return s * (shape.mesh - position), axis + side * s * radius

    for start, end, diameter in shape.sections:
        radius = 0.5 * diameter
        sheet.dimension(at(end, radius), at(start, radius), high, ())
        middle, _ = at(0.5 * (start + end))
        low, top = (middle, axis - s * radius), (middle, axis + s * radius)
        sheet.dimension(low, top, middle, ("\u2300",))
    if ends[0] <= 0.0 and len(shape.sections) > 1:
        over = high + side * _LEVEL
        sheet.dimension(at(shape.length), at(0.0), over, ())


def _block(sheet: Sheet, data: Sequence[Datum], top: float) -> None:
    """Write the data of worm and wheel beside each other, and those of both below the worm's."""
    y = {0.0: -top, _BLOCK: -top}
    for part, title in _PARTS.items():
        left = _BLOCK if part == "wheel" else 0.0
        sheet.text((left, y[left]), said(title), 3.5)
        y[left] += _LINE * _LETTERS
        for datum in (one for one in data if one.part == part):
            cells = said(datum.name), datum.symbol, said(on_drawing(datum)), datum.unit
            for x, words in zip(_COLUMNS, cells, strict=True):
                sheet.text((left + x, y[left]), str(words), 2.5)
            y[left] += _LINE * 2.5
        y[left] += _LINE * _LETTERS

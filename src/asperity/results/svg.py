"""Technical drawings as SVG: black lines on white, letters and dimensions as large as on paper.

Coordinates are millimetres of paper, y downwards, so that a print is as large as it says.
"""

import math
from collections.abc import Iterable, Sequence

from markupsafe import Markup, escape

from asperity.results.language import said
from asperity.results.typeset import typeset
from asperity.results.words import Number, Sentence
from asperity.sources import Source

Point = tuple[float, float]
Words = Sequence[str]

LETTERS = 3.0
_ARROW = 2.0
_HATCH = 1.6
_PENS = {
    "wide": 'stroke-width="0.45"',
    "narrow": 'stroke-width="0.2"',
    "chain": 'stroke-width="0.2" stroke-dasharray="5 1 0.6 1"',
}
SCALES = (10.0, 5.0, 2.0, 1.0, 0.5, 0.2, 0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001)
"""Of drawings (ISO 5455), from memory."""

SCALES_SOURCE = Source("ISO 5455", "from memory", "scales of drawings")


def scale_for(width: float, height: float, widest: float, highest: float) -> float:
    """Return the largest standard scale at which something fits."""
    fits = (scale for scale in SCALES if width * scale <= widest and height * scale <= highest)
    return next(fits, min(widest / width, highest / height))


def scale_text(scale: float) -> str:
    """Return a scale as a drawing says it.

    Examples
    --------
    >>> scale_text(0.5), scale_text(2.0)
    ('1:2', '2:1')
    """
    return f"{scale:g}:1" if scale >= 1.0 else f"1:{1.0 / scale:.4g}"


class Drawing:
    """A drawing that grows by what is put on it.

    Parameters
    ----------
    title : str
        What it shows, for those who hear it read.
    """

    def __init__(self, title: str) -> None:
        self._title = title
        self._parts: list[str] = []
        self._low = [math.inf, math.inf]
        self._high = [-math.inf, -math.inf]

    def _reach(self, points: Iterable[Point], around: float = 0.3) -> None:
        for point in points:
            for axis in (0, 1):
                self._low[axis] = min(self._low[axis], point[axis] - around)
                self._high[axis] = max(self._high[axis], point[axis] + around)

    def line(
        self, points: Sequence[Point], pen: str = "wide", *, closed: bool = False,
        fill: str = "none",
    ) -> None:  # fmt: skip
        """Draw straight lines through points."""
        self._reach(points)
        path = "M" + "L".join(f"{x:.3f} {y:.3f}" for x, y in points) + ("Z" if closed else "")
        self._parts.append(
            f'<path d="{path}" fill="{fill}" stroke="#000" stroke-linejoin="round" {_PENS[pen]}/>'
        )

    def circle(self, centre: Point, radius: float, pen: str = "wide") -> None:
        """Draw a circle."""
        x, y = centre
        self._reach([(x - radius, y - radius), (x + radius, y + radius)])
        self._parts.append(
            f'<circle cx="{x:.3f}" cy="{y:.3f}" r="{radius:.3f}" fill="none" stroke="#000" '
            f"{_PENS[pen]}/>"
        )

    def text(self, at: Point, words: Words, anchor: str = "middle", turned: bool = False) -> None:
        """Write words; numbers among them keep all their digits, symbols are set."""
        shown = said(Sentence(*(w if isinstance(w, Number) else str(w) for w in words)))
        parts = shown.parts if isinstance(shown, Sentence) else (shown,)
        length = 0.58 * LETTERS * sum(map(len, parts))
        start = {"middle": -0.5, "start": 0.0, "end": -1.0}[anchor] * length
        x, y = at
        if turned:
            self._reach([(x - LETTERS, y - start - length), (x + 1.0, y - start)])
        else:
            self._reach([(x + start, y - LETTERS), (x + start + length, y + 1.0)])
        turn = f' transform="rotate(-90 {x:.3f} {y:.3f})"' if turned else ""
        self._parts.append(
            f'<text x="{x:.3f}" y="{y:.3f}" font-size="{LETTERS}" text-anchor="{anchor}" '
            f'font-family="Helvetica, Arial, DejaVu Sans, sans-serif"{turn}>'
            f"{''.join(map(_span, parts))}</text>"
        )

    def arrow(self, tip: Point, towards: Point) -> None:
        """Draw the head of an arrow at its tip, coming from a point."""
        length = math.dist(tip, towards) or 1.0
        ux, uy = (tip[0] - towards[0]) / length, (tip[1] - towards[1]) / length
        back = tip[0] - _ARROW * ux, tip[1] - _ARROW * uy
        wide = _ARROW / 6.0
        corners = [tip, (back[0] - wide * uy, back[1] + wide * ux),
                   (back[0] + wide * uy, back[1] - wide * ux)]  # fmt: skip
        self.line(corners, "narrow", closed=True, fill="#000")

    def dimension(self, one: Point, other: Point, at: float, words: Words) -> None:
        """Draw a dimension between two points that stand above each other, or side by side.

        Its line stands at ``x = at`` where they stand above each other, else at ``y = at``.
        """
        upright = abs(one[0] - other[0]) < abs(one[1] - other[1])
        if upright:
            one, other = sorted((one, other), key=lambda point: point[1])
            ends = (at, one[1]), (at, other[1])
        else:
            one, other = sorted((one, other))
            ends = (one[0], at), (other[0], at)
        for point, end in zip((one, other), ends, strict=True):
            if math.dist(point, end) > 0.0:
                length = math.dist(point, end)
                over = tuple(e + (e - p) / length for p, e in zip(point, end, strict=True))
                self.line([point, (over[0], over[1])], "narrow")
        middle = (ends[0][0] + ends[1][0]) / 2.0, (ends[0][1] + ends[1][1]) / 2.0
        if math.dist(*ends) > 3.0 * _ARROW:
            self.line(ends, "narrow")
            self.arrow(ends[0], ends[1])
            self.arrow(ends[1], ends[0])
        else:
            away = 2.0 * _ARROW
            out = (0.0, away) if upright else (away, 0.0)
            for end, sign in ((ends[0], -1.0), (ends[1], 1.0)):
                start = end[0] + sign * out[0], end[1] + sign * out[1]
                self.line([start, end], "narrow")
                self.arrow(end, start)
        length = 0.58 * LETTERS * sum(len(word) for word in words)
        beside = max(length - math.dist(*ends), 0.0) and (length / 2.0 + 2.0 * _ARROW + 1.0)
        if upright:
            place = middle[1] if not beside else ends[0][1] - beside
            self.text((at - 0.8, place), words, turned=True)
        else:
            place = middle[0] if not beside else ends[1][0] + beside
            self.text((place, at - 0.8), words)

    def hatch(self, corners: Sequence[Point]) -> None:
        """Draw lines at 45 degrees over what is cut: a polygon, by even and odd crossings."""
        turned = [(x + y, x - y) for x, y in corners]
        low, high = min(u for u, _ in turned), max(u for u, _ in turned)
        u = low + 0.37 * _HATCH
        while u < high:
            crossings = []
            for (u0, v0), (u1, v1) in zip(turned, [*turned[1:], turned[0]], strict=True):
                if (u0 <= u) != (u1 <= u):
                    crossings.append(v0 + (v1 - v0) * (u - u0) / (u1 - u0))
            crossings.sort()
            for v0, v1 in zip(crossings[::2], crossings[1::2], strict=False):
                ends = [((u + v) / 2.0, (u - v) / 2.0) for v in (v0, v1)]
                self.line(ends, "narrow")
            u += _HATCH * math.sqrt(2.0)

    def svg(self) -> str:
        """Return the drawing as an element of a page, as large as it is on paper."""
        (x, y), (x1, y1) = self._low, self._high
        width, height = x1 - x, y1 - y
        return Markup(
            '<svg xmlns="http://www.w3.org/2000/svg" role="img" width="{:.2f}mm" '
            'height="{:.2f}mm" viewBox="{:.3f} {:.3f} {:.3f} {:.3f}"><title>{}</title>{}</svg>'
        ).format(
            width, height, x, y, width, height, said(self._title), Markup("".join(self._parts))
        )


def _span(word: str) -> str:
    if isinstance(word, Number):
        key = f' data-key="{escape(word.key)}"' if word.key else ""
        return f'<tspan data-value="{word.value!r}"{key}>{escape(str(word))}</tspan>'
    return (
        str(typeset(word))
        .replace("<sub>", f'<tspan font-size="{0.7 * LETTERS:g}" dy="0.6">')
        .replace("</sub>", '</tspan><tspan dy="-0.6">&#8203;</tspan>')
    )

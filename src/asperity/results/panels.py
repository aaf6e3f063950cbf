"""Panels of a picture as data: what is drawn over what, in which look; one drawer draws them.

::

    drawn([Panel("time (ms)", "friction (N)", [line(0, time, force, "along"), level(full)])])
"""

import dataclasses
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from asperity.results.figures import BLACK, COLOURS, DASHES, axes_grid, legend

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

MARKERS = ("o", "s", "^", "D", "v", "P", "X")
DOTTED = (1, 1.5)
ABOVE: Mapping[str, Any] = {"loc": "lower center", "bbox_to_anchor": (0.5, 1.0)}
BELOW: Mapping[str, Any] = {"loc": "upper center", "bbox_to_anchor": (0.5, -0.2)}
"""Where a legend covers no curve."""


@dataclasses.dataclass(frozen=True)
class Mark:
    """Something in a panel: a name of matplotlib's for it, of what, and in which look.

    Attributes
    ----------
    kind : str
        ``plot``, ``axhline``, ``axvline`` or ``fill_between``.
    values : tuple
        Places and values.
    style : mapping
        Colour, dashes, marker, label.
    in_panel : bool
        Whether what runs up is in parts of the panel, from 0 to 1.
    """

    kind: str
    values: tuple[Any, ...]
    style: Mapping[str, Any]
    in_panel: bool = False

    def put(self, axes: "Axes") -> None:
        """Draw it."""
        style = dict(self.style)
        if self.in_panel:
            style["transform"] = axes.get_xaxis_transform()
        getattr(axes, self.kind)(*self.values, **style)


def line(index: int, x: Any, y: Any, label: str = "", **style: Any) -> Mark:
    """Return a curve in the look of its place among several."""
    look: dict[str, Any] = {"color": COLOURS[index], "dashes": DASHES[index]}
    return Mark("plot", (x, y), {**look, "label": label or None, **style})


def points(
    index: int, x: Any, y: Any, label: str = "", *, filled: bool = False, **style: Any
) -> Mark:
    """Return points without a curve, in the look of their place among several."""
    look: dict[str, Any] = {"color": COLOURS[index], "marker": MARKERS[index], "linestyle": "none"}
    if not filled:
        look |= {"markerfacecolor": "none", "markeredgewidth": 1.2}
    return Mark("plot", (x, y), {**look, "label": label or None, **style})


def level(at: float, label: str = "", *, upright: bool = False, **style: Any) -> Mark:
    """Return a straight line through a panel, level or upright."""
    look: dict[str, Any] = {"color": BLACK, "dashes": (1, 2), "linewidth": 1.0}
    kind = "axvline" if upright else "axhline"
    return Mark(kind, (at,), {**look, "label": label or None, **style})


def band(x: Any, low: Any, high: Any, colour: str) -> Mark:
    """Return what lies between two curves."""
    return Mark("fill_between", (x, low, high), {"color": colour, "alpha": 0.25, "linewidth": 0.0})


def shade(x: Any, where: Any, label: str | None = None, **style: Any) -> Mark:
    """Return stretches of a panel that are shaded from below to above."""
    look = {"where": where, "linewidth": 0.0, "label": label, **style}
    return Mark("fill_between", (x, 0.0, 1.0), look, in_panel=True)


@dataclasses.dataclass(frozen=True)
class Panel:
    """A panel.

    Attributes
    ----------
    x, y : str
        What its axes are, with units.
    marks : sequence of Mark
        What it shows, in the order in which it is drawn.
    title : str
        Above it, to the left.
    legend : mapping or None
        How curves are named; None where they are not.
    tight : bool
        Whether curves run from side to side.
    limits : mapping
        More of the axes, by matplotlib's names: ``ylim``, ``xscale``, ``ymargin``.
    more : callable, optional
        Draws what is special.
    """

    x: str = ""
    y: str = ""
    marks: Sequence[Mark] = ()
    title: str = ""
    legend: Mapping[str, Any] | None = None
    tight: bool = True
    limits: Mapping[str, Any] = dataclasses.field(default_factory=dict)
    more: "Callable[[Axes], object] | None" = None

    def put(self, axes: "Axes") -> None:
        """Draw it."""
        for mark in self.marks:
            mark.put(axes)
        axes.set(xlabel=self.x, ylabel=self.y)
        if self.title:
            axes.set_title(self.title, loc="left")
        if self.tight:
            axes.margins(x=0.0)
        axes.set(**self.limits)
        if self.more is not None:
            self.more(axes)
        if self.legend is not None:
            legend(axes, **self.legend)


def drawn(
    shown: Sequence[Panel], *, columns: int = 1, width: float = 7.0, height: float = 4.2
) -> "Figure":
    """Draw panels, row by row."""
    figure, axes = axes_grid(-(-len(shown) // columns), columns, width=width, height=height)
    for place, panel in zip(axes, shown, strict=False):
        panel.put(place)
    return figure

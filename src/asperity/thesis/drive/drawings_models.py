"""Pictures of the simulation's model, drawn from their datasets alone."""

from typing import TYPE_CHECKING, Any

import numpy as np

from asperity.results.figures import BLACK, COLOURS, axes_grid
from asperity.thesis.drawing import asperity
from asperity.thesis.flanks.drawings_solids import BRONZE, STEEL, View, paint
from asperity.thesis.flanks.shapes import Shape

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_BORE = View((0.5, 0.35, 1.0))
_WHOLE = View((-0.5, 0.45, 1.0))
_GREEN = "#58A06B"


def _projected(view: View, points: Any) -> Any:
    return np.asarray(points) @ view.axes[:2].T


def bore(dataset: "xr.Dataset") -> "Figure":
    """Draw the ring of teeth with its inside in green, on the centre point."""
    figure, (axes,) = axes_grid(1, 1, width=7.0, height=5.6)
    paint(axes, Shape.read(dataset, "ring"), {0: BRONZE, 1: _GREEN}, _BORE, edges=0.1)
    centre = _projected(_BORE, dataset["centre"].values)
    for node in _projected(_BORE, dataset["linked"].values):
        axes.plot(*zip(centre, node, strict=True), color=BLACK, linewidth=0.6, zorder=3)
    axes.plot(*centre, "o", color=BLACK, markersize=5, zorder=4)
    axes.annotate("centre point", centre, (12, -16), textcoords="offset points")
    return figure


def model(dataset: "xr.Dataset") -> "Figure":
    """Draw the meshed wheel and the worm on its torsional spring."""
    figure, (axes,) = axes_grid(1, 1, width=8.0, height=6.0)
    paint(axes, Shape.read(dataset, "gearset"), {0: BRONZE, 1: STEEL}, _WHOLE, edges=0.08)
    axes.plot(*_projected(_WHOLE, dataset["spring"].values).T, color=COLOURS[0], linewidth=1.6)
    ends = _projected(_WHOLE, dataset["ends"].values)
    for name, end in zip("AB", ends, strict=True):
        axes.plot(*end, "o", color=BLACK, markersize=5)
        beside = (-8, 10) if name == "A" else (4, 8)
        axes.annotate(name, end, beside, textcoords="offset points", weight="bold")
    axes.annotate("AB: 4394 N m/rad", ends[1], (10, -22), textcoords="offset points")
    tip = ends[1] + _projected(_WHOLE, 26.0 * dataset["axis"].values)
    axes.annotate("", tip, ends[1], arrowprops={"arrowstyle": "->", "color": BLACK})
    axes.annotate("X", tip, (4, -2), textcoords="offset points")
    for name, direction in zip("YZ", dataset["across"].values, strict=True):
        end = ends[1] + _projected(_WHOLE, 26.0 * direction)
        axes.annotate("", end, ends[1], arrowprops={"arrowstyle": "->", "color": BLACK})
        axes.annotate(name, end, (4, -2), textcoords="offset points")
        axes.update_datalim([end])
    axes.update_datalim([tip])
    axes.autoscale_view()
    return figure


def increment(dataset: "xr.Dataset") -> "Figure":
    """Draw body and root of an asperity through the two phases of an increment."""
    figure, (axes,) = axes_grid(1, 1, width=7.2, height=4.6)
    body, root = dataset["body"].values, dataset["root"].values
    # M'2 is carried by dy, and the second phase begins there.
    stretched = ((root[0], body[0]), (root[1], body[1]), (root[3], body[2]))
    shifts = ((-74, -2), (8, -12), (8, -12))
    asperity(axes, body, root, stretched, dataset["deflection"].values, shifts)
    for place, names, offsets in ((body, _BODIES, _BESIDE_BODIES), (root, _ROOTS, _BESIDE_ROOTS)):
        for at, name, offset in zip(place, names, offsets, strict=True):
            axes.annotate(name, at, offset, textcoords="offset points")
    for (one, other), name, shift in zip(
        ((body[0], body[1]), (body[1], body[2])), ("Δx", "Δy"), ((0, 5), (6, 0)), strict=True
    ):
        axes.annotate(name, 0.5 * (one + other), shift, textcoords="offset points")
    for (root_at, _), angle, name, n in zip(
        stretched[1:], dataset["angle"].values, ("α", "β"), (1, 2), strict=True
    ):
        turn = np.linspace(0.0, angle, 30)
        arc = root_at[:, None] + 0.16 * np.array([np.cos(turn), np.sin(turn)])
        axes.plot(*arc, color=COLOURS[n], linewidth=1.2)
        axes.plot(
            [root_at[0], root_at[0] + 0.22], [root_at[1]] * 2, color=COLOURS[n], linewidth=0.7
        )
        axes.annotate(name, arc[:, 20], (4, 0), textcoords="offset points", color=COLOURS[n])
    _equal(axes, "along x, over $s_{max}$", "along y, over $s_{max}$")
    return figure


_BODIES, _BESIDE_BODIES = ("N'", "N''", "N'₁"), ((-6, 9), (8, -3), (-4, 9))
_ROOTS, _BESIDE_ROOTS = ("M", "M'¹", "M'²", "M₁"), ((-4, -16), (-4, -16), (-24, 4), (-4, -16))


def _equal(axes: "Axes", x: str, y: str) -> None:
    axes.set_aspect("equal")
    axes.set_xlabel(x)
    axes.set_ylabel(y)
    axes.margins(0.12)

"""Figures 4.9, 4.10 and 4.13 of their datasets: body, asperity and base seen askew, and forces."""

from typing import TYPE_CHECKING, Any

import numpy as np

from asperity.arrays import FloatArray
from asperity.results.figures import BLACK, COLOURS, GREEN, ORANGE, axes_grid
from asperity.thesis.drawing import arrow

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

# Of a place in space, seen askew: x to the right, y into the picture, z up.
_SEEN = np.array([[1.0, 0.0], [0.5, 0.38], [0.0, 1.0]])
_BODY, _BASE = (1.0, 0.8, 0.5), (2.6, 1.5, 0.12)
_HIGH = 0.35  # of the asperity


def _shown(places: Any) -> FloatArray:
    return np.asarray(np.asarray(places, float) @ _SEEN)


def _box(axes: "Axes", corner: Any, size: tuple[float, float, float], colour: str) -> None:
    """Draw the three sides of a box that are seen: front, top and right."""
    x, y, z = np.asarray(corner, float)[:, None] + np.array([[0.0, each] for each in size])
    sides = (
        ((x[0], y[0], z[0]), (x[1], y[0], z[0]), (x[1], y[0], z[1]), (x[0], y[0], z[1])),
        ((x[0], y[0], z[1]), (x[1], y[0], z[1]), (x[1], y[1], z[1]), (x[0], y[1], z[1])),
        ((x[1], y[0], z[0]), (x[1], y[1], z[0]), (x[1], y[1], z[1]), (x[1], y[0], z[1])),
    )
    for n, side in enumerate(sides):
        axes.fill(*_shown(side).T, facecolor=colour, alpha=0.16 + 0.08 * n, edgecolor=BLACK,
                  linewidth=0.9)  # fmt: skip


def _name(axes: "Axes", name: str, at: Any, beside: tuple[float, float], colour: str) -> None:
    x, y = _shown(at)
    axes.annotate(name, (x, y), beside, textcoords="offset points", color=colour)


def _arrow(
    axes: "Axes", start: Any, way: Any, name: str, colour: str, beside: tuple[float, float]
) -> None:
    first, last = _shown(start), _shown(np.add(start, way))
    arrow(axes, first, last, colour, linewidth=1.8, shrinkA=0, shrinkB=0)
    axes.annotate(name, (last[0], last[1]), beside, textcoords="offset points", color=colour)
    axes.update_datalim([first, last])


def setup(dataset: "xr.Dataset") -> "Figure":
    """Draw body on its drive spring, the asperity that it bends, and the base that is shaken."""
    figure, (axes,) = axes_grid(1, 1, width=7.2, height=4.2)
    along, across = (float(value) for value in dataset["base"].values)
    length, height = _BODY[0], _BASE[2] + _HIGH
    _box(axes, (0.0, 0.0, 0.0), _BASE, ORANGE)
    _box(axes, (0.7, 0.35, height), _BODY, COLOURS[0])
    root = np.array([0.95, 0.75 - 0.3 * across, _BASE[2]])
    end = np.array([1.2, 0.75, height])
    axes.plot(*_shown([root, end]).T, color=GREEN, linewidth=2.2, marker="o", markersize=4)
    _name(axes, "M", root, (-16, -3), GREEN)
    _name(axes, "N", end, (6, -12), GREEN)
    flat = np.array([end[0], end[1], _BASE[2]])
    axes.plot(*_shown([end, flat]).T, color=BLACK, linewidth=0.7, linestyle=":")
    axes.plot(*_shown([root, flat]).T, color=GREEN, linewidth=1.2, linestyle="--")
    _name(axes, "N'", flat, (5, -7), BLACK)
    _name(axes, "s", 0.5 * (root + flat), (-2, -14), GREEN)
    # The spring of the drive, and what pulls at it.
    turns = np.linspace(0.0, 1.0, 200)
    waves = 0.07 * np.sin(2.0 * np.pi * 7.0 * turns) * (np.abs(turns - 0.5) < 0.4)
    coil = np.column_stack([0.7 + length + 0.8 * turns, np.full(200, 0.75), height + 0.25 + waves])
    axes.plot(*_shown(coil).T, color=BLACK, linewidth=1.0)
    _name(axes, "$k_d$", coil[100], (-4, 12), BLACK)
    _arrow(axes, coil[-1], (0.45, 0.0, 0.0), "$v_d$", BLACK, (4, -4))
    above = np.array([1.2, 0.75, height + _BODY[2] + 0.4])
    _arrow(axes, above, (0.0, 0.0, -0.4), "$F_N$", BLACK, (6, 14))
    corner = np.array([0.25, 0.3, _BASE[2]])
    if along:
        _arrow(axes, corner, (0.6 * along, 0.0, 0.0), "$x_b$", COLOURS[1], (-6, -15))
    _arrow(axes, corner, (0.0, 0.9 * across, 0.0), "$y_b$", COLOURS[2], (-20, 0))
    axes.set_aspect("equal")
    axes.set_axis_off()
    axes.margins(0.06)
    return figure


def forces(dataset: "xr.Dataset") -> "Figure":
    """Draw the friction on the body from above, its components and the drive force."""
    figure, (axes,) = axes_grid(1, 1, width=5.4, height=4.4)
    force, beta = dataset["force"].values, float(dataset["beta"])
    axes.plot([-0.2, 0.2, 0.2, -0.2, -0.2], [-0.16, -0.16, 0.16, 0.16, -0.16], color=BLACK,
              linewidth=0.9)  # fmt: skip
    vectors: tuple[tuple[Any, str, tuple[int, int], str], ...] = (
        (force, "$\\mathbf{F}$", (-8, 6), COLOURS[0]),
        ((force[0], 0.0), "$\\mathbf{F}_x$", (-6, -18), COLOURS[1]),
        ((0.0, force[1]), "$\\mathbf{F}_y$", (6, -2), COLOURS[2]),
        ((float(dataset["drive"]), 0.0), "$\\mathbf{F}_d$", (-6, -18), BLACK),
    )
    for end, name, beside, colour in vectors:
        arrow(axes, (0.0, 0.0), end, colour, linewidth=1.8, shrinkA=0, shrinkB=0)
        axes.annotate(name, end, beside, textcoords="offset points", color=colour)
        axes.update_datalim([end])
    for end in ((force[0], 0.0), (0.0, force[1])):
        axes.plot(*np.transpose([force, end]), color=BLACK, linewidth=0.6)
    turn = np.linspace(0.0, beta, 30)
    axes.plot(-0.35 * np.cos(turn), 0.35 * np.sin(turn), color=BLACK, linewidth=1.0)
    axes.annotate("β", (-0.35, 0.0), (-12, 4), textcoords="offset points")
    axes.set_aspect("equal")
    axes.margins(0.15)
    axes.set(xlabel="along the drive, over $\\mu F_N$", ylabel="across it, over $\\mu F_N$")
    return figure

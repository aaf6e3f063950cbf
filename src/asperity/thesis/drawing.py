"""What pictures of the thesis are drawn with: lines, marks, limits, and axes that several share."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from asperity.arrays import FloatArray
from asperity.results import panels
from asperity.results.figures import BLACK, COLOURS, legend
from asperity.results.panels import DOTTED

__all__ = [
    "DOTTED",
    "OVER_DIRECTION",
    "OVER_RATIO",
    "arrow",
    "asperity",
    "legend_above",
    "limit",
    "line",
    "marks",
]

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_SIZES = ("s", "s'", "s₁")  # deflections, before and after each phase
_RATIO = r"drive force over $\mu F_N$"
OVER_RATIO: dict[str, Any] = {
    "xlabel": r"velocity ratio $k = v_a/v_d$", "xticks": range(0, 21, 2), "xlim": (0.0, 20.5),
    "ylabel": _RATIO,
}  # fmt: skip
OVER_DIRECTION: dict[str, Any] = {
    "xlabel": "direction of vibration (deg)", "xticks": range(0, 361, 45), "xlim": (-6.0, 366.0),
    "ylabel": _RATIO,
}  # fmt: skip


def line(axes: "Axes", index: int, x: Any, y: Any, label: str = "", **style: Any) -> None:
    """Draw a line in the look of its place among several."""
    panels.line(index, x, y, label, **style).put(axes)


def marks(axes: "Axes", index: int, x: Any, y: Any, label: str = "", **style: Any) -> None:
    """Draw points without a line, in the look of their place among several."""
    panels.points(index, x, y, label, **style).put(axes)


def limit(axes: "Axes", *values: float) -> None:
    """Draw forces that cannot be passed."""
    for value in values:
        panels.level(value).put(axes)


def arrow(axes: "Axes", start: Any, end: Any, colour: str, **look: Any) -> None:
    """Draw an arrow from a point to another, with a full head unless the look says else."""
    axes.annotate("", end, start, arrowprops={"arrowstyle": "-|>", "color": colour, **look})


def legend_above(axes: "Axes", columns: int) -> None:
    """Put a legend above a panel, in some columns."""
    legend(axes, **panels.ABOVE, ncols=columns)


def asperity(
    axes: "Axes",
    body: FloatArray,
    root: FloatArray,
    stretched: Sequence[tuple[Any, Any]],
    sizes: FloatArray,
    beside: Sequence[tuple[float, float]],
) -> None:
    """Draw the ways of body and root, and the asperity between them as it is stretched.

    Each stretch from its end on the root to that on the body, its size at a place beside it.
    """
    for n, (one, other) in enumerate(stretched):
        axes.plot(*zip(one, other, strict=True), color=COLOURS[n], linewidth=2.0)
    axes.plot(*body.T, "o-", color=BLACK, linewidth=0.9, markersize=4)
    axes.plot(*root.T, "s:", color=BLACK, linewidth=0.9, markersize=4)
    for (one, other), name, size, shift in zip(stretched, _SIZES, sizes, beside, strict=True):
        axes.annotate(
            f"{name} = {size:.2f}", 0.5 * (one + other), shift, textcoords="offset points"
        )

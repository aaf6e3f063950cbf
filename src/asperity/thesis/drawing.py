"""What pictures of the thesis are drawn with: lines, marks, limits, and axes that several share."""

from typing import TYPE_CHECKING, Any

from asperity.results import panels
from asperity.results.figures import legend
from asperity.results.panels import DOTTED

__all__ = ["DOTTED", "OVER_DIRECTION", "OVER_RATIO", "legend_above", "limit", "line", "marks"]

if TYPE_CHECKING:
    from matplotlib.axes import Axes

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


def legend_above(axes: "Axes", columns: int) -> None:
    """Put a legend above a panel, in some columns."""
    legend(axes, **panels.ABOVE, ncols=columns)

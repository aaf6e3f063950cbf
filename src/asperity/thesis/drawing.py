"""What pictures of the thesis are drawn with: lines, marks, limits, and axes that several share."""

from typing import TYPE_CHECKING, Any

from asperity.results.figures import BLACK, COLOURS, DASHES, legend

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
MARKERS = "osD^v"
DOTTED = (1, 1.5)


def line(axes: "Axes", index: int, x: Any, y: Any, label: str = "", **style: Any) -> None:
    """Draw a line in the look of its place among several."""
    look: dict[str, Any] = {"color": COLOURS[index], "dashes": DASHES[index]}
    axes.plot(x, y, label=label or None, **(look | style))


def marks(
    axes: "Axes", index: int, x: Any, y: Any, label: str = "", *, filled: bool = False, **style: Any
) -> None:
    """Draw points without a line, in the look of their place among several."""
    look: dict[str, Any] = {"color": COLOURS[index], "marker": MARKERS[index], "linestyle": "none"}
    if not filled:
        look |= {"markerfacecolor": "none", "markeredgewidth": 1.2}
    axes.plot(x, y, label=label or None, **(look | style))


def limit(axes: "Axes", *values: float) -> None:
    """Draw forces that cannot be passed."""
    for value in values:
        axes.axhline(value, color=BLACK, dashes=(1, 2), linewidth=1.0)


def legend_above(axes: "Axes", columns: int) -> None:
    """Put a legend above a panel, in some columns."""
    legend(axes, loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=columns)

"""Pictures of a solved sliding body."""

from typing import TYPE_CHECKING, Any

import numpy as np

from asperity.errors import InputError

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from asperity.slider.result import SlideResult

# Okabe and Ito's colours, which colour-blind readers tell apart; dashes and markers tell as well.
BLUE, VERMILION, GREEN, PURPLE, ORANGE, SKY, BLACK = (
    "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000",
)  # fmt: skip
STYLE: dict[Any, Any] = {
    "font.size": 11.0,
    "axes.labelsize": 11.0,
    "axes.titlesize": 11.0,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "legend.fontsize": 10.0,
    "legend.frameon": False,
    "lines.linewidth": 1.5,
    "axes.grid": True,
    "grid.color": "#DDDDDD",
    "grid.linewidth": 0.6,
    "axes.axisbelow": True,
}
_CYCLES = 3


def panels(
    rows: int = 1, columns: int = 1, *, width: float = 7.0, height: float = 4.2
) -> "tuple[Figure, list[Axes]]":
    """Return a figure of the house's style and its axes, without touching matplotlib's state."""
    import matplotlib as mpl
    from matplotlib.figure import Figure

    with mpl.rc_context(STYLE):
        figure = Figure(figsize=(width, height), layout="constrained")
        axes = figure.subplots(rows, columns, squeeze=False)
    return figure, list(axes.flat)


def legend(axes: "Axes", **options: Any) -> None:
    """Put a legend where it hides least."""
    import matplotlib as mpl

    with mpl.rc_context(STYLE):
        axes.legend(**options)


def plot_result(result: "SlideResult") -> "Figure":
    """Draw the drive force over time and the friction over the last cycles.

    Raises
    ------
    InputError
        The result was made without a history.
    """
    history = result.history
    if history is None:
        raise InputError("the result has no history to draw; solve with history=True")
    figure, (upper, lower) = panels(2, height=6.2)
    time, force = history.time, result.static_drive_force
    periodic = result.model.solve.method == "periodic"
    scale, unit = (1e3, "ms") if periodic or time[-1] < 0.1 else (1.0, "s")
    upper.plot(scale * time, history.drive_force, color=BLUE)
    upper.axhline(force, color=BLACK, dashes=(4, 3), linewidth=1.0)
    upper.annotate(
        r"$\mu F_N$", (1.0, force), (-2, 3), xycoords=("axes fraction", "data"),
        textcoords="offset points", ha="right", va="bottom",
    )  # fmt: skip
    upper.set_xlabel(f"time ({unit})")
    upper.set_ylabel("drive force (N)")
    upper.set_title(rf"Drive force, mean {result.ratio:.4g} $\mu F_N$", loc="left")
    upper.margins(x=0.0, y=0.12)
    last = slice(None)
    if result.model.vibrates and not periodic:
        last = slice(int(np.searchsorted(time, time[-1] - _CYCLES / result.model.frequency)), None)
    shown = 1e3 * (time[last] - time[last][0])
    lower.plot(shown, history.friction[last, 0], color=VERMILION, label="along the drive, x")
    if np.any(history.friction[:, 1]):
        lower.plot(shown, history.friction[last, 1], color=GREEN, dashes=(5, 2), label="across, y")
    lower.set_xlabel("time in the last cycles (ms)" if result.model.vibrates else "time (ms)")
    lower.set_ylabel("friction (N)")
    lower.set_title("Friction on the body", loc="left")
    lower.margins(x=0.0)
    legend(lower, loc="lower right", bbox_to_anchor=(1.0, 0.98), ncols=2)
    return figure

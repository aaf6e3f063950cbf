"""Pictures of a solved sliding body."""

from typing import TYPE_CHECKING

import numpy as np

from asperity.errors import InputError
from asperity.results.figures import BLACK, BLUE, GREEN, VERMILION, legend, panels

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from asperity.slider.result import SlideResult

_CYCLES = 3


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

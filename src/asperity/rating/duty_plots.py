"""Powers and temperatures of a load spectrum, drawn."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from asperity.rating.duty import DutyPart
from asperity.rating.warming import Warming
from asperity.results.figures import BLACK, BLUE, VERMILION, axes_grid, legend

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_MINUTE, _HOUR = 60.0, 3600.0
_LONG = 4.0 * _HOUR


def plot_duty(parts: Sequence[DutyPart], limit: float, warming: Warming | None) -> "Figure":
    """Draw losses and oil temperatures over the running time, and how the housing warms.

    Parameters
    ----------
    parts : sequence of DutyPart
        In their order.
    limit : float
        Temperature that the oil bears, degC.
    warming : Warming or None
        Of the housing from cold.
    """
    figure, axes = axes_grid(1, 2, width=9.0, height=3.6)
    ends = np.cumsum([0.0, *(part.hours for part in parts)])
    losses, oil = axes[0], axes[1]
    values = [part.loss for part in parts]
    losses.stairs(values, ends, color=BLUE, fill=True, alpha=0.35)
    losses.stairs(values, ends, color=BLUE)
    losses.set_xlabel("running time (h)")
    losses.set_ylabel("loss (W)")
    losses.set_ylim(0.0, 1.15 * max(values))
    if len(parts) <= 6:
        for part, start, end in zip(parts, ends, ends[1:], strict=False):
            losses.annotate(
                f"{part.torque:.4g} N m", (0.5 * (start + end), part.loss), ha="center",
                va="bottom", xytext=(0, 2), textcoords="offset points", fontsize="small",
            )  # fmt: skip
    if warming is None:
        _sumps(oil, parts, ends)
    else:
        _warming(oil, warming)
    top = max(limit, *oil.get_ylim())
    oil.axhline(limit, color=BLACK, dashes=(4, 3), label="what the oil bears")
    oil.set_ylim(top=1.05 * top)
    oil.set_ylabel("oil (\u00b0C)")
    legend(oil, loc="best")
    return figure


def _sumps(axes: Any, parts: Sequence[DutyPart], ends: Any) -> None:
    sumps = [np.nan if part.sump is None else part.sump for part in parts]
    axes.stairs(sumps, ends, baseline=None, color=VERMILION, label="sump by ISO/TR 14521")
    axes.set_xlabel("running time (h)")


def _warming(axes: Any, warming: Warming) -> None:
    long = warming.time[-1] > _LONG
    time = warming.time / (_HOUR if long else _MINUTE)
    axes.plot(time, warming.temperature, color=VERMILION, label="by heat balance, from cold")
    axes.set_xlabel(f"time ({'h' if long else 'min'})")

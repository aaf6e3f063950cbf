"""Small pictures of findings: what each is seen by, and where."""

from typing import TYPE_CHECKING

import numpy as np

from asperity.arrays import FloatArray
from asperity.results.figures import BLACK, BLUE, ORANGE, panels

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_MOST = 24  # pictures
_COLUMNS = 2
_FEW = 30  # points, which are drawn as such
_LONGEST = 62  # signs of a title
_LEAST_MARK = 0.01  # of a picture's width
_LEAST_SPAN = 0.1  # of the largest value: what hardly moves is drawn as such


def plot_findings(dataset: "xr.Dataset") -> "Figure":
    """Draw each finding by what it is seen in, the place marked."""
    count = min(dataset.sizes.get("finding", 0), _MOST)
    rows = max(-(-count // _COLUMNS), 1)
    columns = _COLUMNS if count > 1 else 1
    figure, axes = panels(rows, columns, width=5.2 * columns, height=0.4 + 2.1 * rows)
    if not count:
        axes[0].text(0.5, 0.5, "nothing found", ha="center", transform=axes[0].transAxes)
        axes[0].set_axis_off()
    for place, panel in enumerate(axes):
        if place >= count:
            panel.set_axis_off()
            continue
        x, y = (dataset[name].values[place] for name in ("x", "y"))
        begin, end = dataset["marks"].values[place]
        # A course that is short ends in copies of its last point.
        same = (x[1:] == x[-1]) & (y[1:] == y[-1])
        own = x.size - int(np.argmin(same[::-1])) if not same.all() else 1
        if end > begin:
            # What is short is seen all the same.
            wide = max(0.5 * (_LEAST_MARK * float(np.ptp(x)) - (end - begin)), 0.0)
            begin, end = begin - wide, end + wide
            panel.axvspan(begin, end, color=ORANGE, alpha=0.25, linewidth=0.0)
        if own <= _FEW:
            panel.plot(x[:own], y[:own], color=BLACK, marker="o", linestyle="none", markersize=4)
        else:
            panel.plot(x[:own], y[:own], color=BLUE, linewidth=0.9)
        title = str(dataset["told"].values[place])
        _not_too_near(panel, y)
        panel.set_title(f"{place + 1}: {title[:_LONGEST]}", fontsize=9, loc="left")
        panel.set_xlabel(str(dataset["across"].values[place]), fontsize=9)
        panel.set_ylabel(str(dataset["up"].values[place]), fontsize=8)
        panel.tick_params(labelsize=8)
    return figure


def _not_too_near(panel: "Axes", values: FloatArray) -> None:
    low, high = panel.get_ylim()
    short = _LEAST_SPAN * float(np.abs(values).max()) - (high - low)
    if short > 0.0:
        panel.set_ylim(low - 0.5 * short, high + 0.5 * short)

"""Pictures of a sweep of worm gearsets: safeties and efficiency, over one axis or two."""

from typing import TYPE_CHECKING

import numpy as np

from asperity.rating.demands import DEMANDS
from asperity.rating.standing import NAMES
from asperity.results.figures import BLACK, COLOURS, DASHES, axes_grid, legend
from asperity.results.panels import MARKERS
from asperity.sweep.axis import POINT
from asperity.sweep.maps import axis_label, plane, ticks

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

_MOST_MARKED = 16  # points of a line
_EFFICIENCIES = {
    "iso14521_eta_ges": "ISO/TR 14521, gearbox",
    "iso14521_eta_z1_2": "ISO/TR 14521, teeth",
    "bs721_eta": "BS 721, teeth",
    "agma6034_eta": "AGMA 6034, teeth",
}


def plot_along(dataset: "xr.Dataset") -> "Figure":
    """Draw every safety over what is asked, and the efficiencies, over one axis."""
    (name,) = dataset["margin"].dims
    axis = dataset[name]
    numeric = axis.dtype.kind in "if"
    order = np.argsort(axis.values) if numeric else np.arange(axis.size)
    places = axis.values[order] if numeric else order
    figure, (upper, lower) = axes_grid(2, width=9.0, height=7.6)
    standards = list(NAMES)
    # Neighbouring rows of a table of points need not belong together.
    apart = name == POINT
    every = 1 if apart else -(-axis.size // _MOST_MARKED)
    line = "" if apart else "-"
    for number, demand in enumerate(DEMANDS):
        variable = f"{demand.standard}_{demand.key}"
        if variable in dataset:
            upper.plot(
                places, dataset[variable].values[order] / demand.asked,
                color=COLOURS[number % len(COLOURS)], marker=MARKERS[number % len(MARKERS)],
                linestyle=line if apart else (0, DASHES[standards.index(demand.standard)]),
                markersize=4.0, markevery=every, label=f"{NAMES[demand.standard]} {demand.name}",
            )  # fmt: skip
    upper.axhline(1.0, color=BLACK, linewidth=1.2)
    upper.set_ylabel("safety over what is asked")
    for (variable, label), colour, marker in zip(
        _EFFICIENCIES.items(), COLOURS, MARKERS, strict=False
    ):
        if variable in dataset:
            lower.plot(
                places, 100.0 * dataset[variable].values[order], color=colour, marker=marker,
                markersize=4.0, markevery=every, linestyle=line, label=label,
            )  # fmt: skip
    lower.set_ylabel("efficiency (%)")
    lower.set_xlabel(axis_label(axis))
    for panel in (upper, lower):
        if panel.lines[1:]:
            legend(panel, loc="upper left", bbox_to_anchor=(1.0, 1.0))
        if not numeric:
            panel.set_xticks(places, labels=[str(value) for value in axis.values])
    upper.set_ylim(bottom=0.0)
    return figure


def plot_plane(dataset: "xr.Dataset") -> "Figure":
    """Draw the least safety over what is asked, and the efficiency, over two numeric axes."""
    down, across = (str(dim) for dim in dataset["margin"].dims)
    order = dataset.sortby([down, across])
    shown = {
        "margin": "least safety over what is asked",
        "iso14521_eta_ges": "efficiency of the gearbox, ISO/TR 14521 (%)",
    }
    shown = {name: title for name, title in shown.items() if name in order}
    figure, axes = axes_grid(1, len(shown), width=1.0 + 5.0 * len(shown), height=4.8)
    for panel, (name, title) in zip(axes, shown.items(), strict=True):
        values = order[name].values
        if name == "margin":
            plane(panel, values, values, colours="RdBu")
        else:
            plane(panel, 100.0 * values, None, colours="viridis")
        ticks(panel, order, down, across)
        panel.set_title(title, fontsize=11.0)
    return figure

"""The picture of a plan."""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure


def plot_plan(dataset: "xr.Dataset") -> "Figure":
    """Draw frequency over the order of the cells, a colour for each supply."""
    import numpy as np
    from matplotlib.figure import Figure

    figure = Figure(figsize=(8.0, 3.2), layout="constrained")
    axes = figure.add_subplot()
    volts = dataset["steel_supply"].values
    cells = np.arange(1, volts.size + 1)
    for one in np.unique(volts):
        chosen = volts == one
        axes.plot(
            cells[chosen], dataset["frequency"].values[chosen], "o", markersize=3,
            label=f"{one:g} V",
        )  # fmt: skip
    axes.set_xlabel("cell, in order")
    axes.set_ylabel("frequency (Hz)")
    axes.legend(title="steel disc", loc="center left", bbox_to_anchor=(1.0, 0.5))
    return figure

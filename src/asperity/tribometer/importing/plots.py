"""The picture of a file that is looked at."""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

_MOST = 12  # columns drawn


def plot_columns(dataset: "xr.Dataset") -> "Figure":
    """Draw each column over time, between the least and the largest of what falls on a line."""
    import numpy as np
    from matplotlib.figure import Figure

    count = min(dataset.sizes["column"], _MOST)
    figure = Figure(figsize=(8.0, 0.8 + 1.1 * count), layout="constrained")
    panels = np.atleast_1d(figure.subplots(count, sharex=True))
    time = dataset["time"].values
    for place, axes in enumerate(panels):
        low, high = (dataset[one].values[place] for one in ("low", "high"))
        axes.fill_between(time, low, high, step="post", linewidth=0.8, edgecolor="C0")
        axes.set_ylabel(str(dataset["name"].values[place]).replace(" (", "\n("))
    panels[-1].set_xlabel("time (s)")
    return figure

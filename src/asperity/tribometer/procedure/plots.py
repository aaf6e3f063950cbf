"""The picture of a run."""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure


def plot_run(dataset: "xr.Dataset") -> "Figure":
    """Draw the torque of each cell before and with vibration."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(8.0, 3.2), layout="constrained")
    axes = figure.add_subplot()
    cells = dataset["cell"].values
    for name, label in (("torque_before", "before"), ("torque_with", "with vibration")):
        axes.plot(cells, dataset[name].values, "o", markersize=3, label=label)
    axes.set_xlabel("cell")
    axes.set_ylabel("torque of the steel disc (N m)")
    axes.set_ylim(bottom=0.0)
    axes.legend()
    if dataset.attrs.get("backend") == "sim":
        axes.set_title("simulated", loc="right", fontsize="small")
    return figure

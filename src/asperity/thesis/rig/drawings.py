"""The pictures of chapter 6, each drawn from its dataset alone."""

from typing import TYPE_CHECKING

from asperity.results.figures import legend, panels
from asperity.thesis.drawing import line, marks

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

_LOAD = r"normal load $F_N$ (N)"


def speeds(dataset: "xr.Dataset") -> "Figure":
    """Draw speeds above and currents below, over the load."""
    figure, (upper, lower) = panels(2, height=6.0)
    load = dataset["load"].values
    for panel, suffix, label in ((upper, "", "speed (rpm)"), (lower, "_current", "current (A)")):
        for index, disc in enumerate(("steel", "bronze")):
            values = dataset[f"{disc}{suffix}"].values
            line(panel, index, load, values)
            marks(panel, index, load, values, f"{disc} disc")
        panel.set(xlabel=_LOAD, ylabel=label)
        legend(panel)
    return figure


def sliding(dataset: "xr.Dataset") -> "Figure":
    """Draw velocities above and the slide-roll ratio below, with what is printed."""
    figure, (upper, lower) = panels(2, height=6.0)
    load = dataset["load"].values
    for index, name in enumerate(("sliding", "rolling")):
        line(upper, index, load, 1e3 * dataset[name].values, f"{name} velocity")
        marks(upper, index, load, 1e3 * dataset[f"printed_{name}"].values, marker="x")
    line(lower, 2, load, dataset["ratio"].values)
    marks(lower, 2, load, dataset["printed_ratio"].values, "printed", marker="x")
    upper.set(xlabel=_LOAD, ylabel="velocity (mm/s)")
    lower.set(xlabel=_LOAD, ylabel="slide-roll ratio R")
    legend(upper)
    legend(lower)
    return figure


def waveforms(dataset: "xr.Dataset") -> "Figure":
    """Draw displacement above and velocity below, over two periods."""
    figure, (upper, lower) = panels(2, height=5.6)
    time = 1e3 * dataset["time"].values
    for index, waveform in enumerate(dataset["waveform"].values):
        one = dataset.sel(waveform=waveform)
        line(upper, index, time, 1e6 * one["displacement"].values, str(waveform))
        line(lower, index, time, 1e3 * one["velocity"].values)
    upper.set(ylabel="displacement (µm)", xmargin=0.0)
    lower.set(xlabel="time (ms)", ylabel="velocity (mm/s)", xmargin=0.0)
    legend(upper, loc="upper right")
    return figure

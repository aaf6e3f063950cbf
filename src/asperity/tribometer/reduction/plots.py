"""Pictures of reduced recordings, drawn from their dataset."""

from typing import TYPE_CHECKING, Any

import numpy as np

from asperity.results.figures import BLACK, COLOURS, legend, panels

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

MARKERS = "osD^v<>P"


def plot_changes(dataset: "xr.Dataset") -> "Figure":
    """Draw the change of the torque over the frequency, a panel a direction and lubricant."""
    return changes(dataset, "torque_change", "change of the torque (%)")


def changes(dataset: "xr.Dataset", name: str, label: str) -> "Figure":
    """Draw a change over the frequency; marks of a waveform and supply are joined."""
    names = ("mode", "lubricant", "waveform")
    words = {key: dataset[key].values.astype(str) for key in names if key in dataset}
    kept = np.isfinite(dataset[name].values) if name in dataset else np.zeros(0, dtype=bool)
    cells = sorted({(words["mode"][n], words["lubricant"][n]) for n in np.flatnonzero(kept)})
    figure, axes = panels(max(len(cells), 1), height=1.0 + 3.2 * max(len(cells), 1))
    for panel, (mode, lubricant) in zip(axes, cells, strict=False):
        here = kept & (words["mode"] == mode) & (words["lubricant"] == lubricant)
        _lines(panel, dataset, words["waveform"], here, name)
        panel.set(xlabel="frequency (Hz)", ylabel=label, title=f"{mode}, {lubricant}")
        panel.axhline(0.0, color=BLACK, linewidth=0.8)
        legend(panel)
    for panel in axes:
        mark_simulated(dataset, panel)
    return figure


def mark_simulated(dataset: "xr.Dataset", axes: Any) -> None:
    """Write across a picture of simulated recordings that no rig stands behind it."""
    if "simulated" in dataset and np.any(dataset["simulated"].values):
        axes.text(
            0.5, 0.5, "simulated", transform=axes.transAxes, fontsize=34, color="#999999",
            alpha=0.35, ha="center", va="center", rotation=20,
        )  # fmt: skip


def _ends(dataset: "xr.Dataset", name: str) -> Any:
    """Return the ends of a quantity's intervals; None where there are none."""
    if name == "torque_change":
        return np.column_stack((dataset["low"].values, dataset["high"].values))
    return dataset[f"{name}_ci95"].values if f"{name}_ci95" in dataset else None


def _lines(panel: Any, dataset: "xr.Dataset", waveforms: Any, here: Any, name: str) -> None:
    supplies = dataset["motor_voltage"].values
    frequency = dataset["commanded"].values
    groups = sorted({(waveforms[n], supplies[n]) for n in np.flatnonzero(here)})
    for place, (waveform, supply) in enumerate(groups):
        rows = np.flatnonzero(here & (waveforms == waveform) & (supplies == supply))
        rows = rows[np.argsort(frequency[rows], kind="stable")]
        values = dataset[name].values[rows]
        colour, marker = COLOURS[place % len(COLOURS)], MARKERS[place % len(MARKERS)]
        dashes = () if waveform == "sine" else (4, 2)
        means = [(f, values[frequency[rows] == f].mean()) for f in np.unique(frequency[rows])]
        panel.plot(*zip(*means, strict=True), color=colour, dashes=dashes, linewidth=1.0)
        ends = _ends(dataset, name)
        if ends is not None:
            low, high = ends[rows].T
            bars = np.abs([values - low, high - values])
            panel.errorbar(frequency[rows], values, bars, color=colour, linestyle="none", capsize=2)
        panel.plot(
            frequency[rows], values, color=colour, marker=marker, linestyle="none",
            markerfacecolor="none", label=f"{waveform}, {supply:g} V",
        )  # fmt: skip

"""Pictures of the rig: plans, runs, columns of a file, findings, reduced recordings, fits."""

from typing import TYPE_CHECKING, Any

import numpy as np

from asperity.arrays import FloatArray
from asperity.results.figures import BLACK, BLUE, COLOURS, ORANGE, axes_grid, legend
from asperity.results.panels import Panel, drawn, level, line, points
from asperity.tribometer.reduction.result import REFUSED

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

MARKERS = "osD^v<>P"
_SMALL: dict[str, Any] = {"filled": True, "marker": "o", "markersize": 3}
_MOST_COLUMNS = 12
_MOST = 24  # findings
_ACROSS = 2
_FEW = 30  # points, which are drawn as such
_LONGEST = 62  # signs of a title
_LEAST_MARK = 0.01  # of a picture's width
_LEAST_SPAN = 0.1  # of the largest value: what hardly moves is drawn as such
_ENDS = 1.96  # deviations to the ends of 95 %


def plot_plan(dataset: "xr.Dataset") -> "Figure":
    """Draw frequency over the order of the cells, a colour for each supply."""
    volts, frequency = dataset["steel_supply"].values, dataset["frequency"].values
    cells = np.arange(1, volts.size + 1)
    marks = [
        points(place % len(COLOURS), cells[volts == one], frequency[volts == one], f"{one:g} V",
               **_SMALL)
        for place, one in enumerate(np.unique(volts))
    ]  # fmt: skip
    beside = {"title": "steel disc", "loc": "center left", "bbox_to_anchor": (1.0, 0.5)}
    panel = Panel("cell, in order", "frequency (Hz)", marks, legend=beside, tight=False)
    return drawn([panel], width=8.0, height=3.2)


def plot_run(dataset: "xr.Dataset") -> "Figure":
    """Draw the torque of each cell before and with vibration."""
    marks = [
        points(place, dataset["cell"].values, dataset[name].values, label, **_SMALL)
        for place, (name, label) in enumerate(
            (("torque_before", "before"), ("torque_with", "with vibration"))
        )
    ]
    panel = Panel("cell", "torque of the steel disc (N m)", marks, legend={}, tight=False,
                  limits={"ylim": (0.0, None)})  # fmt: skip
    figure = drawn([panel], width=8.0, height=3.2)
    if dataset.attrs.get("backend") == "sim":
        figure.axes[0].set_title("simulated", loc="right", fontsize="small")
    return figure


def plot_columns(dataset: "xr.Dataset") -> "Figure":
    """Draw each column over time, between the least and the largest of what falls on a line."""
    count = min(dataset.sizes["column"], _MOST_COLUMNS)
    figure, axes = axes_grid(count, width=8.0, height=0.8 + 1.1 * count)
    time = dataset["time"].values
    for place, panel in enumerate(axes):
        low, high = (dataset[one].values[place] for one in ("low", "high"))
        panel.fill_between(time, low, high, step="post", linewidth=0.8, color=BLUE)
        panel.set_ylabel(str(dataset["name"].values[place]).replace(" (", "\n("))
        panel.sharex(axes[-1])
        panel.tick_params(labelbottom=panel is axes[-1])
    axes[-1].set_xlabel("time (s)")
    return figure


def plot_findings(dataset: "xr.Dataset") -> "Figure":
    """Draw each finding by what it is seen in, the place marked."""
    count = min(dataset.sizes.get("finding", 0), _MOST)
    rows = max(-(-count // _ACROSS), 1)
    columns = _ACROSS if count > 1 else 1
    figure, axes = axes_grid(rows, columns, width=5.2 * columns, height=0.4 + 2.1 * rows)
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
        own = x.size + 1 - int(np.argmin(same[::-1])) if not same.all() else 1
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


def _not_too_near(panel: Any, values: FloatArray) -> None:
    low, high = panel.get_ylim()
    short = _LEAST_SPAN * float(np.abs(values).max()) - (high - low)
    if short > 0.0:
        panel.set_ylim(low - 0.5 * short, high + 0.5 * short)


def plot_fit(dataset: "xr.Dataset") -> "Figure":
    """Draw the measurements over what the law says of them, and below what is left."""
    predicted, measured = dataset["predicted"].values, dataset["measured"].values
    ends = [min(predicted.min(), measured.min()), max(predicted.max(), measured.max())]

    def bars(axes: Any) -> None:
        axes.errorbar(
            predicted, measured, _ENDS * dataset["deviation"].values, color=BLUE, marker="o",
            linestyle="none", markerfacecolor="none", capsize=2,
        )  # fmt: skip

    left = [
        level(0.0, dashes=(), linewidth=0.8),
        *(level(limit, linewidth=0.8) for limit in (-_ENDS, _ENDS)),
        points(0, predicted, dataset["residuals"].values, markeredgewidth=None),
    ]
    equal = line(0, ends, ends, color=BLACK, linewidth=1.0, dashes=(4, 2))
    return drawn(
        [
            Panel("by the law", "measured, with 95 %", [equal], tight=False, more=bars),
            Panel("by the law", "residual over its deviation", left, tight=False),
        ],
        height=6.4,
    )


def plot_changes(dataset: "xr.Dataset") -> "Figure":
    """Draw the change of the torque over the frequency, a panel a direction and lubricant."""
    return changes(dataset, "torque_change", "change of the torque (%)")


def changes(dataset: "xr.Dataset", name: str, label: str) -> "Figure":
    """Draw a change over the frequency; marks of a waveform and supply are joined."""
    names = ("mode", "lubricant", "waveform")
    words = {key: dataset[key].values.astype(str) for key in names if key in dataset}
    kept = np.isfinite(dataset[name].values) if name in dataset else np.zeros(0, dtype=bool)
    cells = sorted({(words["mode"][n], words["lubricant"][n]) for n in np.flatnonzero(kept)})
    figure, axes = axes_grid(max(len(cells), 1), height=1.0 + 3.2 * max(len(cells), 1))
    for panel, (mode, lubricant) in zip(axes, cells, strict=False):
        here = kept & (words["mode"] == mode) & (words["lubricant"] == lubricant)
        _lines(panel, dataset, words["waveform"], here, name)
        panel.set(xlabel="frequency (Hz)", ylabel=label, title=f"{mode}, {lubricant}")
        panel.axhline(0.0, color=BLACK, linewidth=0.8)
        legend(panel)
    for panel in axes:
        mark_simulated(dataset, panel)
    return figure


def over_velocity(dataset: "xr.Dataset") -> "Figure":
    """Draw torque with over torque before against k_v, measured and by the model."""
    usable = dataset["quality"].values.astype(str) != REFUSED
    marks = []
    for place, mode in enumerate(("transverse", "longitudinal")):
        here = usable & (dataset["mode"].values.astype(str) == mode)
        if here.any() and "k_v" in dataset:
            k = dataset["k_v"].values[here]
            ratio = 1.0 + dataset["torque_change"].values[here] / 100.0
            model = dataset["model_ratio"].values[here]
            marks += [
                points(place, k, ratio, f"{mode}, measured", markeredgewidth=None),
                points(place, k, model, f"{mode}, model", filled=True, marker="x"),
            ]
    panel = Panel(
        r"velocity ratio $k_v$", "torque with over torque before",
        [*marks, level(1.0, dashes=(), linewidth=0.8)], legend={}, tight=False,
        more=lambda axes: mark_simulated(dataset, axes),
    )  # fmt: skip
    return drawn([panel])


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

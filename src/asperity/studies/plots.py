"""Pictures of the studies."""

from typing import TYPE_CHECKING

import numpy as np

from asperity.results.figures import (
    BLACK,
    BLUE,
    COLOURS,
    GREEN,
    ORANGE,
    SKY,
    VERMILION,
    axes_grid,
    legend,
)
from asperity.results.panels import MARKERS, Panel, drawn, line, points
from asperity.studies.reported import OWN

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

_KINDS = {
    "as it is": BLACK,
    "oil": BLUE,
    "additive": GREEN,
    "coating": ORANGE,
    "vibration": VERMILION,
}
_SYMBOLS = {
    "pressure_angle": r"$\alpha_n$",
    "centre_distance": r"$a$",
    "worm_speed": r"$n_1$",
    "gear_ratio": r"$u$",
    "diameter_factor": r"$q_1$",
    "axial_module": r"$m_{x1}$",
    "worm_roughness": r"$Ra_1$",
}


def plot_sensitivity(dataset: "xr.Dataset") -> "Figure":
    """Draw the efficiency over the rise of each input; a cross is where answers end."""
    figure, (axes,) = axes_grid(height=4.8)
    ends = []
    rises = dataset["rise"].values
    for place, name in enumerate(dataset["input"].values):
        found = dataset.sel(input=name)
        efficiency, end = 100.0 * found["eta_z1_2"].values, float(found["fails_above"])
        colour = COLOURS[place % len(COLOURS)]
        axes.plot(
            rises, efficiency, color=colour, label=_SYMBOLS.get(name, name.replace("_", " ")),
            marker=MARKERS[place % len(MARKERS)], markersize=5.0,
        )  # fmt: skip
        last = int(np.flatnonzero(~np.isnan(efficiency))[-1])
        if not np.isnan(end):
            ends.append((end, colour))
            axes.plot([rises[last], end], [efficiency[last], 0.0], color=colour, dashes=(2, 2))
    for rise, colour in ends:
        axes.plot(
            rise, 0.0, marker="x", markersize=9.0, markeredgewidth=2.0, color=colour,
            clip_on=False, zorder=5,
        )  # fmt: skip
        axes.annotate(
            f"+{rise:.1f} %", (rise, 0.0), (-6, 8), textcoords="offset points", ha="right",
        )  # fmt: skip
    if ends:
        axes.set_ylim(0.0, None)
    axes.set_xlim(0.0, rises[-1])
    axes.set_xlabel("rise of the input (%)")
    axes.set_ylabel(r"efficiency of the teeth $\eta_{z1-2}$ (%)")
    legend(axes, loc="upper left", bbox_to_anchor=(1.0, 1.0))
    return figure


def plot_comparison(dataset: "xr.Dataset") -> "Figure":
    """Draw the efficiency with each method; a mark is where it is with a vibration's power."""
    efficiency = 100.0 * dataset["eta_z1_2"].values
    counted = 100.0 * dataset["eta_z1_2_with_power"].values
    shaken = np.flatnonzero(dataset["vibration_power"].values > 0.0)
    count = len(efficiency)
    figure, (axes,) = axes_grid(width=8.0, height=1.2 + 0.32 * count)
    # The first on top.
    places = count - 1 - np.arange(count)
    for row, place in enumerate(places):
        computed = dataset["source"].values[row] == str(OWN)
        axes.barh(
            place, efficiency[row], height=0.7, color=_KINDS.get(dataset["kind"].values[row], SKY),
            hatch="///" if computed else None, edgecolor="white", linewidth=0.0,
        )  # fmt: skip
        axes.annotate(
            f"{efficiency[row]:.1f}", (efficiency[row], place), (4, 0),
            textcoords="offset points", va="center",
            # The line of the first may pass behind the number, not through it.
            bbox={"facecolor": "white", "edgecolor": "none", "pad": 1.0},
        )  # fmt: skip
    if shaken.size:
        axes.plot(
            counted[shaken], places[shaken], linestyle="none", marker="D", markersize=8.0,
            color=BLACK, markeredgecolor="white", label="with the vibration's power counted",
        )  # fmt: skip
    axes.axvline(efficiency[0], color=BLACK, dashes=(4, 3), linewidth=1.0)
    axes.set_yticks(places, list(dataset["name"].values))
    axes.tick_params(axis="y", length=0.0)
    axes.grid(visible=False, axis="y")
    axes.set_xlim(0.0, 110.0)
    axes.set_ylim(-0.6, count - 0.4)
    axes.set_xlabel(r"efficiency of the teeth $\eta_{z1-2}$ (%)")
    if shaken.size:
        legend(axes, loc="lower right", bbox_to_anchor=(1.0, 1.0))
    return figure


def plot_trade_off(dataset: "xr.Dataset") -> "Figure":
    """Draw the highest efficiency over the permissible torque, and where the gearset is."""
    attributes = dataset.attrs
    best = line(0, dataset["torque"], 100.0 * dataset["eta_z1_2"], "most efficient designs",
                marker="o", markersize=5.0)  # fmt: skip
    designs = [
        points(
            place, attributes[f"{group}.M_permissible_Nm"], 100.0 * attributes[f"{group}.eta_z1_2"],
            label, filled=True, marker=marker, markersize=9.0,
        )
        for place, group, marker, label in (
            (1, "given", "s", "as it is"),
            (2, "optimum", "D", "optimum, permissible torque kept"),
        )
        if f"{group}.eta_z1_2" in attributes
    ]  # fmt: skip
    panel = Panel(
        r"permissible torque, the lower of $M_w$ and $M_s$ (N m)",
        r"efficiency of the teeth $\eta_{z1-2}$ (%)", [best, *designs], legend={"loc": "best"},
        tight=False, limits={"xmargin": 0.08, "ymargin": 0.12},
    )  # fmt: skip
    return drawn([panel], height=4.4)

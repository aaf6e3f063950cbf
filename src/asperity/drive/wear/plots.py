"""Pictures of a wheel that wears: over its turns, and its flank."""

from typing import TYPE_CHECKING

import numpy as np

from asperity.drive.plots import flank_triangles, pressure_label
from asperity.results.figures import axes_grid
from asperity.results.panels import Panel, drawn, line

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

_LEVELS = 24
# Beyond the largest, which rounding else leaves out.
_ABOVE = 1.0 + 1e-6


def over_life(dataset: "xr.Dataset") -> "Figure":
    """Draw pressure, error, efficiency and depth over the turns of the wheel."""
    turns = dataset["step"].values
    torque = dataset["torque_course"].values
    efficiency = 100.0 * float(dataset["efficiency_new"]) * torque[0] / torque
    return drawn(
        [
            Panel(y="pressure (MPa)", legend={}, limits={"ylim": (0.0, None)}, marks=[
                line(0, turns, 1e-6 * dataset["pressure_course"].values, "mean"),
                line(1, turns, 1e-6 * dataset["peak_course"].values, "largest on the flank"),
            ]),
            Panel(y="error (µrad)", limits={"ylim": (0.0, None)}, marks=[
                line(0, turns, 1e6 * dataset["error_course"].values),
            ]),
            Panel(y="efficiency (%)", marks=[line(0, turns, efficiency)]),
            Panel("turns of the wheel", "depth (µm)", legend={}, marks=[
                line(0, turns, 1e6 * dataset["depth_course"].values, "largest"),
                line(1, turns, 1e6 * dataset["mean_course"].values, "mean of the flank"),
            ]),
        ],
        height=9.0,
    )  # fmt: skip


def flank(dataset: "xr.Dataset") -> "Figure":
    """Draw the depth on the flank, and where it bears, new and worn."""
    from matplotlib.ticker import MaxNLocator

    new, worn = (1e-6 * dataset[name].values for name in ("pattern_new", "pattern"))
    most = float(max(new.max(), worn.max()))
    shown = (
        (1e6 * dataset["depth"].values, None, "worn off", "depth (µm)"),
        (new, most, "new", pressure_label(dataset)),
        (worn, most, "worn", pressure_label(dataset)),
    )
    figure, axes = axes_grid(3, 1, width=7.4, height=7.2)
    for panel, (values, top, title, unit) in zip(axes, shown, strict=True):
        top = float(values.max()) if top is None else top
        filled = panel.tricontourf(
            flank_triangles(dataset), values, levels=np.linspace(0.0, _ABOVE * top, _LEVELS),
            cmap="cividis",
        )  # fmt: skip
        bar = figure.colorbar(filled, ax=panel, format="%.4g", ticks=MaxNLocator(6))
        bar.set_label(unit)
        panel.set_aspect("equal")
        panel.grid(visible=False)
        panel.set_title(title, loc="left")
        panel.set_ylabel("radius (mm)")
    axes[-1].set_xlabel("along the wheel's axis (mm)")
    return figure

"""Pictures of a loaded worm gearset: over a pitch, patterns on the flank, what gives way."""

from typing import TYPE_CHECKING

import numpy as np

from asperity.arrays import FloatArray
from asperity.drive.plots import flank_triangles, pitch_closed, pressure_label
from asperity.results.figures import BLACK, BLUE, COLOURS, DASHES, axes_grid, legend
from asperity.results.panels import Panel, drawn, line

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

_LEVELS = 24
_SHOWN_SHARE = 1e-3


def over_pitch(dataset: "xr.Dataset") -> "Figure":
    """Draw torque, transmission error and the teeth's shares against the worm's angle."""
    names = {
        "torque": "forward", "torque_frictionless": "without friction",
        "torque_reversed": "friction turned round",
    }  # fmt: skip
    angle, *torques = pitch_closed(dataset, *(dataset[name].values for name in names))
    torque_lines = [
        line(k, angle, values, what)
        for k, (values, what) in enumerate(zip(torques, names.values(), strict=True))
    ]
    loaded, unloaded = (1e6 * dataset[f"error_{name}"].values for name in ("loaded", "unloaded"))
    _, loaded, unloaded = pitch_closed(
        dataset, loaded - loaded.mean(), unloaded - unloaded.mean()
    )  # fmt: skip
    errors = [line(0, angle, loaded, "under load"), line(1, angle, unloaded, "without load")]
    parts = _shares(dataset["tooth_force"].values)[: len(angle)]
    shares = [
        line(k % len(DASHES), angle, column, f"tooth {k + 1}", color=COLOURS[k % len(COLOURS)])
        for k, column in enumerate(parts.T[parts.max(axis=0) > _SHOWN_SHARE])
    ]
    most = 1.35 * float(dataset["torque"].max())
    below = {"ncols": len(shares), "loc": "upper center", "bbox_to_anchor": (0.5, -0.22)}
    return drawn(
        [
            Panel(y="torque of the worm (N m)", marks=torque_lines, legend={"ncols": 3},
                  limits={"ylim": (0.0, most)}),
            Panel(y="transmission error (µrad)", marks=errors, legend={"ncols": 2},
                  limits={"ymargin": 0.25}),
            Panel("angle of the worm (deg)", "share of a tooth", shares, legend=below,
                  limits={"ylim": (0.0, 1.0)}),
        ],
        height=8.0,
    )  # fmt: skip


def _shares(force: FloatArray) -> FloatArray:
    """Return shares of the teeth over a closed pitch, (p + 1, K + 1), those of forces (p, K).

    At its end each tooth stands where the one behind it in the row stood at its beginning.
    """
    none = np.zeros((len(force), 1))
    force = np.hstack([none, force])
    ends = np.append(force[0, 1:], 0.0)
    closed = np.vstack([force, ends])
    return np.asarray(closed / closed.sum(axis=1, keepdims=True))


def error(dataset: "xr.Dataset") -> "Figure":
    """Draw the amplitudes of the transmission error's orders, at rising load."""
    order, loads = dataset["order"].values, dataset["error_load"].values
    amplitude = 1e6 * dataset["error_amplitude"].values
    noise = 1e6 * dataset["error_noise"].values
    figure, (axes,) = axes_grid(height=4.2)
    width = 0.8 / len(loads)
    for k, (torque, values) in enumerate(zip(loads, amplitude, strict=True)):
        place = order + (k - 0.5 * (len(loads) - 1)) * width
        words = f"{torque:.4g} N m" if torque else "no load, rigid"
        axes.bar(place, values, 0.9 * width, color=COLOURS[k % len(COLOURS)], label=words)
        axes.hlines(
            noise[k], place - 0.5 * width, place + 0.5 * width, color=BLACK, linewidth=1.0,
            linestyles=(0, (1, 1)), label="the mesh's own" if k + 1 == len(loads) else "_nolegend_",
        )  # fmt: skip
    axes.set_xticks(order)
    axes.grid(visible=False, axis="x")
    axes.set_xlabel("order, times in a pitch")
    axes.set_ylabel("amplitude of the error (µrad)")
    axes.margins(y=0.15)
    legend(axes)
    return figure


def pattern(dataset: "xr.Dataset") -> "Figure":
    """Draw where the flanks bear over a pitch, and how hard, at three torques."""
    loads = dataset["load"].values
    # A node of the other flank lies where half a turn about the tooth takes it.
    flanks = [("pattern", 1.0, "driving flank"), ("pattern_back", -1.0, "other flank, backwards")]
    flanks = [flank for flank in flanks if flank[0] in dataset]
    figure, axes = axes_grid(
        len(loads), len(flanks), width=1.0 + 6.0 * len(flanks), height=1.6 + 1.9 * len(loads)
    )
    for place, panel in enumerate(axes):
        row, column = divmod(place, len(flanks))
        name, side, words = flanks[column]
        mega = 1e-6 * dataset[name].values[row]
        drawn = panel.tricontourf(
            flank_triangles(dataset, side), mega, levels=_LEVELS, cmap="cividis"
        )
        bar = figure.colorbar(drawn, ax=panel)
        bar.set_label(pressure_label(dataset))
        panel.set_aspect("equal")
        panel.grid(visible=False)
        panel.set_title(
            f"{words}: {loads[row]:.4g} N m, at most {mega.max():.4g} MPa", fontsize=10.0
        )
        if not column:
            panel.set_ylabel("radius (mm)")
        if row == len(loads) - 1:
            panel.set_xlabel("along the wheel's axis (mm)")
    return figure


def stiffness(dataset: "xr.Dataset") -> "Figure":
    """Draw what gives way between motor and wheel, as turn of the wheel for its torque."""
    names = [str(name) for name in np.atleast_1d(dataset["part"].values)]
    give = 1e6 / dataset["part_stiffness"].values
    figure, (axes,) = axes_grid(height=1.2 + 0.5 * len(names))
    axes.barh([name.replace("_", " ") for name in names], give, color=BLUE, height=0.6)
    for place, value in enumerate(give):
        axes.annotate(
            f" {value:.3g}", (value, place), va="center", color=BLACK, annotation_clip=False
        )
    axes.invert_yaxis()
    axes.margins(x=0.15)
    axes.grid(visible=False, axis="y")
    whole = float(dataset["stiffness"])
    axes.set_xlabel("turn of the wheel for its torque (µrad/(N m))")
    axes.set_title(f"together {1e6 / whole:.3g} µrad/(N m): {whole:.4g} N m/rad")
    return figure

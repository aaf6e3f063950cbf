"""The pictures of the sliding body's figures, each drawn from its dataset alone."""

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np

from asperity.results.figures import (
    BLACK,
    BLUE,
    GREEN,
    ORANGE,
    PURPLE,
    SKY,
    VERMILION,
    legend,
    panels,
)

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_COLOURS = (BLUE, VERMILION, GREEN, PURPLE, ORANGE, SKY)
_DASHES = ((None, None), (6, 2), (2, 2), (6, 2, 2, 2), (4, 1))
_RATIO = r"drive force over $\mu F_N$"
_ZOOM = 1e-3


def own_names(variable: str, body: str) -> tuple[str, str]:
    """Names of a body's variable and of its time in a dataset that holds several bodies."""
    own = body.replace("-", "_").replace(" ", "_")
    return f"{variable}_{own}", f"time_{own}"


def _histories(dataset: "xr.Dataset", variable: str) -> Iterator[tuple[str, Any, Any]]:
    """Name, times and values of every body, in SI."""
    for name in dataset["body"].values:
        own, time = own_names(variable, str(name))
        yield str(name), dataset[time].values, dataset[own]


def _line(axes: "Axes", index: int, x: Any, y: Any, label: str = "") -> None:
    axes.plot(x, y, color=_COLOURS[index], dashes=_DASHES[index], label=label or None)


def _limit(axes: "Axes", force: float, *, both: bool = False) -> None:
    for value in (force, -force) if both else (force,):
        axes.axhline(value, color=BLACK, dashes=(1, 2), linewidth=1.0)


def force_over_displacement(dataset: "xr.Dataset") -> "Figure":
    """Draw a line for each exponent."""
    figure, (axes,) = panels()
    share = dataset["force"] / dataset["full_force"]
    x = dataset["displacement"].values * 1e9
    for index, exponent in enumerate(dataset["exponent"].values):
        _line(axes, index, x, share.sel(exponent=exponent), f"i = {exponent:g}")
    _limit(axes, 1.0)
    axes.set_xlabel("displacement x (nm)")
    axes.set_ylabel(r"friction over $\mu F_N$")
    axes.margins(x=0.0)
    legend(axes, loc="lower right", title="exponent")
    return figure


def cycle(dataset: "xr.Dataset") -> "Figure":
    """Draw the velocities above and the friction below, over one cycle."""
    figure, (upper, lower) = panels(2, height=5.6)
    base = dataset["base_velocity"]
    time = base[base.dims[0]].values * 1e3
    upper.plot(time, base * 1e3, color=BLUE, label="base")
    upper.axhline(float(dataset["drive_velocity"]) * 1e3, color=BLACK, dashes=(5, 2), label="drive")
    faster = base.values > float(dataset["drive_velocity"])
    for axes in (upper, lower):
        axes.fill_between(
            time, 0, 1, where=faster, color=SKY, alpha=0.2, linewidth=0,
            transform=axes.get_xaxis_transform(),
        )  # fmt: skip
        axes.margins(x=0.0)
        axes.set_xlabel("time (ms)")
    upper.set_ylabel("velocity (mm/s)")
    upper.set_title("Shaded: the base outruns the drive", loc="left")
    legend(upper, loc="lower right", bbox_to_anchor=(1.0, 0.98), ncols=2)
    least = 0.0
    for index, (name, at, friction) in enumerate(_histories(dataset, "friction")):
        along = friction.sel(axis="x").values
        least = min(least, along.min())
        _line(lower, index, at * 1e3, along, name)
    _limit(lower, float(dataset["full_force"]))
    lower.set_ylabel("friction (N)")
    if dataset.sizes["body"] > 1:
        legend(lower, loc="lower left")
    lower.set_ylim(1.1 * least, None)
    return figure


def transverse_cycle(dataset: "xr.Dataset") -> "Figure":
    """Draw velocities, friction along and across, and the path of the friction vector."""
    figure, (upper, lower) = panels(2, height=6.4)
    time = 1e3 * dataset["time"].values
    upper.plot(time, 1e3 * dataset["base_velocity"], color=BLUE, label="base, across")
    upper.axhline(
        1e3 * float(dataset["drive_velocity"]), color=BLACK, dashes=(5, 2), label="drive, along"
    )
    full = float(dataset["full_force"])
    for index, (axis, label) in enumerate((("x", "along the drive"), ("y", "across it"))):
        _line(lower, index, time, dataset["friction"].sel(axis=axis).values, label)
    mean = float(dataset["mean_friction"])
    lower.axhline(mean, color=BLACK, dashes=(1, 1.5), label=f"mean along, {mean:.2f} N")
    _limit(lower, full, both=True)
    upper.set_ylabel("velocity (mm/s)")
    lower.set_ylabel("friction (N)")
    for axes in (upper, lower):
        axes.set_xlabel("time (ms)")
        axes.margins(x=0.0)
        legend(axes, loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=3)
    return figure


def stacked(dataset: "xr.Dataset") -> "Figure":
    """Draw a panel for each body, on the same scale."""
    histories = list(_histories(dataset, "drive_force"))
    figure, all_axes = panels(len(histories), height=1.2 + 1.5 * len(histories))
    low = min(0.0, *(float(force.min()) for _, _, force in histories))
    high = max(float(force.max()) for _, _, force in histories)
    for index, (axes, (name, time, force)) in enumerate(zip(all_axes, histories, strict=True)):
        axes.plot(time * 1e3, force, color=_COLOURS[index])
        axes.set_ylim(low - 0.08 * (high - low), high + 0.08 * (high - low))
        axes.margins(x=0.0)
        axes.set_title(name, loc="left")
        axes.set_ylabel("force (N)")
        axes.tick_params(labelbottom=axes is all_axes[-1])
    all_axes[-1].set_xlabel("time (ms)")
    return figure


def over_ratio(dataset: "xr.Dataset") -> "Figure":
    """Draw the ratio over k: laws and closed form as lines, schemes as markers."""
    figure, (axes,) = panels(height=4.6)
    laws = [str(law) for law in dataset["law"].values]
    for index, law in enumerate(laws):
        label = "periodic state" + (f", law {law}" if len(laws) > 1 else "")
        _line(axes, index, dataset["k"], dataset["periodic"].sel(law=law), label)
    axes.plot(
        dataset["k"], dataset["rigid"], color=BLACK, dashes=(1, 1.5), label="rigid Coulomb friction"
    )
    marks: dict[str, Any] = {
        "linestyle": "none",
        "markeredgecolor": BLACK,
        "markerfacecolor": "none",
    }
    axes.plot(
        dataset["k_marched"], dataset["exponential"], marker="o", markersize=8,
        label="marched, exponential", **marks,
    )  # fmt: skip
    axes.plot(
        dataset["k_marched"], dataset["two_phase"], marker="+", markersize=9,
        label="marched, two-phase", **marks,
    )  # fmt: skip
    axes.set_xlabel(r"velocity ratio $k = v_a/v_d$")
    axes.set_ylabel(_RATIO)
    axes.set_xlim(0.0, 20.5)
    axes.set_xticks(np.arange(0, 21, 2))
    axes.set_ylim(0.0, 1.05)
    legend(axes, loc="upper right")
    return figure


def drive_over_time(dataset: "xr.Dataset") -> "Figure":
    """Draw the whole march above and its last millisecond below."""
    figure, (upper, lower) = panels(2, height=6.2)
    for index, (name, time, force) in enumerate(_histories(dataset, "drive_force")):
        tail = time >= time[-1] - _ZOOM
        _line(upper, index, time, force, name)
        _line(lower, index, (time[tail] - time[-1] + _ZOOM) * 1e3, force[tail], name)
    _limit(upper, float(dataset["full_force"]))
    upper.annotate(
        r"$\mu F_N$", (1.0, float(dataset["full_force"])), (-2, 3),
        xycoords=("axes fraction", "data"), textcoords="offset points", ha="right",
    )  # fmt: skip
    upper.set_xlabel("time (s)")
    upper.set_title("From rest", loc="left")
    lower.set_xlabel("time in the last millisecond (ms)")
    lower.set_title("Enlarged", loc="left")
    lower.ticklabel_format(axis="y", useOffset=False)
    for axes in (upper, lower):
        axes.set_ylabel("drive force (N)")
        axes.margins(x=0.0)
    upper.margins(y=0.12)
    legend(upper, loc="center right")
    return figure


def friction_over_cycles(dataset: "xr.Dataset") -> "Figure":
    """Draw a panel for each friction component."""
    names = {"x": "along the drive, x", "y": "across, y"}
    parts = [str(axis) for axis in dataset["axis"].values]
    figure, all_axes = panels(len(parts), height=1.4 + 2.4 * len(parts))
    for axes, part in zip(all_axes, parts, strict=True):
        for index, (name, time, friction) in enumerate(_histories(dataset, "friction")):
            _line(axes, index, time * 1e3, friction.sel(axis=part), name)
        axes.set_title(f"Friction {names[part]}", loc="left")
        axes.set_ylabel("friction (N)")
        axes.set_xlabel("time (ms)")
        axes.margins(x=0.0)
    legend(all_axes[0], loc="lower right", bbox_to_anchor=(1.0, 0.98), ncols=2)
    return figure


def over_direction(dataset: "xr.Dataset") -> "Figure":
    """Draw a line for each k, marched points on it, LuGre around them."""
    figure, (axes,) = panels(height=5.0)
    markers = "osD^v"
    for index, k in enumerate(dataset["k"].values):
        _line(axes, index, dataset["theta_dense"], dataset["periodic"].sel(k=k))
        axes.plot(
            dataset["theta"], dataset["dahl"].sel(k=k), linestyle="none", color=_COLOURS[index],
            marker=markers[index], markersize=4.5, label=f"Dahl, k = {k:g}",
        )  # fmt: skip
    for n, k in enumerate(dataset["k_lugre"].values):
        axes.plot(
            dataset["theta"], dataset["lugre"].sel(k_lugre=k), linestyle="none", marker="D",
            markersize=9, markerfacecolor="none", markeredgecolor=BLACK, markeredgewidth=0.8,
            label=None if n else "LuGre, k = 2 and 20",
        )  # fmt: skip
    axes.set_xlabel("direction of vibration (deg)")
    axes.set_ylabel(_RATIO)
    axes.set_xticks(np.arange(0, 361, 45))
    axes.set_xlim(-6.0, 366.0)
    axes.set_ylim(0.0, None)
    legend(axes, loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=3)
    return figure

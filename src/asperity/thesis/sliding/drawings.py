"""The pictures of the sliding body's figures, each drawn from its dataset alone."""

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np

from asperity.results.figures import BLACK, BLUE, COLOURS, SKY, axes_grid, legend
from asperity.thesis.drawing import (
    DOTTED,
    OVER_DIRECTION,
    OVER_RATIO,
    arrow,
    asperity,
    legend_above,
    limit,
    line,
    marks,
)

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_ZOOM = 1e-3
_SERIES = {
    "exponential": "pre-existing model (exponential scheme)",
    "two-phase": "coupled model (two-phase scheme)",
}
"""Schemes as the thesis names what they stand for."""
_ARROWS = 9
_OPEN: dict[str, Any] = {"arrowstyle": "->", "shrinkA": 0, "shrinkB": 0}


def own_names(variable: str, body: str) -> tuple[str, str]:
    """Names of a body's variable and of its time in a dataset that holds several bodies."""
    own = body.replace("-", "_").replace(" ", "_")
    return f"{variable}_{own}", f"time_{own}"


def _histories(dataset: "xr.Dataset", variable: str) -> Iterator[tuple[str, Any, Any]]:
    """Name, times and values of every body, in SI."""
    for name in dataset["body"].values:
        own, time = own_names(variable, str(name))
        yield str(name), dataset[time].values, dataset[own]


def force_over_displacement(dataset: "xr.Dataset") -> "Figure":
    """Draw a line for each exponent."""
    figure, (axes,) = axes_grid()
    share = dataset["force"] / dataset["full_force"]
    x = dataset["displacement"].values * 1e9
    for index, exponent in enumerate(dataset["exponent"].values):
        line(axes, index, x, share.sel(exponent=exponent), f"i = {exponent:g}")
    limit(axes, 1.0)
    axes.set(xlabel="displacement x (nm)", ylabel=r"friction over $\mu F_N$", xmargin=0.0)
    legend(axes, loc="lower right", title="exponent")
    return figure


def cycle(dataset: "xr.Dataset") -> "Figure":
    """Draw the velocities above and the friction below, over one cycle."""
    figure, (upper, lower) = axes_grid(2, height=5.6)
    base, drive = dataset["base_velocity"], float(dataset["drive_velocity"])
    time = base[base.dims[0]].values * 1e3
    upper.plot(time, base * 1e3, color=BLUE, label="base")
    upper.axhline(drive * 1e3, color=BLACK, dashes=(5, 2), label="drive")
    for axes in (upper, lower):
        axes.fill_between(
            time, 0, 1, where=base.values > drive, color=SKY, alpha=0.2, linewidth=0,
            transform=axes.get_xaxis_transform(),
        )  # fmt: skip
        axes.set(xlabel="time (ms)", xmargin=0.0)
    upper.set_ylabel("velocity (mm/s)")
    upper.set_title("Shaded: the base outruns the drive", loc="left")
    legend(upper, loc="lower right", bbox_to_anchor=(1.0, 0.98), ncols=2)
    least = 0.0
    for index, (name, at, friction) in enumerate(_histories(dataset, "friction")):
        along = friction.sel(axis="x").values
        least = min(least, along.min())
        line(lower, index, at * 1e3, along, name)
    limit(lower, float(dataset["full_force"]))
    if dataset.sizes["body"] > 1:
        legend(lower, loc="lower left")
    lower.set(ylabel="friction (N)", ylim=(1.1 * least, None))
    return figure


def transverse_cycle(dataset: "xr.Dataset") -> "Figure":
    """Draw the velocities and forces as vectors, and friction along and across over time."""
    figure, (upper, left, lower, right) = axes_grid(2, 2, width=9.6, height=6.4)
    _vectors(left, right, dataset)
    time = 1e3 * dataset["time"].values
    upper.plot(time, 1e3 * dataset["base_velocity"], color=BLUE, label="base, across")
    drive = 1e3 * float(dataset["drive_velocity"])
    upper.axhline(drive, color=BLACK, dashes=(5, 2), label="drive, along")
    full, mean = float(dataset["full_force"]), float(dataset["mean_friction"])
    for index, (axis, label) in enumerate((("x", "along the drive"), ("y", "across it"))):
        line(lower, index, time, dataset["friction"].sel(axis=axis).values, label)
    lower.axhline(mean, color=BLACK, dashes=DOTTED, label=f"mean along, {mean:.2f} N")
    limit(lower, full, -full)
    for axes, label in ((upper, "velocity (mm/s)"), (lower, "friction (N)")):
        axes.set(xlabel="time (ms)", ylabel=label, xmargin=0.0)
        legend_above(axes, 2)
    return figure


def _vectors(upper: "Axes", lower: "Axes", dataset: "xr.Dataset") -> None:
    """Draw slip velocities, and the friction that opposes them, at even times of half a cycle."""
    base, friction = dataset["base_velocity"].values, dataset["friction"].values
    drive = float(dataset["drive_velocity"])
    half = int(np.argmin(base))
    at = np.linspace(int(np.argmax(base)), half, _ARROWS).astype(int) if half else [0]
    for n in at:
        arrow(upper, (0.0, 0.0), (1e3 * drive, -1e3 * base[n]), BLUE, **_OPEN)
        arrow(lower, (0.0, 0.0), (-friction[n, 0], -friction[n, 1]), BLUE, **_OPEN)
    arrow(upper, (0.0, 0.0), (1e3 * drive, 0.0), BLACK, linewidth=2.0, shrinkB=0)
    upper.annotate("$v_d$", (1e3 * drive, 0.0), (6, 0), textcoords="offset points", va="center")
    mean = float(dataset["mean_friction"])
    arrow(lower, (0.0, 0.0), (-mean, 0.0), BLACK, linewidth=2.0, shrinkB=0)
    lower.annotate(
        "mean $F_x$", (-0.5 * mean, 0.0), (0.62, 0.93), textcoords="axes fraction", va="center",
        arrowprops={"arrowstyle": "-", "linewidth": 0.6},
    )  # fmt: skip
    full = float(dataset["full_force"])
    peak = 1e3 * float(np.abs(base).max())
    upper.set(
        xlim=(-0.35 * peak, 1.1 * peak), ylim=(-1.1 * peak, 1.1 * peak),
        xlabel="slip along the drive (mm/s)", ylabel="across (mm/s)",
    )  # fmt: skip
    lower.set(
        xlim=(-1.1 * full, 0.35 * full), ylim=(-1.1 * full, 1.1 * full),
        xlabel="friction along the drive (N)", ylabel="across (N)",
    )  # fmt: skip
    upper.set_title("slip velocity $v_r$ in half a cycle", loc="left")
    lower.set_title("friction on the body", loc="left")
    for axes in (upper, lower):
        axes.set_aspect("equal")


def stacked(dataset: "xr.Dataset") -> "Figure":
    """Draw a panel for each body, on the same scale."""
    histories = list(_histories(dataset, "drive_force"))
    figure, all_axes = axes_grid(len(histories), height=1.2 + 1.5 * len(histories))
    low = min(0.0, *(float(force.min()) for _, _, force in histories))
    high = max(float(force.max()) for _, _, force in histories)
    room = 0.08 * (high - low)
    for index, (axes, (name, time, force)) in enumerate(zip(all_axes, histories, strict=True)):
        axes.plot(time * 1e3, force, color=COLOURS[index])
        axes.set(ylabel="force (N)", ylim=(low - room, high + room), xmargin=0.0)
        axes.set_title(name, loc="left")
        axes.tick_params(labelbottom=axes is all_axes[-1])
    all_axes[-1].set_xlabel("time (ms)")
    return figure


def over_ratio(dataset: "xr.Dataset") -> "Figure":
    """Draw the ratio over k: laws and closed form as lines, schemes as markers."""
    figure, (axes,) = axes_grid(height=4.6)
    laws = [str(law) for law in dataset["law"].values]
    for index, law in enumerate(laws):
        label = "periodic state" + (f", law {law}" if len(laws) > 1 else "")
        line(axes, index, dataset["k"], dataset["periodic"].sel(law=law), label)
    closed = "rigid Coulomb friction"
    line(axes, 0, dataset["k"], dataset["rigid"], closed, color=BLACK, dashes=DOTTED)
    for name, marker, size in (("exponential", "o", 8), ("two_phase", "+", 9)):
        marks(
            axes, 0, dataset["k_marched"], dataset[name], _SERIES[name.replace("_", "-")],
            marker=marker, markersize=size, color=BLACK, markeredgewidth=1.0,
        )  # fmt: skip
    axes.set(ylim=(0.0, 1.05), **OVER_RATIO)
    legend(axes, loc="upper right")
    return figure


def drive_over_time(dataset: "xr.Dataset") -> "Figure":
    """Draw the whole march above and its last millisecond below."""
    figure, (upper, lower) = axes_grid(2, height=6.2)
    for index, (name, time, force) in enumerate(_histories(dataset, "drive_force")):
        tail = time >= time[-1] - _ZOOM
        line(upper, index, time, force, _SERIES.get(name, name))
        line(lower, index, (time[tail] - time[-1] + _ZOOM) * 1e3, force[tail], name)
    upper.axvline(float(dataset["vibration_start"]), color=BLACK, linewidth=0.8)
    full = float(dataset["full_force"])
    limit(upper, full)
    upper.annotate(
        r"$\mu F_N$", (1.0, full), (-2, 3), xycoords=("axes fraction", "data"),
        textcoords="offset points", ha="right",
    )  # fmt: skip
    for axes, title, label in (
        (upper, "From rest", "time (s)"),
        (lower, "The last millisecond, enlarged", "time in the last millisecond (ms)"),
    ):
        axes.set(xlabel=label, ylabel="drive force (N)", xmargin=0.0)
        axes.set_title(title, loc="left")
    lower.ticklabel_format(axis="y", useOffset=False)
    upper.margins(y=0.12)
    legend(upper, loc="center right")
    return figure


def friction_over_cycles(dataset: "xr.Dataset") -> "Figure":
    """Draw a panel for each friction component."""
    names = {"x": "along the drive, x", "y": "across, y"}
    parts = [str(axis) for axis in dataset["axis"].values]
    figure, all_axes = axes_grid(len(parts), height=1.4 + 2.4 * len(parts))
    for axes, part in zip(all_axes, parts, strict=True):
        for index, (name, time, friction) in enumerate(_histories(dataset, "friction")):
            line(axes, index, time * 1e3, friction.sel(axis=part), _SERIES.get(name, name))
        axes.set(xlabel="time in the last cycles (ms)", ylabel="friction (N)", xmargin=0.0)
        axes.set_title(f"Friction {names[part]}", loc="left")
    legend(all_axes[0], loc="lower right", bbox_to_anchor=(1.0, 0.98), ncols=1)
    return figure


def over_direction(dataset: "xr.Dataset") -> "Figure":
    """Draw a line for each k, marched points on it, LuGre around them."""
    figure, (axes,) = axes_grid(height=5.0)
    for index, k in enumerate(dataset["k"].values):
        line(axes, index, dataset["theta_dense"], dataset["periodic"].sel(k=k))
        marked = dataset["dahl"].sel(k=k)
        name = f"Dahl, k = {k:g}"
        marks(axes, index, dataset["theta"], marked, name, filled=True, markersize=4.5)
    for n, k in enumerate(dataset["k_lugre"].values):
        marks(
            axes, 2, dataset["theta"], dataset["lugre"].sel(k_lugre=k),
            "" if n else "LuGre, k = 2 and 20", marker="o", markersize=10, color=BLACK,
            markeredgewidth=0.8,
        )  # fmt: skip
    axes.set(ylim=(0.0, None), **OVER_DIRECTION)
    legend_above(axes, 3)
    return figure


_ARC = 0.14
_BODIES, _ROOTS = ("N'", "N'₁"), ("M", "M'¹", "M'²", "M₁")
_BESIDE_ROOTS = ((-16, -4), (6, 6), (-26, 2), (6, 4))


def increment(dataset: "xr.Dataset") -> "Figure":
    """Draw body and root of an asperity through the two phases, the base moving."""
    figure, (axes,) = axes_grid(1, 1, width=6.4, height=5.0)
    body, root = dataset["body"].values, dataset["root"].values
    base = dataset["base"].values
    stretched = ((root[0], body[0]), (root[1], body[1]), (root[3], body[1]))
    shifts = ((-64, -14), (-56, 42), (6, 8))
    asperity(axes, body, root, stretched, dataset["deflection"].values, shifts)
    for at, name, beside in zip(body, _BODIES, ((-14, -14), (8, -8)), strict=True):
        axes.annotate(name, at, beside, textcoords="offset points")
    for at, name, beside in zip(root, _ROOTS, _BESIDE_ROOTS, strict=True):
        axes.annotate(name, at, beside, textcoords="offset points")
    if base[0]:
        own = body[0] + dataset["own"].values
        axes.plot(*zip(body[0], own, strict=True), color=BLACK, linewidth=0.9, dashes=(5, 2))
        _arrow(axes, own, body[1], "$-Δx_b$", (-8, -16))
    for at, angle, name, n in zip((body[1], body[1]), dataset["angle"].values, "αβ", (1, 2),
                                  strict=True):  # fmt: skip
        turn = np.linspace(0.0, angle, 30)
        size = _ARC * n
        arc = at[:, None] + size * np.array([-np.cos(turn), np.sin(turn)])
        axes.plot(*arc, color=COLOURS[n], linewidth=1.2)
        beside = (-4, -15) if n == 1 else (-11, -5)
        axes.annotate(name, arc[:, 5], beside, textcoords="offset points", color=COLOURS[n])
    axes.plot([body[1][0] - 2.6 * _ARC, body[1][0]], [body[1][1]] * 2, color=BLACK, linewidth=0.6)
    edge = np.array([body[1][0] + 0.12, root[1][1]])
    _arrow(axes, edge, edge + np.array([0.0, base[1]]), "EF = Δy$_b$ of the base")
    axes.set_aspect("equal")
    axes.set(xlabel="along x, over $s_{max}$", ylabel="across y, over $s_{max}$")
    axes.margins(0.16)
    return figure


def _arrow(
    axes: "Axes", start: Any, end: Any, name: str, beside: tuple[float, float] = (5.0, 4.0)
) -> None:
    arrow(axes, start, end, BLUE, **_OPEN)
    axes.annotate(name, 0.5 * (np.asarray(start) + end), beside, textcoords="offset points",
                  color=BLUE)  # fmt: skip
    axes.update_datalim([start, end])


def base(dataset: "xr.Dataset") -> "Figure":
    """Draw the displacement along the axis of vibration and its two components."""
    figure, (axes,) = axes_grid(1, 1, width=5.4, height=4.4)
    theta, share = float(dataset["theta"]), float(dataset["share"])
    way = np.array([np.cos(theta), np.sin(theta)])
    axes.plot(*np.transpose([-way, way]), color=BLACK, dashes=(1, 1.5), linewidth=1.0)
    at = share * way
    vectors: tuple[tuple[Any, str, tuple[int, int], str], ...] = (
        (at, "u", (-16, 4), COLOURS[0]),
        (np.array([at[0], 0.0]), "$x_b$", (-20, -16), COLOURS[1]),
        (np.array([0.0, at[1]]), "$y_b$", (-22, -12), COLOURS[2]),
    )
    for end, name, beside, colour in vectors:
        arrow(axes, (0.0, 0.0), end, colour, linewidth=1.8, shrinkB=0)
        axes.annotate(name, end, beside, textcoords="offset points", color=colour)
    for end in (np.array([at[0], 0.0]), np.array([0.0, at[1]])):
        axes.plot(*np.transpose([at, end]), color=BLACK, linewidth=0.6)
    turn = np.linspace(0.0, theta, 40)
    axes.plot(0.25 * np.cos(turn), 0.25 * np.sin(turn), color=BLACK, linewidth=1.0)
    axes.annotate("θ", (0.25, 0.0), (4, 8), textcoords="offset points")
    axes.set_aspect("equal")
    axes.set(
        xlabel="along the drive, over $u_a$", ylabel="across it, over $u_a$",
        xlim=(-1.0, 1.0), ylim=(-0.75, 0.75),
    )  # fmt: skip
    return figure

"""Pictures of drives; each takes the dataset of an answer.

A torque ratio is never drawn without its balance and whether it settled.
"""

from typing import TYPE_CHECKING

import numpy as np

from asperity.arrays import FloatArray
from asperity.drive.headline import state_of
from asperity.results.figures import (
    BLACK,
    BLUE,
    GREEN,
    ORANGE,
    PURPLE,
    SKY,
    VERMILION,
    axes_grid,
    draw,
)
from asperity.results.panels import BELOW, Mark, Panel, band, drawn, level, line, points, shade

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from matplotlib.tri import Triangulation

_LOST = "#BBBBBB"
_BELOW = {**BELOW, "ncols": 3}
_RESOLVED = 1e-5  # of a balance
_KILO = 1e3
_POWERS = (
    ("power_drive", "motor", BLUE),
    ("power_actuator", "actuator", ORANGE),
    ("power_load", "load", GREEN),
    ("power_friction", "friction", VERMILION),
    ("power_damping", "damping", PURPLE),
    ("power_stored", "stored", SKY),
)


def flank_triangles(dataset: "xr.Dataset", side: float = 1.0) -> "Triangulation":
    """Return the mesh of a wheel's flank in triangles, mm; ``side`` -1 turns it about the tooth."""
    from matplotlib.tri import Triangulation

    z, r = 1e3 * dataset["node_face"].values, 1e3 * dataset["node_radius"].values
    corners = dataset["faces"].values
    halves = np.concatenate([corners[:, [0, 1, 2]], corners[:, [0, 2, 3]]])
    return Triangulation(side * z, r, halves)


def pitch_closed(dataset: "xr.Dataset", *courses: FloatArray) -> tuple[FloatArray, ...]:
    """Return the worm's angles of a pitch, deg, and courses, as it begins again at their ends.

    A single phase has no step by which the pitch would end.
    """
    angle = np.degrees(dataset["phase"].values)
    if len(angle) < 2:
        return angle, *courses
    end = angle[0] + len(angle) * (angle[1] - angle[0])
    return np.append(angle, end), *(np.append(course, course[0]) for course in courses)


def pressure_label(dataset: "xr.Dataset") -> str:
    """Return what a colour bar of pressures is of, with their limit."""
    flow = dataset.get("flow_pressure")
    limit = "" if flow is None else f"\nflows at {float(flow):.4g}"
    return f"pressure (MPa){limit}"


def _percent(share: float) -> str:
    """Return a balance in percent; below what is resolved it is none."""
    return f"{100.0 * share:.2g} %" if abs(share) > _RESOLVED else "0 %"


def _state(dataset: "xr.Dataset") -> str:
    """Return what a ratio is to be read with."""
    return state_of(bool(dataset.attrs["settled"]), float(dataset["torque_balance"]))


def _ratio(dataset: "xr.Dataset") -> str:
    """Return the ratio, what it is one of where that is not the worm's torques, and its state."""
    held = dataset.attrs["drive.protocol"] == "held-wheel"
    what = "load over torque of the held wheel" if held else "ratio"
    return f"{what} {float(dataset['torque_ratio']):.3f}: {_state(dataset)}"


def _power(watts: float) -> str:
    """Return a power as it is read."""
    return f"{1e-3 * watts:.3g} kW" if abs(watts) >= _KILO else f"{watts:.3g} W"


def plot_torque(dataset: "xr.Dataset") -> "Figure":
    """Draw the worm's torque over the last cycles, contact lost shaded, and over all cycles."""
    if "cycle_end" not in dataset.coords:
        return draw(dataset)
    banded = "time" in dataset.coords
    ends, static = 1e3 * dataset["cycle_end"].values, float(dataset["torque_static"])
    load = dataset.attrs["operation.output_torque"]
    title = "From the start of the vibration on"
    if not banded and "torque_ratio" in dataset:
        title += f"; {_ratio(dataset)}"
    course = Panel(
        "time (ms)", "mean of a cycle,\ntorque over static or load",
        [
            line(0, ends, dataset["cycle_torque"] / static, "worm, over static"),
            line(2, ends, dataset["cycle_wheel"] / load, "wheel, over load", dashes=(5, 2)),
            level(float(dataset["floor_reversed"]), "friction reversed", dashes=(2, 2)),
        ],
        legend=_BELOW, more=lambda axes: axes.set_title(title, loc="left", fontsize="medium"),
    )  # fmt: skip
    return drawn([_last_cycles(dataset), course] if banded else [course],
                 height=6.4 if banded else 3.6)  # fmt: skip


def _last_cycles(dataset: "xr.Dataset") -> Panel:
    time, lost = 1e3 * (dataset["time"].values - dataset["time"].values[0]), dataset["open"].values
    marks = [
        band(time, dataset["torque_min"], dataset["torque_max"], BLUE),
        line(0, time, dataset["torque"], "torque of the worm's shaft"),
        level(float(dataset["torque_static"]), "without vibration", dashes=(4, 3)),
    ]
    if lost.any():
        marks.append(shade(time, lost > 0.5, "contact lost", color=_LOST, alpha=0.6, step="mid"))
    title = _ratio(dataset) if "torque_ratio" in dataset else ""
    return Panel("time in the last cycles (ms)", "torque (N m)", marks, title, _BELOW)


def plot_powers(dataset: "xr.Dataset") -> "Figure":
    """Draw the power ledger: what is put in to the right of zero, and where it goes."""
    figure, (axes,) = axes_grid(height=3.4)
    values = [float(dataset[name]) for name, _, _ in _POWERS]
    bars = axes.barh(
        [name for _, name, _ in _POWERS], values, color=[colour for *_, colour in _POWERS],
        height=0.6,
    )  # fmt: skip
    # To the right of zero and of its bar: to the left of a short one stand the names.
    for value, bar in zip(values, bars, strict=True):
        at = (max(value, 0.0), bar.get_y() + 0.5 * bar.get_height())
        axes.annotate(_power(value), at, (3.0, 0.0), textcoords="offset points", va="center")
    axes.axhline(1.5, color=BLACK, linewidth=0.8)
    axes.invert_yaxis()
    axes.margins(x=0.15)
    axes.axvline(0.0, color=BLACK, linewidth=0.8)
    axes.set_xlabel("mean power (W)\nabove the line put in, below it where it goes")
    axes.set_title(f"Closes to {float(dataset['closure']):.1g};\n{_state(dataset)}", loc="left")
    return figure


def plot_directions(dataset: "xr.Dataset") -> "Figure":
    """Draw each way of shaking: ratio, what it saves per watt, the greatest force."""
    figure, panel_rows = axes_grid(2, 2, width=10.0, height=6.0)
    modes = [str(mode) for mode in dataset["mode"].values]
    settled = dataset["settled"].values.astype(bool)
    balance = dataset["torque_balance"].values
    saved, error = dataset["saved"].values, dataset["saved_error"].values
    over = 1e-6 / float(dataset["amplitude"])
    per_watt, of_it = (dataset[f"saved_per_actuator{end}"].values for end in ("", "_error"))
    columns = (
        (dataset["torque_ratio"].values, None, "torque over static"),
        (over * saved, over * error, "drive power saved (W/µm)"),
        (per_watt, of_it, "drive power saved over actuator power"),
        (dataset["force_ratio"].values, None, "greatest normal force over static"),
    )
    labels = [
        f"{mode}\n{'settled' if sure else 'not settled'}, {_percent(off)}"
        if np.isfinite(off)
        else f"{mode}\nnot solved"
        for mode, sure, off in zip(modes, settled, balance, strict=True)
    ]
    colours = [BLUE if sure else _LOST for sure in settled]
    for place, (panel, (values, errors, label)) in enumerate(zip(panel_rows, columns, strict=True)):
        bars = panel.barh(range(len(modes)), np.nan_to_num(values), color=colours, height=0.6)
        words = [f"{value:.3g}" if np.isfinite(value) else "none" for value in values]
        if errors is not None:
            words = [
                word if word == "none" or not np.isfinite(off) else f"{word} ± {off:.1g}"
                for word, off in zip(words, errors, strict=True)
            ]
        panel.bar_label(bars, words, padding=3)
        panel.set_yticks(range(len(modes)), [""] * len(modes) if place % 2 else labels)
        panel.invert_yaxis()
        panel.margins(x=0.2)
        panel.set_xlabel(label)
    return figure


def _loose(
    along: FloatArray, values: FloatArray, settled: "xr.DataArray | None"
) -> tuple[Mark, ...]:
    """Return crosses on what has not settled."""
    out = np.zeros(along.size, bool) if settled is None else settled.values == 0
    if not out.any():
        return ()
    return (
        points(0, along[out], values[out], "not settled", filled=True, color=BLACK, marker="x",
               zorder=5),
    )  # fmt: skip


def plot_locking(dataset: "xr.Dataset") -> "Figure":
    """Draw the creep over the amplitude, the threshold, and what both are by closed forms."""
    amplitude = 1e6 * dataset["amplitude"].values
    marks = [
        line(0, amplitude, dataset["creep_over"], "marched", marker="o", markersize=4),
        line(0, amplitude, dataset["creep_limit"],
             r"$v_a\,\sin(\pi\varphi/2)$, far beyond the threshold",
             color=BLACK, dashes=(4, 3), linewidth=1.0),
        *_loose(amplitude, dataset["creep_over"].values, dataset.get("settled_over")),
        *(
            level(1e6 * float(dataset[name]), words, upright=True, color=colour, dashes=(2, 2),
                  linewidth=1.2)
            for name, colour, words in (
                ("threshold", BLUE, "threshold, marched"),
                ("threshold_closed_form", BLACK, r"threshold, $s_{eff}(1 - \varphi)$"),
            )
            if name in dataset and float(dataset[name]) > 0.0
        ),
    ]  # fmt: skip
    fastest = float(np.abs(dataset["creep_over"]).max())
    linear = max(1e-3 * fastest, 1e-9)

    def scaled(axes: "Axes") -> None:
        axes.set_xscale("log")
        axes.set_yscale("symlog", linthresh=linear)
        if dataset["creep_over"].min() >= -linear:
            axes.set_ylim(-0.3 * linear, 2.0 * max(fastest, float(dataset["creep_limit"].max())))

    word = "holds" if dataset.attrs["locked"] else "does not hold"
    share = float(dataset["holding_share"])
    title = rf"Without vibration it {word} its load, by $\varphi$ = {share:.3g} of full friction"
    panel = Panel("amplitude of the vibration (µm)", "creep of the wheel (rad/s)", marks, title,
                  legend={}, tight=False, more=scaled)  # fmt: skip
    return drawn([panel], height=4.0)

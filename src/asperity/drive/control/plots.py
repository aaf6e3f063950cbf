"""Pictures of a stroke whose vibration is switched; each takes the dataset of an answer."""

from typing import TYPE_CHECKING

from asperity.results.figures import BLACK, BLUE, ORANGE, SKY, VERMILION, axes_grid, legend
from asperity.results.panels import BELOW, Mark, Panel, drawn, level, line

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

_COLUMNS = 2
_BELOW = {**BELOW, "ncols": 3}


def plot_stroke(dataset: "xr.Dataset") -> "Figure":
    """Draw motor, reading with its thresholds, and vibration over a stroke without a failure."""
    time = 1e3 * dataset["time"].values
    of = dataset.isel(failure=0)
    torque = Panel(
        "time (ms)", "torque of the\nmotor (N m)",
        [
            line(0, time, of["torque"].values, "motor"),
            level(float(dataset["torque_static"]), "at a seat, not shaken", dashes=(4, 3)),
            *_limit(dataset),
        ],
        legend=_BELOW,
    )  # fmt: skip
    reading = Panel(
        "time (ms)", "reading (N m)",
        [
            line(0, time, of["reading"].values, "reading"),
            level(float(dataset.attrs["control.on"]), "on", color=VERMILION, dashes=(4, 2)),
            level(float(dataset.attrs["control.off"]), "off", color=BLUE, dashes=(2, 2)),
        ],
        legend=_BELOW,
    )  # fmt: skip
    shaken = Panel(
        "time (ms)", "vibration over\nits amplitude",
        [line(0, time, of["amplitude"].values)],
    )  # fmt: skip
    return drawn([torque, reading, shaken], height=8.0)


def _limit(dataset: "xr.Dataset") -> list[Mark]:
    most = dataset.attrs.get("control.motor_torque")
    if most is None:
        return []
    return [level(float(most), "the most it gives", color=VERMILION, dashes=(2, 2))]


def plot_failures(dataset: "xr.Dataset") -> "Figure":
    """Draw the motor's torque of every failure over that without, shaken times shaded."""
    names = [str(name) for name in dataset["failure"].values]
    count = max(1, -(-len(names) // _COLUMNS))
    figure, every = axes_grid(count, _COLUMNS, width=9.0, height=2.1 * count + 0.6)
    time = 1e3 * dataset["time"].values
    plain = dataset["torque"].isel(failure=0).values
    top = 1.08 * float(dataset["torque"].max())
    for n, (name, axes) in enumerate(zip(names, every, strict=False)):
        of = dataset.isel(failure=n)
        axes.fill_between(
            time, 0.0, top, where=of["amplitude"].values > 0.0, color=SKY, alpha=0.25, linewidth=0,
            label="shaken" if n == 0 else None,
        )  # fmt: skip
        axes.plot(time, plain, color=BLACK, linewidth=0.8, dashes=(3, 2),
                  label="nothing fails" if n == 0 else None)  # fmt: skip
        axes.plot(time, of["torque"].values, color=ORANGE if n else BLUE, linewidth=1.3)
        for mark in _limit(dataset):
            mark.put(axes)
        holds = "holds after" if dataset["held"].values[n] else "does NOT hold after"
        axes.set_title(f"{'nothing' if name == 'none' else name}: {holds}", loc="left",
                       fontsize="medium")  # fmt: skip
        axes.set_ylim(0.0, top)
        if n // _COLUMNS == (len(names) - 1) // _COLUMNS or n + _COLUMNS >= len(names):
            axes.set_xlabel("time (ms)")
        if n % _COLUMNS == 0:
            axes.set_ylabel("motor (N m)")
    for axes in every[len(names) :]:
        axes.set_visible(False)
    legend(every[0], loc="upper center")
    return figure

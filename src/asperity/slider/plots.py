"""Pictures of a solved sliding body."""

import dataclasses
from typing import TYPE_CHECKING, Any

import numpy as np

from asperity.results.figures import BLUE, GREEN, SKY, VERMILION, draw
from asperity.results.panels import Mark, Panel, band, drawn, level, line, shade

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_CYCLES = 3
_DASHED: dict[str, Any] = {"dashes": (4, 3)}
_FRICTION: tuple[tuple[str, str, dict[str, Any]], ...] = (
    ("x", "along the drive, x", {"color": VERMILION, "dashes": ()}),
    ("y", "across, y", {"color": GREEN, "dashes": (5, 2)}),
)


def plot_slide(dataset: "xr.Dataset") -> "Figure":
    """Draw the drive force over time and the friction over the last cycles.

    An answer without a history shows its numbers.
    """
    if "time" not in dataset.coords:
        return draw(dataset)
    time, force = dataset["time"].values, float(dataset["static_drive_force"])
    frequency = dataset.attrs.get("vibration.frequency")
    periodic = dataset.attrs["solve.method"] == "periodic"
    scale, unit = (1e3, "ms") if periodic or time[-1] < 0.1 else (1.0, "s")

    def whole(axes: "Axes") -> None:
        axes.annotate(
            r"$\mu F_N$", (1.0, force), (-2, 3), xycoords=("axes fraction", "data"),
            textcoords="offset points", ha="right", va="bottom",
        )  # fmt: skip
        if axes.get_ylim()[0] > 0.0:
            axes.set_ylim(bottom=0.0)

    last = slice(None)
    if frequency and not periodic:
        last = slice(int(np.searchsorted(time, time[-1] - _CYCLES / frequency)), None)
    shown = 1e3 * (time[last] - (0.0 if periodic else time[last][0]))
    friction = [
        mark
        for axis, label, style in _FRICTION
        if axis == "x" or np.any(dataset["friction"].sel(axis=axis))
        for mark in _course(shown, dataset.sel(axis=axis).isel(time=last), "friction", label, style)
    ]
    over = "time (ms)" if not frequency or periodic else "time in the last cycles (ms)"
    drive = _course(scale * time, dataset, "drive_force", "", {"color": BLUE})
    panels = [
        Panel(
            f"time ({unit})", "drive force (N)", [*drive, level(force, **_DASHED)],
            rf"Drive force, mean {float(dataset['ratio']):.4g} $\mu F_N${unsettled(dataset)}",
            limits={"ymargin": 0.12}, more=whole,
        ),
        Panel(
            over, "friction (N)", friction, "Friction on the body",
            legend={"loc": "lower right", "bbox_to_anchor": (1.0, 0.98), "ncols": 2},
        ),
    ]  # fmt: skip
    if "normal_force" not in dataset or "time" not in dataset["normal_force"].dims:
        return drawn(panels, height=6.2)
    load, share = dataset["normal_force"].values[last], float(dataset["open_share"])
    flight = flight_of(shown, load)
    pressed = [
        *_course(shown, dataset.isel(time=last), "normal_force", "", {"color": BLUE}),
        level(dataset.attrs["slider.normal_force"], **_DASHED), *flight,
    ]  # fmt: skip
    panels[1] = dataclasses.replace(panels[1], marks=[*friction, *flight])
    title = f"Normal force, {100.0 * share:.3g} % of the time in flight"
    return drawn([*panels, Panel(over, "normal force (N)", pressed, title)], height=8.6)


def unsettled(dataset: "xr.Dataset") -> str:
    """Return what follows a mean in a title; nothing of one that has settled."""
    return "" if bool(dataset.attrs["settled"]) else ": not settled, no prediction"


def flight_of(at: np.ndarray, load: np.ndarray, label: str | None = None) -> list[Mark]:
    """Return where there is no load, shaded."""
    flight = load <= 0.0
    return [shade(at, flight, label, color=SKY, alpha=0.3)] if np.any(flight) else []


def _course(
    time: np.ndarray, dataset: "xr.Dataset", name: str, label: str, style: dict[str, Any]
) -> list[Mark]:
    """Return a curve, and what lies between least and greatest where a mean hides something."""
    marks = [line(0, time, dataset[name], label, **style)]
    if f"{name}_min" in dataset:
        low, high = dataset[f"{name}_min"].values, dataset[f"{name}_max"].values
        if np.any(low < high):
            marks.insert(0, band(time, low, high, style["color"]))
    return marks

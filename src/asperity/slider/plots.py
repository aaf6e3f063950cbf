"""Pictures of a solved sliding body."""

from typing import TYPE_CHECKING, Any

import numpy as np

from asperity.results.figures import BLACK, BLUE, GREEN, SKY, VERMILION, draw, legend, panels

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_CYCLES = 3
_FRICTION: tuple[tuple[str, str, dict[str, Any]], ...] = (
    ("x", "along the drive, x", {"color": VERMILION}),
    ("y", "across, y", {"color": GREEN, "dashes": (5, 2)}),
)


def plot_slide(dataset: "xr.Dataset") -> "Figure":
    """Draw the drive force over time and the friction over the last cycles.

    An answer without a history shows its numbers.
    """
    if "time" not in dataset.coords:
        return draw(dataset)
    pressed = "normal_force" in dataset and "time" in dataset["normal_force"].dims
    figure, (upper, lower, *more) = panels(3 if pressed else 2, height=8.6 if pressed else 6.2)
    time, force = dataset["time"].values, float(dataset["static_drive_force"])
    frequency = dataset.attrs.get("vibration.frequency")
    periodic = dataset.attrs["solve.method"] == "periodic"
    scale, unit = (1e3, "ms") if periodic or time[-1] < 0.1 else (1.0, "s")
    _band(upper, scale * time, dataset, "drive_force", BLUE)
    upper.plot(scale * time, dataset["drive_force"], color=BLUE)
    upper.axhline(force, color=BLACK, dashes=(4, 3), linewidth=1.0)
    upper.annotate(
        r"$\mu F_N$", (1.0, force), (-2, 3), xycoords=("axes fraction", "data"),
        textcoords="offset points", ha="right", va="bottom",
    )  # fmt: skip
    upper.set_xlabel(f"time ({unit})")
    upper.set_ylabel("drive force (N)")
    ratio = float(dataset["ratio"])
    upper.set_title(rf"Drive force, mean {ratio:.4g} $\mu F_N$", loc="left")
    upper.margins(x=0.0, y=0.12)
    if upper.get_ylim()[0] > 0.0:
        upper.set_ylim(bottom=0.0)
    last = slice(None)
    if frequency and not periodic:
        last = slice(int(np.searchsorted(time, time[-1] - _CYCLES / frequency)), None)
    shown = 1e3 * (time[last] - (0.0 if periodic else time[last][0]))
    for axis, label, style in _FRICTION:
        if axis == "x" or np.any(dataset["friction"].sel(axis=axis)):
            along = dataset.sel(axis=axis).isel(time=last)
            _band(lower, shown, along, "friction", style["color"])
            lower.plot(shown, along["friction"], label=label, **style)
    whole = not frequency or periodic
    lower.set_xlabel("time (ms)" if whole else "time in the last cycles (ms)")
    lower.set_ylabel("friction (N)")
    lower.set_title("Friction on the body", loc="left")
    lower.margins(x=0.0)
    legend(lower, loc="lower right", bbox_to_anchor=(1.0, 0.98), ncols=2)
    for axes in more:
        load = dataset["normal_force"].values[last]
        _band(axes, shown, dataset.isel(time=last), "normal_force", BLUE)
        axes.plot(shown, load, color=BLUE)
        axes.axhline(
            dataset.attrs["slider.normal_force"], color=BLACK, dashes=(4, 3), linewidth=1.0
        )
        for each in (lower, axes):
            shade_flight(each, shown, load, "in flight" if each is axes else None)
        axes.set(xlabel=lower.get_xlabel(), ylabel="normal force (N)")
        share = float(dataset["open_share"])
        axes.set_title(f"Normal force, {100.0 * share:.3g} % of the time in flight", loc="left")
        axes.margins(x=0.0)
    return figure


def shade_flight(axes: "Axes", at: np.ndarray, load: np.ndarray, label: str | None) -> None:
    """Shade where there is no load."""
    flight = load <= 0.0
    if np.any(flight):
        axes.fill_between(
            at, 0.0, 1.0, where=flight, color=SKY, alpha=0.3, linewidth=0.0,
            transform=axes.get_xaxis_transform(), label=label,
        )  # fmt: skip


def _band(axes: "Axes", time: np.ndarray, dataset: "xr.Dataset", name: str, colour: str) -> None:
    """Shade between least and greatest of each stretch, where a mean hides something."""
    if f"{name}_min" in dataset:
        low, high = dataset[f"{name}_min"].values, dataset[f"{name}_max"].values
        if np.any(low < high):
            axes.fill_between(time, low, high, color=colour, alpha=0.25, linewidth=0.0)

"""Pictures of a solved sliding body."""

from typing import TYPE_CHECKING

import numpy as np

from asperity.results.figures import BLACK, BLUE, GREEN, VERMILION, draw, legend, panels

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

_CYCLES = 3


def plot_slide(dataset: "xr.Dataset") -> "Figure":
    """Draw the drive force over time and the friction over the last cycles.

    An answer without a history shows its numbers.
    """
    if "time" not in dataset.coords:
        return draw(dataset)
    figure, (upper, lower) = panels(2, height=6.2)
    time, force = dataset["time"].values, float(dataset["static_drive_force"])
    friction = dataset["friction"].values
    frequency = dataset.attrs.get("vibration.frequency")
    periodic = dataset.attrs["solve.method"] == "periodic"
    scale, unit = (1e3, "ms") if periodic or time[-1] < 0.1 else (1.0, "s")
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
    last = slice(None)
    if frequency and not periodic:
        last = slice(int(np.searchsorted(time, time[-1] - _CYCLES / frequency)), None)
    shown = 1e3 * (time[last] - time[last][0])
    lower.plot(shown, friction[last, 0], color=VERMILION, label="along the drive, x")
    if np.any(friction[:, 1]):
        lower.plot(shown, friction[last, 1], color=GREEN, dashes=(5, 2), label="across, y")
    lower.set_xlabel("time in the last cycles (ms)" if frequency else "time (ms)")
    lower.set_ylabel("friction (N)")
    lower.set_title("Friction on the body", loc="left")
    lower.margins(x=0.0)
    legend(lower, loc="lower right", bbox_to_anchor=(1.0, 0.98), ncols=2)
    return figure

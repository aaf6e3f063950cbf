"""Pictures of a solved block: the pressure over its face, and friction over a settled cycle.

Forces in time are the slider's.
"""

import dataclasses
from typing import TYPE_CHECKING

import numpy as np

from asperity.results.figures import BLACK, BLUE, axes_grid
from asperity.results.panels import Panel, drawn, level, line
from asperity.slider.plots import unsettled

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.collections import Collection
    from matplotlib.contour import ContourSet
    from matplotlib.figure import Figure


_LEVELS = 24
# Share of full friction below which a force across the drive is rounding.
_SHOWN = 1e-4


def plot_pressure(dataset: "xr.Dataset") -> "Figure":
    """Draw the mean pressure in the window over the block's face, seen from below.

    Each face of an element is drawn as the triangles between its nodes, the pressure as what the
    nodes around it have in the mean.
    """
    from matplotlib.tri import Triangulation

    x, y = 1e3 * dataset["node_x"].values, 1e3 * dataset["node_y"].values
    pressure = 1e-3 * dataset["pressure"].values
    # The face fills the room beside the bar, whatever its shape, and leaves some for the title.
    aspect = float(np.ptp(x) / np.ptp(y))
    width = min(max(5.0, 2.1 + 4.0 * aspect), 9.0)
    figure, (axes,) = axes_grid(
        width=width, height=min(max(2.6, 1.2 + (width - 2.1) / aspect), 5.0)
    )
    triangles = Triangulation(x, y, face_triangles(dataset["faces"].values))
    spread = float(np.ptp(pressure))
    if spread > 1e-6 * float(np.abs(pressure).max()):
        drawn: ContourSet | Collection = axes.tricontourf(
            triangles, pressure, levels=_LEVELS, cmap="cividis"
        )
    else:
        drawn = axes.tripcolor(triangles, pressure, cmap="cividis")
    bar = figure.colorbar(drawn, ax=axes)
    bar.set_label("mean pressure (kPa)")
    axes.set_aspect("equal")
    axes.grid(visible=False)
    axes.set_xlabel("along the drive, x (mm)")
    axes.set_ylabel("across, y (mm)")
    length, width, _ = dataset.attrs["block.size"]
    mean = 1e-3 * float(dataset["normal_force"]) / (length * width)
    peak = 1e-3 * float(dataset["peak_pressure"])
    figure.suptitle(
        f"Contact pressure, mean {mean:.3g} kPa;\ngreatest at an integration point {peak:.3g} kPa",
        fontsize="medium",
    )
    return figure


def plot_settled(dataset: "xr.Dataset") -> "Figure":
    """Draw the friction of a settled block over one cycle beside that of the sliding body."""
    full, mean = float(dataset["static_drive_force"]), float(dataset["mean_drive_force"])
    largest = abs(dataset["friction"]).max("phase")
    axes_shown = [axis for axis in ("x", "y") if largest.sel(axis=axis) > _SHOWN * full]
    phase = np.concatenate([[0.0], dataset["phase"].values])
    panels = []
    for axis in axes_shown:
        # A cycle begins where the one before it ended.
        rigid, elastic = (
            [force[-1], *force]
            for force in (dataset[f"{of}friction"].sel(axis=axis).values for of in ("slider_", ""))
        )
        marks = [
            line(0, phase, rigid, "sliding body", color=BLACK, dashes=(5, 2)),
            line(0 if axis == "x" else 1, phase, elastic, "elastic block", dashes=()),
        ]
        panels.append(Panel(y="friction (N)", marks=marks))
    among = level(mean, "mean drive force", color=BLUE, dashes=(1, 1))
    title = rf"Along the drive, mean {mean / full:.4g} $\mu F_N${unsettled(dataset)}"
    panels[0] = dataclasses.replace(
        panels[0], marks=[*panels[0].marks, among], title=title, legend={"loc": "best"}
    )
    if len(panels) > 1:
        panels[1] = dataclasses.replace(panels[1], title="Across it")
    panels[-1] = dataclasses.replace(panels[-1], x="time over the period of the vibration")
    return drawn(panels, height=2.2 + 2.0 * len(panels))


def face_triangles(faces: "np.ndarray[tuple[int, int], np.dtype[np.int64]]") -> np.ndarray:
    """Return the triangles between the nodes of 4- or 9-node faces, shape (k, 3)."""
    if faces.shape[1] == 4:
        quads = faces[:, None, :]
    else:
        # Corner, middle of an edge, middle of the face, middle of the other edge.
        parts = np.array([[0, 4, 8, 7], [4, 1, 5, 8], [8, 5, 2, 6], [7, 8, 6, 3]])
        quads = faces[:, parts]
    quads = quads.reshape(-1, 4)
    return np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])

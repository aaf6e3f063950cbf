"""The contact pattern at the corners of the mounting tolerances, drawn from a study's dataset."""

from typing import TYPE_CHECKING

import numpy as np

from asperity.results.figures import BLACK, axes_grid

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

_MICROMETRES = 1e3
_GROUND = "#F2F2F2"
_LEVELS = 7


def corners(dataset: "xr.Dataset") -> "Figure":
    """Draw the pattern of the flank s = +1, as it is meant (dashed) and at each corner."""
    film = _MICROMETRES * float(dataset["marking_thickness"].max())
    flank = dataset.sel(side=1)
    face, radius = flank["face"].values, flank["radius"].values
    meant = _MICROMETRES * flank["gap"].values
    names = [str(name) for name in dataset["corner"].values]
    columns = 2 if len(names) <= 4 else 4
    rows = -(-len(names) // columns)
    figure, axes = axes_grid(rows, columns, width=3.5 * columns, height=0.8 + 2.6 * rows)
    filled = None
    for panel, name, gap in zip(axes, names, dataset["corner_gap"].values, strict=False):
        shown = np.maximum(_MICROMETRES * gap, 0.0)
        panel.grid(False)
        panel.set_facecolor(_GROUND)
        if shown.min() < film:
            levels = np.linspace(0.0, film, _LEVELS)
            filled = panel.contourf(face, radius, shown, levels=levels, cmap="viridis")
            panel.contour(face, radius, shown, levels=[film], colors=BLACK, linewidths=1.0)
        if meant.min() < film:
            panel.contour(
                face, radius, meant, levels=[film], colors=BLACK, linewidths=1.0,
                linestyles="dashed",
            )  # fmt: skip
        panel.set_title(name)
    for number, panel in enumerate(axes):
        if number % columns == 0:
            panel.set_ylabel("from the axis (mm)")
        if number + columns >= len(names):
            panel.set_xlabel("from mid-face (mm)")
    if filled is not None:
        bar = figure.colorbar(filled, ax=axes)
        bar.set_label(f"gap (µm), bare above {film:g};\ndashed: as meant")
    return figure

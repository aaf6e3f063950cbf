"""Pictures of the stresses at the roots of a loaded wheel."""

from typing import TYPE_CHECKING

import numpy as np

from asperity.drive.plots import pitch_closed
from asperity.results.figures import BLACK, BLUE, VERMILION, axes_grid, legend

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

_LEVELS = 16


def over_pitch(dataset: "xr.Dataset") -> "Figure":
    """Draw the largest tension and compression over a pitch."""
    figure, (panel,) = axes_grid(1, 1, width=6.4, height=3.6)
    angle, tension, compression = pitch_closed(
        dataset, 1e-6 * dataset["tension_course"].values,
        -1e-6 * dataset["compression_course"].values,
    )  # fmt: skip
    panel.plot(angle, tension, "o-", color=VERMILION, label="tension, loaded side")
    panel.plot(angle, compression, "s--", color=BLUE, label="compression, other side")
    panel.set_ylim(0.0, None)
    panel.set_xlabel("angle of the worm (°)")
    panel.set_ylabel("stress at the fillet (MPa)")
    legend(panel)
    return figure


def fillet(dataset: "xr.Dataset") -> "Figure":
    """Draw the largest tension of a pitch over the fillet and the root."""
    figure, (panel,) = axes_grid(1, 1, width=6.4, height=3.6)
    face, way = 1e3 * dataset["fillet_face"].values, 1e3 * dataset["fillet_way"].values
    tension = 1e-6 * dataset["fillet_tension"].values
    drawn = panel.contourf(face, way, np.maximum(tension, 0.0), _LEVELS, cmap="cividis")
    at = np.unravel_index(np.argmax(tension), tension.shape)
    panel.plot(face[at], way[at], "o", color="white", markeredgecolor=BLACK, markersize=7)
    panel.invert_yaxis()
    panel.set_xlabel("along the face (mm)")
    panel.set_ylabel("from the foot of the flank (mm)")
    figure.colorbar(drawn, ax=panel, label="largest tension of a pitch (MPa)")
    return figure

"""A picture of the designs that a search for relief has tried."""

from typing import TYPE_CHECKING

import numpy as np

from asperity.results.figures import BLACK, BLUE, GREEN, PURPLE, VERMILION, axes_grid, legend

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

_EDGES = (("worm_tip", "worm's tip", VERMILION), ("wheel_tip", "wheel's tip", PURPLE),
          ("face_end", "ends of the face", GREEN))  # fmt: skip


def designs(dataset: "xr.Dataset") -> "Figure":
    """Draw the forces on the edges, the pressures and the error of each design."""
    names = [_short(str(name)) for name in np.atleast_1d(dataset["design"].values)]
    at = np.arange(len(names))
    figure, (force, pressure, error) = axes_grid(3, 1, width=7.4, height=7.6)
    # Beside each other: each at its own worst load and mounting, all together at theirs.
    shown = [(*edge, np.nan_to_num(dataset[edge[0]].values)) for edge in _EDGES]
    shown = [edge for edge in shown if edge[-1].any()]
    wide = 0.75 / max(len(shown), 1)
    for k, (_, label, colour, values) in enumerate(shown):
        places = at + (k - 0.5 * (len(shown) - 1)) * wide
        force.bar(places, values, 0.9 * wide, color=colour, label=label)
    force.plot(at, dataset["edge_force"].values, "_", color=BLACK, markersize=22, label="together")
    force.set_ylim(0.0, None)
    force.set_ylabel("force on edges (N)")
    legend(force)
    pressure.plot(at, 1e-6 * dataset["peak"].values, "^", color=VERMILION, label="edges included")
    pressure.plot(at, 1e-6 * dataset["flank"].values, "o", color=BLUE, label="flank")
    pressure.set_ylim(0.0, None)
    pressure.set_ylabel("pressure (MPa)")
    legend(pressure)
    error.bar(at, 1e6 * dataset["error"].values, 0.6, color=BLUE)
    error.set_ylabel("error (µrad)")
    best = int(np.argmax(dataset["is_best"].values))
    for panel in (force, pressure, error):
        panel.set_xticks(at, [])
        panel.set_xlim(-0.6, len(names) - 0.4)
        panel.axvspan(best - 0.45, best + 0.45, color=BLACK, alpha=0.08, linewidth=0.0)
    error.set_xticks(at, names, rotation=60 if len(names) > 6 else 0, fontsize=9.0)
    error.set_xlabel("design; shaded: the best")
    return figure


def _short(name: str) -> str:
    parts = [part.partition(".")[2] or part for part in name.split(", ")]
    return "\n".join(
        part.replace("_", " ").replace("=", " ").replace(" um", " µm") for part in parts
    )

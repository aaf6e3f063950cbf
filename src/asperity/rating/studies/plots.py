"""Pictures of the studies."""

from typing import TYPE_CHECKING

import numpy as np

from asperity.slider.plots import BLACK, BLUE, GREEN, ORANGE, PURPLE, SKY, VERMILION, legend, panels

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from asperity.rating.studies.sensitivity import Sensitivity

_COLOURS = (BLUE, VERMILION, GREEN, PURPLE, ORANGE, SKY, BLACK)
_MARKERS = ("o", "s", "^", "D", "v", "P", "X")
_SYMBOLS = {
    "pressure_angle": r"$\alpha_n$",
    "centre_distance": r"$a$",
    "worm_speed": r"$n_1$",
    "gear_ratio": r"$u$",
    "diameter_factor": r"$q_1$",
    "axial_module": r"$m_{x1}$",
    "worm_roughness": r"$Ra_1$",
}


def plot_sensitivity(study: "Sensitivity") -> "Figure":
    """Draw the efficiency over the rise of each input; a cross is where answers end."""
    figure, (axes,) = panels(height=4.8)
    ends = []
    for place, found in enumerate(study.influences):
        colour = _COLOURS[place % len(_COLOURS)]
        name = _SYMBOLS.get(found.quantity.name, found.quantity.name.replace("_", " "))
        axes.plot(
            100.0 * study.rises, 100.0 * found.efficiency, color=colour, label=name,
            marker=_MARKERS[place % len(_MARKERS)], markersize=5.0,
        )  # fmt: skip
        last = int(np.flatnonzero(~np.isnan(found.efficiency))[-1])
        if found.fails_above is not None:
            ends.append((100.0 * found.fails_above, colour))
            axes.plot(
                [100.0 * study.rises[last], 100.0 * found.fails_above],
                [100.0 * found.efficiency[last], 0.0], color=colour, dashes=(2, 2),
            )  # fmt: skip
    for rise, colour in ends:
        axes.plot(
            rise, 0.0, marker="x", markersize=9.0, markeredgewidth=2.0, color=colour,
            clip_on=False, zorder=5,
        )  # fmt: skip
        axes.annotate(
            f"+{rise:.1f} %", (rise, 0.0), (-6, 8), textcoords="offset points", ha="right",
        )  # fmt: skip
    if ends:
        axes.set_ylim(0.0, None)
    axes.set_xlim(0.0, 100.0 * study.rises[-1])
    axes.set_xlabel("rise of the input (%)")
    axes.set_ylabel(r"efficiency of the teeth $\eta_{z1-2}$ (%)")
    legend(axes, loc="upper left", bbox_to_anchor=(1.0, 1.0))
    return figure

"""Pictures of the studies."""

from typing import TYPE_CHECKING

import numpy as np

from asperity.results.figures import (
    BLACK,
    BLUE,
    GREEN,
    ORANGE,
    PURPLE,
    SKY,
    VERMILION,
    legend,
    panels,
)
from asperity.studies.optimise import design_numbers

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from asperity.studies.comparison import Comparison
    from asperity.studies.optimise import Optimum
    from asperity.studies.sensitivity import Sensitivity
    from asperity.studies.tradeoff import TradeOff

_COLOURS = (BLUE, VERMILION, GREEN, PURPLE, ORANGE, SKY, BLACK)
_MARKERS = ("o", "s", "^", "D", "v", "P", "X")
_KINDS = {
    "as it is": BLACK,
    "oil": BLUE,
    "additive": GREEN,
    "coating": ORANGE,
    "vibration": VERMILION,
}
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


def plot_comparison(comparison: "Comparison") -> "Figure":
    """Draw the efficiency with each method; a mark is where it is with a vibration's power."""
    rows = comparison.rows[::-1]
    figure, (axes,) = panels(width=8.0, height=1.2 + 0.32 * len(rows))
    for place, row in enumerate(rows):
        computed = row.vibration is not None and row.vibration.computed
        axes.barh(
            place, 100.0 * row.efficiency, height=0.7, color=_KINDS.get(row.kind, SKY),
            hatch="///" if computed else None, edgecolor="white", linewidth=0.0,
        )  # fmt: skip
        axes.annotate(
            f"{100.0 * row.efficiency:.1f}", (100.0 * row.efficiency, place), (4, 0),
            textcoords="offset points", va="center",
        )  # fmt: skip
    counted = [
        (100.0 * row.efficiency_with_vibration, place)
        for place, row in enumerate(rows)
        if row.vibration_power > 0.0
    ]
    if counted:
        axes.plot(
            *zip(*counted, strict=True), linestyle="none", marker="D", markersize=8.0,
            color=BLACK, markeredgecolor="white", label="with the vibration's power counted",
        )  # fmt: skip
    axes.axvline(100.0 * comparison.rows[0].efficiency, color=BLACK, dashes=(4, 3), linewidth=1.0)
    axes.set_yticks(range(len(rows)), [row.name for row in rows])
    axes.tick_params(axis="y", length=0.0)
    axes.grid(visible=False, axis="y")
    axes.set_xlim(0.0, 105.0)
    axes.set_ylim(-0.6, len(rows) - 0.4)
    axes.set_xlabel(r"efficiency of the teeth $\eta_{z1-2}$ (%)")
    if counted:
        legend(axes, loc="lower right", bbox_to_anchor=(1.0, 1.0))
    return figure


def plot_trade_off(curve: "TradeOff", optimum: "Optimum | None" = None) -> "Figure":
    """Draw the highest efficiency over the permissible torque, and where the gearset is."""
    figure, (axes,) = panels(height=4.4)
    axes.plot(
        curve.torque, 100.0 * curve.efficiency, color=BLUE, marker="o", markersize=5.0,
        label="most efficient designs",
    )  # fmt: skip
    axes.plot(
        curve.given["M_permissible_Nm"], 100.0 * curve.given["eta_z1_2"], linestyle="none",
        marker="s", markersize=9.0, color=VERMILION, label="as it is",
    )  # fmt: skip
    if optimum is not None:
        after = design_numbers(optimum.after)
        axes.plot(
            after["bs721"]["M_permissible_Nm"], 100.0 * after["iso14521"]["eta_z1_2"],
            linestyle="none", marker="D", markersize=9.0, color=GREEN,
            label=r"optimum, $M_w$ and $M_s$ kept",
        )  # fmt: skip
    axes.margins(x=0.08, y=0.12)
    axes.set_xlabel(r"permissible torque, the lower of $M_w$ and $M_s$ (N m)")
    axes.set_ylabel(r"efficiency of the teeth $\eta_{z1-2}$ (%)")
    legend(axes, loc="best")
    return figure

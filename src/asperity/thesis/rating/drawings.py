"""The pictures of chapter 3, each drawn from its dataset alone."""

from typing import TYPE_CHECKING

import numpy as np

from asperity.results.figures import BLACK, GREEN, ORANGE, SKY, axes_grid, legend
from asperity.thesis.drawing import DOTTED, line, marks

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure


def friction(dataset: "xr.Dataset") -> "Figure":
    """Draw friction over sliding velocity, by standard and gearset."""
    figure, (axes,) = axes_grid(height=4.6)
    velocity = dataset["velocity"]
    for index, name in enumerate(dataset["gearset"].values):
        own = dataset.sel(gearset=name)
        line(axes, index, velocity, own["mu_zm"], rf"ISO $\mu_{{zm}}$, {name}")
        for key in ("own_mu_zm", "own_mu_AGMA"):
            marks(
                axes, index, own["own_velocity"], own[key], filled=True, markersize=7,
                markeredgecolor="white",
            )  # fmt: skip
    line(axes, 0, velocity, dataset["mu_0T"], r"ISO $\mu_{0T}$", color=BLACK, dashes=DOTTED)
    line(axes, 3, velocity, dataset["mu_AGMA"], "AGMA", color=GREEN)
    axes.set_xscale("log")
    axes.set_xticks([0.02, 0.1, 1.0, 10.0], ["0.02", "0.1", "1", "10"])
    axes.set(
        xlabel="sliding velocity (m/s)", xlim=(float(velocity[0]), float(velocity[-1])),
        ylabel="coefficient of friction", ylim=(0.0, None),
    )  # fmt: skip
    legend(axes, loc="upper right")
    return figure


_SHARES = {"eta_z": r"$\eta_{z1-2}$", "eta_AGMA": r"$\eta_{AGMA}$"}
_TORQUES = {"M_26k": "$M_{26k}$", "M_w": "$M_w$", "M_s": "$M_s$", "T_G_all": "$T_{G,all}$"}


def efficiencies(dataset: "xr.Dataset") -> "Figure":
    """Draw a bar for each gearset, standard and design."""
    return _bars(100.0 * dataset, _SHARES, "efficiency of the teeth (%)", "{:.1f}")


def torques(dataset: "xr.Dataset") -> "Figure":
    """Draw a bar for each gearset, torque and design."""
    return _bars(dataset, _TORQUES, "torque of the wheel (N m)", "{:.0f}")


def _bars(dataset: "xr.Dataset", names: dict[str, str], label: str, shown: str) -> "Figure":
    gearsets, designs = (dataset[name].values for name in ("gearset", "design"))
    figure, all_axes = axes_grid(1, len(gearsets), height=4.2)
    places = np.arange(len(names))
    top = 1.18 * max(float(dataset[name].max()) for name in names)
    for axes, gearset in zip(all_axes, gearsets, strict=True):
        for index, design in enumerate(designs):
            heights = [float(dataset[name].sel(gearset=gearset, design=design)) for name in names]
            bars = axes.bar(
                places + 0.4 * (index - 0.5), heights, 0.36, color=(SKY, ORANGE)[index],
                edgecolor=BLACK, linewidth=0.6, hatch=("", "///")[index], label=str(design),
            )  # fmt: skip
            texts = [shown.format(height) for height in heights]
            axes.bar_label(bars, texts, padding=2, fontsize=9.5)
        axes.set_xticks(places, list(names.values()))
        axes.tick_params(axis="x", length=0.0, pad=6.0)
        axes.grid(visible=False, axis="x")
        axes.set_title(str(gearset), loc="left")
        axes.set_ylim(0.0, top)
    all_axes[0].set_ylabel(label)
    legend(all_axes[0], loc="upper left")
    return figure

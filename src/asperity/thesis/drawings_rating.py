"""The pictures of chapter 3, each drawn from its dataset alone."""

from typing import TYPE_CHECKING, Any

from asperity.slider.plots import BLACK, BLUE, GREEN, ORANGE, PURPLE, SKY, VERMILION, legend, panels

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

_COLOURS = (BLUE, VERMILION, GREEN, PURPLE, ORANGE, SKY)
_MARKERS = "osD^v"
_DASHES = ((None, None), (6, 2), (2, 2), (6, 2, 2, 2), (4, 1))


def friction(dataset: "xr.Dataset") -> "Figure":
    """Draw friction over sliding velocity, by standard and gearset."""
    figure, (axes,) = panels(height=4.6)
    velocity = dataset["velocity"]
    for index, name in enumerate(dataset["gearset"].values):
        own = dataset.sel(gearset=name)
        style: dict[str, Any] = {"color": _COLOURS[index], "dashes": _DASHES[index]}
        axes.plot(velocity, own["mu_zm"], label=rf"ISO $\mu_{{zm}}$, {name}", **style)
        for key in ("own_mu_zm", "own_mu_AGMA"):
            axes.plot(
                own["own_velocity"], own[key], linestyle="none", marker=_MARKERS[index],
                color=_COLOURS[index], markersize=7, markeredgecolor="white",
            )  # fmt: skip
    axes.plot(velocity, dataset["mu_0T"], color=BLACK, dashes=(1, 1.5), label=r"ISO $\mu_{0T}$")
    axes.plot(velocity, dataset["mu_AGMA"], color=GREEN, dashes=(6, 2, 2, 2), label="AGMA")
    axes.set_xscale("log")
    axes.set_xlim(float(velocity[0]), float(velocity[-1]))
    axes.set_xticks([0.02, 0.1, 1.0, 10.0], ["0.02", "0.1", "1", "10"])
    axes.set_ylim(0.0, None)
    axes.set_xlabel("sliding velocity (m/s)")
    axes.set_ylabel("coefficient of friction")
    legend(axes, loc="upper right")
    return figure

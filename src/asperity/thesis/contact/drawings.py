"""The pictures of the elastic block's figures, each drawn from its dataset alone."""

from typing import TYPE_CHECKING, Any

import numpy as np

from asperity.results.figures import BLACK, BLUE, GREEN, ORANGE, PURPLE, VERMILION, legend, panels

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_COLOURS = (BLUE, VERMILION, GREEN, PURPLE, ORANGE)
_MARKERS = "osD^v"
_RATIO = r"drive force over $\mu F_N$"
_APART = r"apart (10$^{-3}\,\mu F_N$)"
_FROM = {
    "slider": "from sliding body",
    "in_series": "with compliance",
    "rocking": "and rocking",
}
_OPEN: dict[str, Any] = {"linestyle": "none", "markerfacecolor": "none", "markeredgewidth": 1.2}


def over_ratio(dataset: "xr.Dataset") -> "Figure":
    """Draw ratios over k above, and how far block and sliding body are apart below."""
    figure, (upper, lower) = panels(2, height=6.8)
    shaken = [str(one) for one in dataset["shaken"].values]
    for index, one in enumerate(shaken):
        what = f", {one} shaken" if len(shaken) > 1 else ""
        part = dataset.sel(shaken=one)
        upper.plot(
            dataset["k"], part["periodic"], color=BLUE, dashes=((1, 0), (4, 1.5))[index],
            label=f"sliding body{what}",
        )  # fmt: skip
        upper.plot(
            dataset["k_block"], part["block"], label=f"elastic block{what}",
            color=(VERMILION, GREEN)[index], marker="os"[index], markersize=7 + 3 * index, **_OPEN,
        )  # fmt: skip
        for other, colour, marker in (
            ("slider", BLACK, "o"), ("in_series", PURPLE, "^"), ("rocking", ORANGE, "s"),
        ):  # fmt: skip
            lower.plot(
                dataset["k_block"], 1e3 * (part["block"] - part[other]), color=colour,
                marker=marker, markersize=6, markerfacecolor=("none", colour)[index],
                linewidth=1.0, dashes=((1, 0), (4, 1.5))[index], label=f"{_FROM[other]}{what}",
            )  # fmt: skip
    upper.plot(
        dataset["k"], dataset["rigid"], color=BLACK, dashes=(1, 1.5), label="rigid Coulomb friction"
    )
    upper.set_ylabel(_RATIO)
    upper.set_ylim(0.0, 1.05)
    legend(upper, loc="upper right")
    _apart(lower)
    lower.margins(y=0.1)
    legend(lower, loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=max(2, len(shaken)))
    for axes in (upper, lower):
        axes.set_xlabel(r"velocity ratio $k = v_a/v_d$")
        axes.set_xlim(0.0, 20.5)
        axes.set_xticks(np.arange(0, 21, 2))
    return figure


def _apart(axes: "Axes") -> None:
    axes.axhline(0.0, color=BLACK, linewidth=0.8)
    axes.set_ylabel(_APART)
    axes.margins(y=0.35)


def over_direction(dataset: "xr.Dataset") -> "Figure":
    """Draw a line for each k with the blocks on it above, and how far they are apart below."""
    figure, (upper, lower) = panels(2, height=7.4)
    apart = 1e3 * (dataset["block"] - dataset["slider"])
    for index, k in enumerate(dataset["k"].values):
        colour = _COLOURS[index]
        upper.plot(dataset["theta"], dataset["periodic"].sel(k=k), color=colour, linewidth=1.2)
        for axes, values in ((upper, dataset["block"]), (lower, apart)):
            axes.plot(
                dataset["theta_block"], values.sel(k=k), color=colour, marker=_MARKERS[index],
                label=f"k = {k:g}", **_OPEN,
            )  # fmt: skip
    upper.set_ylabel(_RATIO)
    upper.set_ylim(0.0, None)
    legend(upper, loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=5)
    _apart(lower)
    for axes in (upper, lower):
        axes.set_xlabel("direction of vibration (deg)")
        axes.set_xticks(np.arange(0, 361, 45))
        axes.set_xlim(-6.0, 366.0)
    return figure


def pressure(dataset: "xr.Dataset") -> "Figure":
    """Draw the pressure under the cylinder above, and how deep it sinks on its way below."""
    figure, (upper, lower) = panels(2, height=6.2)
    half = float(dataset["x"].max())
    upper.plot(1e3 * dataset["x"], 1e-6 * dataset["hertz"], color=BLACK, label="Hertz")
    names = {"nodes": "at nodes", "surface": "integrated"}
    for index, kind in enumerate(str(one) for one in dataset["kind"].values):
        style: dict[str, Any] = {
            "color": _COLOURS[1 - index],
            "marker": "os"[index],
            "markerfacecolor": "none",
            "label": names[kind],
        }
        at = dataset[f"x_{kind}"].values
        near = np.abs(at) < 2.5 * half
        values = dataset[f"pressure_{kind}"].values
        upper.plot(1e3 * at[near], 1e-6 * values[near], dashes=(3, 2), **style)
        lower.plot(dataset["shift"], 1e6 * dataset["approach"].sel(kind=kind), **style)
    upper.set_xlabel("distance from the middle of the cylinder (mm)")
    upper.set_ylabel("pressure (MPa)")
    legend(upper, loc="upper right")
    lower.set_xlabel("place of the cylinder, in elements from a line of nodes")
    lower.set_ylabel("approach (µm)")
    lower.margins(y=0.15)
    legend(lower, loc="best")
    return figure


def normal_laws(dataset: "xr.Dataset") -> "Figure":
    """Draw pressure over overclosure above, and its slope below."""
    figure, (upper, lower) = panels(2, height=5.6)
    over = 1e6 * dataset["overclosure"].values
    for index, law in enumerate(str(one) for one in dataset["law"].values):
        style: dict[str, Any] = {
            "color": _COLOURS[index], "dashes": ((1, 0), (4, 1.5))[index], "label": law,
        }  # fmt: skip
        upper.plot(over, 1e-9 * dataset["pressure"].sel(law=law), **style)
        lower.plot(over, 1e-15 * dataset["slope"].sel(law=law), **style)
    upper.set_ylabel("pressure (GPa)")
    lower.set_ylabel("stiffness (GPa/µm)")
    for axes in (upper, lower):
        for edge in ("start", "end"):
            axes.axvline(1e6 * float(dataset[edge]), color=BLACK, linewidth=0.8, dashes=(1, 1.5))
        axes.set_xlabel("overclosure (µm)")
        axes.margins(x=0.0)
    legend(upper, loc="upper left")
    return figure

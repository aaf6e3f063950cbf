"""The pictures of the elastic block's figures, each drawn from its dataset alone."""

from typing import TYPE_CHECKING

import numpy as np

from asperity.results.figures import (
    BLACK,
    BLUE,
    GREEN,
    ORANGE,
    PURPLE,
    VERMILION,
    axes_grid,
    legend,
)
from asperity.thesis.drawing import DOTTED, OVER_DIRECTION, OVER_RATIO, legend_above, line, marks

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_APART = r"apart (10$^{-3}\,\mu F_N$)"
_FROM = {
    "slider": ("from sliding body", BLACK, "o"),
    "in_series": ("with compliance", PURPLE, "^"),
    "rocking": ("and rocking", ORANGE, "s"),
}
_WAYS: tuple[tuple[float, ...], ...] = ((1, 0), (4, 1.5))


def over_ratio(dataset: "xr.Dataset") -> "Figure":
    """Draw ratios over k above, and how far block and sliding body are apart below."""
    figure, (upper, lower) = axes_grid(2, height=6.8)
    shaken = [str(one) for one in dataset["shaken"].values]
    k, at = dataset["k"], dataset["k_block"]
    for index, one in enumerate(shaken):
        what = f", {one} shaken" if len(shaken) > 1 else ""
        part, dashes = dataset.sel(shaken=one), _WAYS[index]
        line(upper, 0, k, part["periodic"], f"sliding body{what}", dashes=dashes)
        marks(
            upper, index, at, part["block"], f"elastic block{what}",
            color=(VERMILION, GREEN)[index], markersize=7 + 3 * index,
        )  # fmt: skip
        for other, (name, colour, marker) in _FROM.items():
            line(
                lower, 0, at, 1e3 * (part["block"] - part[other]), f"{name}{what}", color=colour,
                dashes=dashes, marker=marker, markerfacecolor=("none", colour)[index],
                linewidth=1.0,
            )  # fmt: skip
    closed = "rigid Coulomb friction"
    line(upper, 0, k, dataset["rigid"], closed, color=BLACK, dashes=DOTTED)
    upper.set(ylim=(0.0, 1.05), **OVER_RATIO)
    legend(upper, loc="upper right")
    lower.set(**OVER_RATIO)
    _apart(lower, 0.1)
    legend_above(lower, max(2, len(shaken)))
    return figure


def _apart(axes: "Axes", margin: float) -> None:
    axes.axhline(0.0, color=BLACK, linewidth=0.8)
    axes.set(ylabel=_APART, ymargin=margin)


def over_direction(dataset: "xr.Dataset") -> "Figure":
    """Draw a line for each k with the blocks on it above, and how far they are apart below."""
    figure, (upper, lower) = axes_grid(2, height=7.4)
    apart = 1e3 * (dataset["block"] - dataset["slider"])
    at = dataset["theta_block"]
    for index, k in enumerate(dataset["k"].values):
        line(upper, index, dataset["theta"], dataset["periodic"].sel(k=k), dashes=(), linewidth=1.2)
        for axes, values in ((upper, dataset["block"]), (lower, apart)):
            marks(axes, index, at, values.sel(k=k), f"k = {k:g}")
    upper.set(ylim=(0.0, None), **OVER_DIRECTION)
    legend_above(upper, 5)
    lower.set(**OVER_DIRECTION)
    _apart(lower, 0.35)
    return figure


def pressure(dataset: "xr.Dataset") -> "Figure":
    """Draw the pressure under the cylinder above, and how deep it sinks on its way below."""
    figure, (upper, lower) = axes_grid(2, height=6.2)
    half = float(dataset["x"].max())
    upper.plot(1e3 * dataset["x"], 1e-6 * dataset["hertz"], color=BLACK, label="Hertz")
    for kind, name, colour, marker in (
        ("nodes", "at nodes", VERMILION, "o"), ("surface", "integrated", BLUE, "s"),
    ):  # fmt: skip
        look = {"color": colour, "marker": marker, "markerfacecolor": "none"}
        at = dataset[f"x_{kind}"].values
        near = np.abs(at) < 2.5 * half
        values = dataset[f"pressure_{kind}"].values
        line(upper, 0, 1e3 * at[near], 1e-6 * values[near], name, dashes=(3, 2), **look)
        line(lower, 0, dataset["shift"], 1e6 * dataset["approach"].sel(kind=kind), name, **look)
    upper.set(xlabel="distance from the middle of the cylinder (mm)", ylabel="pressure (MPa)")
    legend(upper, loc="upper right")
    place = "place of the cylinder, in elements from a line of nodes"
    lower.set(xlabel=place, ylabel="approach (µm)", ymargin=0.15)
    legend(lower, loc="best")
    return figure


def normal_laws(dataset: "xr.Dataset") -> "Figure":
    """Draw pressure over overclosure above, and its slope below, scaled by the law's far end."""
    figure, (upper, lower) = axes_grid(2, height=5.6)
    end, stiffness = float(dataset["end"]), float(dataset["slope"].max())
    over = dataset["overclosure"].values / end
    for index, law in enumerate(str(one) for one in dataset["law"].values):
        own = dataset.sel(law=law)
        line(upper, index, over, own["pressure"] / (stiffness * end), law)
        line(lower, index, over, own["slope"] / stiffness, law)
    for axes, label in ((upper, "pressure, scaled"), (lower, "stiffness over the final one")):
        for edge in ("start", "end"):
            axes.axvline(float(dataset[edge]) / end, color=BLACK, linewidth=0.8, dashes=DOTTED)
        axes.set(xlabel="overclosure over that of the final stiffness", ylabel=label, xmargin=0.0)
    legend(upper, loc="upper left")
    return figure

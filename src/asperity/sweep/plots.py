"""Pictures of a sweep over one or two axes."""

from typing import TYPE_CHECKING

import numpy as np

from asperity.errors import InputError
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

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from asperity.sweep.axes import Axis
    from asperity.sweep.result import SweepResult

_COLOURS = (BLUE, VERMILION, GREEN, PURPLE, ORANGE, SKY, BLACK)
_MARKERS = ("o", "s", "^", "D", "v", "P", "X")
MOST_AXES = 2
_MOST_MARKED = 40


def plot_sweep(result: "SweepResult") -> "Figure":
    """Draw the ratio over the longer numeric axis, one line for each value of the other.

    Raises
    ------
    InputError
        The sweep has more than two axes.
    """
    axes = result.axes
    if len(axes) > MOST_AXES:
        raise InputError(
            f"the sweep has {len(axes)} axes; at most {MOST_AXES} can be drawn: take the dataset"
        )
    ratio = result.arrays["ratio"].reshape(result.status.shape)
    along = max(range(len(axes)), key=lambda place: (axes[place].numeric, ratio.shape[place]))
    curves = np.moveaxis(ratio, along, 0).reshape(ratio.shape[along], -1)
    figure, (panel,) = panels()
    across = next((axis for axis in axes if axis is not axes[along]), None)
    if across is None:
        _line(panel, axes[along], curves[:, 0], BLUE, "o", None)
    elif curves.shape[1] <= len(_COLOURS):
        for place, colour in zip(range(curves.shape[1]), _COLOURS, strict=False):
            name = across.text(place).partition("=")[2]
            _line(panel, axes[along], curves[:, place], colour, _MARKERS[place], name)
        legend(
            panel,
            title=_label(across, with_unit=False),
            loc="upper left",
            bbox_to_anchor=(1.0, 1.0),
        )
    else:
        _many_lines(figure, panel, axes[along], curves, across)
    panel.set_xlabel(_label(axes[along]))
    panel.set_ylabel(r"mean drive force over $\mu F_N$")
    panel.set_ylim(bottom=min(0.0, float(np.nanmin(ratio))) if np.isfinite(ratio).any() else 0.0)
    return figure


def _line(
    panel: "Axes", axis: "Axis", values: np.ndarray, colour: object, marker: str, name: str | None
) -> None:
    # In rising order, since the axis may have been given in any.
    order = np.argsort(axis.shown) if axis.numeric else np.arange(len(values))
    marked = marker if len(values) <= _MOST_MARKED else ""
    panel.plot(
        [axis.shown[at] for at in order], values[order], color=colour, marker=marked,
        markersize=4.0, label=name, linestyle="-" if axis.numeric else "",
    )  # fmt: skip


def _many_lines(
    figure: "Figure", panel: "Axes", axis: "Axis", curves: np.ndarray, across: "Axis"
) -> None:
    import matplotlib as mpl
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import Normalize

    shades = mpl.colormaps["viridis"]
    places = np.arange(curves.shape[1])
    numbers = np.array(across.shown) if across.numeric else places
    scale = Normalize(float(numbers.min()), float(numbers.max()))
    for place in places:
        _line(panel, axis, curves[:, place], shades(scale(numbers[place])), "", None)
    bar = figure.colorbar(ScalarMappable(scale, shades), ax=panel, label=_label(across))
    if not across.numeric:
        bar.set_ticks(places.tolist(), labels=[str(value) for value in across.shown])


def _label(axis: "Axis", *, with_unit: bool = True) -> str:
    name = axis.key.replace("_", " ")
    return f"{name} ({axis.unit})" if with_unit and axis.unit else name

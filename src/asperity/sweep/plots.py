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
from asperity.sweep.result import MOST_AXES

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_COLOURS = (BLUE, VERMILION, GREEN, PURPLE, ORANGE, SKY, BLACK)
_MARKERS = ("o", "s", "^", "D", "v", "P", "X")
_MOST_MARKED = 40


def plot_sweep(dataset: "xr.Dataset") -> "Figure":
    """Draw the ratio over the longer numeric axis, one line for each value of the other.

    Raises
    ------
    InputError
        The sweep has more than two axes.
    """
    ratio = dataset["ratio"]
    axes = [dataset[dim] for dim in ratio.dims]
    if len(axes) > MOST_AXES:
        raise InputError(
            f"the sweep has {len(axes)} axes; at most {MOST_AXES} can be drawn: take the dataset"
        )
    along = max(axes, key=lambda axis: (_is_numeric(axis), axis.size))
    curves = ratio.transpose(along.name, ...).values.reshape(along.size, -1)
    figure, (panel,) = panels()
    across = next((axis for axis in axes if axis.name != along.name), None)
    if across is None:
        _line(panel, along, curves[:, 0], BLUE, "o", None)
    elif curves.shape[1] <= len(_COLOURS):
        for place, colour in zip(range(curves.shape[1]), _COLOURS, strict=False):
            value = across.values[place]
            name = f"{value:.12g} {_unit(across)}".rstrip() if _is_numeric(across) else str(value)
            _line(panel, along, curves[:, place], colour, _MARKERS[place], name)
        legend(
            panel,
            title=_label(across, with_unit=False),
            loc="upper left",
            bbox_to_anchor=(1.0, 1.0),
        )
    else:
        _many_lines(figure, panel, along, curves, across)
    panel.set_xlabel(_label(along))
    panel.set_ylabel(r"mean drive force over $\mu F_N$")
    panel.set_ylim(bottom=min(0.0, float(np.nanmin(ratio))) if np.isfinite(ratio).any() else 0.0)
    return figure


def _line(
    panel: "Axes",
    axis: "xr.DataArray",
    values: np.ndarray,
    colour: object,
    marker: str,
    name: str | None,
) -> None:
    # In rising order, since the axis may have been given in any.
    numeric = _is_numeric(axis)
    order = np.argsort(axis.values) if numeric else np.arange(len(values))
    marked = marker if len(values) <= _MOST_MARKED else ""
    panel.plot(
        axis.values[order], values[order], color=colour, marker=marked,
        markersize=4.0, label=name, linestyle="-" if numeric else "",
    )  # fmt: skip


def _many_lines(
    figure: "Figure",
    panel: "Axes",
    axis: "xr.DataArray",
    curves: np.ndarray,
    across: "xr.DataArray",
) -> None:
    import matplotlib as mpl
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import Normalize

    shades = mpl.colormaps["viridis"]
    places = np.arange(curves.shape[1])
    numbers = across.values if _is_numeric(across) else places
    scale = Normalize(float(numbers.min()), float(numbers.max()))
    for place in places:
        _line(panel, axis, curves[:, place], shades(scale(numbers[place])), "", None)
    bar = figure.colorbar(ScalarMappable(scale, shades), ax=panel, label=_label(across))
    if not _is_numeric(across):
        bar.set_ticks(places.tolist(), labels=[str(value) for value in across.values])


def _is_numeric(axis: "xr.DataArray") -> bool:
    return axis.dtype.kind in "if"


def _unit(axis: "xr.DataArray") -> str:
    # Micro is an axis's letter, not a word's.
    unit = axis.attrs["units"]
    return "" if unit == "1" else unit.replace("um", "µm")


def _label(axis: "xr.DataArray", *, with_unit: bool = True) -> str:
    name, unit = axis.attrs["long_name"], _unit(axis)
    return f"{name} ({unit})" if with_unit and unit else name

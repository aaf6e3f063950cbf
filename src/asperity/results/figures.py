"""The look of every picture, and a picture of any answer."""

import math
from typing import TYPE_CHECKING, Any

from asperity.results.language import ENGLISH, language, said

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

# Okabe and Ito's colours, which colour-blind readers tell apart; dashes and markers tell as well.
BLUE, VERMILION, GREEN, PURPLE, ORANGE, SKY, BLACK = (
    "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000",
)  # fmt: skip
COLOURS = (BLUE, VERMILION, GREEN, PURPLE, ORANGE, SKY, BLACK)
DASHES: tuple[Any, ...] = ((), (5, 2), (2, 2), (7, 2, 2, 2), (1, 1))
STYLE: dict[Any, Any] = {
    "axes.prop_cycle": f"cycler('color', {list(COLOURS)})",
    "font.size": 11.0,
    "axes.labelsize": 11.0,
    "axes.titlesize": 11.0,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "legend.fontsize": 10.0,
    "legend.frameon": False,
    "lines.linewidth": 1.5,
    "axes.grid": True,
    "grid.color": "#DDDDDD",
    "grid.linewidth": 0.6,
    "axes.axisbelow": True,
}
DOTS_PER_INCH = 150
_MOST_COLUMNS = 5


def axes_grid(
    rows: int = 1, columns: int = 1, *, width: float = 7.0, height: float = 4.2
) -> "tuple[Figure, list[Axes]]":
    """Return a figure of the house's style and its axes, without touching matplotlib's state."""
    import matplotlib as mpl
    from matplotlib.figure import Figure

    with mpl.rc_context(STYLE):
        figure = Figure(figsize=(width, height), layout="constrained")
        axes = figure.subplots(rows, columns, squeeze=False)
    return figure, list(axes.flat)


def legend(axes: "Axes", **options: Any) -> None:
    """Put a legend where it hides least."""
    import matplotlib as mpl

    with mpl.rc_context(STYLE):
        axes.legend(**options)


def spoken_figure(figure: "Figure") -> "Figure":
    """Return a figure with its words in the language that people are shown."""
    if language() != ENGLISH:
        from matplotlib.text import Text

        for text in figure.findobj(Text):
            if text.get_text():
                text.set_text(said(text.get_text()))
    return figure


def draw(dataset: "xr.Dataset") -> "Figure":
    """Draw any answer: its curves, a panel a unit; without curves its numbers, as bars."""
    curves = {
        name: array
        for name, array in dataset.data_vars.items()
        if array.ndim >= 1
        and array.dtype.kind in "if"
        and array.dims[0] in dataset.coords
        and dataset[array.dims[0]].dtype.kind in "if"
        and math.prod(array.shape[1:]) <= _MOST_COLUMNS
    }
    if curves:
        return _curves(dataset, curves)
    numbers = {
        str(name): array
        for name, array in dataset.data_vars.items()
        if not array.ndim and array.dtype.kind in "if"
    }
    return _bars(numbers)


def _curves(dataset: "xr.Dataset", curves: Any) -> "Figure":
    groups: dict[tuple[str, str], list[Any]] = {}
    for array in curves.values():
        groups.setdefault((str(array.dims[0]), array.attrs["units"]), []).append(array)
    figure, axes = axes_grid(len(groups), height=1.0 + 2.6 * len(groups))
    for panel, ((dim, unit), arrays) in zip(axes, groups.items(), strict=True):
        along = dataset[dim]
        count = 0
        for array in arrays:
            for column in array.values.reshape(len(along), -1).T:
                panel.plot(
                    along.values, column, color=COLOURS[count % len(COLOURS)],
                    dashes=DASHES[count % len(DASHES)], label=array.attrs["long_name"],
                )  # fmt: skip
                count += 1
        panel.set_xlabel(_with_unit(along.attrs["long_name"], along.attrs["units"]))
        single = arrays[0].attrs["long_name"] if len(arrays) == 1 else ""
        panel.set_ylabel(_with_unit(single, unit))
        panel.margins(x=0.0)
        if len(arrays) > 1:
            legend(panel)
    return figure


def _bars(numbers: Any) -> "Figure":
    groups: dict[str, list[Any]] = {}
    for array in numbers.values():
        groups.setdefault(array.attrs["units"], []).append(array)
    count = max(len(groups), 1)
    height = 1.0 + 0.6 * count + 0.3 * len(numbers)
    figure, axes = axes_grid(count, height=height)
    for panel, (unit, arrays) in zip(axes, groups.items(), strict=False):
        names = [array.attrs["long_name"] for array in arrays]
        panel.barh(names, [float(array) for array in arrays], color=BLUE, height=0.6)
        panel.invert_yaxis()
        panel.set_xlabel(_with_unit("", unit))
        panel.ticklabel_format(axis="x", style="sci", scilimits=(-3, 4))
    return figure


def _with_unit(name: str, unit: str) -> str:
    if unit in ("", "1"):
        return name or "ratio"
    return f"{name} ({unit})" if name else unit

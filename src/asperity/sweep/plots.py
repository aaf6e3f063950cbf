"""Pictures of a sweep over one or two axes: of bodies, and of worm gearsets with their safeties."""

from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from asperity.arrays import FloatArray
from asperity.errors import InputError
from asperity.rating.demands import DEMANDS
from asperity.rating.standing import NAMES
from asperity.results.figures import BLACK, BLUE, COLOURS, DASHES, VERMILION, axes_grid, legend
from asperity.results.panels import MARKERS
from asperity.sweep.axis import POINT, by_factors
from asperity.sweep.maps import axis_label, balances, plane, plot_map, resonances, ticks
from asperity.sweep.result import MOST_AXES

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_MOST_MARKED = 40
_DASH = "_"  # which cannot be hollow
_FEW = 8  # values that are all told on an axis
_ROOM = 0.04  # above the greatest value, over what is drawn
_LABELS = {
    "ratio": r"mean drive force over $\mu F_N$",
    "torque_ratio": "mean torque over that without vibration",
    "margin": "least safety over what is asked",
}


def plot_sweep(dataset: "xr.Dataset") -> "Figure":
    """Draw the ratio over the longer numeric axis, one line for each value of the other.

    Of drives over two numeric axes it is a map, see `asperity.sweep.maps`; of gearsets safeties and
    efficiency.

    Raises
    ------
    InputError
        The sweep has more than two axes.
    """
    shown = next(name for name in _LABELS if name in dataset)
    ratio = dataset[shown]
    axes = [dataset[dim] for dim in ratio.dims]
    if len(axes) > MOST_AXES:
        raise InputError(
            f"the sweep has {len(axes)} axes; at most {MOST_AXES} can be drawn: take the dataset"
        )
    drives = "torque_balance" in dataset
    if drives and len(axes) == MOST_AXES and all(map(_is_numeric, axes)):
        return plot_map(dataset)
    if shown == "margin" and len(axes) == 1:
        return plot_along(dataset)
    if shown == "margin" and all(map(_is_numeric, axes)):
        return plot_plane(dataset)
    along = max(axes, key=lambda axis: (_is_numeric(axis), axis.size))
    curves, loose = _curves(along, ratio), _loose(along, dataset, ratio)
    figure, (panel,) = axes_grid()
    across = next((axis for axis in axes if axis.name != along.name), None)
    if across is None or curves.shape[1] <= len(COLOURS):
        names = [""] if across is None else [_text(across, value) for value in across.values]
        for values, out, name, colour, marker in zip(
            curves.T, loose.T, names, COLOURS, MARKERS, strict=False
        ):
            _line(panel, along, values, out, color=colour, marker=marker, label=name or None)
        if across is not None:
            _beside(panel, _label(across, with_unit=False))
    else:
        _many_lines(panel, along, curves, loose, across)
    if loose.any():
        _mark_unsettled(panel, along, curves, loose, dataset)
    _scale(panel, along)
    if drives:
        panel.set_title(balances(dataset).replace("; ", ";\n"), loc="left", fontsize=10.0)
        if across is None and _is_numeric(along):
            _closed_form(panel, along, dataset)
    panel.set(xlabel=_label(along), ylabel=_LABELS[shown])
    least = float(np.nanmin(ratio)) if np.isfinite(ratio).any() else 0.0
    if least < 0.0:
        # Below it the vibration drives the body.
        panel.axhline(0.0, color=BLACK, linewidth=1.0)
    else:
        panel.set_ylim(bottom=0.0)
    if "settled" in dataset:
        # Marks at the greatest value are not cut by the edge.
        low, high = panel.get_ylim()
        panel.set_ylim(low, high + _ROOM * (high - low))
    return figure


def plot_branches(dataset: "xr.Dataset") -> "Figure":
    """Draw what was found there and back: ratio and, of a pressed body, its swing and flight."""
    drawn = {
        "ratio": (r"mean drive force over $\mu W$", 1.0),
        "penetration_swing": ("swing of the penetration (µm)", 1e6),
        "open_share": ("share of the time in flight", 1.0),
    }
    drawn = {name: how for name, how in drawn.items() if np.isfinite(dataset[name]).any()}
    figure, every = axes_grid(len(drawn), height=2.6 * len(drawn) + 0.6)
    name = dataset.attrs["axis"].partition(".")[2].replace("_", " ")
    unit = dataset.attrs["axis_unit"].replace("um", "µm")
    for panel, (variable, (label, scale)) in zip(every, drawn.items(), strict=True):
        for way, colour, marker in (("there", VERMILION, "o"), ("back", BLUE, "s")):
            found = dataset[variable].sel(way=way)
            order = np.argsort(found["value"].values)
            look: dict[str, Any] = {
                "color": colour, "marker": marker, "markersize": 4.0 if way == "there" else 6.5,
                "fillstyle": "none", "linewidth": 1.0,
            }  # fmt: skip
            out = np.zeros(order.size, dtype=bool)
            if "settled" in dataset:
                out = dataset["settled"].sel(way=way).values == 0.0
            firm = np.where(out, np.nan, scale * found.values)
            panel.plot(found["value"].values[order], firm[order], label=way, **look)
            if out.any():
                look["linestyle"] = ""
                panel.plot(found["value"].values[out], scale * found.values[out], **look)
                told = any(line.get_label() == "not settled" for line in panel.lines)
                panel.plot(
                    found["value"].values[out], scale * found.values[out], linestyle="",
                    marker="x", color=BLACK, zorder=5,
                    label=None if told else "not settled",
                )  # fmt: skip
        rest = dataset.get("ratio_from_rest")
        if variable == "ratio" and rest is not None and np.isfinite(rest).any():
            panel.plot(
                rest["value"].values, rest.values, linestyle="", marker="^", color=BLACK,
                fillstyle="none", label="from rest",
            )  # fmt: skip
        panel.set_ylabel(label)
        panel.margins(x=0.01)
        if variable == "open_share" and not dataset[variable].fillna(0.0).any():
            panel.set_ylim(0.0, 1.0)  # no share is below nothing
        _scale(panel, dataset["value"])
    legend(every[0], loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=3)
    every[-1].set_xlabel(f"{name} ({unit})" if unit else name)
    return figure


def _scale(panel: "Axes", along: "xr.DataArray") -> None:
    """Have factors as far apart as each other, where values go by factors."""
    if not (_is_numeric(along) and along.name != POINT and by_factors(along.values)):
        return
    panel.set_xscale("log")
    if along.size <= _FEW:
        # The values that were asked for: between whole decades others stand in each other's way.
        panel.set_xticks(along.values, labels=[f"{value:.4g}" for value in along.values])
        panel.set_xticks([], minor=True)


def _beside(panel: "Axes", title: str) -> None:
    """Say beside a panel what its lines are."""
    legend(panel, title=title, loc="upper left", bbox_to_anchor=(1.0, 1.0))


def _curves(along: "xr.DataArray", values: "xr.DataArray") -> FloatArray:
    """Return what is drawn over an axis, a column for each value of the other."""
    found: FloatArray = values.transpose(along.name, ...).values.reshape(along.size, -1)
    return found


def _loose(
    along: "xr.DataArray", dataset: "xr.Dataset", ratio: "xr.DataArray"
) -> npt.NDArray[np.bool_]:
    """Return which of the drawn values have not settled."""
    curves = _curves(along, ratio)
    if "settled" not in dataset:
        return np.zeros(curves.shape, dtype=bool)
    loose: npt.NDArray[np.bool_] = ~(_curves(along, dataset["settled"]) > 0.0)
    return loose & np.isfinite(curves)


def _mark_unsettled(
    panel: "Axes",
    along: "xr.DataArray",
    curves: FloatArray,
    loose: npt.NDArray[np.bool_],
    dataset: "xr.Dataset",
) -> None:
    """Cross out what has not settled, and say so; beside it where a march from rest settles."""
    places = along.values if _is_numeric(along) else np.arange(along.size)
    crosses = [
        panel.plot(places[out], column[out], linestyle="", marker="x", color=BLACK, zorder=5)[0]
        for column, out in zip(curves.T, loose.T, strict=True)
    ]
    crosses[0].set_label("not settled")
    if "ratio_from_rest" in dataset:
        marks = [
            panel.plot(
                places, column, linestyle="", marker="^", color=BLACK, fillstyle="none", zorder=5
            )[0]
            for column in _curves(along, dataset["ratio_from_rest"]).T
        ]
        marks[0].set_label("from rest")
    # Beside it: in it a cross would be one more that has not settled.
    lines = panel.get_legend()
    _beside(panel, "" if lines is None else lines.get_title().get_text())


def _closed_form(panel: "Axes", along: "xr.DataArray", dataset: "xr.Dataset") -> None:
    """Draw what a drive comes to far above its resonances, and where these are."""
    for label, at in resonances(dataset, str(along.name)):
        panel.axvline(at, color=BLACK, dashes=(4, 2), linewidth=1.2)
        panel.annotate(label, (at, 1.0), xycoords=("data", "axes fraction"), ha="center")
    if "torque_ratio_closed_form" in dataset:
        form = dataset["torque_ratio_closed_form"].values
        _line(panel, along, form, color=BLACK, dashes=(5, 2), label="closed form, no resonance")
        legend(panel)


def _line(
    panel: "Axes",
    axis: "xr.DataArray",
    values: np.ndarray,
    loose: npt.NDArray[np.bool_] | None = None,
    **style: Any,
) -> None:
    """Draw values over an axis; hollow, with no line through it, what is loose."""
    # In rising order, since the axis may have been given in any.
    numeric = _is_numeric(axis)
    order = np.argsort(axis.values) if numeric else np.arange(len(values))
    out = np.zeros(len(values), dtype=bool) if loose is None else loose[order]
    places, firm = axis.values[order], np.where(out, np.nan, values[order])
    style = {"marker": ""} | style
    if len(values) > _MOST_MARKED:
        style["marker"] = ""
    # Neighbouring rows of a table of points need not belong together.
    if numeric and axis.name != POINT:
        line = "-"
        if not style["marker"] and (alone := _alone(firm)):
            style |= {"marker": "o", "markevery": alone}
    else:
        line = ""
        style = {name: how for name, how in style.items() if name != "dashes"}
        style["marker"] = style["marker"] or _DASH
    panel.plot(places, firm, markersize=4.0, linestyle=line, **style)
    if out.any():
        panel.plot(
            places[out], values[order][out], linestyle="", fillstyle="none",
            marker="o" if style["marker"] in ("", _DASH) else style["marker"],
            markersize=6.0, color=style["color"],
        )  # fmt: skip


def _alone(values: FloatArray) -> list[int]:
    """Return the places of values that no line reaches: with none on either side."""
    there = np.concatenate([[False], np.isfinite(values), [False]])
    alone: list[int] = np.flatnonzero(there[1:-1] & ~there[:-2] & ~there[2:]).tolist()
    return alone


def _many_lines(
    panel: "Axes",
    axis: "xr.DataArray",
    curves: np.ndarray,
    loose: npt.NDArray[np.bool_],
    across: "xr.DataArray",
) -> None:
    import matplotlib as mpl
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import LogNorm, Normalize

    shades = mpl.colormaps["viridis"]
    places = np.arange(curves.shape[1])
    numbers = across.values if _is_numeric(across) else places
    even = LogNorm if _is_numeric(across) and by_factors(across.values) else Normalize
    scale = even(float(numbers.min()), float(numbers.max()))
    for place in places:
        shade = shades(scale(numbers[place]))
        _line(panel, axis, curves[:, place], loose[:, place], color=shade)
    bar = panel.figure.colorbar(ScalarMappable(scale, shades), ax=panel, label=_label(across))
    if not _is_numeric(across):
        bar.set_ticks(places.tolist(), labels=[str(value) for value in across.values])


def _text(axis: "xr.DataArray", value: object) -> str:
    return f"{value:.12g} {_unit(axis)}".rstrip() if _is_numeric(axis) else str(value)


def _is_numeric(axis: "xr.DataArray") -> bool:
    return axis.dtype.kind in "if"


def _unit(axis: "xr.DataArray") -> str:
    # Micro is an axis's letter, not a word's.
    unit = axis.attrs["units"]
    return "" if unit == "1" else unit.replace("um", "µm")


def _label(axis: "xr.DataArray", *, with_unit: bool = True) -> str:
    name, unit = axis.attrs["long_name"], _unit(axis)
    return f"{name} ({unit})" if with_unit and unit else name


_MARKED_OF_GEARS = 16  # points of a line
_EFFICIENCIES = {
    "iso14521_eta_ges": "ISO/TR 14521, gearbox",
    "iso14521_eta_z1_2": "ISO/TR 14521, teeth",
    "bs721_eta": "BS 721, teeth",
    "agma6034_eta": "AGMA 6034, teeth",
}


def plot_along(dataset: "xr.Dataset") -> "Figure":
    """Draw every safety over what is asked, and the efficiencies, over one axis."""
    (name,) = dataset["margin"].dims
    axis = dataset[name]
    numeric = axis.dtype.kind in "if"
    order = np.argsort(axis.values) if numeric else np.arange(axis.size)
    places = axis.values[order] if numeric else order
    figure, (upper, lower) = axes_grid(2, width=9.0, height=7.6)
    standards = list(NAMES)
    # Neighbouring rows of a table of points need not belong together.
    apart = name == POINT
    every = 1 if apart else -(-axis.size // _MARKED_OF_GEARS)
    line = "" if apart else "-"
    for number, demand in enumerate(DEMANDS):
        variable = f"{demand.standard}_{demand.key}"
        if variable in dataset:
            upper.plot(
                places, dataset[variable].values[order] / demand.asked,
                color=COLOURS[number % len(COLOURS)], marker=MARKERS[number % len(MARKERS)],
                linestyle=line if apart else (0, DASHES[standards.index(demand.standard)]),
                markersize=4.0, markevery=every, label=f"{NAMES[demand.standard]} {demand.name}",
            )  # fmt: skip
    upper.axhline(1.0, color=BLACK, linewidth=1.2)
    upper.set_ylabel("safety over what is asked")
    for (variable, label), colour, marker in zip(
        _EFFICIENCIES.items(), COLOURS, MARKERS, strict=False
    ):
        if variable in dataset:
            lower.plot(
                places, 100.0 * dataset[variable].values[order], color=colour, marker=marker,
                markersize=4.0, markevery=every, linestyle=line, label=label,
            )  # fmt: skip
    lower.set_ylabel("efficiency (%)")
    lower.set_xlabel(axis_label(axis))
    for panel in (upper, lower):
        _scale(panel, axis)
        if panel.lines[1:]:
            legend(panel, loc="upper left", bbox_to_anchor=(1.0, 1.0))
        if not numeric:
            panel.set_xticks(places, labels=[str(value) for value in axis.values])
    upper.set_ylim(bottom=0.0)
    return figure


def plot_plane(dataset: "xr.Dataset") -> "Figure":
    """Draw the least safety over what is asked, and the efficiency, over two numeric axes."""
    down, across = (str(dim) for dim in dataset["margin"].dims)
    order = dataset.sortby([down, across])
    shown = {
        "margin": "least safety over what is asked",
        "iso14521_eta_ges": "efficiency of the gearbox, ISO/TR 14521 (%)",
    }
    shown = {name: title for name, title in shown.items() if name in order}
    figure, axes = axes_grid(1, len(shown), width=1.0 + 5.0 * len(shown), height=4.8)
    for panel, (name, title) in zip(axes, shown.items(), strict=True):
        values = order[name].values
        if name == "margin":
            plane(panel, values, values, colours="RdBu")
        else:
            plane(panel, 100.0 * values, None, colours="viridis")
        ticks(panel, order, down, across)
        panel.set_title(title, fontsize=11.0)
    return figure

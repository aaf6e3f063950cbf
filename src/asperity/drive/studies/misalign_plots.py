"""Pictures of a gearset that is off: numbers over each axis, and patterns at its ends."""

from typing import TYPE_CHECKING

import numpy as np

from asperity.arrays import FloatArray
from asperity.drive.plots import flank_triangles, pressure_label
from asperity.results.figures import BLACK, BLUE, GREEN, VERMILION, axes_grid, legend

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_LEVELS = 24
_MOST = 9
# Beyond the largest, which rounding else leaves out.
_ABOVE = 1.0 + 1e-6
_SAME = 1e-9


def over_axes(dataset: "xr.Dataset") -> "Figure":
    """Draw pressure, edge force, error and K_Hbeta over each axis; lines: it alone is off."""
    values = dataset["value"].values
    edges = [dataset[f"force_{edge}"].values for edge in ("worm_tip", "wheel_tip", "face_end")]
    shown = (
        (
            "pressure (MPa)",
            (
                ("flank", 1e-6 * dataset["pressure_flank"].values, BLUE, "o"),
                ("edge", 1e-6 * dataset["pressure_edge"].values, VERMILION, "^"),
            ),
        ),
        ("force on an edge (N)", (("", np.max(edges, axis=0), VERMILION, "^"),)),
        (
            "transmission error (µrad)",
            (("", 1e6 * dataset["transmission_error"].values, BLUE, "o"),),
        ),
        ("$K_{H\\beta}$", (("", dataset["k_h_beta"].values, GREEN, "s"),)),
    )
    count = values.shape[1]
    figure, axes = axes_grid(
        len(shown), count, width=max(6.0, 0.8 + 3.3 * count), height=0.8 + 2.1 * len(shown)
    )
    for place, panel in enumerate(axes):
        row, column = divmod(place, count)
        what, curves = shown[row]
        at = values[:, column]
        alone = _alone(values, column)
        lined = len(alone) > 1
        for label, numbers, colour, marker in curves:
            panel.plot(
                at,
                numbers,
                marker,
                color=colour,
                markersize=4,
                alpha=0.35,
                markeredgewidth=0.0,
                label=None if lined else label or None,
            )
            if lined:
                order = alone[np.argsort(at[alone])]
                panel.plot(
                    at[order], numbers[order], marker=marker, color=colour, label=label or None
                )
            panel.plot(at[:1], numbers[:1], marker, color=BLACK, markerfacecolor="none")
        every = np.concatenate([numbers for _, numbers, *_ in curves])
        _room(panel, every)
        if column == 0:
            panel.set_ylabel(what)
        if row == len(shown) - 1:
            panel.set_xlabel(_named(dataset, column))
        if row == 0 and (flow := float(dataset.get("flow_pressure", np.inf))) < panel.get_ylim()[1]:
            panel.axhline(flow, color=BLACK, linewidth=1.0, linestyle=":", label="flows")
        if place == 0:
            legend(panel)
    return figure


def patterns(dataset: "xr.Dataset") -> "Figure":
    """Draw where the flank bears as the case is, at the ends of each axis, and at the worst."""
    chosen = _chosen(dataset)
    columns = min(3, len(chosen))
    rows = -(-len(chosen) // columns)
    figure, axes = axes_grid(rows, columns, width=1.0 + 3.6 * columns, height=0.9 + 1.5 * rows)
    triangles = flank_triangles(dataset)
    mega = 1e-6 * dataset["pattern"].values
    most = float(np.nanmax(mega[chosen]))
    levels = np.linspace(0.0, _ABOVE * most, _LEVELS)
    for number, panel in enumerate(axes):
        if number >= len(chosen):
            panel.set_visible(False)
            continue
        point = chosen[number]
        panel.tricontourf(triangles, mega[point], levels=levels, cmap="cividis")
        panel.set_aspect("equal")
        panel.grid(visible=False)
        panel.set_title(_title(dataset, point), fontsize=9.0)
        if number % columns == 0:
            panel.set_ylabel("radius (mm)")
        if number + columns >= len(chosen):
            panel.set_xlabel("along the wheel's axis (mm)")
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import Normalize

    bar = figure.colorbar(ScalarMappable(Normalize(0.0, most), "cividis"), ax=axes)
    bar.set_label(pressure_label(dataset))
    return figure


def _alone(values: FloatArray, column: int) -> "np.ndarray":
    """Return the points at which this axis alone is off from the case."""
    others = np.delete(np.arange(values.shape[1]), column)
    size = np.maximum(np.nanmax(values, axis=0) - np.nanmin(values, axis=0), 1e-300)
    off = np.abs(values - values[0])[:, others] / size[others]
    return np.flatnonzero((off <= _SAME).all(axis=1))


def _chosen(dataset: "xr.Dataset") -> list[int]:
    values = dataset["value"].values
    solved = np.isfinite(dataset["pressure_flank"].values)
    found = [0]
    for column in range(values.shape[1]):
        alone = [n for n in _alone(values, column) if solved[n]]
        if len(alone) > 1:
            found += [min(alone, key=lambda n: values[n, column]),
                      max(alone, key=lambda n: values[n, column])]  # fmt: skip
    edge = np.max(
        [dataset[f"force_{edge}"].values for edge in ("worm_tip", "wheel_tip", "face_end")], axis=0
    )
    found += [int(n) for n in np.flatnonzero(solved) if np.isnan(values[n]).all()]
    found.append(int(np.nanargmax(np.where(solved, edge, -1.0))))
    return list(dict.fromkeys(found))[:_MOST]


def _title(dataset: "xr.Dataset", point: int) -> str:
    if point == 0:
        return "as the case is"
    values, own = dataset["value"].values[point], dataset["value"].values[0]
    if np.isnan(values).all():
        return "warm"
    units = [str(unit) for unit in np.atleast_1d(dataset["axis_unit"].values)]
    names = [str(name).partition(".")[2] for name in np.atleast_1d(dataset["axis"].values)]
    parts = [
        f"{name.removesuffix('_error').replace('_', ' ')} {value:.4g}{_with(unit)}"
        for name, value, middle, unit in zip(names, values, own, units, strict=True)
        if not abs(value - middle) <= _SAME * max(abs(value), abs(middle))
    ]
    return "\n".join(parts) or "as the case is"


def _named(dataset: "xr.Dataset", column: int) -> str:
    name = str(np.atleast_1d(dataset["axis"].values)[column]).partition(".")[2]
    unit = str(np.atleast_1d(dataset["axis_unit"].values)[column])
    return name.replace("_", " ") + ("" if unit == "1" else f" ({_with(unit).strip()})")


def _with(unit: str) -> str:
    return "" if unit == "1" else f" {unit.replace('um', 'µm')}"


def _room(panel: "Axes", numbers: FloatArray) -> None:
    """Leave room about numbers that hardly change, so that rounding is no hill."""
    low, high = float(np.nanmin(numbers)), float(np.nanmax(numbers))
    reach = max(high - low, 0.05 * abs(high), 1e-12)
    middle = 0.5 * (low + high)
    panel.set_ylim(max(0.0, middle - 0.65 * reach) if low >= 0.0 else None, middle + 0.65 * reach)

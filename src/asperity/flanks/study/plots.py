"""Pictures of flanks and of what happens on them, drawn from the dataset of a study alone.

Maps lie over the flank as it is seen along the tooth: across, the distance from mid-face along the
wheel's axis; upwards, the distance from the wheel's axis. There is a panel for each flank.
"""

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np

from asperity.arrays import FloatArray
from asperity.flanks.wheel.flank import RESOLVED
from asperity.results.figures import BLACK, BLUE, STYLE, VERMILION, axes_grid
from asperity.results.panels import Panel, drawn, line

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_GROUND = "#F2F2F2"
_LINES = 12
_LEVELS = 7
# More than any part of a velocity.
_BEYOND = 9.0
_SIDES = {1: BLUE, -1: VERMILION}
_MICROMETRES = 1e3
_SHAKEN = {"axial": "worm, axial", "torsional": "worm, torsional", "wheel_axial": "wheel, axial"}


def pattern(dataset: "xr.Dataset") -> "Figure":
    """Draw where the marking compound is squeezed out."""
    figure, axes = _flanks(dataset)
    film = _MICROMETRES * float(dataset["marking_thickness"].max())
    filled: Any = None
    for panel, flank in zip(axes, _each(dataset), strict=True):
        face, radius = flank["face"].values, flank["radius"].values
        gap = np.maximum(_MICROMETRES * flank["gap"].values, 0.0)
        if gap.min() < film:
            levels = np.linspace(0.0, film, 7)
            filled = panel.contourf(face, radius, gap, levels=levels, cmap="viridis")
            panel.contour(face, radius, gap, levels=[film], colors=BLACK, linewidths=1.0)
            centre = float(flank["pattern_face"]), float(flank["pattern_radius"])
            for size, width, colour in ((13.0, 2.2, "white"), (11.0, 1.2, BLACK)):
                panel.plot(
                    *centre, linestyle="none", marker="+", markersize=size, color=colour,
                    markeredgewidth=width,
                )  # fmt: skip
    if filled is not None:
        _bar(figure, filled, axes, f"gap (µm), bare above {film:g}; + centre")
    return figure


def ease_off(dataset: "xr.Dataset") -> "Figure":
    """Draw how much less material the wheel has than one cut by an identical hob."""
    figure, axes = _flanks(dataset)
    removed = _MICROMETRES * dataset["ease_off"].where(dataset["compared"].astype(bool))
    low, high = float(removed.min()), float(removed.max())
    rounding = _MICROMETRES * RESOLVED
    if max(-low, high) <= rounding:
        for panel in axes:
            _zero(panel, f"zero within {rounding:.0g} µm:\nan identical hob cut the wheel")
        return figure
    if high - low <= rounding:
        low, high = low - 1.0, high + 1.0
    levels = _levels(low, high)
    filled: Any = None
    for panel, flank, side in zip(axes, _each(dataset), dataset["side"], strict=True):
        face, radius, values = flank["face"], flank["radius"], removed.sel(side=side)
        filled = panel.contourf(face, radius, values, levels=levels, cmap="cividis")
        lines = panel.contour(face, radius, values, levels=levels, colors="white", linewidths=0.7)
        panel.clabel(lines, levels[::2], fmt="%g", fontsize=8.5)
    _bar(figure, filled, axes, "ease-off (µm), positive where material was removed")
    return figure


def contact_lines(dataset: "xr.Dataset") -> "Figure":
    """Draw contact lines: as far apart as a pitch are two that touch at once on two teeth."""
    figure, axes = _flanks(dataset)
    pitch = float(dataset["pitch"])
    every = pitch / 4.0
    for panel, flank in zip(axes, _each(dataset), strict=True):
        # Beyond, the worm is nearest with its tip, and never touches.
        phase = flank["phase"].where(flank["reach"] >= -RESOLVED)
        if not phase.notnull().any():
            continue
        first = int(np.ceil(float(phase.min()) / every))
        last = int(np.floor(float(phase.max()) / every))
        for number in range(first, last + 1):
            whole = number % 4 == 0
            lines = panel.contour(
                flank["face"], flank["radius"], phase, levels=[number * every],
                colors=_SIDES[int(flank["side"])], linewidths=2.0 if whole else 0.8,
                linestyles="solid" if whole else "dashed",
            )  # fmt: skip
            if whole:
                panel.clabel(lines, fmt=f"{np.degrees(number * every):.0f}°", fontsize=9.0)
    figure.suptitle(
        f"angle of the worm; a pitch is {np.degrees(pitch):.4g}°, thin lines each quarter of one",
        fontsize=10.0,
    )
    return figure


def transmission_error(dataset: "xr.Dataset") -> "Figure":
    """Draw the transmission error over a pitch, which ends where the next begins."""
    angle = np.degrees(np.linspace(0.0, float(dataset["pitch"]), dataset.sizes["place"] + 1))
    peak, marks = 0.0, []
    for flank in _each(dataset):
        error, side = flank["transmission_error"].values, int(flank["side"])
        error = np.append(error, error[0])
        about = error - np.mean(error)
        peak = max(peak, float(np.ptp(about)))
        marks.append(
            line(side < 0, angle, 1e6 * about, f"flank s = {side:+d}",
                 dashes=(1, 0) if side > 0 else (4, 2))
        )  # fmt: skip
    least = RESOLVED / float(dataset["radius"].max())

    def even(axes: "Axes") -> None:
        if peak <= least:
            axes.set_ylim(-1.0, 1.0)
            _zero(axes, f"zero within {1e6 * least:.0g} µrad: the wheel turns evenly")

    panel = Panel(
        "angle of the worm (°)", "error of the wheel (µrad)", marks,
        "Transmission error about its mean over a pitch",
        {"loc": "upper right", "ncols": 2, "bbox_to_anchor": (1.0, 1.0)}, more=even,
        limits={"ymargin": 0.25, "xlim": (angle[0], angle[-1])},
    )  # fmt: skip
    return drawn([panel], height=3.6)


def vibration(dataset: "xr.Dataset") -> "Figure":
    """Draw the parts of each vibration direction over the flank s = +1."""
    flank = dataset.sel(side=1)
    face, radius = flank["face"].values, flank["radius"].values
    parts = list(flank["part"].values)
    count = len(_SHAKEN)
    figure, axes = axes_grid(count, len(parts), width=8.6, height=1.75 * count + 0.6)
    filled: Any = None
    # An even number of levels, so that nothing has a colour of its own.
    levels = np.linspace(-1.05, 1.05, 22)
    for row, (direction, name) in enumerate(_SHAKEN.items()):
        for column, part in enumerate(parts):
            panel = axes[row * len(parts) + column]
            panel.grid(visible=False)
            share = flank["vibration"].sel(direction=direction, part=part).values
            filled = panel.contourf(
                face, radius, share, levels=levels, cmap="RdBu_r", extend="both"
            )
            # In black and white red is as dark as blue.
            panel.contourf(
                face, radius, share, levels=[-_BEYOND, levels[10]], colors="none", hatches=["////"]
            )
            panel.plot(*outline(face, radius), color=BLACK, linewidth=1.0)
            if row == 0:
                panel.set_title(part)
            if row == count - 1:
                panel.set_xlabel("face (mm)")
            else:
                panel.tick_params(labelbottom=False)
            if column == 0:
                panel.set_ylabel(f"{name}\nradius (mm)")
            else:
                panel.tick_params(labelleft=False)
    said = "part of the vibration's velocity, hatched below zero"
    _bar(figure, filled, axes, said, location="right")
    figure.axes[-1].set_yticks(np.linspace(-1.0, 1.0, 5))
    return figure


def outline(face: FloatArray, radius: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the edge of a grid over a flank, closed."""

    def round_it(values: FloatArray) -> FloatArray:
        return np.concatenate([values[0], values[1:, -1], values[-1, -2::-1], values[-2::-1, 0]])

    return round_it(face), round_it(radius)


def _each(dataset: "xr.Dataset") -> "Iterator[xr.Dataset]":
    for side in dataset["side"]:
        yield dataset.sel(side=side)


def _flanks(dataset: "xr.Dataset") -> "tuple[Figure, list[Axes]]":
    count = dataset.sizes["side"]
    figure, axes = axes_grid(1, count, width=4.6 * count, height=3.9)
    for place, (panel, flank) in enumerate(zip(axes, _each(dataset), strict=True)):
        edge = outline(flank["face"].values, flank["radius"].values)
        panel.fill(*edge, color=_GROUND, zorder=0)
        panel.plot(*edge, color=BLACK, linewidth=1.2, zorder=2.5)
        panel.grid(visible=False)
        panel.set_title(f"flank s = {int(flank['side']):+d}", loc="left")
        panel.set_xlabel("distance from mid-face (mm)")
        if place == 0:
            panel.set_ylabel("distance from the wheel's axis (mm)")
        panel.margins(0.04)
    return figure, axes


def _zero(panel: "Axes", why: str) -> None:
    panel.text(0.5, 0.6, why, transform=panel.transAxes, ha="center", va="center", color=BLACK)


def _levels(low: float, high: float) -> FloatArray:
    from matplotlib.ticker import MaxNLocator

    return np.asarray(MaxNLocator(_LINES, steps=[1, 2, 5, 10]).tick_values(low, high))


def _bar(
    figure: "Figure", drawn: Any, axes: "list[Axes]", label: str, location: str = "bottom"
) -> None:
    import matplotlib as mpl

    with mpl.rc_context(STYLE):
        bar = figure.colorbar(
            drawn, ax=axes, location=location, shrink=0.6, aspect=35.0, label=label
        )
        bar.ax.grid(visible=False)


def corners(dataset: "xr.Dataset") -> "Figure":
    """Draw the pattern of the flank s = +1, as it is meant (dashed) and at each corner."""
    film = _MICROMETRES * float(dataset["marking_thickness"].max())
    flank = dataset.sel(side=1)
    face, radius = flank["face"].values, flank["radius"].values
    meant = _MICROMETRES * flank["gap"].values
    names = [str(name) for name in dataset["corner"].values]
    columns = 2 if len(names) <= 4 else 4
    rows = -(-len(names) // columns)
    figure, axes = axes_grid(rows, columns, width=3.5 * columns, height=0.8 + 2.6 * rows)
    filled = None
    for panel, name, gap in zip(axes, names, dataset["corner_gap"].values, strict=False):
        shown = np.maximum(_MICROMETRES * gap, 0.0)
        panel.grid(False)
        panel.set_facecolor(_GROUND)
        if shown.min() < film:
            levels = np.linspace(0.0, film, _LEVELS)
            filled = panel.contourf(face, radius, shown, levels=levels, cmap="viridis")
            panel.contour(face, radius, shown, levels=[film], colors=BLACK, linewidths=1.0)
        if meant.min() < film:
            panel.contour(
                face, radius, meant, levels=[film], colors=BLACK, linewidths=1.0,
                linestyles="dashed",
            )  # fmt: skip
        panel.set_title(name)
    for number, panel in enumerate(axes):
        if number % columns == 0:
            panel.set_ylabel("from the axis (mm)")
        if number + columns >= len(names):
            panel.set_xlabel("from mid-face (mm)")
    if filled is not None:
        bar = figure.colorbar(filled, ax=axes)
        bar.set_label(f"gap (µm), bare above {film:g};\ndashed: as meant")
    return figure

"""Pictures of shafts: to scale with their bearings and loads, moments, deflection."""

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np

from asperity.results.figures import BLACK, BLUE, DASHES, SKY, VERMILION, axes_grid
from asperity.results.panels import Mark, Panel, line

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_ENDS = ("A", "B")
_POSITION = "position from the end (mm)"
_HIGH = 0.62  # of the drawing's panel, over its width


def plot_shafts(dataset: "xr.Dataset") -> "Figure":
    """Draw each shaft in the case that bends it most: loads, moments, deflection."""
    names = [name for name in ("worm", "wheel") if f"{name}_at" in dataset]
    figure, axes = axes_grid(3, len(names), width=5.8 * len(names) + 0.4, height=11.4)
    for column, name in enumerate(names):
        own = axes[column :: len(names)]
        _loads(own[0], dataset, name)
        _moments(dataset, name).put(own[1])
        _deflection(dataset, name).put(own[2])
        length = float(dataset[f"{name}_stretch"].values.max())
        for panel in own:
            panel.set_xlim(-0.05 * length, 1.05 * length)
            panel.set_xlabel(_POSITION)
    return figure


def _loads(axes: "Axes", dataset: "xr.Dataset", name: str) -> None:
    """Draw the shaft to scale, and its radial loads to another one as arrows."""
    from matplotlib.patches import Rectangle

    stretches = dataset[f"{name}_stretch"].values
    diameters = dataset[f"{name}_diameter"].values
    threads = dataset[f"{name}_threads"].values
    for (start, end), diameter, threaded in zip(stretches, diameters, threads, strict=True):
        axes.add_patch(
            Rectangle(
                (start, -diameter / 2.0),
                end - start,
                diameter,
                facecolor="#E8E8E8",
                edgecolor=BLACK,
                linewidth=1.0,
                hatch="////" if threaded else None,
            )
        )
    widest = float(np.nanmax([*diameters, *dataset[f"{name}_bearing_size"].values[:, 0]]))
    at = dataset[f"{name}_bearing"].values
    for place, (outer, width) in zip(at, dataset[f"{name}_bearing_size"].values, strict=True):
        if np.isfinite(outer):
            inner = _bore(stretches, diameters, place)
            for low in (inner / 2.0, -outer / 2.0):
                axes.add_patch(
                    Rectangle(
                        (place - width / 2.0, low),
                        width,
                        (outer - inner) / 2.0,
                        facecolor=SKY,
                        edgecolor=BLACK,
                        linewidth=1.0,
                    )
                )
    reactions = np.hypot(*dataset[f"{name}_reaction"].values.T)
    axial = dataset[f"{name}_axial"].values
    loads, forces = dataset[f"{name}_load"].values, dataset[f"{name}_force"].values
    radial = np.hypot(forces[:, 1], forces[:, 2])
    most = max(float(reactions.max()), float(radial.max()), 1e-9)
    half = max(0.55 * _HIGH * float(stretches.max()), 1.1 * widest)
    reach = 0.35 * (half - 0.5 * widest)
    gap = 0.1 * (half - 0.5 * widest)

    def arrow(position: float, size: float, upwards: bool, colour: str, words: str) -> None:
        length = reach * size / most
        side = -1.0 if upwards else 1.0
        edge = side * 0.5 * widest
        axes.annotate(
            "",
            (position, edge),
            (position, edge + side * (length + gap)),
            arrowprops={"arrowstyle": "-|>", "color": colour, "linewidth": 1.8},
        )
        axes.text(
            position,
            edge + side * (length + 1.3 * gap),
            words,
            color=colour,
            ha="center",
            va="top" if upwards else "bottom",
        )

    for end, place, size, along in zip(_ENDS, at, reactions, axial, strict=True):
        words = f"{end} {size:.0f} N"
        if along:
            words += f"\n← {along:.0f} N" if along > 0.0 else f"\n{-along:.0f} N →"
        arrow(float(place), float(size), True, BLUE, words)
    for number, (place, size) in enumerate(zip(loads, radial, strict=True)):
        if size:
            arrow(
                float(place),
                float(size),
                False,
                VERMILION,
                f"{'teeth' if number == 0 else 'load'} {size:.0f} N",
            )
    axes.axhline(0.0, color=BLACK, linewidth=0.8, dashes=(8, 3, 2, 3))
    axes.set_ylim(-half, half)
    axes.set_aspect("equal", adjustable="box")
    axes.set_ylabel("to scale (mm)")
    axes.grid(visible=False)
    case = str(dataset[f"{name}_case"].values)
    axes.set_title(f"{name.capitalize()}'s shaft, {case}", loc="left")


def _bore(stretches: Any, diameters: Any, position: float) -> float:
    for (start, end), diameter in zip(stretches, diameters, strict=True):
        if start <= position <= end:
            return float(diameter)
    return float(diameters[-1])


def _moments(dataset: "xr.Dataset", name: str) -> Panel:
    at, moment = dataset[f"{name}_at"].values, dataset[f"{name}_moment"].values
    torque = line(1, at, dataset[f"{name}_torque"].values, "torque", dashes=DASHES[3])
    return Panel(_POSITION, "moment (N m)", [*_across(at, moment, "bending, ", "bending "), torque],
                 "Bending moment and torque", {"ncols": 2, "loc": "upper right"}, tight=False,
                 more=_with_room(0.35))  # fmt: skip


def _deflection(dataset: "xr.Dataset", name: str) -> Panel:
    at, bent = dataset[f"{name}_place"].values, dataset[f"{name}_deflection"].values
    return Panel(
        _POSITION,
        "deflection (um)",
        _across(at, bent),
        "Deflection, with shear",
        {"ncols": 3, "loc": "upper right"},
        tight=False,
        more=_with_room(0.25),
    )


def _across(at: Any, both: Any, whole: str = "", part: str = "") -> list[Mark]:
    """Return what runs across a shaft: its size, and what it is by y and z."""
    return [
        line(0, at, np.hypot(*both.T), f"{whole}resultant"),
        line(2, at, both[:, 0], f"{part}by y", dashes=(5, 2)),
        line(4, at, both[:, 1], f"{part}by z", dashes=(2, 2)),
    ]


def _with_room(share: float) -> "Callable[[Axes], None]":
    """Leave a share of a panel's height above its curves, for their names."""

    def leave(axes: "Axes") -> None:
        low, high = axes.get_ylim()
        axes.set_ylim(low, high + share * (high - low))

    return leave

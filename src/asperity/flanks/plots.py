"""Pictures of flanks and of what happens on them.

Maps lie over the flank as it is seen along the tooth: across, the distance from mid-face along the
wheel's axis; upwards, the distance from the wheel's axis.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from asperity.flanks.worm.profiles import FloatArray
from asperity.results.figures import BLACK, BLUE, STYLE, VERMILION, legend, panels

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_GROUND = "#F2F2F2"
_LINES = 12
_SIDES = {1: BLUE, -1: VERMILION}


@dataclass(frozen=True, eq=False)
class FlankMap:
    """Values over one flank.

    Attributes
    ----------
    side : int
        Which flank, 1 or -1.
    face, radius : ndarray, shape (rows, columns)
        Distance from mid-face and from the wheel's axis, mm.
    values : ndarray, shape (rows, columns)
        What is drawn.
    """

    side: int
    face: FloatArray
    radius: FloatArray
    values: FloatArray

    @property
    def name(self) -> str:
        """How the flank is called in a picture."""
        return f"flank s = {self.side:+d}"

    @property
    def outline(self) -> tuple[FloatArray, FloatArray]:
        """The edge of the flank, closed."""

        def round_it(values: FloatArray) -> FloatArray:
            return np.concatenate(
                [values[0], values[1:, -1], values[-1, -2::-1], values[-2::-1, 0]]
            )

        return round_it(self.face), round_it(self.radius)


def plot_pattern(
    maps: Sequence[FlankMap], film: float, centres: Sequence[tuple[float, float]]
) -> "Figure":
    """Draw where the marking compound is squeezed out.

    Parameters
    ----------
    maps : sequence of FlankMap
        Smallest gap over all phases, micrometres, a panel each.
    film : float
        Thickness of the compound, micrometres.
    centres : sequence of tuple of float
        Place of each pattern's centre, face and radius, mm.
    """
    figure, axes = _flanks(maps)
    filled: Any = None
    for panel, shown, (face, radius) in zip(axes, maps, centres, strict=True):
        panel.fill(*shown.outline, color=_GROUND, zorder=0)
        if shown.values.min() < film:
            levels = np.linspace(0.0, film, 7)
            gap = np.maximum(shown.values, 0.0)
            filled = panel.contourf(
                shown.face, shown.radius, gap, levels=levels, cmap="viridis", extend="neither"
            )
            panel.contour(
                shown.face, shown.radius, gap, levels=[film], colors=BLACK, linewidths=1.0
            )
            panel.plot(
                face, radius, linestyle="none", marker="+", markersize=13.0, markeredgewidth=2.2,
                color="white",
            )  # fmt: skip
            panel.plot(
                face, radius, linestyle="none", marker="+", markersize=11.0, markeredgewidth=1.2,
                color=BLACK,
            )  # fmt: skip
        panel.plot(*shown.outline, color=BLACK, linewidth=1.2)
    if filled is not None:
        _bar(figure, filled, axes, f"gap (µm), bare above {film:g}; + centre")
    return figure


def plot_ease_off(maps: Sequence[FlankMap]) -> "Figure":
    """Draw how much less material the wheel has than one cut by an identical hob.

    Parameters
    ----------
    maps : sequence of FlankMap
        Ease-off, micrometres, a panel each; NaN where there is nothing to compare with.
    """
    figure, axes = _flanks(maps)
    known = np.concatenate([shown.values[np.isfinite(shown.values)] for shown in maps])
    low, high = float(known.min()), float(known.max())
    filled: Any = None
    if high - low < 1e-6:
        # The same hob: nothing but rounding is left, and that is no map.
        low, high = low - 1.0, high + 1.0
    levels = _levels(low, high)
    for panel, shown in zip(axes, maps, strict=True):
        panel.fill(*shown.outline, color=_GROUND, zorder=0)
        filled = panel.contourf(
            shown.face, shown.radius, shown.values, levels=levels, cmap="cividis"
        )
        lines = panel.contour(
            shown.face, shown.radius, shown.values, levels=levels, colors="white", linewidths=0.7
        )
        panel.clabel(lines, levels[::2], fmt="%g", fontsize=8.5)
        panel.plot(*shown.outline, color=BLACK, linewidth=1.2)
    _bar(figure, filled, axes, "ease-off (µm), positive where material was removed")
    return figure


def plot_contact_lines(maps: Sequence[FlankMap], pitch: float) -> "Figure":
    """Draw contact lines over the flank.

    Parameters
    ----------
    maps : sequence of FlankMap
        Angle of the worm at which each point is nearest to it, rad, a panel each; NaN where the
        worm's flank is never nearest.
    pitch : float
        Angle of the worm from one tooth to the next, rad: as far apart are two lines that touch at
        once on neighbouring teeth.
    """
    figure, axes = _flanks(maps)
    for panel, shown in zip(axes, maps, strict=True):
        panel.fill(*shown.outline, color=_GROUND, zorder=0)
        panel.plot(*shown.outline, color=BLACK, linewidth=1.2)
        known = shown.values[np.isfinite(shown.values)]
        if not known.size:
            continue
        low, high = float(known.min()), float(known.max())
        every = pitch / 4.0
        first, last = int(np.ceil(low / every)), int(np.floor(high / every))
        for number in range(first, last + 1):
            whole = number % 4 == 0
            lines = panel.contour(
                shown.face, shown.radius, shown.values, levels=[number * every],
                colors=_SIDES[shown.side], linewidths=2.0 if whole else 0.8,
                linestyles="solid" if whole else "dashed",
            )  # fmt: skip
            if whole:
                panel.clabel(lines, fmt=f"{np.degrees(number * every):.0f}°", fontsize=9.0)
    figure.suptitle(
        f"angle of the worm; a pitch is {np.degrees(pitch):.4g}°, thin lines each quarter of one",
        fontsize=10.0,
    )
    return figure


def plot_transmission_error(
    phase: FloatArray, errors: Mapping[int, FloatArray], pitch: float
) -> "Figure":
    """Draw the transmission error over a pitch.

    Parameters
    ----------
    phase : ndarray, shape (n,)
        Angle of the worm, rad.
    errors : mapping of int to ndarray, shape (n,)
        Error of the wheel by side, rad.
    pitch : float
        Angle of the worm from one tooth to the next, rad.
    """
    figure, (axes,) = panels(height=3.6)
    peak = 0.0
    for side, error in errors.items():
        about = 1e6 * (error - np.mean(error))
        peak = max(peak, float(np.ptp(about)))
        axes.plot(
            np.degrees(phase), about, color=_SIDES[side], label=f"flank s = {side:+d}",
            dashes=(1, 0) if side > 0 else (4, 2),
        )  # fmt: skip
    # What is rounding is drawn as the straight line that it is.
    if peak < 1e-3:
        axes.set_ylim(-1.0, 1.0)
    axes.set_xlim(np.degrees(phase[0]), np.degrees(phase[0] + pitch))
    axes.set_xlabel("angle of the worm (°)")
    axes.set_ylabel("error of the wheel (µrad)")
    axes.set_title("Transmission error about its mean over a pitch", loc="left")
    legend(axes, loc="upper right", ncols=2, bbox_to_anchor=(1.0, 1.0))
    axes.margins(y=0.25)
    return figure


def plot_vibration(
    maps: Mapping[str, Mapping[str, FlankMap]], names: Mapping[str, str]
) -> "Figure":
    """Draw the parts of each vibration direction over a flank.

    Parameters
    ----------
    maps : mapping of str to mapping of str to FlankMap
        By direction and part, per unit of the vibration's velocity.
    names : mapping of str to str
        What each direction is called.
    """
    parts = list(next(iter(maps.values())))
    figure, axes = panels(len(maps), len(parts), width=8.6, height=1.75 * len(maps) + 0.6)
    filled: Any = None
    # An even number of levels, so that nothing has a colour of its own.
    levels = np.linspace(-1.05, 1.05, 22)
    for row, (direction, by_part) in enumerate(maps.items()):
        for column, (part, shown) in enumerate(by_part.items()):
            panel = axes[row * len(parts) + column]
            panel.grid(visible=False)
            filled = panel.contourf(
                shown.face, shown.radius, shown.values, levels=levels, cmap="RdBu_r", extend="both"
            )
            panel.plot(*shown.outline, color=BLACK, linewidth=1.0)
            if row == 0:
                panel.set_title(part)
            if row == len(maps) - 1:
                panel.set_xlabel("face (mm)")
            else:
                panel.tick_params(labelbottom=False)
            if column == 0:
                panel.set_ylabel(f"{names[direction]}\nradius (mm)")
            else:
                panel.tick_params(labelleft=False)
    _bar(figure, filled, axes, "part of the vibration's velocity", location="right")
    figure.axes[-1].set_yticks(np.linspace(-1.0, 1.0, 5))
    return figure


def _round(values: FloatArray) -> FloatArray:
    top, back = values[-1, -2::-1], values[-2::-1, 0]
    return np.concatenate([values[0], values[1:, -1], top, back])


def _flanks(maps: Sequence[FlankMap]) -> "tuple[Figure, list[Axes]]":
    figure, axes = panels(1, len(maps), width=4.6 * len(maps), height=3.9)
    for place, (panel, shown) in enumerate(zip(axes, maps, strict=True)):
        panel.grid(visible=False)
        panel.set_title(shown.name, loc="left")
        panel.set_xlabel("distance from mid-face (mm)")
        if place == 0:
            panel.set_ylabel("distance from the wheel's axis (mm)")
        panel.margins(0.04)
    return figure, axes


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

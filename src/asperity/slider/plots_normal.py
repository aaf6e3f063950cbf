"""Pictures of vibration out of the plane, from plain arrays."""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from asperity.arrays import FloatArray
from asperity.results.figures import (
    BLACK,
    BLUE,
    COLOURS,
    DASHES,
    SKY,
    VERMILION,
    legend,
    panels,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_MARKERS = ("o", "s", "^", "D")


def plot_master_curve(
    velocity: FloatArray,
    curves: Mapping[float, FloatArray],
    reduction: FloatArray,
    approximated: FloatArray,
    points: Mapping[float, tuple[FloatArray, FloatArray]],
) -> "Figure":
    """Draw the ratio for several swings, and the reduction over the swing, on which they meet.

    Parameters
    ----------
    velocity : ndarray, shape (n,)
        Over the critical velocity.
    curves : mapping of float to ndarray
        Ratio of each swing at these velocities.
    reduction, approximated : ndarray, shape (n,)
        The master curve and a polynomial for it.
    points : mapping of float to two ndarrays
        Velocities and ratios of a model, for each swing.
    """
    figure, (left, right) = panels(1, 2, width=9.0, height=4.0)
    for index, (swing, ratio) in enumerate(curves.items()):
        colour, dashes = COLOURS[index % len(COLOURS)], DASHES[index % len(DASHES)]
        left.plot(velocity, ratio, color=colour, dashes=dashes, label=f"a = {swing:g}")
    right.plot(velocity, reduction, color=BLACK, label="h(V)")
    right.plot(velocity, approximated, color=BLACK, dashes=(2, 2), linewidth=1.0, label="Popov")
    for index, (swing, (at, ratio)) in enumerate(points.items()):
        style: dict[str, Any] = {
            "color": COLOURS[index % len(COLOURS)], "marker": _MARKERS[index % len(_MARKERS)],
            "linestyle": "", "markersize": 4.5, "fillstyle": "none",
        }  # fmt: skip
        left.plot(at, ratio, **style)
        right.plot(at, (1.0 - ratio) / swing, label=f"a = {swing:g}", **style)
    left.set_ylabel(r"friction over $\mu N_0$")
    right.set_ylabel("reduction over swing")
    for axes in (left, right):
        axes.set_xlabel("velocity over the critical velocity, V")
        axes.margins(x=0.02)
        axes.set_ylim(0.0, 1.05)
    legend(left, loc="lower right")
    legend(right, loc="upper right")
    return figure


def plot_directions(elevation: FloatArray, azimuth: FloatArray, ratio: FloatArray) -> "Figure":
    """Draw the ratio over the vibration's direction in space, and where it turns into a thrust.

    Parameters
    ----------
    elevation, azimuth : ndarray, shapes (n,), (m,)
        rad.
    ratio : ndarray, shape (n, m)
    """
    figure, (axes,) = panels(width=7.4, height=4.4)
    degrees = np.degrees(azimuth), np.degrees(elevation)
    thrust = bool(ratio.min() < 0.0)
    size = max(float(np.abs(ratio).max()), 1e-12)
    # White at zero, so that a thrust has a colour of its own.
    field = axes.pcolormesh(
        *degrees, ratio, cmap="RdBu_r" if thrust else "Reds", vmin=-size if thrust else 0.0,
        vmax=size, shading="gouraud", rasterized=True,
    )  # fmt: skip
    axes.grid(visible=False)
    levels = axes.contour(*degrees, ratio, colors=BLACK, linewidths=0.7, levels=8)
    axes.clabel(levels, fontsize=8.0, fmt="%.2g")
    if thrust and ratio.max() > 0.0:
        axes.contour(*degrees, ratio, levels=[0.0], colors=BLACK, linewidths=2.0)
    figure.colorbar(field, ax=axes, label=r"drive force over $\mu W$")
    axes.set_xlabel("azimuth from the drive (deg)")
    axes.set_ylabel("elevation (deg)")
    return figure


def plot_two_cycles(
    time: FloatArray,
    load: FloatArray,
    friction: FloatArray,
    limit: float,
    static_load: float,
) -> "Figure":
    """Draw normal force and friction over time, flight shaded.

    Parameters
    ----------
    time, load, friction : ndarray, shape (n,)
        s, N, N; friction along the drive.
    limit : float
        Coefficient of friction: what friction can be at most is that of the load.
    static_load : float
        The load without vibration, N.
    """
    figure, (upper, lower) = panels(2, height=5.4)
    scale, unit = (1e3, "ms") if time[-1] - time[0] > 1e-3 else (1e6, "µs")
    at = scale * (time - time[0])
    for axes in (upper, lower):
        shade_flight(axes, at, load, label="in flight" if axes is upper else None)
        axes.margins(x=0.0)
    upper.plot(at, load, color=BLUE, label="normal force")
    upper.axhline(static_load, color=BLACK, dashes=(4, 3), linewidth=1.0, label="at rest")
    upper.axhline(_mean(time, load), color=BLUE, dashes=(1, 1.5), linewidth=1.0, label="its mean")
    upper.set_ylabel("normal force (N)")
    for sign in (1.0, -1.0):
        lower.plot(
            at, sign * limit * load, color=BLUE, linewidth=0.8, dashes=(2, 2),
            label=r"$\pm\mu N$" if sign > 0.0 else None,
        )  # fmt: skip
    lower.plot(at, friction, color=VERMILION, label="friction")
    mean = _mean(time, friction)
    lower.axhline(mean, color=VERMILION, dashes=(1, 1.5), linewidth=1.0, label="its mean")
    lower.set_ylabel("friction (N)")
    lower.set_xlabel(f"time ({unit})")
    for axes in (upper, lower):
        legend(axes, loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=4)
    return figure


def shade_flight(axes: "Axes", at: FloatArray, load: FloatArray, label: str | None) -> None:
    """Shade where there is no load."""
    flight = load <= 0.0
    if np.any(flight):
        axes.fill_between(
            at, 0.0, 1.0, where=flight, color=SKY, alpha=0.3, linewidth=0.0,
            transform=axes.get_xaxis_transform(), label=label,
        )  # fmt: skip


def _mean(time: FloatArray, values: FloatArray) -> float:
    return float(np.trapezoid(values, time) / (time[-1] - time[0]))

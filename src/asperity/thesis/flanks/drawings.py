"""The pictures of chapter 2 about flanks, each drawn from its dataset alone."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from asperity.flanks.study.plots import outline
from asperity.results.figures import BLACK, BLUE, STYLE, VERMILION, axes_grid, legend
from asperity.thesis.drawing import limit
from asperity.thesis.flanks.drawings_solids import BRONZE, DYE, FLANK_VIEW, paint
from asperity.thesis.flanks.shapes import Shape

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_GROUND = "#F2F2F2"
_WORM_RADIUS = "from the worm's axis (mm)"
_FACE, _RADIUS = "distance from mid-face (mm)", "from the wheel's axis (mm)"
_EXAGGERATED = 10.0
_PRESSURES = (
    ("misaligned", "(a) axis 0.1° askew"),
    ("lead", "lead corrected by 0.07°"),
    ("over_relieved", "(b) relief 80 µm from the pitch line"),
    ("relieved", "relief 10 µm, outer half"),
    ("low", "(a) a twentieth of the torque"),
    ("high", "(b) the rated torque"),
)


def pressures(dataset: "xr.Dataset") -> "Figure":
    """Draw contact lines coloured by the pressure on them, a panel each design or torque."""
    from matplotlib.collections import LineCollection
    from matplotlib.colors import Normalize

    designs = [(name, title) for name, title in _PRESSURES if f"{name}_pressure" in dataset]
    rows = len(designs) // 2
    figure, axes = axes_grid(rows, 2, width=8.6, height=0.6 + 2.9 * rows)
    highest = max(float(dataset[f"{name}_pressure"].max()) for name, _ in designs)
    scale = Normalize(0.0, np.ceil(highest / 200.0) * 200.0)
    drawn: Any = None
    for place, (panel, (name, title)) in enumerate(zip(axes, designs, strict=True)):
        pressure = dataset[f"{name}_pressure"].values
        _ground(panel, *dataset[f"{name}_outline"].values.T)
        order = np.argsort(pressure)
        drawn = panel.add_collection(
            LineCollection(
                list(dataset[f"{name}_place"].values[order]), array=pressure[order], norm=scale,
                cmap="inferno_r", linewidths=2.2, capstyle="round",
            )
        )  # fmt: skip
        length = float(dataset[f"{name}_length"])
        panel.set_title(f"{title}\nup to {pressure.max():.0f} MPa, lines of {length:.0f} mm carry",
                        loc="left")  # fmt: skip
        _labels(panel, bottom=place > len(designs) - 3, left=place % 2 == 0)
    _colour_bar(drawn, axes, "Hertzian pressure (MPa)", shrink=0.7, aspect=30.0)
    return figure


def _colour_bar(drawn: Any, axes: Sequence["Axes"], label: str, **options: Any) -> None:
    import matplotlib as mpl

    with mpl.rc_context(STYLE):
        bar = axes[0].figure.colorbar(drawn, ax=axes, location="right", label=label, **options)
        bar.ax.grid(visible=False)


def formation(dataset: "xr.Dataset") -> "Figure":
    """Draw where the tooth and the worm are close at some instants, on both."""
    import matplotlib as mpl

    titles = ("(a) identical hob", "(b) misaligned", "(c) oversized and tilted hob")
    figure, axes = axes_grid(2, 3, width=10.2, height=5.8)
    film = float(dataset["film"])
    times = dataset.sizes["time"]
    colours = mpl.colormaps["viridis"](np.linspace(0.05, 0.9, times))
    for column, title in enumerate(titles):
        own = dataset.isel(design=column)
        worm, wheel = axes[column], axes[3 + column]
        worm.set_title(title, loc="left")
        thread, rho = own["thread"].values, own["worm_radius"].values
        root, tip = float(dataset["worm_root"]), float(dataset["worm_tip"])
        worm.axhspan(root, tip, color=_GROUND, zorder=0)
        _ground(wheel, *outline(own["face"].values, own["radius"].values))
        for time in range(times):
            gap = own["gap"].values[time]
            near = np.ma.masked_where(gap > film, own["phase"].values)
            at = float(own["instant"].values[time])
            for panel, x, y in (
                (worm, thread[time], rho[time]),
                (wheel, own["face"].values, own["radius"].values),
            ):
                panel.contourf(x, y, gap, levels=[-1e3, film], colors=[colours[time]], alpha=0.75)
                panel.contour(x, y, near, levels=[at], colors=BLACK, linewidths=0.9,
                              linestyles="solid")  # fmt: skip
        shown = dataset["thread"].values[dataset["gap"].values < film]
        worm.set(
            xlabel="along the worm's thread (°)", xlim=(shown.min() - 8.0, shown.max() + 8.0),
            ylim=(root - 0.3, tip + 0.3),
        )  # fmt: skip
        wheel.set_xlabel(_FACE)
        for panel in (worm, wheel):
            panel.grid(visible=False)
    axes[0].set_ylabel(_WORM_RADIUS)
    axes[3].set_ylabel(_RADIUS)
    first = [
        mpl.patches.Patch(color=colour, alpha=0.75, label=f"{time + 1}")
        for time, colour in enumerate(colours)
    ]
    legend(axes[4], handles=first, title="instant", loc="center", fontsize="small")
    return figure


def dye(dataset: "xr.Dataset") -> "Figure":
    """Draw teeth with the dye on them, and the gap below the dye's thickness as a map."""
    tilts = dataset["tilt"].values
    figure, axes = axes_grid(2, len(tilts), width=9.0, height=6.6)
    grid: Any = axes[0].get_gridspec()
    grid.set_height_ratios([1.5, 1.0])
    film = float(dataset["film"])
    filled: Any = None
    for column, tilt in enumerate(tilts):
        solid, flat = axes[column], axes[len(tilts) + column]
        own = dataset.sel(tilt=tilt)
        paint(solid, Shape.read(dataset, f"teeth_{tilt:g}"), {0: BRONZE, 1: DYE}, FLANK_VIEW)
        solid.set_title(
            f"tilt {tilt:g}°: {100.0 * float(own['marked_share']):.0f} % marked,\n"
            f"middle {abs(float(own['centre'])):.1f} mm from mid-face"
        )
        face, radius = own["face"].values, own["radius"].values
        _ground(flat, *outline(face, radius))
        gap = np.maximum(own["gap"].values, 0.0)
        filled = flat.contourf(face, radius, gap, levels=np.linspace(0.0, film, 7), cmap="Blues_r")
        flat.contour(face, radius, gap, levels=[film], colors=BLACK, linewidths=1.0)
        _labels(flat, bottom=True, left=column == 0)
    _colour_bar(filled, axes[2:], f"gap (µm),\nbare above {film:g}", aspect=14.0)
    return figure


def modified_profile(dataset: "xr.Dataset") -> "Figure":
    """Draw a thread in the axial section with the modification enlarged, and the modification."""
    figure, (thread, amount) = axes_grid(1, 2, width=8.6, height=4.2)
    radius, half = dataset["radius"].values, dataset["axial"].values
    moved = dataset["relief"].values / float(dataset["normal"]) * 1e-3
    outline = dataset["outline_axial"].values, dataset["outline_radius"].values
    for side in (1, -1):
        first = side > 0
        thread.plot(side * outline[0], outline[1], color=BLACK, label="plain" if first else None)
        thread.plot(
            side * (half - _EXAGGERATED * moved), radius, color=VERMILION, dashes=(4, 2),
            label=f"modified, {_EXAGGERATED:g}×" if first else None,
        )  # fmt: skip
    tip = float(dataset["tip_radius"])
    thread.plot([-outline[0][-1], outline[0][-1]], [tip, tip], color=BLACK)
    thread.set(aspect="equal", xlabel="along the worm's axis (mm)", ylabel=_WORM_RADIUS)
    amount.plot(dataset["relief"], radius, color=BLUE)
    amount.set_xlabel("taken off, normal to the flank (µm)")
    pitch = float(dataset["pitch_radius"])
    for panel in (thread, amount):
        limit(panel, pitch)
        panel.set_ylim(float(dataset["root_radius"]) - 0.4, tip + 0.4)
    amount.annotate(
        "pitch line", (float(dataset["relief"].max()), pitch),
        xytext=(0, 4), textcoords="offset points", ha="right", fontsize=10.0,
    )  # fmt: skip
    legend(thread, loc="lower center")
    return figure


def _ground(panel: "Axes", x: Any, y: Any) -> None:
    panel.grid(visible=False)
    panel.fill(x, y, color=_GROUND, zorder=0)
    panel.plot(x, y, color=BLACK, linewidth=1.0)


def _labels(panel: "Axes", *, bottom: bool, left: bool) -> None:
    panel.tick_params(labelbottom=bottom, labelleft=left)
    if bottom:
        panel.set_xlabel(_FACE)
    if left:
        panel.set_ylabel(_RADIUS)

"""The pictures about flanks and of bodies in space, each drawn from its dataset alone.

What is further away is painted first, so that what is nearer hides it. Light comes from over the
left shoulder; the projection is parallel.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from asperity.arrays import FloatArray
from asperity.flanks.study.plots import outline
from asperity.results.figures import BLACK, BLUE, STYLE, VERMILION, axes_grid, legend
from asperity.thesis.drawing import limit
from asperity.thesis.flanks.shapes import Shape

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

STEEL, BRONZE, DYE = "#B4BCC6", "#DDAF6B", "#1F4E9E"
_EDGE = "#30343A"
_LIGHT = np.array([-0.45, 0.65, 0.75]) / np.linalg.norm([-0.45, 0.65, 0.75])
_AMBIENT, _DIFFUSE, _SHINE, _POWER = 0.42, 0.6, 0.16, 24.0
_BEHIND = 0.72


@dataclass(frozen=True)
class View:
    """From where a body is seen: the direction to the eye, and what points up."""

    towards: tuple[float, float, float]
    up: tuple[float, float, float] = (0.0, 1.0, 0.0)

    @property
    def axes(self) -> FloatArray:
        """Unit vectors to the right, up and to the eye, as rows."""
        eye = np.array(self.towards) / np.linalg.norm(self.towards)
        right = np.cross(self.up, eye)
        right /= np.linalg.norm(right)
        return np.array([right, np.cross(eye, right), eye])


def paint(
    axes: "Axes", shape: Shape, colours: Mapping[int, str], view: View,
    *, edges: float = 0.0, shell: bool = False,
) -> None:  # fmt: skip
    """Paint a body, each of its parts in a colour.

    Lines round its faces are some points wide, none by default; faces of a shell are seen from
    behind as well, darker.
    """
    from matplotlib.collections import PolyCollection
    from matplotlib.colors import to_rgb

    corners = (shape.points @ view.axes.T)[shape.faces]
    normal = np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
    # The last two corners of a triangle are one, and the second diagonal still is a chord of it.
    normal /= np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-300)
    behind = normal[:, 2] < 0.0
    seen = np.arange(len(corners)) if shell else np.flatnonzero(~behind)
    order = seen[np.argsort(corners[seen, :, 2].mean(axis=1), kind="stable")]
    facing = np.where(behind[:, None], -normal, normal)
    half = _LIGHT + np.array([0.0, 0.0, 1.0])
    half /= np.linalg.norm(half)
    # A wide lamp, so that what faces away from it is not all of one darkness.
    light = _AMBIENT + _DIFFUSE * (0.5 + 0.5 * facing @ _LIGHT)
    shine = _SHINE * np.maximum(facing @ half, 0.0) ** _POWER
    light = np.where(behind, _BEHIND * light, light)
    table = {part: np.array(to_rgb(colour)) for part, colour in colours.items()}
    base = np.array([table[int(part)] for part in shape.part])
    shaded = np.clip(base * light[:, None] + shine[:, None], 0.0, 1.0)[order]
    # As one array, of which paths are made ten times as fast as of a list, though not so typed.
    polygons: Any = corners[order, :, :2]
    axes.add_collection(
        PolyCollection(
            polygons, facecolors=shaded,
            # Without a line of the face's own colour the paper shows between faces.
            edgecolors=_EDGE if edges else shaded, linewidths=edges or 0.7, joinstyle="round",
        )
    )  # fmt: skip
    axes.set_aspect("equal")
    axes.set_axis_off()
    axes.autoscale_view()
    axes.margins(0.02)


_OBLIQUE = View((-0.4, 0.55, 1.0))
FLANK_VIEW = View((0.85, 0.75, -0.7))
_TOOTH = View((0.75, 0.8, 0.9))
_PAIR = {0: BRONZE, 1: STEEL}


def gearset(dataset: "xr.Dataset") -> "Figure":
    """Draw worm and wheel, and a tooth as a stepwise machining simulation and as a hob leave it."""
    figure, (whole, stepped, exact) = _pictures([1.6, 1.0, 1.0], 11.0, 4.8)
    paint(whole, Shape.read(dataset, "gearset"), _PAIR, View((-0.55, 0.4, 1.0)))
    whole.set_title("worm and wheel, exact flanks")
    highest = 1e3 * float(dataset["facet_height"].max())
    scale = float(dataset["enlargement"])
    for axes, name, title in (
        (stepped, "stepped", f"cut in steps: facets up to {highest:.2g} µm,\nshown {scale:g}×"),
        (exact, "exact", "enveloped: one smooth face\n"),
    ):
        paint(axes, Shape.read(dataset, name), _PAIR, FLANK_VIEW)
        axes.set_title(title)
    return figure


def sector(dataset: "xr.Dataset") -> "Figure":
    """Draw the worm in some teeth of the wheel."""
    figure, (axes,) = _pictures([1.0], 7.0, 5.2)
    paint(axes, Shape.read(dataset, "gearset"), _PAIR, _OBLIQUE)
    return figure


def shell(dataset: "xr.Dataset") -> "Figure":
    """Draw the worm's surface with the lines of its quadrilaterals."""
    figure, (axes,) = _pictures([1.0], 7.0, 4.0)
    paint(axes, Shape.read(dataset, "worm"), _PAIR, _LYING, edges=0.3, shell=True)
    return figure


# The worm's axis, z, across the picture.
_LYING = View((0.45, 1.0, 0.4), (1.0, 0.0, 0.0))
_PARTS = {0: "#C9CDD2", 1: "#E3B05F", 2: "#7FA8C9", 3: "#8DBF9A"}


def topology(dataset: "xr.Dataset") -> "Figure":
    """Draw a tooth with each of its faces in one colour, and the same tooth meshed."""
    figure, (faces, meshed) = _pictures([1.0, 1.0], 9.0, 4.0)
    tooth = Shape.read(dataset, "tooth")
    paint(faces, tooth, _PARTS, _TOOTH)
    faces.set_title("one face a flank (ochre), fillet (blue), tip (green)")
    paint(meshed, Shape.read(dataset, "mesh"), {0: BRONZE}, _TOOTH, edges=0.25)
    meshed.set_title(f"{int(dataset['elements'])} hexahedra")
    return figure


def densities(dataset: "xr.Dataset") -> "Figure":
    """Draw the same tooth in three meshes."""
    names = [str(name) for name in dataset["density"].values]
    figure, all_axes = _pictures([1.0] * len(names), 11.0, 3.4)
    for axes, name, letter in zip(all_axes, names, "abc", strict=True):
        own = dataset.sel(density=name)
        paint(axes, Shape.read(dataset, name), {0: BRONZE}, _TOOTH, edges=0.2)
        axes.set_title(
            f"{letter}) {name}: {float(own['element_height']):.2f} x "
            f"{float(own['element_width']):.2f} mm,\n"
            f"{int(own['elements'])} hexahedra a tooth"
        )
    return figure


def _pictures(widths: list[float], width: float, height: float) -> "tuple[Figure, list[Any]]":
    figure, axes = axes_grid(1, len(widths), width=width, height=height)
    grid: Any = axes[0].get_gridspec()
    grid.set_width_ratios(widths)
    return figure, axes


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

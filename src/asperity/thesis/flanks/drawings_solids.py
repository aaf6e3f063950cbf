"""Bodies in space as shaded pictures, drawn from their datasets alone.

What is further away is painted first, so that what is nearer hides it. Light comes from over the
left shoulder; the projection is parallel.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from asperity.arrays import FloatArray
from asperity.results.figures import axes_grid
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

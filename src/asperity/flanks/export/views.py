"""Pictures in space of worm, wheel and meshes, drawn off-screen; they need the ``view`` extra."""

import contextlib
import os
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from asperity.errors import InputError, MissingExtraError
from asperity.flanks.export.together import centred_teeth, mounted_worm
from asperity.flanks.export.worm import worm_body
from asperity.flanks.meshing.pattern.marking import MARKING
from asperity.flanks.wheel.enveloped import FlankGrid, Wheel
from asperity.mesh import HexMesh
from asperity.mesh.surface import Surface
from asperity.store import write_atomically

STEEL, BRONZE, PAPER = "#AEB6BF", "#D9A860", "#FFFFFF"
SIZE = (1600, 1200)
# A coloured patch has to stand out of the triangles below it, which cut corners; mm.
_LIFT = 0.01
_MICROMETRES = 1e3
_COLOURS = "viridis"
_LIGHT = {"ambient": 0.2, "diffuse": 0.8, "specular": 0.25, "specular_power": 20.0}


def require_view() -> None:
    """Raise unless the ``view`` extra is installed.

    Raises
    ------
    MissingExtraError
        It is not.
    """
    try:
        import pyvista  # noqa: F401
    except ImportError as error:
        raise MissingExtraError(
            f"pictures in space need the view extra ({error}): pip install asperity[view]"
        ) from error


@dataclass(frozen=True)
class Camera:
    """Where a picture is seen from.

    Attributes
    ----------
    towards : tuple of 3 float
        Direction from the body to the eye.
    up : tuple of 3 float
        What points up in the picture.
    zoom : float
        Enlargement of what just fits.
    """

    towards: tuple[float, float, float]
    up: tuple[float, float, float]
    zoom: float = 1.25


_WORM = Camera((0.3, 1.0, 0.45), (1.0, 0.0, 0.0), 1.1)
_WHEEL = Camera((-0.55, 0.75, 1.0), (0.0, 1.0, 0.0))
# A single tooth is tall, and below a mesh there may be a scale of colours.
_WHOLE = replace(_WHEEL, zoom=1.0)
# Past the tip of the next tooth at the flank s = +1 of a right-hand wheel.
_FLANK = (0.85, 0.75, -0.7)


def worm_view(path: str | os.PathLike[str], wheel: Wheel) -> Path:
    """Draw the worm that runs with a wheel, as PNG.

    Raises
    ------
    MissingExtraError
        The ``view`` extra is not installed.
    StorageError
        The file cannot be written.
    """
    body = worm_body(wheel.pair)
    with _plotter(path, _WORM) as plotter:
        _add(plotter, body.surface(), STEEL)
    return Path(path)


def wheel_view(path: str | os.PathLike[str], wheel: Wheel, teeth: int = 7) -> Path:
    """Draw several teeth of a wheel with their rim, as PNG; errors as in `worm_view`."""
    with _plotter(path, _WHEEL) as plotter:
        _add(plotter, centred_teeth(wheel, teeth).surface(), BRONZE)
    return Path(path)


def pair_view(path: str | os.PathLike[str], wheel: Wheel, teeth: int = 9) -> Path:
    """Draw the worm at phase 0 in several teeth of the wheel, as PNG; errors as in `worm_view`."""
    with _plotter(path, _WHEEL) as plotter:
        _add(plotter, mounted_worm(wheel).surface(), STEEL)
        _add(plotter, centred_teeth(wheel, teeth).surface(), BRONZE)
    return Path(path)


def pattern_view(
    path: str | os.PathLike[str],
    wheel: Wheel,
    grid: FlankGrid,
    gap: ArrayLike,
    *,
    thickness: float = MARKING,
    teeth: int = 3,
) -> Path:
    """Draw a contact pattern on the flanks that bear it, as PNG.

    Parameters
    ----------
    path : path
        File to write.
    wheel : Wheel
        The wheel.
    grid : FlankGrid
        Points of the flank.
    gap : array_like, shape of the grid
        Smallest distance between the flanks at each point, mm.
    thickness : float
        Thickness of the marking compound, mm: the pattern is where the gap is less.
    teeth : int
        Number of teeth.

    Raises
    ------
    InputError
        A gap that is not finite or has not the grid's shape, or a thickness that is not positive.
    MissingExtraError
        The ``view`` extra is not installed.
    StorageError
        The file cannot be written.
    """
    values = _MICROMETRES * np.asarray(gap, dtype=float)
    if values.shape != grid.radius.shape or not np.isfinite(values).all():
        raise InputError(f"the gap has the shape {values.shape}; give finite {grid.radius.shape}")
    if not thickness > 0:
        raise InputError(f"the marking compound is {thickness:g} mm thick; it must be positive")
    film = _MICROMETRES * thickness
    shown = grid.points + _LIFT * grid.normals
    label = f"gap in µm, bare where above {film:g}"
    side = 1 if grid.points[..., 0].mean() > 0 else -1
    x, y, z = _FLANK
    # The other flank is this one turned about Y, a left-hand wheel its mirror image.
    camera = Camera((side * x, y, side * wheel.pair.mirror * z), (0.0, 1.0, 0.0), 0.95)
    with _plotter(path, camera) as plotter:
        _add(plotter, centred_teeth(wheel, teeth).surface(), BRONZE)
        for turn in _turns(wheel, teeth):
            turned = shown @ turn.T * [1.0, 1.0, wheel.pair.mirror]
            marked = _polygons(turned.reshape(-1, 3), _quads(values.shape))
            marked.point_data[label] = values.reshape(-1)
            below = marked.clip_scalar(scalars=label, value=film)
            if below.n_cells:
                look = {"scalars": label, "cmap": _COLOURS, "clim": (0.0, film), **_bar(label)}
                plotter.add_mesh(below, **look)
    return Path(path)


def mesh_view(
    path: str | os.PathLike[str],
    mesh: HexMesh,
    values: ArrayLike | None = None,
    label: str = "",
    limits: tuple[float, float] | None = None,
) -> Path:
    """Draw a mesh of teeth with its edges, coloured by what is known at its nodes, as PNG.

    Parameters
    ----------
    path : path
        File to write.
    mesh : HexMesh
        The mesh, about the wheel's axis.
    values : array_like, shape (n,), optional
        One number a node.
    label : str
        What the numbers are, with their unit.
    limits : tuple of float, optional
        Numbers at the ends of the scale of colours; the least and the largest if left out.

    Raises
    ------
    InputError
        Values that are not finite or not one a node.
    MissingExtraError
        The ``view`` extra is not installed.
    StorageError
        The file cannot be written.
    """
    numbers = None if values is None else _checked(values, len(mesh.points))
    with _plotter(path, _WHOLE) as plotter:
        shown = _polygons(mesh.points, mesh.skin())
        look: dict[str, Any] = {"show_edges": True, "edge_color": "#404040", "line_width": 1.0}
        if numbers is None:
            plotter.add_mesh(shown, color=BRONZE, **look)
        else:
            shown.point_data[label] = numbers
            plotter.add_mesh(
                shown, scalars=label, cmap=_COLOURS, clim=limits, **look, **_bar(label)
            )
    return Path(path)


def _turns(wheel: Wheel, teeth: int) -> list[NDArray[np.float64]]:
    return [_turned(wheel, number - teeth // 2) for number in range(teeth)]


def _turned(wheel: Wheel, pitches: int) -> NDArray[np.float64]:
    angle = 2.0 * np.pi * pitches / wheel.pair.geometry.wheel_teeth
    cosine, sine = np.cos(angle), np.sin(angle)
    return np.array([[cosine, sine, 0.0], [-sine, cosine, 0.0], [0.0, 0.0, 1.0]])


def _checked(values: ArrayLike, count: int) -> NDArray[np.float64]:
    numbers = np.asarray(values, dtype=float)
    if numbers.shape != (count,) or not np.isfinite(numbers).all():
        raise InputError(f"values have the shape {numbers.shape}; give {count} finite numbers")
    return numbers


def _quads(shape: tuple[int, ...]) -> NDArray[np.int64]:
    number = np.arange(shape[0] * shape[1]).reshape(shape)
    corners = [number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:]]
    return np.stack(corners, axis=-1).reshape(-1, 4)


@contextlib.contextmanager
def _plotter(path: str | os.PathLike[str], camera: Camera) -> Iterator[Any]:
    """Give a plotter to draw with; what was drawn is written when the block ends well."""
    require_view()
    import pyvista

    # Without a display VTK complains on standard error before it draws without one.
    with pyvista.vtk_verbosity("off"):
        plotter = pyvista.Plotter(off_screen=True, window_size=list(SIZE), theme=_theme())
        try:
            yield plotter
            plotter.view_vector(camera.towards, viewup=camera.up)
            plotter.enable_parallel_projection()
            plotter.camera.zoom(camera.zoom)
            plotter.enable_anti_aliasing("ssaa")
            write_atomically(path, lambda target: plotter.screenshot(str(target)))
        finally:
            plotter.close()


def _theme() -> Any:
    from pyvista.plotting.themes import DocumentTheme

    theme = DocumentTheme()
    theme.background = PAPER
    theme.font.color = "black"
    return theme


def _polygons(points: NDArray[np.float64], faces: NDArray[np.int64]) -> Any:
    import pyvista

    return pyvista.PolyData.from_regular_faces(points, faces)


def _add(plotter: Any, surface: Surface, colour: str) -> None:
    shown = _polygons(surface.points, surface.triangles)
    look = {"smooth_shading": True, "split_sharp_edges": True, "feature_angle": 25.0}
    look |= _LIGHT
    plotter.add_mesh(shown, color=colour, **look)


def _bar(label: str) -> dict[str, Any]:
    bar = {
        "title": f"{label}\n",
        "vertical": False,
        "title_font_size": 26,
        "label_font_size": 22,
        "position_x": 0.3,
        "position_y": 0.04,
        "width": 0.4,
        "height": 0.1,
        "fmt": "%.3g",
    }
    return {"scalar_bar_args": bar, **_LIGHT}

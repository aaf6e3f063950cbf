"""Pictures in space of worm, wheel and meshes, drawn off-screen; they need the ``view`` extra."""

import contextlib
import math
import os
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from asperity.arrays import FloatArray, IntArray
from asperity.files.store import write_atomically
from asperity.flanks.export.extras import require_view
from asperity.flanks.export.tooth import centred_teeth
from asperity.flanks.export.worm import mounted_worm
from asperity.flanks.wheel.enveloped import Wheel
from asperity.flanks.wheel.frame import turned
from asperity.mesh import HexMesh
from asperity.mesh.glb import Node
from asperity.mesh.surface import Surface

STEEL, BRONZE, PAPER = "#AEB6BF", "#D9A860", "#FFFFFF"
SIZE = (1600, 1200)
_LIGHT = {"ambient": 0.2, "diffuse": 0.8, "specular": 0.25, "specular_power": 20.0}


@dataclass(frozen=True)
class Camera:
    """Direction from the body to the eye, what points up, enlargement of what just fits."""

    towards: tuple[float, float, float]
    up: tuple[float, float, float]
    zoom: float = 1.25


_WHEEL = Camera((-0.55, 0.75, 1.0), (0.0, 1.0, 0.0))
# A single tooth is tall.
_WHOLE = replace(_WHEEL, zoom=1.0)
_UPRIGHT = Camera((-0.5, -1.0, 0.45), (0.0, 0.0, 1.0), 1.2)
_FINER = 2
_FRAME_SIZE = (520 * _FINER, 520 * _FINER)
_FRAMES = 12
_FRAME_MS = 80


def pair_view(path: str | os.PathLike[str], wheel: Wheel, teeth: int = 9) -> Path:
    """Draw the worm at phase 0 in several teeth of the wheel, as PNG."""
    with _plotter(path, _WHEEL) as plotter:
        _add(plotter, mounted_worm(wheel.pair).surface(), STEEL)
        _add(plotter, centred_teeth(wheel, teeth).surface(), BRONZE)
    return Path(path)


def mesh_view(path: str | os.PathLike[str], mesh: HexMesh) -> Path:
    """Draw a mesh of teeth about the wheel's axis with its edges, as PNG."""
    with _plotter(path, _WHOLE) as plotter:
        plotter.add_mesh(
            _polygons(mesh.points, mesh.skin()),
            color=BRONZE, show_edges=True, edge_color="#404040", line_width=1.0,
        )  # fmt: skip
    return Path(path)


def turning_view(path: str | os.PathLike[str], scene: Node, starts: int) -> Path:
    """Draw a scene that turns on by a pitch, over and over, as WebP; its first frame is a still.

    After a pitch, a turn of the worm by so many starts, everything is as it was.
    """
    require_view()
    from PIL import Image

    frames = max(_FRAMES, 2 * _FRAMES // starts)
    made = []
    with _drawing(_FRAME_SIZE) as plotter:
        moved = [(_shown(plotter, *body), body) for body in _bodies(scene)]
        for k in range(frames):
            for actor, body in moved:
                actor.user_matrix = body.placed @ _matrix(
                    turned(2.0 * math.pi * body.turns * k / (frames * starts))
                )
            if k == 0:
                _look(plotter, _UPRIGHT)
            plotter.render()
            made.append(Image.fromarray(plotter.screenshot(return_img=True)).reduce(_FINER))
    first, *others = made
    options = {"duration": _FRAME_MS, "loop": 0, "quality": 70}

    def write(target: Path) -> None:
        first.save(target, "WEBP", save_all=True, append_images=others, **options)

    return write_atomically(path, write)


class _Moved(NamedTuple):
    """Surfaces that turn as one about their z axis, where that stands, and in what colour."""

    points: FloatArray
    triangles: IntArray
    colour: tuple[float, float, float]
    turns: float
    placed: FloatArray


def _bodies(node: Node, above: FloatArray | None = None) -> Iterator[_Moved]:
    """Yield what turns in a scene with all that it carries, of each colour."""
    placed = (np.eye(4) if above is None else above) @ _matrix(node.rotation, node.place)
    if not node.turns:
        for child in node.children:
            yield from _bodies(child, placed)
        return
    every = [*_surfaces(node, np.eye(4))]
    for colour in dict.fromkeys(colour for *_, colour in every):
        own = [(surface, at) for surface, at, of in every if of == colour]
        counts = np.cumsum([0, *(len(surface.points) for surface, _ in own)])
        yield _Moved(
            np.concatenate([s.points @ m[:3, :3].T + m[:3, 3] for s, m in own]),
            np.concatenate([s.triangles + n for (s, _), n in zip(own, counts, strict=False)]),
            colour,
            node.turns,
            placed,
        )


def _surfaces(
    node: Node, at: FloatArray
) -> Iterator[tuple[Surface, FloatArray, tuple[float, float, float]]]:
    if node.surface is not None:
        yield node.surface, at, node.colour
    for child in node.children:
        yield from _surfaces(child, at @ _matrix(child.rotation, child.place))


def _matrix(rotation: FloatArray, position: FloatArray | None = None) -> FloatArray:
    made = np.eye(4)
    made[:3, :3] = rotation
    made[:3, 3] = 0.0 if position is None else position
    return made


@contextlib.contextmanager
def _plotter(path: str | os.PathLike[str], camera: Camera) -> Iterator[Any]:
    """Give a plotter to draw with; what was drawn is written when the block ends well."""
    require_view()
    with _drawing(SIZE) as plotter:
        yield plotter
        _look(plotter, camera)
        plotter.enable_anti_aliasing("ssaa")
        write_atomically(path, lambda target: plotter.screenshot(str(target)))


@contextlib.contextmanager
def _drawing(size: tuple[int, int]) -> Iterator[Any]:
    import pyvista

    # Without a display VTK complains on standard error before it draws without one.
    with pyvista.vtk_verbosity("off"):
        plotter = pyvista.Plotter(off_screen=True, window_size=list(size), theme=_theme())
        try:
            yield plotter
        finally:
            plotter.close()


def _look(plotter: Any, camera: Camera) -> None:
    plotter.view_vector(camera.towards, viewup=camera.up)
    plotter.enable_parallel_projection()
    plotter.camera.zoom(camera.zoom)


def _theme() -> Any:
    from pyvista.plotting.themes import DocumentTheme

    theme = DocumentTheme()
    theme.background = PAPER
    theme.font.color = "black"
    return theme


def _polygons(points: FloatArray, faces: IntArray) -> Any:
    import pyvista

    return pyvista.PolyData.from_regular_faces(points, faces)


def _add(plotter: Any, surface: Surface, colour: str) -> None:
    _shown(plotter, surface.points, surface.triangles, colour)


def _shown(plotter: Any, points: FloatArray, triangles: IntArray, colour: Any, *_: Any) -> Any:
    look = {"smooth_shading": True, "split_sharp_edges": True, "feature_angle": 25.0}
    look |= _LIGHT
    return plotter.add_mesh(_polygons(points, triangles), color=colour, **look)

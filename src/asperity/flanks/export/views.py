"""Pictures in space of worm, wheel and meshes, drawn off-screen; they need the ``view`` extra."""

import contextlib
import os
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from asperity.arrays import FloatArray, IntArray
from asperity.flanks.export.extras import require_view
from asperity.flanks.export.tooth import centred_teeth
from asperity.flanks.export.worm import mounted_worm
from asperity.flanks.wheel.enveloped import Wheel
from asperity.mesh import HexMesh
from asperity.mesh.surface import Surface
from asperity.store import write_atomically

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


def _polygons(points: FloatArray, faces: IntArray) -> Any:
    import pyvista

    return pyvista.PolyData.from_regular_faces(points, faces)


def _add(plotter: Any, surface: Surface, colour: str) -> None:
    shown = _polygons(surface.points, surface.triangles)
    look = {"smooth_shading": True, "split_sharp_edges": True, "feature_angle": 25.0}
    look |= _LIGHT
    plotter.add_mesh(shown, color=colour, **look)

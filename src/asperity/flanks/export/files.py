"""The files of wheel and worm: meshes, surfaces, views, bodies."""

import contextlib
from pathlib import Path

from asperity.errors import MissingExtraError
from asperity.flanks.export.assembly import Assembly
from asperity.flanks.export.cad.solids import Solids
from asperity.flanks.export.space import views
from asperity.flanks.export.space.scene import gearset_scene, write_gearset
from asperity.flanks.export.tooth import tooth_body
from asperity.flanks.export.turned import Beside
from asperity.flanks.export.worm import worm_body
from asperity.flanks.wheel.enveloped import Wheel
from asperity.mesh import HexMesh
from asperity.mesh.inp import write_inp
from asperity.mesh.stl import write_stl
from asperity.mesh.vtu import write_vtu

GEARSET, TURNING = "gearset.glb", "turning.webp"
"""The gearset in space for any viewer, and its picture that turns."""


def write_bodies(
    wheel: Wheel,
    mesh: HexMesh,
    assembly: Assembly,
    folder: Path,
    *,
    beside: Beside = None,
    name: str = "worm gearset",
    solids: Solids | None = None,
) -> list[str]:
    """Write worm and wheel to a folder that exists, each file whole or not at all; return names.

    Views in space are left out where the ``view`` extra is not installed: `extras.require_view`.
    Solids of tooth, worm and wheel are written as STEP too.
    """
    write_vtu(folder / "tooth.vtu", mesh)
    write_inp(folder / "tooth.inp", mesh)
    names = ["tooth.vtu", "tooth.inp"]
    for body in (tooth_body(wheel), worm_body(wheel.pair)):
        write_stl(folder / f"{body.name}.stl", body.surface())
        names.append(f"{body.name}.stl")
    scene = gearset_scene(wheel, assembly, beside)
    write_gearset(folder / GEARSET, scene)
    names.append(GEARSET)
    with contextlib.suppress(MissingExtraError):
        views.pair_view(folder / "view-gearset.png", wheel)
        views.mesh_view(folder / "view-tooth-mesh.png", mesh)
        views.turning_view(folder / TURNING, scene, assembly.pair.geometry.starts)
        names += ["view-gearset.png", "view-tooth-mesh.png", TURNING]
    if solids is not None:
        names += solids.write(folder, name)
    return names

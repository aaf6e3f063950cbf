"""The files of wheel and worm: meshes, surfaces, views, bodies."""

import contextlib
from pathlib import Path

from asperity.errors import MissingExtraError
from asperity.flanks.export import views
from asperity.flanks.export.extras import require_cad
from asperity.flanks.export.step import write_step
from asperity.flanks.export.tooth import centred_teeth, tooth_body
from asperity.flanks.export.worm import mounted_worm, worm_body
from asperity.flanks.wheel.enveloped import Wheel
from asperity.mesh import HexMesh
from asperity.mesh.inp import write_inp
from asperity.mesh.surface_files import write_glb, write_stl
from asperity.mesh.vtu import write_vtu

_TEETH = 5
"""Teeth of the wheel in the file that shows worm and wheel."""


def write_bodies(wheel: Wheel, mesh: HexMesh, folder: Path, *, step: bool = False) -> list[str]:
    """Write worm and wheel to a folder that exists, each file whole or not at all; return names.

    Views in space are left out where the ``view`` extra is not installed: `extras.require_view`.
    ``step`` writes the tooth and the worm as STEP too, and needs the ``cad`` extra.
    """
    if step:
        require_cad()
    bodies = tooth_body(wheel), worm_body(wheel.pair)
    write_vtu(folder / "tooth.vtu", mesh)
    write_inp(folder / "tooth.inp", mesh)
    names = ["tooth.vtu", "tooth.inp"]
    for body in bodies:
        write_stl(folder / f"{body.name}.stl", body.surface())
        names.append(f"{body.name}.stl")
    parts = {"worm": mounted_worm(wheel.pair), "wheel": centred_teeth(wheel, _TEETH)}
    write_glb(folder / "gearset.glb", {name: body.surface() for name, body in parts.items()})
    names.append("gearset.glb")
    with contextlib.suppress(MissingExtraError):
        views.pair_view(folder / "view-gearset.png", wheel)
        views.mesh_view(folder / "view-tooth-mesh.png", mesh)
        names += ["view-gearset.png", "view-tooth-mesh.png"]
    if step:
        for body in bodies:
            write_step(folder / f"{body.name}.step", body)
            names.append(f"{body.name}.step")
    return names

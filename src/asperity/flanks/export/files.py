"""The files of wheel and worm: meshes, surfaces, views, bodies."""

import contextlib
from pathlib import Path

import numpy as np

from asperity.errors import MissingExtraError
from asperity.flanks.export import views
from asperity.flanks.export.assembly import Assembly
from asperity.flanks.export.brep import solid
from asperity.flanks.export.extras import require_cad
from asperity.flanks.export.scene import BRONZE, STEEL, write_gearset
from asperity.flanks.export.step import Component, write_assembly, write_step
from asperity.flanks.export.tooth import tooth_body, wheel_body
from asperity.flanks.export.worm import whole_worm, worm_body
from asperity.flanks.parameters import Blanks
from asperity.flanks.wheel.enveloped import Wheel
from asperity.mesh import HexMesh
from asperity.mesh.inp import write_inp
from asperity.mesh.stl import write_stl
from asperity.mesh.vtu import write_vtu


def write_bodies(
    wheel: Wheel,
    mesh: HexMesh,
    assembly: Assembly,
    folder: Path,
    *,
    blanks: Blanks | None = None,
    name: str = "worm gearset",
    step: bool = False,
) -> list[str]:
    """Write worm and wheel to a folder that exists, each file whole or not at all; return names.

    Views in space are left out where the ``view`` extra is not installed: `extras.require_view`.
    ``step`` writes a tooth, worm, wheel and both in mesh as STEP too, and needs the ``cad`` extra.
    """
    if step:
        require_cad()
    write_vtu(folder / "tooth.vtu", mesh)
    write_inp(folder / "tooth.inp", mesh)
    names = ["tooth.vtu", "tooth.inp"]
    one = tooth_body(wheel)
    for body in (one, worm_body(wheel.pair)):
        write_stl(folder / f"{body.name}.stl", body.surface())
        names.append(f"{body.name}.stl")
    write_gearset(folder / "gearset.glb", wheel, assembly, blanks)
    names.append("gearset.glb")
    with contextlib.suppress(MissingExtraError):
        views.pair_view(folder / "view-gearset.png", wheel)
        views.mesh_view(folder / "view-tooth-mesh.png", mesh)
        names += ["view-gearset.png", "view-tooth-mesh.png"]
    if step:
        write_step(folder / "tooth.step", one)
        names += ["tooth.step", *write_solids(wheel, assembly, folder, blanks=blanks, name=name)]
    return names


def write_solids(
    wheel: Wheel,
    assembly: Assembly,
    folder: Path,
    *,
    blanks: Blanks | None = None,
    name: str = "worm gearset",
) -> list[str]:
    """Write the whole wheel, the worm, and both in mesh as STEP; return the names of the files."""
    turned = Component(
        solid(whole_worm(assembly.pair, blanks)),
        assembly.worm_rotation,
        assembly.worm_place,
        STEEL,
    )
    hobbed = Component(
        solid(wheel_body(wheel, blanks)), assembly.wheel_rotation, np.zeros(3), BRONZE
    )
    for part in (turned, hobbed):
        write_step(folder / f"{part.solid.name}.step", part.solid)
    write_assembly(folder / "gearset.step", name, [turned, hobbed])
    return [*(f"{part.solid.name}.step" for part in (turned, hobbed)), "gearset.step"]

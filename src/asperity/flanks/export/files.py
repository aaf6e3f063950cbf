"""The files a study of flanks leaves: numbers, pictures, meshes, bodies."""

import dataclasses
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING

from asperity.errors import MissingExtraError
from asperity.flanks.export import views
from asperity.flanks.export.brep import require_cad
from asperity.flanks.export.patch import Body
from asperity.flanks.export.step import write_step
from asperity.flanks.export.together import centred_teeth, mounted_worm
from asperity.flanks.export.tooth import tooth_body
from asperity.flanks.export.worm import worm_body
from asperity.mesh.inp import write_inp
from asperity.mesh.surface_files import write_glb, write_stl
from asperity.mesh.vtu import write_vtu
from asperity.store import write_atomically, write_dataset

if TYPE_CHECKING:
    from asperity.flanks.result import FlankStudy

_DOTS_PER_INCH = 150
_TEETH = 5
"""Teeth of the wheel in the file that shows worm and wheel."""


@dataclasses.dataclass(frozen=True)
class Written:
    """What was written.

    Attributes
    ----------
    names : tuple of str
        The files, in their folder.
    notes : tuple of str
        What is not among them, and why.
    """

    names: tuple[str, ...]
    notes: tuple[str, ...]


def write_study(study: "FlankStudy", folder: Path, *, step: bool = False) -> Written:
    """Write what a study found to a folder, each file whole or not at all.

    Parameters
    ----------
    study : FlankStudy
        The study.
    folder : path
        A folder that exists.
    step : bool
        Also the tooth and the worm as STEP.

    Raises
    ------
    MissingExtraError
        STEP is asked for and the ``cad`` extra is not installed.
    StorageError
        A file cannot be written.
    """
    if step:
        require_cad()
    names, notes = [], []
    write_dataset(study.to_dataset(), folder / "flank.nc")
    names.append("flank.nc")
    for name, figure in study.pictures().items():
        write_atomically(
            folder / f"{name}.png",
            lambda target, drawn=figure: drawn.savefig(target, dpi=_DOTS_PER_INCH),  # type: ignore[misc]
        )
        names.append(f"{name}.png")
    tooth, worm = tooth_body(study.wheel), worm_body(study.wheel.pair)
    write_vtu(folder / "tooth.vtu", study.mesh)
    write_inp(folder / "tooth.inp", study.mesh)
    names += ["tooth.vtu", "tooth.inp"]
    names += _surfaces(study, folder, tooth, worm)
    try:
        names += _views(study, folder)
    except MissingExtraError as error:
        notes.append(str(error))
    if step:
        for body in (tooth, worm):
            write_step(folder / f"{body.name}.step", body)
            names.append(f"{body.name}.step")
    return Written(tuple(names), tuple(notes))


def _surfaces(study: "FlankStudy", folder: Path, tooth: Body, worm: Body) -> Iterator[str]:
    for body in (tooth, worm):
        write_stl(folder / f"{body.name}.stl", body.surface())
        yield f"{body.name}.stl"
    parts = {"worm": mounted_worm(study.wheel), "wheel": centred_teeth(study.wheel, _TEETH)}
    write_glb(folder / "gearset.glb", {name: body.surface() for name, body in parts.items()})
    yield "gearset.glb"


def _views(study: "FlankStudy", folder: Path) -> Iterator[str]:
    wheel = study.wheel
    drawn: dict[str, Callable[[Path], object]] = {
        "view-gearset": lambda path: views.pair_view(path, wheel),
        "view-tooth-mesh": lambda path: views.mesh_view(path, study.mesh),
    }
    for name, draw in drawn.items():
        draw(folder / f"{name}.png")
        yield f"{name}.png"

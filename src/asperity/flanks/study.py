"""The study of a worm gearset's flanks, from the tables of a case."""

import contextlib
import dataclasses
import time
from collections.abc import Iterator, Mapping
from typing import TypeVar

import numpy as np

from asperity.casefile import Case, Table
from asperity.errors import InputError
from asperity.flanks.backlash import Play, play, set_backlash
from asperity.flanks.conjugacy import conjugacy_residual
from asperity.flanks.ease_off import ease_off
from asperity.flanks.kinematics import kinematics
from asperity.flanks.mesh import element_size, tooth
from asperity.flanks.parameters import Disc, Hob, Modification, Mount
from asperity.flanks.pattern import pattern
from asperity.flanks.remarks import assumptions, from_memory
from asperity.flanks.result import MICROMETRES, FlankResult, FlankStudy
from asperity.flanks.setting import Pair
from asperity.flanks.transmission import Transmission, transmission
from asperity.flanks.vibration_share import vibration_share
from asperity.flanks.wheel import Wheel
from asperity.gearset import Gearset

ROWS, COLUMNS = 30, 41
"""Points of a flank that what is found of it is given at."""

SIDES = (1, -1)

T = TypeVar("T", bound=Table)


@dataclasses.dataclass(frozen=True)
class Prepared:
    """What a study begins with; what can be refused without work has been.

    Attributes
    ----------
    gearset : Gearset
        The gearset.
    hob, mount, modification, disc : Hob, Mount, Modification, Disc or None
        How it is cut, mounted, modified and ground.
    density : str or float
        Density of the mesh: its name, or the element size in mm.
    pair : Pair
        What follows from the tables.
    source : str
        The case they come from, for messages; empty for none.
    """

    gearset: Gearset
    hob: Hob | None
    mount: Mount | None
    modification: Modification | None
    disc: Disc | None
    density: str | float
    pair: Pair
    source: str = ""


def prepare(
    gearset: Gearset,
    hob: Hob | None = None,
    mount: Mount | None = None,
    modification: Modification | None = None,
    disc: Disc | None = None,
    density: str | float = "intermediate",
) -> Prepared:
    """Return what a study begins with.

    Parameters
    ----------
    gearset : Gearset
        The gearset.
    hob, mount, modification, disc : Hob, Mount, Modification, Disc, optional
        How it is cut, mounted, modified and ground; each has its defaults if left out.
    density : str or float
        Density of the mesh: its name, or the element size on the flank in mm.

    Raises
    ------
    InputError
        The numbers do not belong together, make no solid worm or hob, or the density does not
        exist.
    """
    pair = Pair.of(gearset, hob, mount, modification, disc)
    if isinstance(density, str):
        element_size(Wheel(pair), density)
    return Prepared(gearset, hob, mount, modification, disc, density, pair)


def prepare_case(case: Case, density: str | float = "intermediate") -> Prepared:
    """Return what the study of a case file begins with; as `prepare`."""

    def table(model: type[T]) -> T | None:
        return case.require(model) if model.table in case else None

    gearset = case.require(Gearset)
    with _named(case.source):
        prepared = prepare(
            gearset, table(Hob), table(Mount), table(Modification), table(Disc), density
        )
    return dataclasses.replace(prepared, source=case.source)


def study(prepared: Prepared) -> FlankStudy:
    """Cut the wheel of a gearset, and find how it meshes.

    Raises
    ------
    InputError
        There is no such wheel, with the reason, or the mesh would take too much memory.
    ConvergenceError
        The worm does not reach the wheel somewhere, or no thread has the backlash.
    """
    with _named(prepared.source):
        return _study(prepared)


def _study(prepared: Prepared) -> FlankStudy:
    began = time.perf_counter()
    wheel = Wheel.cut(prepared.pair)
    mesh = tooth(wheel, prepared.density)
    if isinstance(prepared.density, str):
        size, density = element_size(wheel, prepared.density), prepared.density
    else:
        size, density = prepared.density, f"{prepared.density:g} mm"
    meshes = {side: transmission(prepared.pair, wheel.flank(side)) for side in SIDES}
    if prepared.pair.backlash is not None:
        meshes = set_backlash(meshes, prepared.pair.backlash)
        wheel = Wheel(meshes[1].search.pair)
    found = {side: _flank(wheel, meshes[side]) for side in SIDES}
    room = play(meshes)
    assumed = assumptions(prepared.gearset, prepared.hob, prepared.disc)
    return FlankStudy(
        name=prepared.gearset.name,
        wheel=wheel,
        flanks=found,
        play=room,
        mesh=mesh,
        density=density,
        element_size=size,
        assumed=assumed,
        from_memory=from_memory(prepared.gearset, assumed),
        notes=_notes(found, room),
        seconds=time.perf_counter() - began,
    )


@contextlib.contextmanager
def _named(source: str) -> Iterator[None]:
    """Let a refusal begin with the case that is refused."""
    try:
        yield
    except InputError as error:
        if source:
            error.args = (f"{source}: {error}", *error.args[1:])
        raise


def _flank(wheel: Wheel, mesh: Transmission) -> FlankResult:
    pair, flank = wheel.pair, wheel.flank(mesh.search.flank.side)
    grid = flank.grid(ROWS, COLUMNS)
    motion = kinematics(pair, grid, flank.side, ahead=flank.side * mesh.mean)
    return FlankResult(
        side=flank.side,
        mirror=pair.mirror,
        transmission=mesh,
        pattern=pattern(mesh, grid),
        ease_off=ease_off(flank, grid),
        motion=motion,
        share=vibration_share(pair, motion),
        area=flank.area(),
        undercut=bool(np.any(flank.undercut_at(grid.z[0]))),
        conjugacy_residual=float(np.abs(conjugacy_residual(flank, grid)).max()),
    )


def _notes(flanks: Mapping[int, FlankResult], room: Play) -> tuple[str, ...]:
    notes = []
    least = min(room.normal.values())
    if least < -1e-9:
        notes.append(
            f"the threads of nominal thickness would cut {-MICROMETRES * least:.3g} um into the "
            "wheel: give mount.backlash, and they are made thinner"
        )
    undercut = [f"{side:+d}" for side, found in flanks.items() if found.undercut]
    if undercut:
        notes.append(f"the hob undercuts the wheel: flank s = {' and '.join(undercut)}")
    if not all(found.ease_off.compared.all() for found in flanks.values()):
        notes.append(
            "near the root the flanks reach where an identical hob leaves its fillet; the ease-off "
            "is not counted there"
        )
    return tuple(notes)

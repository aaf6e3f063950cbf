"""The study of a worm gearset's flanks, from the tables of a case."""

import dataclasses
import time
from collections.abc import Mapping
from typing import ClassVar

from asperity.casefile import Case, naming_source
from asperity.errors import InputError, MissingExtraError
from asperity.flanks import parameters
from asperity.flanks.export.assembly import Assembly
from asperity.flanks.export.cad.keyway import require_keys
from asperity.flanks.export.extras import require_cad, require_draw, require_view
from asperity.flanks.export.turned import Bodies
from asperity.flanks.measuring import measures
from asperity.flanks.mesh.tooth import element_size, read_density, tooth
from asperity.flanks.meshing import lubrication
from asperity.flanks.meshing.analysis import MICROMETRES, Analysis, analyse
from asperity.flanks.meshing.backlash import core_clearance
from asperity.flanks.meshing.lubrication import Load
from asperity.flanks.parameters import Disc, Hob, MeasuringOptions, Modification, Mount
from asperity.flanks.study.meshed import ToothMesh
from asperity.flanks.study.result import FlankStudy
from asperity.flanks.study.toleranced import Toleranced, require_once
from asperity.flanks.wheel.enveloped import Wheel
from asperity.flanks.worm.setting import Pair
from asperity.gearset import Gearset
from asperity.gearset.proportions import SOURCES as PROPORTIONS
from asperity.gearset.tolerancing.backlash import backlash
from asperity.gearset.tolerancing.table import Tolerances
from asperity.rating import Operation, RatingOptions, rate_case
from asperity.rating.backlash import worn
from asperity.rating.driven import driven
from asperity.rating.regime import Film
from asperity.runs import Run
from asperity.sources import Source

_TOUCH = 1e-9
_ZERO_CELSIUS = 273.15
_HERTZ = (
    "Hertzian pressures are those of contact lines that all give alike, edges left out; what a "
    "gear bears under load, with its edges, asperity drive --static resolves"
)
_CUSTOMARY = {
    "disc.diameter": f"{1e3 * parameters.DISC_DIAMETER:g} mm",
    "disc.profile_radius": f"{parameters.DISC_PROFILE_RADIUS:g} modules",
    "hob.tip_radius": f"{parameters.HOB_TIP_RADIUS:g} modules, or what there is room for",
}
_OUTSIDE = Source(
    "MITCalc 1.74; SDP/SI, Elements of Metric Gear Technology, section 17", "verified", "d_a2 + m"
)


@dataclasses.dataclass(frozen=True)
class Prepared:
    """What a study begins with; what can be refused without much work has been.

    The notes are of the load; ``step`` says whether its files are to hold STEP, ``seconds`` what it
    took; the wear is that of the life by ISO/TR 14521, um.
    """

    gearset: Gearset
    hob: Hob | None
    disc: Disc | None
    wheel: Wheel
    mesh: ToothMesh
    seconds: float
    load: Load | None = None
    notes: tuple[str, ...] = ()
    step: bool = False
    dxf: bool = False
    beside: Bodies | None = None
    measuring: MeasuringOptions | None = None
    tolerances: Tolerances | None = None
    wear: float | None = None


def prepare_gearset(
    gearset: Gearset,
    hob: Hob | None = None,
    mount: Mount | None = None,
    modification: Modification | None = None,
    disc: Disc | None = None,
    density: str | float = "intermediate",
) -> Prepared:
    """Cut the wheel of a gearset, and mesh a tooth of it.

    Parameters
    ----------
    gearset : Gearset
        Worm and wheel.
    hob, mount, modification, disc : Hob, Mount, Modification, Disc, optional
        How the wheel is cut, how both are mounted, how the worm's flank differs from its type,
        and what grinds it.
    density : str or float
        ``coarse``, ``intermediate``, ``fine``, or the element size on the flank, mm.

    Returns
    -------
    Prepared
        Wheel and mesh, for `study`.

    Raises
    ------
    InputError
        There is no such wheel, with the reason, or no such mesh, or it would take too much memory.
    """
    began = time.perf_counter()
    wheel = Wheel.cut(Pair.of(gearset, hob, mount, modification, disc))
    if isinstance(density, str):
        size, name = element_size(wheel, density), density
    else:
        size, name = density, f"{density:g} mm"
    mesh = ToothMesh.of(tooth(wheel, size), name, size)
    return Prepared(gearset, hob, disc, wheel, mesh, time.perf_counter() - began)


def prepare(
    case: Case, *, density: str | float = "intermediate", step: bool = False, dxf: bool = False
) -> Prepared:
    """Return what the study of a case begins with.

    Parameters
    ----------
    case : Case
        With its gearset.
    density : str or float
        Of the mesh: ``coarse``, ``intermediate``, ``fine``, or the element size on the flank, as
        text with its unit or in mm.
    step : bool
        Whether the files are to hold tooth, worm, wheel and both in mesh as STEP.
    dxf : bool
        Whether they are to hold a drawing as DXF.

    Returns
    -------
    Prepared
        As of `prepare_gearset`.

    Raises
    ------
    InputError
        As from `prepare_gearset`.
    MissingExtraError
        STEP is asked for and the ``cad`` extra is not installed, or DXF without ``draw``.
    """
    if step:
        require_cad()
    if dxf:
        require_draw()
    size = read_density(density) if isinstance(density, str) else density
    gearset = case.require(Gearset).require_consistent()
    made = prepare_gearset(
        gearset, case.get(Hob), case.get(Mount), case.get(Modification), case.get(Disc), size
    )
    pair = made.wheel.pair
    with naming_source(case):
        beside = Bodies.of(case, pair)
        require_keys(pair, beside)
    tolerances, measuring = case.get(Tolerances), case.get(MeasuringOptions)
    require_once(tolerances, case.get(Mount), measuring)
    if tolerances is not None:
        backlash(gearset, tolerances)
    load, notes = _load(case, gearset)
    return dataclasses.replace(
        made,
        load=load,
        notes=tuple(notes),
        step=step,
        dxf=dxf,
        beside=beside,
        measuring=measuring,
        tolerances=tolerances,
        wear=None if tolerances is None else _wear(case),
    )


def answer(prepared: Prepared, run: Run) -> FlankStudy:
    """Find how a gearset meshes, as the command does; errors as in `study`."""
    if run.folder is None:
        for asked in ("step", "dxf"):
            if getattr(prepared, asked):
                raise InputError(
                    f"--{asked}: there is no folder for the files; name one with --out DIR"
                )
        return study(prepared)
    try:
        require_view()
    except MissingExtraError as error:
        run.notify(str(error))
    return study(prepared)


def study(prepared: Prepared) -> FlankStudy:
    """Find how a gearset meshes.

    Parameters
    ----------
    prepared : Prepared
        From `prepare` or `prepare_gearset`.

    Returns
    -------
    FlankStudy
        Contact lines, pattern, transmission error, measures and mesh.

    Raises
    ------
    InputError
        The worm's threads cannot leave the backlash.
    ConvergenceError
        The worm does not reach the wheel somewhere, or no thread leaves the backlash.
    """
    began = time.perf_counter()
    pair, load = prepared.wheel.pair, prepared.load
    notes = list(prepared.notes)
    try:
        found = analyse(pair, prepared.wheel, load=load)
    except InputError as error:
        if load is None:
            raise
        found = analyse(pair, prepared.wheel, worm_speed=load.worm_speed)
        notes.append(f"no load on the contact lines: {error}")
    wheel = Wheel(found.pair)
    off = None
    if prepared.tolerances is not None:
        off = Toleranced.of(prepared.gearset, wheel, found, prepared.tolerances, prepared.wear)
    between = None if off is None else off.backlash
    measured = measures.measure(wheel, found.play, prepared.measuring, between)
    assembly = Assembly.of(found, made=prepared.step)
    if assembly.thinned:
        less = MICROMETRES * assembly.thinned
        notes.append(
            f"in worm.step and gearset.step the threads are {less:.3g} um thinner along the axis, "
            "so that they do not overlap the wheel"
        )
    loaded = [lines for flank in found.flanks.values() for lines in flank.loaded]
    if loaded:
        # Where the entrainment turns its sign there is no film: the mean tells of the flank.
        thinnest = min(lines.numbers.film_mean for lines in loaded)
        notes.append(Film(thinnest, 1e6 * prepared.gearset.worm_roughness).sentence())
    assumed = _assumed(prepared.gearset, prepared.hob, prepared.disc)
    kind = MountedStudy if off is not None and off.corners else FlankStudy
    return kind(
        name=prepared.gearset.name,
        wheel=wheel,
        analysis=found,
        mesh=prepared.mesh,
        assumed=assumed,
        from_memory=_from_memory(prepared.gearset, assumed, loaded=load is not None),
        notes=(*_notes(found, prepared.wheel), *notes),
        seconds=prepared.seconds + time.perf_counter() - began,
        assembly=assembly,
        measuring=measured,
        step=prepared.step,
        dxf=prepared.dxf,
        beside=prepared.beside,
        toleranced=off,
    )


def _notes(found: Analysis, wheel: Wheel) -> list[str]:
    notes = []
    least = min(found.play.normal.values())
    if least < -_TOUCH:
        notes.append(
            f"the threads of nominal thickness would cut {-MICROMETRES * least:.3g} um into the "
            "wheel: give mount.backlash, and they are made thinner"
        )
    room = core_clearance(found.pair, wheel.blank)
    if room < -_TOUCH:
        notes.append(
            f"the wheel's tips would reach {-MICROMETRES * room:.3g} um into the worm's core: look "
            "at mount.centre_distance_error"
        )
    flanks = found.flanks.values()
    if any(flank.undercut for flank in flanks):
        notes.append("the hob undercuts the wheel")
    if not all(flank.ease_off.compared.all() for flank in flanks):
        notes.append(
            "near the root the flanks reach where an identical hob leaves its fillet; the ease-off "
            "is not counted there"
        )
    return notes


def _load(case: Case, gearset: Gearset) -> tuple[Load | None, list[str]]:
    """The load of a case that says how the gearset is run, and what is to be said of it."""
    operation = case.get(Operation)
    if operation is None:
        return None, []
    try:
        operation = driven(gearset, operation, case.get(RatingOptions))
    except InputError as error:
        return None, [f"no load on the contact lines, for want of a torque: {error}"]
    if operation.oil_temperature is not None:
        return Load.of(gearset, operation, operation.oil_temperature), [_HERTZ]
    try:
        rated = rate_case(case, ("iso14521",)).iso14521
    except InputError as error:
        return None, [f"no load on the contact lines, for want of the oil's temperature: {error}"]
    sump = float(rated["theta_S_degC"]) if rated is not None else 0.0
    note = f"oil at {sump:.4g} degC, from the heat balance of ISO/TR 14521"
    return Load.of(gearset, operation, sump + _ZERO_CELSIUS), [_HERTZ, note]


def _wear(case: Case) -> float | None:
    """Depth that the life wears off the wheel's flanks, um; None where the standard cannot say."""
    if case.get(Operation) is None:
        return None
    try:
        return worn(rate_case(case, ("iso14521",)).found)
    except InputError:
        return None


def _assumed(gearset: Gearset, hob: Hob | None, disc: Disc | None) -> dict[str, str]:
    """Return the keys that bear on the flanks and were left out, and what was assumed for them."""
    found = {
        f"gearset.{key}": text
        for key, text in gearset.assumed.items()
        if key not in ("worm_roughness",)
    }
    if hob is None:
        found["hob"] = "identical to the worm"
    elif "oversize" not in hob.model_fields_set:
        found["hob.oversize"] = "1, the worm's own size"
    if hob is None or hob.tip_radius is None:
        found["hob.tip_radius"] = _CUSTOMARY["hob.tip_radius"]
    for key in _ground(gearset):
        name = key.partition(".")[2]
        if disc is None or name not in disc.model_fields_set:
            found[key] = _CUSTOMARY[key]
    return found


def _from_memory(
    gearset: Gearset, assumed: dict[str, str], *, loaded: bool = False
) -> dict[str, str]:
    """Return what rests on something that no document at hand confirms, with its source."""
    sources = {
        f"gearset.tooth_proportions {gearset.tooth_proportions}": PROPORTIONS[
            gearset.tooth_proportions
        ],
        "outside diameter of the wheel": _OUTSIDE,
        **{key: parameters.SOURCES[key] for key in assumed if key in parameters.SOURCES},
        **(lubrication.SOURCES if loaded else {}),
    }
    return {
        key: source.name + (f"; {source.note}" if source.note else "")
        for key, source in sources.items()
        if source.confidence == "from memory"
    }


def _ground(gearset: Gearset) -> tuple[str, ...]:
    return {"ZK": ("disc.diameter",), "ZC": ("disc.diameter", "disc.profile_radius")}.get(
        gearset.flank, ()
    )


class MountedStudy(FlankStudy):
    """The flanks of a worm gearset, and their contact at the corners of how it may be mounted."""

    drawings: ClassVar[Mapping[str, str]] = {
        **FlankStudy.drawings,
        "corners": "asperity.flanks.study.plots:corners",
    }
    captions: ClassVar[Mapping[str, str]] = {
        **FlankStudy.captions,
        "corners": "The pattern of the flank s = +1 at the corners of the mounting tolerances.",
    }

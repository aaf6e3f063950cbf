"""What ``asperity shafts`` does: both shafts of a gearset, by the tables of a case."""

import dataclasses
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

from asperity.casefile import Case, naming_source
from asperity.errors import InputError
from asperity.gearset.blanks import Blanks
from asperity.gearset.parameters import Gearset
from asperity.rating.bs721.tables import Tables
from asperity.rating.driven import driven
from asperity.rating.inputs import Inputs, inputs, scaled
from asperity.rating.parameters import Operation, RatingOptions
from asperity.rating.rated import Rated
from asperity.rating.result import Rating
from asperity.rating.standards import rate_by, tables_of
from asperity.rating.tables import operation_of
from asperity.rating.verdict_rows import Row
from asperity.runs import Run
from asperity.shafts.loads import (
    Condition,
    Load,
    cases_of,
    loads_of,
    on_wheel_shaft,
    on_worm_shaft,
)
from asperity.shafts.model import Model, model_of
from asperity.shafts.options import BearingOptions
from asperity.shafts.parameters import WheelShaft, WormShaft
from asperity.shafts.result import ShaftStudy
from asperity.shafts.shaft import LoadedShaft, find_shaft
from asperity.shafts.shape import require_once, shape_of
from asperity.shafts.statics import PointLoad

_MIDWAY = 1e-3
_DEFLECTION = "safety_deflection", "delta_m_mm"


class Prepared(NamedTuple):
    """What is solved."""

    rating_inputs: Inputs
    tables: Tables
    worm: Model | None
    wheel: Model | None
    options: BearingOptions
    blanks: Blanks | None = None


def given_shafts(case: Case) -> bool:
    """Whether a case has a shaft."""
    return WormShaft.table in case or WheelShaft.table in case


def prepare(case: Case) -> Prepared:
    """Return the shafts of a case.

    Parameters
    ----------
    case : Case
        With ``[gearset]``, ``[operation]`` and one of ``[worm_shaft]`` and ``[wheel_shaft]``.

    Returns
    -------
    Prepared
        For `answer`.

    Raises
    ------
    InputError
        It has none, or its gearset's numbers do not belong together.
    """
    gearset = case.require(Gearset)
    if not given_shafts(case):
        raise InputError(
            f"{case.source}: the table [worm_shaft] is missing, and [wheel_shaft]; add one"
        )
    with naming_source(case):
        gearset.require_consistent()
        worm, wheel, blanks = case.get(WormShaft), case.get(WheelShaft), case.get(Blanks)
        g = gearset.geometry
        shapes = (None if table is None else shape_of(table, g) for table in (worm, wheel))
        require_once(blanks, *shapes)
        found = prepared(
            gearset,
            operation_of(case),
            case.get(RatingOptions, RatingOptions()),
            (worm, wheel),
            case.get(BearingOptions, BearingOptions()),
            case.folder,
        )
        return found._replace(blanks=blanks)


def prepared(
    gearset: Gearset,
    operation: Operation,
    options: RatingOptions,
    shafts: tuple[WormShaft | None, WheelShaft | None],
    bearing_options: BearingOptions,
    folder: Path | None = None,
) -> Prepared:
    """Return the shafts of a gearset: the worm's and the wheel's, None where there is none.

    Raises
    ------
    InputError
        The gearset's numbers do not belong together.
    """
    operation = driven(gearset, operation, options)
    gearset.require_consistent()
    worm, wheel = (None if one is None else model_of(one, gearset.geometry) for one in shafts)
    rating_inputs = inputs(gearset, operation, options)
    return Prepared(rating_inputs, tables_of(options, folder), worm, wheel, bearing_options)


def answer(problem: Prepared, _: Run) -> ShaftStudy:
    """Find what both shafts and their bearings come to.

    Parameters
    ----------
    problem : Prepared
        From `prepare`.

    Returns
    -------
    ShaftStudy
        Loads, deflection, safeties and lives.

    Raises
    ------
    InputError
        ISO/TR 14521 has no answer for the gearset, whose losses the loads follow from.
    """
    return studied(problem)


def studied(problem: Prepared, rating: Rating | None = None) -> ShaftStudy:
    """Return what both shafts come to, by a rating by ISO/TR 14521 where there is one."""
    iso = rating or rate_by("iso14521", problem.rating_inputs, problem.tables)
    return study(problem, loads_of(problem.rating_inputs, iso), iso)


def study(problem: Prepared, loads: tuple[Load, ...], iso: Rating) -> ShaftStudy:
    """Return what both shafts come to under given loads, beside a rating by ISO/TR 14521."""
    return ShaftStudy.of(
        problem.rating_inputs,
        found_of(problem, loads),
        loads,
        asked_life(problem, loads),
        (float(iso["delta_m_mm"]), float(iso["delta_lim_mm"])) if "delta_m_mm" in iso else None,
        problem.blanks,
    )


def asked_life(problem: Prepared, loads: tuple[Load, ...]) -> float:
    """Return the life that the bearings must reach, h."""
    if problem.options.life is not None:
        return scaled(problem.options.life, 1.0 / 3600.0)
    return float(sum(load.hours for load in loads))


def found_of(problem: Prepared, loads: tuple[Load, ...]) -> dict[str, LoadedShaft]:
    """Return both shafts under loads, by table."""
    inputs, options = problem.rating_inputs, problem.options
    hand = 1.0 if inputs.gearset.hand == "right" else -1.0
    cases = cases_of(loads, options.raises)

    def on_worm(load: Load, case: Condition) -> PointLoad:
        assert problem.worm is not None
        force = load.on_worm(case, hand)
        return on_worm_shaft(problem.worm.mesh, force, float(inputs.worm_pitch_diameter))

    def on_wheel(load: Load, case: Condition) -> PointLoad:
        assert problem.wheel is not None
        force = load.on_worm(case, hand)
        return on_wheel_shaft(problem.wheel.mesh, force, float(inputs.wheel_mean_diameter))

    found: dict[str, LoadedShaft] = {}
    if problem.worm is not None:
        found["worm_shaft"] = find_shaft(
            problem.worm, loads, cases, options, on_worm, of_wheel=False
        )
    if problem.wheel is not None:
        found["wheel_shaft"] = find_shaft(
            problem.wheel, loads, cases, options, on_wheel, of_wheel=True
        )
    return found


def rows_by(case: Case) -> Callable[[Gearset], tuple[Row, ...]] | None:
    """Return what says of another gearset what a case's shafts come to; None without shafts.

    Parameters
    ----------
    case : Case
        With all but the gearset that is asked about.
    """
    if not given_shafts(case):
        return None
    operation, options = operation_of(case), case.get(RatingOptions, RatingOptions())
    shafts = case.get(WormShaft), case.get(WheelShaft)
    asked = case.get(BearingOptions, BearingOptions())
    return lambda gearset: (
        studied(prepared(gearset, operation, options, shafts, asked, case.folder)).rows
    )


def overhang_by(case: Case) -> str:
    """Return where the mesh of a case's worm lies beyond its bearings; empty between them."""
    if WormShaft.table not in case:
        return ""
    return model_of(case.require(WormShaft), case.require(Gearset).geometry).overhang


def _off_centre(worm: Model) -> str:
    """Say that the worm's mesh is not midway between its bearings, where the standard has it."""
    first, second = worm.bearings
    place, span = worm.mesh - first, second - first
    if abs(place - 0.5 * span) <= _MIDWAY * span or worm.overhang:
        return ""
    return (
        f"worm_shaft: its mesh is {place:.4g} mm from bearing A, of {span:.4g} mm; forces on "
        "bearings and deflection by ISO/TR 14521 have it midway, asperity shafts where it is"
    )


def _judged(rated: Rated, worm: Model | None) -> Rated:
    """Return a rating without the standard's deflection where the worm overhangs."""
    iso = rated.iso14521
    if iso is None or worm is None or not worm.overhang or _DEFLECTION[0] not in iso:
        return rated
    why = (
        f"the worm overhangs, its mesh {worm.overhang}; the worm as a beam, below, has its "
        "deflection"
    )
    first = rated.verdict.first
    found = dataclasses.replace(rated, iso14521=iso.without(_DEFLECTION, why))
    if first is not None and first.demand.path == f"iso14521.{_DEFLECTION[0]}":
        # What moves a safety that is none is of no use.
        return dataclasses.replace(found, levers=(), alternatives=())
    return found


def beside_rating(case: Case) -> Callable[[Rated, Run], Rated]:
    """Return what adds shafts and bearings of a case to its rating: a row for each of them.

    Parameters
    ----------
    case : Case
        With ``[worm_shaft]``, ``[wheel_shaft]`` or both.

    Returns
    -------
    callable
        Takes the rating and a run, and returns the rating with the rows.

    Raises
    ------
    InputError
        As from `prepare`.
    """
    problem = prepare(case)

    def add(rated: Rated, _: Run) -> Rated:
        shafts = studied(problem, rated.iso14521)
        models = [one.model for one in shafts.found.values()]
        wrong = [seat.why for model in models for seat in model.misseated]
        wrong += [model.threads for model in models if model.threads]
        wrong += [_off_centre(model) for model in models if model is problem.worm]
        return dataclasses.replace(
            _judged(rated, problem.worm),
            rows=(*rated.rows, *shafts.rows),
            shafts=shafts,
            notes=(*rated.notes, *filter(None, wrong)),
        )

    return add

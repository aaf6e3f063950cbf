"""The command ``asperity rig report``: the recordings of a folder on one page."""

import dataclasses
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from asperity.casefile import Case, read_case
from asperity.errors import AsperityError, InputError, plain
from asperity.runs import Run
from asperity.tribometer.channels import Channels
from asperity.tribometer.deposit import Package
from asperity.tribometer.geared import GearPair
from asperity.tribometer.options import Plan
from asperity.tribometer.pair import BOUNDARY, Pair
from asperity.tribometer.pairs import pair_of
from asperity.tribometer.parameters import Conditions, Lubricant
from asperity.tribometer.recording import Recording
from asperity.tribometer.reduction import study as reduction
from asperity.tribometer.reduction.result import REFUSED, Reduced, SegmentResult
from asperity.tribometer.reduction.study import Reducible, Series
from asperity.tribometer.report.result import Report
from asperity.tribometer.report.standards import friction, headings_of
from asperity.tribometer.sheets import sheets

_BESIDE = Conditions.table, Package.table  # of a case, what no recording needs
_ANSWERS = Reduced.stem, "run", "plan"  # that commands leave beside recordings


@dataclasses.dataclass(frozen=True)
class Gathered(Case):
    """The configuration of a folder's first recording, with all of them, and what was left out."""

    reducible: tuple[Reducible, ...] = ()
    refused: tuple[tuple[str, str], ...] = ()
    standard: str = ""


def read(
    case: str,
    known: Mapping[str, Any],
    settings: Sequence[str],
    *,
    folder: str,
    config: str = "",
    standard: str = "",
    **_: Any,
) -> Case:
    """Open every recording in a folder; what is none is left out and named."""
    place = Path(folder)
    if not place.is_dir():
        raise InputError(f"{plain(folder)} is not a folder; give the one that holds recordings")
    told = read_case(config, known, settings).raw if config else {}
    beside = {name: told[name] for name in _BESIDE if name in told}
    if config and not beside:
        tables = " or ".join(f"[{name}]" for name in _BESIDE)
        raise InputError(f"--config {config} has no {tables}, which is all that is taken from it")
    found: list[Reducible] = []
    refused: list[tuple[str, str]] = []
    for path in sorted(place.glob("*.nc")):
        try:
            recording = Recording.open(path)
            own = recording.case(known)
            own = dataclasses.replace(own, raw=own.raw | beside).replace(settings)
            found.append(Reducible(recording, own))
            geared = pair_of(found[-1].case).geared
            if geared != pair_of(found[0].case).geared:
                raise InputError("it is of another kind of rig than the first; give each a folder")
            found[-1].case.require(Channels)
        except AsperityError as error:
            if path.stem not in _ANSWERS:
                refused.append((plain(path.name), str(error)))
            found = [one for one in found if one.recording.path != path]
    if not found:
        why = (
            f": {refused[0][0]}: {refused[0][1]}"
            if refused
            else "; recordings come from asperity rig run or asperity rig import --out"
        )
        raise InputError(f"{plain(folder)} holds no recording that can be reduced{why}")
    first = found[0].case
    if standard and pair_of(first).geared:
        raise InputError(
            f"--standard {standard} asks for friction and wear of discs; of a worm and its wheel "
            "leave it out"
        )
    values = {field.name: getattr(first, field.name) for field in dataclasses.fields(Case)}
    return Gathered(
        **(values | {"source": plain(folder)}), reducible=tuple(found), refused=tuple(refused),
        standard=standard,
    )  # fmt: skip


def prepare(case: Case, **_: Any) -> Gathered:
    """Return what was gathered."""
    if not isinstance(case, Gathered):
        raise InputError("a report is made of a folder of recordings")
    return case


def answer(problem: Gathered, run: Run) -> Report:
    """Reduce the recordings and gather what the page says."""
    reduced = reduction.answer(Series(problem.reducible), run)
    left = [
        (f"{one.file}, segment at {one.start or 0.0:.0f} s", "; ".join(one.flags))
        for one in reduced.segments
        if one.quality == REFUSED
    ]
    recordings = [one.recording for one in problem.reducible]
    channels = problem.require(Channels)
    return Report(
        sheets=sheets(channels), standard=problem.standard,
        asked=(
            headings_of(problem.standard, problem, reduced, recordings) if problem.standard else ()
        ),
        friction=friction(problem, reduced.segments) if problem.standard else None,
        reduced=reduced, conditions=tuple(_conditions(problem, reduced.segments)),
        geared=pair_of(problem).geared, refused=(*problem.refused, *left),
        recordings=len(problem.reducible),
        measured=sum(one.quality != REFUSED for one in reduced.segments),
        left_out=len(problem.refused) + len(left), planned=_cells(problem),
        simulated=any(one.recording.simulated for one in problem.reducible), notes=reduced.notes,
    )  # fmt: skip


def _cells(case: Case) -> int:
    from asperity.tribometer.parameters import Limits
    from asperity.tribometer.plan.matrix import planned_files

    plan = case.get(Plan, Plan())
    limits = case.get(Limits, Limits())
    if not plan.frequencies or not plan.steel_supplies:
        return 0
    return sum(len(one.cells) for one in planned_files(plan, limits))


def _conditions(problem: Gathered, segments: Sequence[SegmentResult]) -> Iterator[tuple[str, str]]:
    """Yield what the tests were made under, in words."""
    pair = pair_of(problem)
    yield "rig", pair.rig.name
    if isinstance(pair, GearPair):
        yield from _of_gears(pair)
    else:
        yield from _of_discs(pair)
    if Lubricant.table in problem:
        oil = problem.require(Lubricant)
        yield "lubricant", f"{oil.kind} {oil.name}".strip()
    films = [one.film_parameter for one in segments if one.film_parameter is not None]
    if films:
        regime = "boundary lubrication" if max(films) < BOUNDARY else "not boundary lubrication"
        yield "film over roughness", f"{min(films):.2g} to {max(films):.2g}: {regime}"
    begun = min(one.recording.start for one in problem.reducible)
    yield "first recording", begun.strftime("%Y-%m-%d %H:%M UTC")


def _of_discs(pair: Pair) -> Iterator[tuple[str, str]]:
    steel, bronze = pair.steel, pair.bronze
    yield "steel disc", f"{steel.material}, {1e3 * steel.diameter:g} mm"
    yield "bronze disc", f"{bronze.material}, {1e3 * bronze.diameter:g} mm"
    yield "normal force", f"{pair.rig.load:.1f} N"
    yield "largest Hertz pressure", f"{1e-6 * pair.pressure:.1f} N/mm2"


def _of_gears(pair: GearPair) -> Iterator[tuple[str, str]]:
    gearset, own = pair.gearset, pair.geometry
    yield "gearset", f"{gearset.name}, {own.starts} starts to {own.wheel_teeth} teeth".lstrip(", ")
    yield "centre distance", f"{own.centre_distance:.4g} mm"
    yield "worm", pair.steel.material
    yield "wheel", pair.bronze.material
    yield "torque of the brake", f"{pair.brake_torque:.4g} N m"
    yield "normal force, without friction", f"{pair.load:.4g} N"

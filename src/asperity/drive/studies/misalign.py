"""The command `misalign`: a loaded gearset wherever its mounting may bring it.

Points are a grid over keys of the case, or the corners, sides and middle of its ``[tolerances]``.
Each is solved as `asperity drive --static` is, with what ``[shaft]`` and ``[worm_shaft]`` give.
"""

import itertools
import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from asperity.arrays import FloatArray, IntArray
from asperity.casefile import Case, Table
from asperity.drive.lacking import require_all
from asperity.drive.problem import DriveProblem
from asperity.drive.resolved.flank import grid_faces, grid_of
from asperity.drive.static.loaded import Loaded
from asperity.drive.static.notes import few_phases, rigid_parts
from asperity.drive.static.solve import wheel_of
from asperity.drive.studies.misaligned import Misaligned
from asperity.drive.studies.points import solve_points
from asperity.drive.warmed import warmth
from asperity.errors import ConvergenceError, InputError
from asperity.flanks.parameters import Mount
from asperity.gearset.tolerancing.allowances import Allowances
from asperity.gearset.tolerancing.table import Tolerances
from asperity.runs import Run
from asperity.sweep.axes import parse_axes
from asperity.sweep.axis import Axis, spanned
from asperity.units import quantity_of, to_si

MOST = 1000
"""Points of a study: an hour and more."""

_MILLIMETRES, _MICRO = 1e3, 1e6
_NAMED = 3  # points that a note names, where it is not true of all
_EXAMPLE = (
    "give [tolerances] with centre_distance, axial_offset or shaft_angle, or axes such as "
    "--over 'mount.shaft_angle_error=-0.1,0,0.1 deg'"
)


class StudyPoint(NamedTuple):
    """A point of the study."""

    where: tuple[int, ...]  #: Value of each axis by number; empty where it is off another way
    problem: DriveProblem | str  #: Or why there is none
    name: str  #: In words


class Study(NamedTuple):
    """What is to be solved."""

    case: Case
    axes: tuple[Axis, ...]
    places: tuple[
        StudyPoint, ...
    ]  #: The case as it is first; where temperatures are given, warm then


def prepare(case: Case, *, over: Sequence[str] | None = ()) -> Study:
    """Return the points of a study; InputError where there are none, or the case has no answer.

    Parameters
    ----------
    case : Case
        Of a gearset's drive; its vibration counts for nothing.
    over : sequence of str
        Axes, as ``mount.shaft_angle_error=-0.1,0,0.1 deg``; left out: those of ``[tolerances]``.
    """
    require_all(case, shaken=False)
    nominal = DriveProblem.from_case(case, shaken=False)
    axes = tuple(parse_axes(over, case)) if over else tuple(of_tolerances(case, nominal))
    if not axes:
        raise InputError(f"nothing says how far the gearset may be off: {_EXAMPLE}")
    if words := next((axis for axis in axes if not axis.numeric), None):
        raise InputError(f"{words.path}: words have no order to be off by; take keys with numbers")
    shape, runs = spanned(axes)
    if math.prod(shape) > MOST:
        raise InputError(
            f"there are {math.prod(shape)} points; a study has at most {MOST}: take fewer values"
        )
    places = [StudyPoint((), nominal, described(axes, ()))]
    if (warm := _warm(case, nominal)) is not None:
        places.append(warm)
    for index in itertools.product(*map(range, shape)):
        where = tuple(index[run] for run in runs)
        values = {axis.path: axis.values[n] for axis, n in zip(axes, where, strict=True)}
        try:
            problem = DriveProblem.from_case(case.replace_values(values), shaken=False)
        except InputError as error:
            places.append(StudyPoint(where, str(error), described(axes, where)))
        else:
            places.append(StudyPoint(where, problem, described(axes, where)))
    return Study(case, axes, tuple(places))


def answer(study: Study, run: Run) -> Misaligned:
    """Solve the points of a study, each kept as soon as it is there.

    Raises
    ------
    ConvergenceError
        The case as it is, or no other point, has an answer.
    """
    problems = [place.problem for place in study.places if not isinstance(place.problem, str)]
    nominal = problems[0]
    solved = iter(solve_points(problems, run))
    found: list[Loaded | str] = [
        place.problem if isinstance(place.problem, str) else next(solved) for place in study.places
    ]
    if isinstance(found[0], str):
        raise ConvergenceError(f"the gearset as the case has it: {found[0]}")
    if all(isinstance(each, str) for each in found[1:]):
        raise ConvergenceError(f"no point has an answer; the first: {found[1]}")
    names = tuple(place.name for place in study.places)
    notes = list(_notes(study.places))
    notes += [f"{n}: {e}" for n, e in zip(names, found, strict=True) if isinstance(e, str)]
    own = [own_value(study.case, axis) for axis in study.axes]
    values = [own] + [_values(study.axes, place.where) for place in study.places[1:]]
    return Misaligned.of(
        nominal, study.axes, values, names, found, _flank(nominal), tuple(notes)
    )  # fmt: skip


def _notes(places: Sequence[StudyPoint]) -> Iterator[str]:
    """Yield what should be known of the points; where it is not true of all, with those it is."""
    of: dict[str, list[str]] = {}
    solved = [(p.name, p.problem) for p in places if not isinstance(p.problem, str)]
    headline = solved[0][1].drive.phases
    for name, problem in solved:
        # Of the case itself the headline says it.
        few = () if problem.drive.phases == headline else few_phases(problem)
        # A cold one has the warm point beside it.
        warm = warmth(problem) if problem.drive.warm else ()
        for note in (*warm, *few, *rigid_parts(problem), *_housing(problem)):
            of.setdefault(note, []).append(name)
    for note, names in of.items():
        if len(names) == len(solved):
            yield note
        elif len(names) <= _NAMED:
            yield f"{'; '.join(names)}: {note}"
        else:
            yield f"{len(names)} of {len(solved)} points, {names[0]} and on: {note}"


def _housing(problem: DriveProblem) -> Iterator[str]:
    """Yield what the housing gives."""
    if problem.shaft.housing is None:
        yield "the housing is rigid: shaft.housing is its stiffness along the centre distance"


def _values(axes: Sequence[Axis], where: tuple[int, ...]) -> list[float]:
    """Return the values of a point in their units; NaN where it is off another way."""
    if not where:
        return [math.nan] * len(axes)
    return [float(axis.shown[n]) for axis, n in zip(axes, where, strict=True)]


def _warm(case: Case, problem: DriveProblem) -> StudyPoint | None:
    """Return the gearset as it runs warm; None where the case is, or gives no temperatures."""
    found = problem.warmer
    if found is None:
        return None
    name, values = f"warm: {found.told}", found.values
    try:
        return StudyPoint(
            (), DriveProblem.from_case(case.replace_values(values), shaken=False), name
        )
    except InputError as error:
        return StudyPoint((), str(error), name)


def _flank(problem: DriveProblem) -> tuple[FloatArray, FloatArray, IntArray]:
    """Radius, place across the face, and faces of the points that patterns are of."""
    points, *_ = grid_of(wheel_of(problem))
    radius = np.hypot(points[:, 0], points[:, 1])
    return radius, problem.gearset.hand_sign * points[:, 2], grid_faces()


def described(axes: Sequence[Axis], where: tuple[int, ...]) -> str:
    """Return a point in words; the case itself has no values."""
    if not where:
        return "as the case is"
    return ", ".join(axis.text(n) for axis, n in zip(axes, where, strict=True))


def own_value(case: Case, axis: Axis) -> float:
    """Return the value that the case itself has of an axis, in its unit; NaN for none."""
    model = case.known[axis.table]
    table = case.get(model)
    value = model.model_fields[axis.key].default if table is None else getattr(table, axis.key)
    if not isinstance(value, int | float):
        return math.nan
    scale = to_si(f"1 {axis.unit}".strip(), unit) if (unit := _unit(model, axis.key)) else 1.0
    return float(f"{value / scale:.6g}")


def _unit(model: type[Table], key: str) -> str:
    quantity = quantity_of(model, key)
    return quantity.unit if quantity is not None else ""


def of_tolerances(case: Case, problem: DriveProblem) -> Iterator[Axis]:
    """Yield what may be off of how the worm stands: to either side, and not at all."""
    given = case.get(Tolerances)
    if given is None:
        return
    mount = problem.mount or Mount()
    allowed = Allowances.of(problem.geometry, given)
    for key, off, unit, size in (
        ("centre_distance_error", allowed.centre_distance / _MILLIMETRES, "um", 1.0 / _MICRO),
        ("axial_offset", given.axial_offset, "um", 1.0 / _MICRO),
        ("shaft_angle_error", given.shaft_angle, "deg", math.pi / 180.0),
    ):
        if off:
            middle = getattr(mount, key)
            values = tuple(middle + sign * off for sign in (-1.0, 0.0, 1.0))
            shown = tuple(float(f"{value / size:.6g}") for value in values)
            yield Axis(f"mount.{key}", values, shown, unit)

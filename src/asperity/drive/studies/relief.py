r"""The command `relief`: which relief takes the load off the edges, wherever the gearset stands.

Designs are values of keys such as ``modification.tip_relief`` or ``hob.oversize``; one key after
the other is gone through with the others held, from the case as it is, until none gives more. Each
design is solved under every load and at every mounting; the worst of these counts. A design is the
better, the less force its edges bear, if that is more than `LITTLE` of the normal force; of equal
ones the less pressure its flank does, then the smaller its transmission error, then the more evenly
its pattern bears across the face (:math:`K_{H\beta}`). What differs by less than `EQUAL` is equal.
"""

import dataclasses
import itertools
import math
from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple

import numpy as np

from asperity.casefile import Case
from asperity.drive.lacking import require_all
from asperity.drive.problem import DriveProblem
from asperity.drive.static.loaded import Loaded
from asperity.drive.studies.misalign import described, of_tolerances, own_value
from asperity.drive.studies.points import solve_points
from asperity.drive.studies.relieved import NONE, Design, Relieved
from asperity.errors import ConvergenceError, InputError
from asperity.rating.parameters import Operation
from asperity.runs import Run
from asperity.sweep.axes import parse_axes
from asperity.sweep.axis import Axis, Value

LITTLE = 0.01
"""Of the normal force, below which the force of edges counts for nothing."""

EQUAL = 0.01
"""Of the least among designs, by which another's may be more and still count as equal."""

HALVINGS = 3
"""Times that `between` tries values half-way between the best and those beside it."""

_RELIEF = "modification.tip_relief=0,10,20,30,40 um"
_FURTHER = "modification.root_relief=0,20,40,60,80 um"
_LESS = 1.0 / 3.0
_ROUNDS = 5
_MOST = 200
_DESIGNS = ("modification", "hob", "disc")
_STANDS = ("mount", "operation", "shaft")


class Search(NamedTuple):
    """What is looked for."""

    case: Case
    axes: tuple[Axis, ...]
    stands: tuple[tuple[str, dict[str, float]], ...]  #: Loads and mountings, by name and values
    halvings: int = 0  #: Times that values between the best and those beside it are tried
    further: tuple[Axis, ...] = ()  #: Looked for as well where the wheel's tip edge bears the most


def prepare(
    case: Case, *, over: Sequence[str] | None = (), at: Sequence[str] | None = ()
) -> Search:
    """Return what is looked for; InputError where there is nothing to look for.

    Parameters
    ----------
    case : Case
        Of a gearset's drive; its vibration counts for nothing.
    over : sequence of str
        Values of keys of ``[modification]``, ``[hob]`` or ``[disc]``; left out: tip relief from 0
        to 40 um, and root relief from 0 to 80 um where with it the wheel's tip edge bears the most.
    at : sequence of str
        Values of keys of ``[mount]``, ``[operation]`` or ``[shaft]`` that a design is to bear
        with, all with all; left out: the load and a third of it at the case's mounting, and the
        load at the corners of its ``[tolerances]``.
    """
    require_all(case, shaken=False)
    problem = DriveProblem.from_case(case, shaken=False)
    axes = tuple(parse_axes(over or [_RELIEF], case))
    _only("--over", axes, _DESIGNS)
    if at:
        where = parse_axes(at, case, option="--at")
        _only("--at", where, _STANDS)
        stands = [
            (
                described(where, index),
                {a.path: float(a.values[n]) for a, n in zip(where, index, strict=True)},
            )
            for index in itertools.product(*(range(len(axis.values)) for axis in where))
        ]
    else:
        stands = list(_of_case(case, problem))
    further = () if over else tuple(parse_axes([_FURTHER], case))
    count = len(stands) * sum(len(axis.values) for axis in (*axes, *further))
    if count > _MOST:
        raise InputError(
            f"{len(stands)} loads and mountings of {count // len(stands)} designs are more than "
            f"{_MOST} points: take fewer values"
        )
    found = Search(case, axes, tuple(stands), further=further)
    for axis in axes:
        for n in range(len(axis.values)):
            _problems(found, (*_start(found)[: axes.index(axis)], n))
    return found


def answer(search: Search, run: Run) -> Relieved:
    """Look for the best design, each point kept as soon as it is there.

    Raises
    ------
    ConvergenceError
        The case as it is has no answer.
    """
    known: dict[tuple[int, ...], Design] = {}

    def look(search: Search, places: Sequence[tuple[int, ...]]) -> None:
        new = [place for place in dict.fromkeys(places) if place not in known]
        problems = [problem for place in new for problem in _problems(search, place)]
        solved = solve_points(problems, run) if problems else []
        each = len(search.stands)
        for n, place in enumerate(new):
            known[place] = _design(search, place, solved[n * each : (n + 1) * each])

    own = _start(search)
    look(search, [own])
    if known[own].failed:
        raise ConvergenceError(f"the gearset as the case has it: {known[own].failed}")
    best = own
    for halving in range(search.halvings + 1):
        if halving:
            search = _halved(search, best)
        best = _by_rounds(search, best, known, look, beside=halving > 0)
    if search.further and known[best].on_wheel_tip:
        search, best = _further(search, best, known)
        best = _by_rounds(search, best, known, look)
    # Of all that were tried, whatever the way to it.
    best = _best([best, *known], known)
    nominal = DriveProblem.from_case(search.case, shaken=False)
    return Relieved.of(
        nominal, search.axes, tuple(name for name, _ in search.stands), list(known.values()),
        list(known).index(best),
    )  # fmt: skip


def _by_rounds(
    search: Search,
    best: tuple[int, ...],
    known: Mapping[tuple[int, ...], Design],
    look: Callable[[Search, Sequence[tuple[int, ...]]], None],
    *,
    beside: bool = False,
) -> tuple[int, ...]:
    """Return the best design by going through one axis after the other until none gives more.

    Through all of its values, or through those beside the best one alone.
    """
    for _ in range(_ROUNDS):
        before = best
        for k, axis in enumerate(search.axes):
            # Of a round the case's own value is one as well.
            values = _beside(axis, best[k]) if beside else range(len(axis.values))
            around = [(*best[:k], n, *best[k + 1 :]) for n in values]
            look(search, around)
            best = _best([best, *around], known)
        if best == before:
            break
    return best


def _further(
    search: Search, best: tuple[int, ...], known: dict[tuple[int, ...], Design]
) -> tuple[Search, tuple[int, ...]]:
    """Return a search over its further axes as well, and the best; what is known stays known."""
    own = _start(search._replace(axes=search.further))
    values = tuple(own_value(search.case, axis) for axis in search.further)
    before = dict(known)
    known.clear()
    for place, design in before.items():
        known[*place, *own] = dataclasses.replace(design, values=(*design.values, *values))
    return search._replace(axes=(*search.axes, *search.further)), (*best, *own)


def _best(
    places: Sequence[tuple[int, ...]], known: Mapping[tuple[int, ...], Design]
) -> tuple[int, ...]:
    """Return the best design, the first of equal ones."""
    left = list(places)
    for what in zip(*(known[place].merit for place in places), strict=True):
        of = dict(zip(places, what, strict=True))
        least = min(of[place] for place in left)
        left = [place for place in left if of[place] <= (1.0 + EQUAL) * least]
    return left[0]


def between(search: Search) -> Search:
    """Return it as one that also tries values half-way between, and the case's own."""
    axes = []
    for axis, n in zip(search.axes, _start(search), strict=True):
        own = own_value(search.case, axis)
        scale = next((float(v) / float(s) for v, s in zip(axis.values, axis.shown, strict=True)
                      if s), 1.0)  # fmt: skip
        axes.append(axis if n >= 0 or math.isnan(own) else _longer(axis, [(scale * own, own)]))
    return search._replace(axes=tuple(axes), halvings=HALVINGS)


def _halved(search: Search, best: tuple[int, ...]) -> Search:
    """Return it with values half-way between those of the best design and the ones beside them."""
    axes = []
    for axis, n in zip(search.axes, best, strict=True):
        middles = [
            (_middle(axis.values, n, k), float(f"{_middle(axis.shown, n, k):.6g}"))
            for k in _beside(axis, n)
            if k != n
        ]
        axes.append(_longer(axis, middles))
    return search._replace(axes=tuple(axes))


def _middle(values: Sequence[Value], one: int, other: int) -> float:
    return 0.5 * (float(values[one]) + float(values[other]))


def _longer(axis: Axis, more: Sequence[tuple[float, float]]) -> Axis:
    """Return an axis with more values, in SI and in its unit, behind its own."""
    values, shown = zip(*more, strict=True) if more else ((), ())
    return dataclasses.replace(axis, values=axis.values + values, shown=axis.shown + shown)


def _beside(axis: Axis, n: int) -> list[int]:
    """Return a value of an axis and the nearest to either side; none where it is no value of it."""
    if n < 0:
        return []
    order = sorted(range(len(axis.values)), key=lambda k: float(axis.values[k]))
    at = order.index(n)
    return order[max(at - 1, 0) : at + 2]


def _start(search: Search) -> tuple[int, ...]:
    """Return the case as it is: of every axis the number of its value, -1 where it is none."""
    found = []
    for axis in search.axes:
        own = own_value(search.case, axis)
        near = (n for n, v in enumerate(axis.shown) if math.isclose(float(v), own, rel_tol=1e-9))
        found.append(next(near, -1))
    return tuple(found)


def _problems(search: Search, place: tuple[int, ...]) -> list[DriveProblem]:
    values = {
        axis.path: axis.values[n] for axis, n in zip(search.axes, place, strict=False) if n >= 0
    }
    case = search.case.replace_values(values)
    return [
        DriveProblem.from_case(case.replace_values(stand), shaken=False)
        for _, stand in search.stands
    ]


def _design(search: Search, place: tuple[int, ...], found: Sequence[Loaded | str]) -> Design:
    own = [
        own_value(search.case, axis) if n < 0 else float(axis.shown[n])
        for axis, n in zip(search.axes, place, strict=True)
    ]
    own_names = [axis.text(n) for axis, n in zip(search.axes, place, strict=True) if n >= 0]
    name = "as the case is" if place == _start(search) else ", ".join(own_names)
    failed = next((each for each in found if isinstance(each, str)), "")
    if failed:
        return Design(name, tuple(own), failed=failed, merit=NONE)
    solved = [each for each in found if isinstance(each, Loaded)]
    edges = [each.force_worm_tip + each.force_wheel_tip + each.force_face_end for each in solved]
    share = max(edge / each.normal_force for edge, each in zip(edges, solved, strict=True))
    flank = max(each.pressure_flank for each in solved)
    error = max(each.transmission_error for each in solved)
    uneven = max(each.k_h_beta for each in solved)
    peak = max(
        max(e.pressure_flank, e.pressure_worm_tip, e.pressure_wheel_tip, e.pressure_face_end)
        for e in solved
    )
    return Design(
        name,
        tuple(own),
        edge_force=max(edges),
        edge_share=share,
        worm_tip=max(each.force_worm_tip for each in solved),
        wheel_tip=max(each.force_wheel_tip for each in solved),
        face_end=max(each.force_face_end for each in solved),
        flank=flank,
        peak=peak,
        error=error,
        k_h_beta=uneven,
        worst=search.stands[int(np.argmax(edges))][0],
        counts=share > LITTLE,
        merit=(max(edges) if share > LITTLE else 0.0, flank, error, uneven),
    )


def _only(option: str, axes: Sequence[Axis], tables: Sequence[str]) -> None:
    for axis in axes:
        if axis.table not in tables or not axis.numeric:
            raise InputError(f"{option} {axis.path}: take keys with numbers of {', '.join(tables)}")


def _of_case(case: Case, problem: DriveProblem) -> "list[tuple[str, dict[str, float]]]":
    """Return the load and a third of it, at the case's mounting and at its tolerances' corners."""
    torque = f"{Operation.table}.output_torque"
    loads = [
        (f"{torque}={value:.6g} N m", {torque: value})
        for value in (problem.load, _LESS * problem.load)
    ]
    axes = list(of_tolerances(case, problem))
    corners = (
        [
            (
                described(axes, index),
                {a.path: float(a.values[n]) for a, n in zip(axes, index, strict=True)},
            )
            for index in itertools.product(*((0, 2) for _ in axes))
        ]
        if axes
        else []
    )
    return loads + [
        (f"{where}, {loads[0][0]}", {**values, **loads[0][1]}) for where, values in corners
    ]

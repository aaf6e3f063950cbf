"""The command `wear`: a loaded wheel beds in, step by step, until a depth or a number of turns.

A step wears the flank by what a pitch takes off it, times so many turns of the wheel that no point
loses more than `DEEPEST`: a pressure that a larger step would turn about would hunt. Each step
begins at other phases, so that what lies between two of them wears as well, and takes off the mean
of what was found at the phases of the last `PARTS` steps: its own alone would leave waves as deep
as a step, and the flank would bear on more at the phases that were worn last than between them.
"""

import dataclasses
import math
from collections.abc import Mapping
from functools import partial
from typing import Any, NamedTuple

import numpy as np

from asperity.arrays import FloatArray
from asperity.casefile import Case
from asperity.drive.lacking import require_all
from asperity.drive.problem import DriveProblem
from asperity.drive.resolved.flank import grid_faces
from asperity.drive.resolved.strip import FLANK
from asperity.drive.static.loaded import loaded_of
from asperity.drive.static.notes import rigid_parts
from asperity.drive.static.solve import StaticModel, TooMuchError
from asperity.drive.static.sweep import LoadCase
from asperity.drive.warmed import warmth
from asperity.drive.wear.model import Taken, node_area, worn_model
from asperity.drive.wear.result import WheelWorn
from asperity.errors import AsperityError, InputError, plain
from asperity.rating.rate import rate_case
from asperity.runs import Run
from asperity.runs.key import code_key, key
from asperity.runs.tree import from_tree, to_tree
from asperity.slider.wear import Wear
from asperity.units import to_si

DEEPEST = 1e-6
"""Depth of a step where it wears fastest, m: at twice that the shortest waves would hunt."""

PARTS = 5
"""Steps whose phases wear together: they lie evenly over the pitch."""

_MOST_DEPTH = 0.5e-3
_MOST_STEPS = 500
_GOLDEN = 0.5 * (math.sqrt(5.0) - 1.0)
_ENOUGH = 1e-9
_HOUR, _MICRO, _MILLI3, _MEGA = 3600.0, 1e6, 1e9, 1e6
_FURTHER = "; wear goes no further in this model, whatever the torque"
_FULL = (
    "worn to the worm's shape, more than half of a flank would bear at once, beyond what the "
    f"contact holds{_FURTHER}"
)
_OVERLAP = (
    "worm and teeth would overlap by more than a tenth of the module, as nothing bears but rims of "
    f"what is worn{_FURTHER}"
)
_CURVES = {
    "error_course": "transmission error", "pressure_course": "mean pressure",
    "peak_course": "largest pressure", "deflection_course": "turn of the wheel",
}  # fmt: skip
# Of the mean of a curve, from which on it is told to go to and fro; and of how many steps.
_SWINGS, _LEAST_STEPS = 0.01, 4
_MANY = f"that is {_MOST_STEPS} steps, each {_MICRO * DEEPEST:g} um where it wears fastest by then"
_COURSES = (
    "turns", "depth_course", "mean_course", "pressure_course", "peak_course", "error_course",
    "torque_course", "deflection_course", "area_course",
)  # fmt: skip


class Wearing(NamedTuple):
    """What is to be solved."""

    problem: DriveProblem
    coefficient: float  #: m^2/N
    source: str
    standard: float | None  #: Depth by ISO/TR 14521 for a turn of the wheel, m
    depth: float  #: At which it ends, m
    revolutions: float  #: Of the wheel, after which it ends


@dataclasses.dataclass(eq=False)
class _Worn:
    """How far it has come."""

    depth: FloatArray  #: At the points of the flank, m
    turns: float  #: Of the wheel
    work: float  #: Of the normal forces on a tooth on the way that they slide, N m
    rows: list[FloatArray]  #: Of the course
    #: Depth and work of a turn at the phases of the last steps, up to `PARTS` of them
    rates: list[FloatArray] = dataclasses.field(default_factory=list)
    works: list[float] = dataclasses.field(default_factory=list)

    def take(self, rate: FloatArray, work: float) -> None:
        """Take a depth, m, and a work, N m, of a turn at the phases of a step."""
        self.rates = [*self.rates, rate][-PARTS:]
        self.works = [*self.works, work][-PARTS:]

    def length(self) -> float:
        """Return for how many turns of the wheel the next step is.

        No point loses more than `DEEPEST` in it. The first steps, with fewer phases to take a mean
        of, are shorter, so that those of each step wear for as long.
        """
        most = max(float(rate.max()) for rate in self.rates)
        return DEEPEST / most * len(self.rates) / PARTS

    def rate(self) -> FloatArray:
        """Return the depth of a turn at the points of the flank, mean of the last steps, m."""
        return np.asarray(np.mean(self.rates, axis=0))

    def wear(self, turns: float) -> None:
        """Wear it for so many turns."""
        self.depth = self.depth + turns * self.rate()
        self.turns += turns
        self.work += turns * float(np.mean(self.works))


def prepare(case: Case, *, depth: str = "20 um", revolutions: str = "") -> Wearing:
    """Return the problem of a case; InputError where it cannot be solved.

    Parameters
    ----------
    case : Case
        Of a gearset's drive; its vibration counts for nothing.
    depth : str
        Largest depth on the flank at which it ends, with its unit.
    revolutions : str
        Turns of the wheel after which it ends; left out: when the depth is there.
    """
    require_all(case, shaken=False)
    problem = DriveProblem.from_case(case, shaken=False)
    turns = math.inf
    if revolutions:
        turns = _number(revolutions, "", "--revolutions", "a positive number of turns such as 1e4")
    deep = _number(depth, "m", "--depth", "a positive length such as '20 um'")
    if not deep <= _MOST_DEPTH:
        raise InputError(
            f"--depth is {plain(depth)}; it may be at most {1e3 * _MOST_DEPTH:g} mm: beyond, the "
            "teeth's own stiffness changes"
        )
    coefficient, source, standard = _coefficient(case)
    return Wearing(problem, coefficient, source, standard, deep, turns)


def answer(asked: Wearing, run: Run) -> WheelWorn:
    """Wear a wheel, going on from where the same work was interrupted.

    Raises
    ------
    InputError, ConvergenceError
        The teeth cannot carry the torque, or no balance is found.
    """
    problem = asked.problem
    new = StaticModel(problem, run)
    fresh = loaded_of(new)
    flank = new.resolved.flank
    area = node_area(flank)
    step = float(new.sector.pitch * new.contact.stand.ratio / len(new.phases))
    assert problem.case is not None
    name = key(code_key(__name__), problem.case.canonical(), repr(asked[1:]))
    kept = run.resume(name)
    now = from_tree(_Worn, kept) if kept else _Worn(np.zeros(flank.nodes), 0.0, 0.0, [])
    before: _Worn | None = None
    ended: tuple[str, ...] = ()
    with run.interruptible():
        while True:
            phases = new.phases + step * ((len(now.rows) * _GOLDEN) % 1.0)
            model = worn_model(new, now.depth, phases)
            taken = Taken(model.resolved, step)
            try:
                (pitch_sweep,) = model.sweeps([LoadCase(problem.load, evaluate=taken.evaluate)])
            except TooMuchError as error:
                if before is None:
                    raise
                # As it was a step ago, of which all is known.
                now, ended = before, _ended(before, _FULL if error.full else _OVERLAP)
                break
            now.rows.append(np.array([
                now.turns, now.depth.max(), now.depth @ area / area.sum(), taken.force / taken.area,
                taken.peaks[FLANK], np.ptp(pitch_sweep.error), pitch_sweep.worm_torque.mean(),
                pitch_sweep.mean_deflection, taken.area / len(phases),
            ]))  # fmt: skip
            now.take(asked.coefficient * taken.depth, taken.work)
            left = asked.revolutions - now.turns
            if now.depth.max() >= asked.depth * (1.0 - _ENOUGH) or left <= _ENOUGH * now.turns:
                break
            if len(now.rows) > _MOST_STEPS:
                ended = _ended(now, _MANY)
                break
            # Where it wears fastest, and not beyond the depth at which it ends.
            still = (asked.depth - now.depth) / np.maximum(now.rate(), 1e-300)
            before = dataclasses.replace(now)
            now.wear(min(now.length(), float(still.min()), left))
            share = max(float(now.depth.max()) / asked.depth, now.turns / asked.revolutions)
            total = max(len(now.rows), math.ceil(len(now.rows) / share))
            run.checkpoint(len(now.rows), total, partial(to_tree, now))
    depth, turns = now.depth, now.turns
    columns = dict(zip(_COURSES, np.array(now.rows).T, strict=True))
    worn = loaded_of(worn_model(new, depth, new.phases))
    points = flank.grid[0]
    ideal = problem.load / problem.geometry.gear_ratio
    return WheelWorn(
        problem=problem,
        coefficient=asked.coefficient,
        coefficient_source=asked.source,
        revolutions=turns,
        time=turns * 2.0 * math.pi * problem.geometry.gear_ratio / problem.worm_speed / _HOUR,
        depth_max=_MICRO * float(depth.max()),
        depth_mean=_MICRO * float(depth @ area / area.sum()),
        depth_standard=None if asked.standard is None else _MICRO * asked.standard * turns,
        volume=_MILLI3 * float(depth @ area),
        friction_work=new.friction * now.work,
        pressure_mean_new=fresh.pressure_mean / _MEGA,
        pressure_mean=worn.pressure_mean / _MEGA,
        flow_pressure=None if (flow := problem.flow_pressure) is None else flow / _MEGA,
        transmission_error_new=fresh.transmission_error,
        transmission_error=worn.transmission_error,
        efficiency_new=ideal / fresh.input_torque,
        efficiency=ideal / worn.input_torque,
        depth=depth,
        pattern_new=fresh.pattern,
        pattern=worn.pattern,
        node_radius=np.hypot(points[:, 0], points[:, 1]),
        node_face=problem.gearset.hand_sign * points[:, 2],
        faces=grid_faces(),
        notes=(
            *ended,
            "all teeth wear alike, the worm does not; new and worn are told at the same phases, "
            "each step of the course at phases of its own, by the first strips of patches",
            *_to_and_fro(columns, problem.drive.phases),
            *warmth(problem),
            *rigid_parts(problem),
        ),
        **columns,
    )


def _ended(worn: _Worn, why: str) -> tuple[str, ...]:
    """Return why a flank is worn no further."""
    return (
        f"it ends before the depth or the turns asked for, {_MICRO * worn.depth.max():.4g} um deep "
        f"at most: {why}",
    )


def _to_and_fro(columns: Mapping[str, FloatArray], phases: int) -> tuple[str, ...]:
    """Return by how much curves go to and fro from step to step, as each has other phases."""
    swings = []
    for name, what in _CURVES.items():
        values = columns[name]
        if len(values) < _LEAST_STEPS or not values.mean() > 0.0:
            continue
        # Of a curve that falls or rises evenly nothing is left; of one to and fro its reach.
        swing = float(np.abs(np.diff(values, 2)).mean() / (2.0 * values.mean()))
        if swing > _SWINGS:
            swings.append(f"the {what} by {100.0 * swing:.2g} %")
    if not swings:
        return ()
    go, mean = ("goes", "its mean") if len(swings) == 1 else ("go", "their means")
    return (
        f"from step to step {' and '.join(swings)} of {mean} {go} to and fro: each step has "
        f"other phases of the pitch, of which {phases} do not tell the whole; that is no wear, and "
        "more phases (drive.phases) make it even",
    )


def _coefficient(case: Case) -> tuple[float, str, float | None]:
    """Return the coefficient, m^2/N, where it is from, and the standard's depth by turn, m."""
    given = case.get(Wear)
    standard: dict[str, Any] = {}
    why = ""
    try:
        rated = rate_case(case)
        standard = {entry.key: entry.value for entry in rated.found.get("iso14521", ())}
    except AsperityError as error:
        why = f" ({error})"
    depth, cycles = standard.get("delta_Wn_mm"), standard.get("N_L")
    by_turn = None if depth is None or cycles is None else 1e-3 * float(depth) / float(cycles)
    if given is not None and given.coefficient is not None and given.hardness is not None:
        return given.coefficient / given.hardness, "[wear], coefficient/hardness", by_turn
    wear, stress = standard.get("J_W"), standard.get("sigma_Hm_wear_MPa")
    if wear is None or stress is None:
        raise InputError(
            "nothing says how fast the wheel wears: give wear.coefficient and wear.hardness; "
            f"ISO/TR 14521 has no wear intensity for this gearset{why}"
        )
    return float(wear) / (_MEGA * float(stress)), "ISO/TR 14521, J_W/sigma_Hm", by_turn


def _number(text: str, unit: str, option: str, example: str) -> float:
    try:
        value = to_si(text, unit, bare="refuse" if unit else "si")
    except InputError:
        value = math.nan
    if not 0.0 < value < math.inf:
        raise InputError(f"{option} is {plain(text)}; it must be {example}")
    return value

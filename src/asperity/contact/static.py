"""Quasi-static contact: a counter-surface moved to a place, or pushed until it bears a load.

The body is held (`CondensedBody` of a tied body, or any flexibility of held nodes). The
counter-surface has one freedom at a time, a shift or a turn; a tooth of a gear is loaded in this
way by the worm. A path of several parts, such as pressing and then rubbing to and fro, goes from
state to state: `on_guide` takes a state from one freedom to the next, `follow` through a list of
places.
"""

from __future__ import annotations

import dataclasses
import math
from dataclasses import dataclass, field

import numpy as np
from scipy.spatial.transform import Rotation

from asperity.arrays import FloatArray
from asperity.contact.increment.problem import ContactState, IncrementProblem, IncrementResult
from asperity.contact.increment.solver import IncrementSolver
from asperity.contact.interface.counter_motion import Drift, SurfaceMotion
from asperity.contact.interface.rigid import Pose
from asperity.errors import ConvergenceError, InputError

_MOST_CUTS = 12
_MOST_SEARCHES = 60
# Of a load, over itself.
_TOLERANCE = 1e-9
_SMALL = 0.01  # of the forces that the contact bears, for a load


@dataclass(frozen=True, eq=False)
class Guide:
    """One freedom of a counter-surface: a shift along ``axis`` or a turn about it."""

    axis: FloatArray  #: (3,): Direction; its length does not count
    pose: Pose = field(default_factory=Pose)  #: Where the surface stands at place 0
    centre: FloatArray | None = None  #: (3,): A point of the axis of a turn, m; None for a shift

    def __post_init__(self) -> None:
        length = float(np.linalg.norm(self.axis))
        if not (math.isfinite(length) and length > 0.0):
            raise InputError(f"the axis is {self.axis}; give a direction")
        object.__setattr__(self, "axis", np.asarray(self.axis, dtype=float) / length)

    def at(self, position: float) -> Pose:
        """Pose at a place, m or rad."""
        if self.centre is None:
            return dataclasses.replace(
                self.pose, translation=self.pose.translation + position * self.axis
            )
        turn = Rotation.from_rotvec(position * self.axis).as_matrix()
        return Pose(
            turn @ self.pose.rotation,
            self.centre + turn @ (self.pose.translation - self.centre),
        )

    def load(self, problem: IncrementProblem, result: IncrementResult) -> float:
        """Force along the axis, or moment about it, that holds the surface there, N or N m.

        It is what the body's contact forces say: positive where the surface pushes the body the
        way of the axis.
        """
        forces = result.force.reshape(-1, 3)
        if self.centre is None:
            return float(forces.sum(axis=0) @ self.axis)
        at = problem.surface.positions + result.displacement.reshape(-1, 3) - self.centre
        return float(np.cross(at, forces).sum(axis=0) @ self.axis)


@dataclass(frozen=True, eq=False)
class StaticState:
    """A body in static contact."""

    place: float  #: Of the counter-surface on its guide, m or rad
    load: float  #: That holds it there, N or N m
    contact: IncrementResult  #: The last increment
    increments: int  #: Increments taken since the state before
    #: Done against friction since the state before, J: of the mean tractions of each increment on
    #: its slip. Over a closed cycle it is dissipated; on the way the asperities hold a part of it.
    friction_work: float = 0.0


def _friction_work(
    problem: IncrementProblem, before: ContactState, result: IncrementResult
) -> float:
    slip = result.slip_1 + result.slip_2
    # The slip lies in the tangent plane, so that the pressure has no share in the work.
    mean = 0.5 * (before.traction + result.traction)
    weights = problem.surface.weights.ravel()
    return -float(np.einsum("q,qi,qi->", weights, mean, slip))


def move_to(
    solver: IncrementSolver,
    guide: Guide,
    position: float,
    *,
    start: StaticState | float = 0.0,
    increments: int = 1,
) -> StaticState:
    """Move the counter-surface to a place on its guide, m or rad.

    The `flexibility` of the solver is that of the held body. The start is a state, or a place at
    which the body is untouched and undeformed. The way is gone in equal increments: friction
    depends on the path, and its steps on their size.

    Raises
    ------
    ConvergenceError
        No equilibrium even with increments cut to 1/4096.
    """
    if increments < 1:
        raise InputError(f"increments is {increments}; it must be at least 1")
    problem = solver.problem
    state, at = _begin(problem, start)
    begin, done, count, work = at, 0.0, 0, 0.0
    share = 1.0 / increments
    result = None
    while done < 1.0:
        ahead = min(done + share, 1.0)
        # The last part must not be left over by rounding.
        if 1.0 - ahead < 1e-9 * share:
            ahead = 1.0
        to = begin + ahead * (position - begin)
        try:
            result = solver.solve(_unloaded(problem), _motion(guide, at, to), state)
        except ConvergenceError as error:
            share *= 0.5
            if share * increments < 0.5**_MOST_CUTS:
                raise ConvergenceError(
                    f"static contact stops at {at:.6g} on the way to {position:.6g}: {error}",
                    reached={"place": at, **error.reached},
                ) from error
            continue
        work += _friction_work(problem, state, result)
        state, at, done, count = result.state, to, ahead, count + 1
    assert result is not None
    return StaticState(at, guide.load(problem, result), result, count, work)


def load_to(
    solver: IncrementSolver,
    guide: Guide,
    load: float,
    *,
    start: StaticState | float = 0.0,
    increments: int = 1,
    step: float | None = None,
) -> StaticState:
    """Push the counter-surface until it bears a load, from where and in increments as `move_to`.

    The load is the force along the guide's axis or the moment about it, on the body, N or N m; it
    has to grow with the place. ``step`` is a first guess of how far to go, m or rad, needed from an
    untouched start.

    Raises
    ------
    ConvergenceError
        The load is not reached: the surface misses the body or slides off.
    """
    if increments < 1:
        raise InputError(f"increments is {increments}; it must be at least 1")
    now = start
    first = start.load if isinstance(start, StaticState) else 0.0
    # A small load is the difference of forces, which are known no better than themselves.
    scale = max(abs(load), _SMALL * max(abs(first), _borne(start)))
    work = 0.0
    for part in range(1, increments + 1):
        target = first + part / increments * (load - first)
        now, way = _one_load(solver, guide, target, now, step, scale)
        step = way or step
        work += now.friction_work
    assert isinstance(now, StaticState)
    return dataclasses.replace(now, increments=increments, friction_work=work)


def _borne(start: StaticState | float) -> float:
    """Return the size of all contact forces of a state together, N."""
    if not isinstance(start, StaticState):
        return 0.0
    return float(np.linalg.norm(start.contact.force.reshape(-1, 3), axis=1).sum())


def _one_load(
    solver: IncrementSolver,
    guide: Guide,
    target: float,
    start: StaticState | float,
    step: float | None,
    scale: float,
) -> tuple[StaticState, float]:
    """One increment to a load: bracketed regula falsi (Illinois) on the place."""
    problem = solver.problem
    state, at = _begin(problem, start)

    def tried(way: float) -> StaticState:
        result = solver.solve(_unloaded(problem), _motion(guide, at, at + way), state)
        work = _friction_work(problem, state, result)
        return StaticState(at + way, guide.load(problem, result), result, 1, work)

    def found(state: StaticState) -> bool:
        # The forces of an increment are known no better than its residual.
        known = max(_TOLERANCE, problem.tolerance, state.contact.residual)
        return abs(state.load - target) <= known * scale

    here = tried(0.0)
    miss = here.load - target
    if found(here):
        return here, 0.0
    if not step:
        raise InputError("step is missing; give a first guess of how far the surface goes")
    # A larger place bears more: find a place beyond the load, then one between.
    low, low_miss = 0.0, miss
    high, high_miss = 0.0, miss
    way = math.copysign(abs(step), -miss)
    for _ in range(_MOST_SEARCHES):
        high_state = tried(way)
        high, high_miss = way, high_state.load - target
        if high_miss * miss <= 0.0 or found(high_state):
            break
        low, low_miss = high, high_miss
        way *= 2.0
    else:
        raise ConvergenceError(
            f"a load of {target:.6g} is not reached at {at + way:.6g}: the surface misses the body",
            reached={"place": at + way, "load": high_miss + target},
        )
    best = high_state
    side = 0
    for _ in range(_MOST_SEARCHES):
        if found(best):
            return best, best.place - at
        way = (low * high_miss - high * low_miss) / (high_miss - low_miss)
        best = tried(way)
        miss = best.load - target
        if miss * high_miss > 0.0:
            high, high_miss = way, miss
            low_miss *= 0.5 if side == 1 else 1.0
            side = 1
        else:
            low, low_miss = way, miss
            high_miss *= 0.5 if side == -1 else 1.0
            side = -1
    raise ConvergenceError(
        f"a load of {target:.6g} is not found: {best.load:.6g} at {best.place:.6g}",
        reached={"place": best.place, "load": best.load},
    )


def _begin(problem: IncrementProblem, start: StaticState | float) -> tuple[ContactState, float]:
    if isinstance(start, StaticState):
        return start.contact.state, start.place
    return ContactState.rest(problem), float(start)


def _unloaded(problem: IncrementProblem) -> FloatArray:
    """Displacement of the nodes without contact: the body is held."""
    return np.zeros(3 * problem.nodes)


def _motion(guide: Guide, before: float, after: float) -> SurfaceMotion:
    end = guide.at(after)
    return SurfaceMotion(end, Drift.between(guide.at(before), end))

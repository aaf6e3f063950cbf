r"""The command `locking`: whether a gearset holds its load, and how much shaking it takes to not.

The motor is off, the wheel pushes. At rest the worm holds where a share :math:`\phi < 1` of full
friction is enough. A vibration along the flank of amplitude :math:`u` lets it creep as soon as it
bends asperities and teeth from there to full friction, :math:`u > s_{eff}(1 - \phi)`; far beyond,
:math:`u \gg s_{eff}`, friction sides with the load for as much of the cycle as balances it, and the
flanks creep at :math:`v_a\sin(\pi\phi/2)`. Only what sticks until it slips holds at all under the
smallest vibration: Coulomb's friction, and Dahl's of exponent 0 where it slips along the flank
alone; other asperities creep at any.
"""

import dataclasses
import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar, NamedTuple

import numpy as np
import numpy.typing as npt

from asperity.arrays import FloatArray
from asperity.casefile import Case
from asperity.drive.driven import inputs
from asperity.drive.point import MeshPoint
from asperity.drive.problem import DriveProblem
from asperity.drive.protocols.many import solve_many
from asperity.drive.protocols.solve import asked, least_creep
from asperity.drive.reduced.model import ReducedModel
from asperity.drive.reduced.reduction import Reduction, reduction
from asperity.drive.result import DriveResult
from asperity.drive.solve import prepare as prepare_drive
from asperity.drive.solve import prepare_shaken
from asperity.errors import AsperityError, ConvergenceError
from asperity.friction import Friction
from asperity.results import Result, quantity
from asperity.results.settled import told
from asperity.runs import Run
from asperity.runs.key import code_key, key
from asperity.vibration import Vibration

if TYPE_CHECKING:
    from asperity.results.report import Picture

_AMPLITUDES = ("amplitude",)
_PROTOCOL = "back-drive"
_DRIVES = "it does not hold its load without vibration: the wheel drives the worm"
_NOT_SHAKEN = (
    "nothing shakes it: how much shaking sets it free is told with a [vibration] (mode, frequency "
    "and an amplitude)"
)
# Of the way from rest to full friction, what the chart shows.
_CHART = np.geomspace(0.05, 20.0, 14)
_ROUNDS, _AT_ONCE = 2, 4
# Where the chart creeps from its first point on, so many times a 16th of the amplitude is tried.
_LOWER, _DEEPEST = np.array([1.0 / 16.0, 1.0 / 8.0, 1.0 / 4.0, 1.0 / 2.0]), 5
# Creep below so much of the vibration's own speed is the rest of settling down.
_CREEPS = 2e-4
_MICRO = 1e6


class Locking(Result):
    """Whether a gearset holds, and from which vibration on it creeps.

    A march that has not settled holds nowhere, and creeps where each of its blocks does by more
    than they are apart: the threshold is sought between what holds and what creeps, and is left out
    where others lie between them.
    """

    title: ClassVar[str] = "Self-locking of a worm gearset under vibration"
    stem: ClassVar[str] = "locking"
    drawings: ClassVar[Mapping[str, str]] = {"locking": "asperity.drive.plots:plot_locking"}

    problem: DriveProblem
    locked: bool = quantity("", "", "holds its load without vibration")
    holding_share: float = quantity("phi", "", "share of full friction that holds it")
    holding_share_rated: float = quantity(
        "", "", "the same on the reference circle, with the pressure angle, as AGMA 6034 has it"
    )
    holding_share_without_pressure_angle: float = quantity(
        "", "", "as ISO/TR 14521 rates it, there and without the pressure angle"
    )
    elastic_slip: float = quantity(
        "s_eff", "m", "way along the flank from none to full friction, asperities and teeth"
    )
    threshold: float | None = quantity(
        "u_0", "m", "least amplitude of the vibration under which it creeps"
    )
    threshold_closed_form: float | None = quantity(
        "s_eff (1 - phi)", "m", "the same by its closed form, along the flank alone"
    )
    creep: float | None = quantity(
        "", "rad/s", "mean speed of the wheel under the case's vibration", key="creep_rad_s"
    )
    settled: bool | None = quantity("", "", "whether that speed stays")
    settled_by: str = quantity("", "", "settled by", shown=False, default="")
    step_error: float | None = quantity(
        "", "", "error of that speed from the step, about", default=None
    )
    creep_closed_form: float | None = quantity(
        "v_a sin(pi phi/2)", "rad/s", "the same far beyond the threshold",
        key="creep_closed_form_rad_s",
    )  # fmt: skip
    amplitude: FloatArray = quantity(
        "u_a", "m", "amplitude of the vibration", dims=_AMPLITUDES, coordinate=True
    )
    creep_over: FloatArray = quantity(
        "", "rad/s", "mean speed of the wheel at an amplitude", dims=_AMPLITUDES
    )
    creep_limit: FloatArray = quantity(
        "", "rad/s", "far beyond the threshold, by its closed form", dims=_AMPLITUDES
    )
    settled_over: npt.NDArray[np.int8] = quantity(
        "", "", "1 where that speed stays", dims=_AMPLITUDES
    )

    def headline(self) -> tuple[str, ...]:
        """Return that the creep under the case's vibration is none that stays, where it is not."""
        return told(self)

    def write(self, folder: Path, *, pictures: str = "png") -> list[str]:
        """Write JSON, netCDF and, of one that is shaken, a picture."""
        return super().write(folder, pictures=pictures if self.amplitude.size else "")

    def pictures(self, folder: Path | None = None) -> "tuple[Picture, ...]":
        """Return its picture, of one that is shaken."""
        return super().pictures(folder) if self.amplitude.size else ()

    @property
    def inputs(self) -> Mapping[str, Any]:
        """What was asked, by ``table.key``."""
        return inputs(self.problem)


def prepare(case: Case) -> DriveProblem:
    """Return the problem of a case, its motor off; InputError where it cannot be solved.

    Without a vibration it is asked no more than whether it holds.
    """
    if Vibration.table in case:
        return prepare_shaken(case, _PROTOCOL)
    problem = prepare_drive(case, static=True)
    drive = problem.drive.model_copy(update={"protocol": _PROTOCOL})
    return dataclasses.replace(problem, drive=drive)


def answer(problem: DriveProblem, run: Run) -> Locking:
    """Find what a gearset holds.

    Raises
    ------
    ConvergenceError
        A march's powers do not balance.
    """
    reduced = reduction(problem, run)
    model = ReducedModel(problem, reduced)
    point = model.point
    at_rest = model.holding
    share = point.holding_share(at_rest)
    locked = share < 1.0
    force = point.normal_force(problem.load, -min(share, 1.0) * at_rest)
    slip = model.elastic_slip * force / model.normal_force
    notes = [*reduced.notes, *_near_limit(problem, point, at_rest)]
    if problem.vibration is None:
        return _at_rest(problem, model, notes, share, slip)
    # Way along the flank for a displacement of the vibration, and the wheel's turn for a way.
    along = _along(problem, model)
    turn = 1.0 / (point.length * point.ratio)
    frequency = 2.0 * math.pi * problem.vibrated[1].frequency
    closed = slip * (1.0 - share) / along if locked else None
    search = _Search(problem, reduced, point, turn * along * frequency, run)
    amplitudes = _CHART * slip / along
    marched = search.marches([*amplitudes, problem.amplitude] if locked else [problem.amplitude])
    own = marched[-1]
    over = marched[:-1] if locked else marched
    if not own.settled:
        notes.append(f"the creep under the case's vibration has not settled: {own.settled_by}")
    threshold = None
    if locked:
        threshold, remarks = search.threshold(amplitudes, over)
        notes += [*remarks, *_yields(problem.friction, threshold, closed or 0.0)]
    else:
        notes.append(_DRIVES)
    limit = math.sin(0.5 * math.pi * min(share, 1.0)) * turn * along * frequency
    chart = amplitudes if locked else np.array([problem.amplitude])
    return Locking(
        problem=problem,
        locked=locked,
        holding_share=share,
        holding_share_rated=problem.point(None).holding_share(at_rest),
        holding_share_without_pressure_angle=_without_pressure_angle(problem) / at_rest,
        elastic_slip=slip,
        threshold=threshold,
        threshold_closed_form=closed,
        creep=own.creep,
        settled=own.settled,
        settled_by=own.settled_by,
        step_error=own.step_error,
        creep_closed_form=limit * problem.amplitude if locked else None,
        amplitude=chart,
        creep_over=np.array([each.creep for each in over]),
        creep_limit=limit * chart,
        settled_over=np.array([each.settled for each in over], np.int8),
        notes=tuple(notes),
    )


def _at_rest(
    problem: DriveProblem, model: ReducedModel, notes: Sequence[str], share: float, slip: float
) -> Locking:
    """Return whether a gearset holds that nothing shakes, which takes no march."""
    none = np.zeros(0)
    return Locking(
        problem=problem,
        locked=share < 1.0,
        holding_share=share,
        holding_share_rated=problem.point(None).holding_share(model.holding),
        holding_share_without_pressure_angle=_without_pressure_angle(problem) / model.holding,
        elastic_slip=slip,
        threshold=None,
        threshold_closed_form=None,
        creep=None,
        settled=None,
        creep_closed_form=None,
        amplitude=none,
        creep_over=none,
        creep_limit=none,
        settled_over=np.zeros(0, np.int8),
        notes=(*notes, _NOT_SHAKEN if share < 1.0 else _DRIVES),
    )


def _without_pressure_angle(problem: DriveProblem) -> float:
    """Friction from which on a worm locks itself by standards that leave out the pressure angle."""
    return math.tan(problem.geometry.lead_angle)


def _near_limit(problem: DriveProblem, point: MeshPoint, friction: float) -> tuple[str, ...]:
    """Return that a rating has another limit, where the friction is between that and its own."""
    rated = _without_pressure_angle(problem)
    across = friction * problem.point(None).holding_share(friction)
    here = friction * point.holding_share(friction)
    if not min(here, across) <= friction <= max(here, rated):
        return ()
    return (
        f"near its limit: a friction of {friction:.4g} counts, and {here:.4g} holds the load where "
        f"its teeth touch, {1e3 * point.radius:.4g} mm from the worm's axis; asperity rate has the "
        f"limit on the reference circle, at {1e3 * problem.reference_radius:.4g} mm, as "
        f"{rated:.4g} by ISO/TR 14521 and, unless asked otherwise, BS 721, which leave out the "
        f"pressure angle, and {across:.4g} with it, by AGMA 6034",
    )


def _along(problem: DriveProblem, model: ReducedModel) -> float:
    """Way along the flank per displacement of the vibration."""
    point, radius = model.point, problem.reference_radius
    return {
        "axial": point.lead / point.length,
        "torsional": point.radius**2 / (point.length * radius),
        "wheel-axial": point.radius / point.length,
        "screw": point.length / radius,
    }[problem.mode]


def _creeps_always(friction: Friction) -> bool:
    """Return whether asperities creep at any amplitude, whichever way they slip."""
    return friction.model != "coulomb" and friction.exponent > 0.0


def _yields(friction: Friction, threshold: float | None, closed: float) -> tuple[str, ...]:
    """Return that asperities yield below their limit, where they do."""
    said = "such asperities creep at any amplitude"
    if not _creeps_always(friction):
        if friction.model == "coulomb" or threshold is None or threshold >= 0.05 * closed:
            return ()
        said = "a slip across the flank makes such asperities yield below their limit"
    return (f"friction.exponent is {friction.exponent:g}: {said}; friction.model 'coulomb' holds",)


class _Marched(NamedTuple):
    """What a march without a motor came to.

    Attributes
    ----------
    creep, spread : float
        The wheel's speed in the load's direction, and how far its blocks are apart in it, rad/s.
    settled, settled_by, step_error
        As of `asperity.drive.result.DriveResult`.
    """

    creep: float
    spread: float
    settled: bool
    settled_by: str
    step_error: float | None


class _Search:
    """Marches at many amplitudes; ``unit`` is the wheel's speed per amplitude."""

    def __init__(
        self, problem: DriveProblem, reduced: Reduction, point: MeshPoint, unit: float, run: Run
    ) -> None:
        self._problem = problem
        self._point = point
        self._reduced = reduced
        self._unit = unit
        self._run = run
        self._known = run.resume(key(code_key(__name__), asked(problem))) or {}
        # Whether it creeps at an amplitude, None where it has not settled.
        self._moves: dict[float, bool | None] = {}
        # Those that creep, at a speed that has not settled.
        self._unsteady: set[float] = set()

    def marches(self, amplitudes: Sequence[float] | FloatArray) -> list[_Marched]:
        """Return what it does at each amplitude."""
        shaken = [
            (self._problem.shaken(self._problem.mode, float(amplitude)), self._reduced)
            for amplitude in amplitudes
        ]
        found = solve_many(shaken, self._run, what="amplitudes", known=self._known)
        return [_marched(each, self._point) for each in found]

    def threshold(
        self, amplitudes: FloatArray, marched: Sequence[_Marched]
    ) -> tuple[float | None, tuple[str, ...]]:
        """Return the least amplitude that creeps, and what to know of it.

        None where none does, or where marches beside it have not settled; 0 where every one does.

        Parameters
        ----------
        amplitudes : ndarray
            Those tried, m.
        marched : sequence of _Marched
            What it does at each of them.
        """
        self._save(amplitudes, marched)
        low, high, loose = self._bounds()
        if not math.isfinite(high):
            if loose:
                return None, (
                    f"no march that has settled creeps: {len(loose)} of {len(amplitudes)} "
                    "amplitudes have not, and the threshold may be there",
                )
            return None, ("no amplitude up to 20 times its elastic slip sets it free",)
        deeper = 0 if low or _creeps_always(self._problem.friction) else _DEEPEST
        for _ in range(deeper):
            self._try(_LOWER * high)
            low, high, loose = self._bounds()
            if low:
                break
        for _ in range(_ROUNDS if low else 0):
            self._try(np.geomspace(low, high, _AT_ONCE + 2)[1:-1])
            low, high, loose = self._bounds()
        if loose:
            return None, (_between(low, high, loose),)
        told = f"the march at {_MICRO * high:.3g} um has not settled, but creeps in all its blocks"
        return math.sqrt(low * high), (told,) if high in self._unsteady else ()

    def _try(self, amplitudes: FloatArray) -> None:
        self._save(amplitudes, self.marches(amplitudes))

    def _save(self, amplitudes: FloatArray, marched: Sequence[_Marched]) -> None:
        for amplitude, each in zip(amplitudes.tolist(), marched, strict=True):
            creeps = bool(each.creep > (least := _CREEPS * self._unit * amplitude))
            self._moves[amplitude] = creeps if each.settled else None
            if not each.settled and each.creep - each.spread > least:
                self._moves[amplitude] = True
                self._unsteady.add(amplitude)

    def _bounds(self) -> tuple[float, float, list[float]]:
        """Return the greatest that holds below the least that creeps, that, and what is between.

        0 and infinite where there is none.
        """
        high = min((u for u, moves in self._moves.items() if moves), default=math.inf)
        low = max((u for u, moves in self._moves.items() if moves is False and u < high), default=0)
        loose = [u for u, moves in self._moves.items() if moves is None and low < u < high]
        return low, high, loose


def _marched(outcome: DriveResult | AsperityError, point: MeshPoint) -> _Marched:
    if isinstance(outcome, AsperityError):
        raise outcome
    if outcome.creep is None:
        raise ConvergenceError("a march without a motor told no creep", reached={})
    apart = math.inf if outcome.spread is None else outcome.spread
    apart *= max(least_creep(outcome.problem, point), abs(outcome.creep))
    return _Marched(
        -outcome.creep + 0.0, apart, outcome.settled, outcome.settled_by, outcome.step_error
    )


def _between(low: float, high: float, loose: Sequence[float]) -> str:
    """Return where a threshold is that marches which have not settled hide."""
    return (
        f"it begins to creep between {_MICRO * low:.3g} and {_MICRO * high:.3g} um, where "
        f"{len(loose)} marches have not settled: no threshold is told; a longer solve.duration may "
        "settle them"
    )

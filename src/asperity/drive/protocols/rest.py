"""A drive without vibration: what its ratios refer to, and where its march begins.

Under constant friction that is steady sliding, in closed form, in which a march stays. Friction
that falls with the speed may shake a drive by itself: then it is the state that a march without
vibration comes to, and the march under vibration goes on from it. A held wheel that was slid
against before is let come to rest.
"""

import dataclasses
import math

import numpy as np
import numpy.typing as npt

from asperity.arrays import FloatArray
from asperity.drive.lugre import of_speed, static_ratio
from asperity.drive.motion.system import System
from asperity.drive.problem import DriveProblem
from asperity.drive.protocols.equations_of_motion import begin, system
from asperity.drive.protocols.judgement import PERIODIC
from asperity.drive.protocols.march import March, Records, mean
from asperity.drive.reduced.mesh_model import MeshModel
from asperity.runs import Run

_SECONDS, _SWINGS = 60e-3, 20  # marched at least, and of the wheel on what holds it
_STRETCHES, _PARTS = 60, 10
_LONGER = (1, 4)  # times as long, where it still grows by so much from part to part
_GROWS = 1.05
_WHOLE = 0.05  # of a number of pitches, by which it may miss a whole one
# Of the wheel's speed; and where steady sliding is missed by no more, a march stays in it.
_NUDGE, _MISSED = 1e-4, 1e-6


@dataclasses.dataclass(frozen=True)
class Rest:
    """A drive without vibration.

    Attributes
    ----------
    torque : float
        Mean of the worm's, N m; of a held wheel that of the motor.
    wheel_torque : float
        Mean of the mesh's on the wheel, N m.
    normal : float
        Mean normal force, N.
    spread : float
        Of its torque over three parts of its march; of steady sliding the share it may be off by.
    marched : bool
        Whether it is another than steady sliding.
    states, committed : ndarray
        Where the march under vibration begins.
    """

    torque: float
    wheel_torque: float
    normal: float
    spread: float
    marched: bool
    states: Records
    committed: FloatArray

    @property
    def settled(self) -> bool:
        """Whether its torque stays."""
        return self.spread <= PERIODIC


def at_rest(
    problem: DriveProblem,
    model: MeshModel,
    moving: System,
    stop: npt.NDArray[np.int64] | None = None,
) -> Rest:
    """Return a drive without vibration.

    Parameters
    ----------
    problem, model, moving : DriveProblem, MeshModel, System
        What is asked, its mesh and what moves.
    stop : ndarray of int64, shape (1,), optional
        As of `asperity.drive.protocols.solve.solve_shaken`.
    """
    held = not moving.rolls
    steady = Rest(
        model.worm_torque, problem.load, model.normal_force, model.torque_off, False,
        *begin(problem, model, moving),
    )  # fmt: skip
    # Of the first cycles, steady sliding is what they begin in.
    if problem.drive.protocol == "window" or not _of_speed(problem, model, moving):
        return steady
    seconds = max(_SECONDS, _SWINGS / _slowest(model, moving))
    measure, expected = ("wheel_torque", problem.load) if held else ("torque", model.worm_torque)
    for times in _LONGER:
        march, rows = _marched(problem, model, moving, times * seconds, stop)
        ripples = [
            float(part["torque_max"].max() - part["torque_min"].min())
            for part in np.split(rows, _PARTS)
        ]
        if not ripples[-1] > _GROWS * ripples[-2]:
            break
    last = rows[rows.size // 2 :]
    parts = [mean(part, measure) / expected for part in np.split(last, 3)]
    # A push that fades leaves the mean no further off than it was.
    fades = moving.rolls and ripples[-2] > _GROWS * ripples[-1]
    if abs(float(np.mean(parts)) - 1.0) < (_NUDGE if fades else _MISSED):
        return steady
    return Rest(
        model.worm_torque if held else mean(last, "torque"),
        mean(last, "wheel_torque"), mean(last, "driving"), float(np.ptp(parts)), True,
        march.states, march.committed,
    )  # fmt: skip


def over_the_same(
    problem: DriveProblem, model: MeshModel, march: March, cycles: int, rest: Rest
) -> Rest:
    """Return a drive without vibration over the part of a pitch that its march was judged by.

    Parameters
    ----------
    problem, model, march : DriveProblem, MeshModel, March
        What was asked, its mesh and what was marched.
    cycles : int
        By which it was judged, the last of them.
    rest : Rest
        The same over whole pitches.
    """
    if model.pitch is None or not (march.system.speed and march.system.rolls):
        return rest
    if problem.drive.protocol == "window":
        still = system(problem, model, shaken=False)
        before = March(model, still, *begin(problem, model, still), Run(), march.stop)
        before.go(cycles)
        return dataclasses.replace(rest, torque=mean(before.rows, "torque"), spread=0.0)
    pitches = cycles * march.cycle / model.pitch
    if abs(pitches - round(pitches)) < _WHOLE * pitches:
        return rest
    last = problem.worm_speed * march.rows.size * march.cycle
    first = last - problem.worm_speed * cycles * march.cycle
    torque, off = model.torque_over(first, last)
    return dataclasses.replace(rest, torque=torque, spread=off)


def _marched(
    problem: DriveProblem, model: MeshModel, moving: System, seconds: float,
    stop: npt.NDArray[np.int64] | None,
) -> tuple[March, Records]:  # fmt: skip
    """March until the vibration begins, which stands still before where it begins."""
    march = March(model, moving, *begin(problem, model, moving, seconds), Run(), stop)
    if moving.rolls:
        march.states[0]["roll_rate"] *= 1.0 + _NUDGE
    rows = march.stretches(_STRETCHES, seconds / _STRETCHES)
    march.states[0]["time"] = 0.0
    return march, rows


def _of_speed(problem: DriveProblem, model: MeshModel, moving: System) -> bool:
    """Return whether friction may leave steady sliding: falling with the speed, or at rest."""
    if model.pitch is not None or not (moving.speed or moving.motor_torque):
        return False
    law = problem.friction
    falls = model.curve.values.size > 1 or (
        law.model == "lugre" and static_ratio(law) > 1.0 and law.stribeck_velocity > 0.0
    )
    return falls or (not moving.rolls and of_speed(law))


def _slowest(model: MeshModel, moving: System) -> float:
    """Natural frequency of the wheel on teeth and shaft, Hz."""
    point = model.point
    give = 1.0 / ((point.normal_z * point.arm) ** 2 * model.stiffness[0])
    if moving.torsion:
        give += 1.0 / (moving.torsion * point.ratio**2)
    return 1.0 / (2.0 * math.pi * math.sqrt(give * moving.wheel_inertia))

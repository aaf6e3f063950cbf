"""A stroke marched: load by the wheel's turn, vibration by who decides, then the motor stops."""

import dataclasses
import math
from collections.abc import Callable

import numpy as np

from asperity.arrays import FloatArray
from asperity.drive.control.machine import Machine, load_at
from asperity.drive.control.parameters import Control
from asperity.drive.motion.system import SUMS
from asperity.drive.problem import DriveProblem
from asperity.drive.protocols.judgement import steady_speed
from asperity.drive.protocols.march import Records
from asperity.drive.reduced.mesh_model import MeshModel
from asperity.runs import Run
from asperity.runs.tree import Tree

_RECORDED = 600
_RUN_UP = 6.0  # rises, until the amplitude of a stroke that begins shaken is there
_CALM = 20e-3  # s, and until teeth and shaft have come to rest at it
_HOLDS = 60e-3  # s with the motor off, beside the vibration's dying away
_AT_REST = 1e-3  # of the wheel's speed with the motor on, that is no creep
_LOOK = 256  # ticks between two looks at whether it is to stop


@dataclasses.dataclass(frozen=True)
class Stroke:
    """What a stroke came to; torques in N m, of the motor, a cam's share in it.

    Attributes
    ----------
    time, turn, load, torque, amplitude, reading, on : ndarray
        Some hundred stretches of it: their ends in s, the wheel's turn in rad, its load, the
        motor's mean torque, the share of the full amplitude, the last reading, and whether the
        controller asks for vibration.
    peak, mean, rms : float
        Of the motor's torque: greatest mean over ``control.peak_time``, mean, root mean square of
        such means.
    energy_motor, energy_actuator : float
        Mechanical, J; a cam's is part of the motor's.
    share_on : float
        Of its time, with any vibration.
    switched : int
        Times that the vibration was switched on, that of the beginning among them.
    late : float
        From where the load of the second seat reaches ``control.on`` to the amplitude's first
        :math:`1 - 1/e`, s; NaN where that does not come.
    fault, fault_time
        What was found, and when, s; empty and NaN where nothing was.
    crept : float
        The wheel's turn from where the motor stops on, as the load pushes it, rad.
    holds : bool
        Whether it then stands.
    ripple, read_ripple : float
        Greatest less least of the sensor's torque and of what is behind the filter, in the last
        tenth of the second seat, N m.
    closure : float
        Of all powers, what is missing over what is put in.
    steps : int
        Of the march.
    """

    time: FloatArray
    turn: FloatArray
    load: FloatArray
    torque: FloatArray
    amplitude: FloatArray
    reading: FloatArray
    on: FloatArray
    peak: float
    mean: float
    rms: float
    energy_motor: float
    energy_actuator: float
    share_on: float
    switched: int
    late: float
    fault: str
    fault_time: float
    crept: float
    holds: bool
    ripple: float
    read_ripple: float
    closure: float
    steps: int


def march_stroke(
    problem: DriveProblem, model: MeshModel, control: Control, failure: str, run: Run,
    done: int = 0, of: int = 1000, *, coarser: float = 1.0,
    kept: Callable[[], Tree] | None = None,
) -> Stroke:  # fmt: skip
    """March a stroke from seat to seat, and what comes when the motor has stopped.

    Parameters
    ----------
    problem, model : DriveProblem, MeshModel
        The drive and its mesh.
    control : Control
        Who decides.
    failure : str
        A key of `asperity.drive.control.parameters.FAILURES`, or empty.
    run : Run
        Who is told how far it is.
    done, of : int
        Thousandths of all strokes that are done, and of how many.
    coarser : float
        Steps are so many times as long as chosen.
    kept : callable, optional
        Gives the strokes that are done.

    Raises
    ------
    ConvergenceError
        The motion left the finite numbers.
    """
    machine = Machine(problem, model, control, failure, run, coarser)
    begins = control.begins_on and not machine.clutch
    machine.switch.begin(0.0, on=begins)
    machine.target = float(begins and failure != "dead")
    ahead = (_RUN_UP * machine.rise + _CALM) if begins else 0.0
    while machine.now < ahead or machine.ticks % machine.parts:
        machine.advance(machine.seat, motor=True)
    started, speed = machine.now, problem.worm_speed
    # A controller counts from where the stroke begins.
    machine.switch.begin(started, on=machine.switch.on)
    whole = problem.drive.stroke * model.point.ratio / speed
    whole = machine.cycle * math.ceil(whole / machine.cycle)
    ticks = round(whole / machine.tick)
    rows, traces, switched = np.zeros(ticks, SUMS), [], int(machine.target)
    before = float(machine.march.states[0]["stored"])
    turn, target, late, crossed = 0.0, machine.target, math.nan, math.nan
    tail: list[tuple[float, float, float, float]] = []
    for n in range(ticks):
        if n % _LOOK == 0:
            run.checkpoint(done + 1000 * n // ticks, of, kept, "thousandths of strokes")
        load = load_at(problem, control, turn)
        if started + whole - machine.now <= control.cut_ahead and machine.failure != "latched":
            machine.cut_off()
        some, behind = machine.advance(load, motor=True, turn=turn)
        rows[n] = _summed(some)
        turn += float(some["rolled"].sum())
        if machine.target > target:
            switched += 1
        target = machine.target
        second = turn > 0.5 * problem.drive.stroke
        if second and math.isnan(crossed) and _reaches(machine, load):
            crossed = machine.now
        if second and math.isnan(late) and machine.amplitude >= 1.0 - math.exp(-1.0) - 1e-9:
            late = machine.now - crossed
        if turn > problem.drive.stroke - 0.1 * problem.drive.stroke_seat:
            name = "torque" if control.sensor == "motor" and not machine.clutch else "wheel_torque"
            raw = some[name] / some["time"]
            tail.append((raw.min(), raw.max(), min(behind), max(behind)))
        traces.append((
            machine.now - started, turn, load, machine.amplitude, machine.reading,
            float(machine.switch.on),
        ))  # fmt: skip
    crept, holds = _after(machine, turn)
    return _summary(machine, rows, np.array(traces), started, before, switched, late, crept, holds,
                    np.array(tail))  # fmt: skip


def _reaches(machine: Machine, load: float) -> bool:
    """Whether a load without vibration would read as much as switches on."""
    torque = load
    if machine.still != machine.seat:
        torque = machine.still * load / machine.seat
    return torque >= machine.control.on


def _after(machine: Machine, turn: float) -> tuple[float, bool]:
    """March on with the motor off: the way that the load pushes the wheel, and whether it holds."""
    machine.stop_motor()
    rolled, time = [], []
    end = machine.now + _HOLDS + 10.0 * machine.rise
    while machine.now < end:
        rows, _ = machine.advance(machine.seat, motor=False, turn=turn)
        rolled.append(rows["rolled"].sum())
        time.append(rows["time"].sum())
    quarter = len(rolled) // 4
    speed = steady_speed(np.array(rolled[-quarter:]), np.array(time[-quarter:]))
    running = machine.problem.worm_speed / machine.model.point.ratio
    return -float(np.sum(rolled)) + 0.0, abs(speed) < _AT_REST * running


_EXTREMES = ("torque_min", "torque_max", "driving_min", "driving_max", "back_max", "residual",
             "advantage_min", "advantage_max")  # fmt: skip


def _summed(rows: Records) -> np.void:
    """Return stretches one after the other as one; of what is no sum, the last."""
    one: np.void = rows[-1].copy()
    for name in rows.dtype.names or ():
        if name not in _EXTREMES and name != "stored":
            one[name] = rows[name].sum()
    return one


def _summary(
    machine: Machine, rows: Records, traces: FloatArray, started: float, before: float,
    switched: int, late: float, crept: float, holds: bool, tail: FloatArray,
) -> Stroke:  # fmt: skip
    speed, time = machine.problem.worm_speed, rows["time"]
    given = rows["drive"] + (rows["actuator"] if machine.clutch else 0.0)
    # Over whole cycles: a part of one would tell the vibration's swing.
    cycles = math.ceil(machine.control.peak_time / machine.cycle * (1.0 - 1e-9))
    window = min(cycles * machine.parts, rows.size)
    work = np.concatenate([[0.0], np.cumsum(given)])
    clock = np.concatenate([[0.0], np.cumsum(time)])
    means = (work[window:] - work[:-window]) / (speed * (clock[window:] - clock[:-window]))
    put_in = rows["drive"].sum() + rows["actuator"].sum()
    ledger = {name: float(rows[name].sum()) for name in ("load", "friction", "contact_damping",
                                                         "shaft_damping")}  # fmt: skip
    stored = float(rows["stored"][-1]) - before
    scale = max(abs(put_in), *(abs(each) for each in ledger.values()))
    apart = np.linspace(0, rows.size, min(_RECORDED, rows.size) + 1).round().astype(int)
    ends = apart[1:] - 1
    torque = np.diff(work[apart]) / (speed * np.diff(clock[apart]))
    columns = traces[ends].T
    return Stroke(
        time=columns[0], turn=columns[1], load=columns[2], torque=torque,
        amplitude=columns[3], reading=columns[4], on=columns[5],
        peak=float(means.max()),
        mean=float(work[-1] / (speed * clock[-1])),
        rms=float(math.sqrt(np.mean(means**2))),
        energy_motor=float(given.sum()),
        energy_actuator=float(rows["actuator"].sum()),
        share_on=float((time * (traces[:, 3] > 0.0)).sum() / time.sum()),
        switched=switched,
        late=late,
        fault=machine.switch.fault,
        fault_time=machine.switch.fault_time - started,
        crept=crept,
        holds=holds,
        ripple=float(tail[:, 1].max() - tail[:, 0].min()) if tail.size else 0.0,
        read_ripple=float(tail[:, 3].max() - tail[:, 2].min()) if tail.size else 0.0,
        closure=abs(put_in - sum(ledger.values()) - stored) / scale,
        steps=int(rows["steps"].sum()),
    )  # fmt: skip

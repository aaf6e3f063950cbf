"""The command `control`: a stroke whose vibration is switched, and what fails in it."""

import dataclasses
import math

import numpy as np

from asperity.casefile import Case, naming_source
from asperity.drive.control.machine import rise_of, seat_and_between
from asperity.drive.control.parameters import FAILURES, Control
from asperity.drive.control.result import Controlled
from asperity.drive.control.sensor import alias, late_by, passed
from asperity.drive.control.stroke import Stroke, march_stroke
from asperity.drive.models import model_of
from asperity.drive.problem import DriveProblem
from asperity.drive.protocols.equations_of_motion import system
from asperity.drive.protocols.solve import asked
from asperity.drive.reduced.mesh_model import MeshModel
from asperity.drive.reduced.reduction import reduction
from asperity.drive.solve import prepare as prepare_drive
from asperity.errors import ConvergenceError, InputError
from asperity.results.ledger import NOTED, REFUSED
from asperity.results.settled import smaller_step
from asperity.runs import Run
from asperity.runs.key import code_key, key
from asperity.runs.tree import from_tree, to_tree
from asperity.slider.parameters import in_proportion
from asperity.vibration.waveform import SAMPLED

_COARSER = 2.0
_CHATTERS = 2  # times on in a stroke from seat to seat: once at each
_PLAIN = ""
_MOST_CYCLES = 2e6


def prepare(case: Case) -> DriveProblem:
    """Return the problem of a case; InputError where no stroke can be marched."""
    problem = prepare_drive(case)
    with naming_source(case):
        _, shape = problem.vibrated
        control, drive = case.require(Control), problem.drive
        if drive.model != "reduced":
            raise InputError(
                "drive.model is 'teeth', whose strokes take days; asperity control marches "
                "'reduced': leave it out"
            )
        if shape.code == SAMPLED:
            raise InputError(
                "vibration.waveform is 'sampled', which need not begin at nothing, so that it "
                "cannot be switched without a jump: take 'sine', 'triangle' or 'square'"
            )
        if shape.ramp:
            raise InputError(
                "vibration.ramp is of a vibration that begins once; here control.rise says how "
                "fast the amplitude comes and goes: leave it out"
            )
        if control.kind == "clutch" and problem.vibrated[0].per_turn is None:
            raise InputError(
                "control.kind is 'clutch', whose cam turns with the worm: give "
                "vibration.frequency as '12 per turn'"
            )
        if not 2.0 * (drive.stroke_seat + control.seat_edge) < drive.stroke:
            raise InputError(
                f"control.seat_edge is {math.degrees(control.seat_edge):.4g} deg and "
                f"drive.stroke_seat {math.degrees(drive.stroke_seat):.4g} deg; both seats leave "
                f"nothing of a stroke of {math.degrees(drive.stroke):.4g} deg: give less"
            )
        cycles = drive.stroke * problem.geometry.gear_ratio / problem.worm_speed * shape.frequency
        if not cycles <= _MOST_CYCLES:
            raise InputError(
                f"drive.stroke is {math.degrees(drive.stroke):.4g} deg, {cycles:.3g} cycles of the "
                f"vibration; a stroke is marched over {_MOST_CYCLES:.0e} at most: give less"
            )
    return problem


def answer(problem: DriveProblem, run: Run) -> Controlled:
    """March a stroke without and with each failure.

    Raises
    ------
    ConvergenceError
        The motion left the finite numbers.
    """
    if problem.case is None:
        raise InputError("a stroke needs a case with [control]")
    control = problem.case.require(Control)
    with in_proportion():
        model = model_of(problem, reduction(problem, run), run)
        strokes, again = _strokes(problem, model, control, run)
    return _summarised(problem, model, control, strokes, again)


def _strokes(
    problem: DriveProblem, model: MeshModel, control: Control, run: Run
) -> tuple[dict[str, Stroke], Stroke]:
    """March those that are not known yet, the plain one twice: in longer steps as well."""
    known = run.resume(key(code_key(__name__), asked(problem))) or {}
    names = (_PLAIN, *control.tried)
    wanted = [*((name, 1.0) for name in names), (_PLAIN, _COARSER)]
    found = []
    longest = system(problem, model).longest
    time = problem.drive.stroke * model.point.ratio / problem.worm_speed
    steps = time / longest * len(wanted)
    run.forecast(model.step_seconds * steps, f"{steps:.3g} steps")
    with run.interruptible():
        for n, (name, coarser) in enumerate(wanted):
            label = f"{name or 'none'}-{coarser:g}"
            if label not in known:
                made = march_stroke(
                    problem, model, control, name, run, 1000 * n, 1000 * len(wanted),
                    coarser=coarser, kept=lambda: known,
                )  # fmt: skip
                known[label] = to_tree(made)
            found.append(from_tree(Stroke, known[label]))
    return dict(zip(names, found, strict=False)), found[-1]


def _summarised(
    problem: DriveProblem, model: MeshModel, control: Control, strokes: dict[str, Stroke],
    again: Stroke,
) -> Controlled:  # fmt: skip
    plain, every = strokes[_PLAIN], list(strokes.values())
    worst = max(each.closure for each in every)
    if worst > REFUSED:
        given = problem.solve.step is not None
        advice = smaller_step(
            system(problem, model).longest, worst / NOTED, given=given, sure=False
        )
        raise ConvergenceError(
            f"the powers of a stroke are off by {worst:.2g}: {advice}",
            reached={"closure": worst},
        )
    _, shape = problem.vibrated
    cycle = 1.0 / shape.frequency
    clutch = control.kind == "clutch"
    rate = 1.0 / cycle if clutch else control.sample_rate
    seat, between = seat_and_between(problem)
    static = model.worm_torque
    answer = Controlled(
        problem=problem,
        control=control,
        names=np.array([name or "none" for name in strokes]),
        torque_static=static,
        torque_static_between=model.point.worm_torque(between, model.friction),
        peak=plain.peak,
        peak_ratio=plain.peak / static,
        mean=plain.mean,
        rms=plain.rms,
        energy_motor=plain.energy_motor,
        energy_actuator=plain.energy_actuator,
        share_on=plain.share_on,
        switched=plain.switched,
        late=None if math.isnan(plain.late) else plain.late,
        crept=plain.crept,
        holds=plain.holds,
        rise=rise_of(problem, control, shape.frequency),
        ripple=plain.ripple,
        read_ripple=plain.read_ripple,
        filter_leaves=passed(control, shape.frequency, cycle),
        filter_late=late_by(control, cycle),
        read_as=None if clutch else alias(shape.frequency, rate),
        closure=worst,
        step_error=abs(again.energy_motor / plain.energy_motor - 1.0),
        steps=sum(each.steps for each in every),
        time=plain.time,
        turn=np.stack([each.turn for each in every]),
        load=np.stack([each.load for each in every]),
        torque=np.stack([each.torque for each in every]),
        amplitude=np.stack([each.amplitude for each in every]),
        reading=np.stack([each.reading for each in every]),
        peaks=np.array([each.peak for each in every]),
        shares_on=np.array([each.share_on for each in every]),
        times_on=np.array([each.switched for each in every]),
        creeps=np.array([each.crept for each in every]),
        held=np.array([each.holds for each in every], np.int8),
        faults=np.array([each.fault for each in every]),
        fault_times=np.array([each.fault_time for each in every]),
    )
    notes = (*model.reduction.notes, *_notes(answer, seat, between))
    return dataclasses.replace(answer, notes=notes)


def _notes(controlled: Controlled, seat: float, between: float) -> list[str]:
    control, notes = controlled.control, []
    if controlled.closure > NOTED:
        notes.append(f"the powers of a stroke close to {controlled.closure:.1g} only")
    thrust = control.kind == "clutch" or control.sensor == "thrust"
    most = seat if thrust else controlled.torque_static
    least = between if thrust else controlled.torque_static_between
    if not control.on < most:
        notes.append(
            f"control.on is {control.on:g} N m, but the seat reads {most:.4g} N m without "
            "vibration: it never comes of a reading"
        )
    if not control.off > least:
        notes.append(
            f"control.off is {control.off:g} N m, but between the seats {least:.4g} N m are read "
            "without vibration: it need not go"
        )
    if controlled.switched > _CHATTERS:
        notes.append(
            f"it chatters: on {controlled.switched} times in a stroke of two seats. "
            + (
                "The motor's torque falls by the vibration itself, so off must lie below what it "
                "leaves of the seat's; the thrust does not fall"
                if not thrust
                else "off and on are nearer to each other than the reading's swing"
            )
        )
    notes += _of_dogs(controlled)
    if control.begins_on and control.kind == "electronic":
        notes.append(
            "the stroke begins when the vibration is there: the motor would else start against the "
            "seat without it, whatever the controller reads (control.begins_on)"
        )
    if control.kind == "clutch":
        notes.append(
            "the worm turns the cam, so that the actuator's power is the motor's: only a vibration "
            "that takes less power in all makes the motor's torque less"
        )
    if not control.interlock and control.kind == "electronic":
        notes.append("control.interlock is false: nothing but the controller cuts the vibration")
    notes += [f"{name}: {FAILURES[name]}" for name in controlled.names if name in FAILURES]
    return notes


def _of_dogs(controlled: Controlled) -> list[str]:
    """Return the line about a clutch whose places are too far apart for a seat."""
    control, problem = controlled.control, controlled.problem
    if control.kind != "clutch":
        return []
    turn = 2.0 * math.pi / problem.worm_speed
    seat = problem.drive.stroke_seat * problem.geometry.gear_ratio / problem.worm_speed
    if turn / control.dogs <= seat:
        return []
    return [
        f"the clutch can close every {1e3 * turn / control.dogs:.3g} ms (control.dogs), a seat "
        f"lasts {1e3 * seat:.3g} ms: it may pass before"
    ]

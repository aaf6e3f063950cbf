"""A shaken drive solved by its protocol."""

import dataclasses
import math
from typing import Any

import numpy as np
import numpy.typing as npt

from asperity.drive.actuator import Demand, demand, elastic_energy, system_efficiency
from asperity.drive.closed_form import screw_ratio
from asperity.drive.lugre import of_speed
from asperity.drive.motion.system import System
from asperity.drive.point import MeshPoint
from asperity.drive.problem import DriveProblem
from asperity.drive.protocols.accuracy import StepError, beside, measure_of, sensitive, step_error
from asperity.drive.protocols.disturbed import other_state
from asperity.drive.protocols.equations_of_motion import switched_off, system
from asperity.drive.protocols.judgement import Judgement, steady_speed
from asperity.drive.protocols.march import March, Records, bands_of, mean, refined
from asperity.drive.protocols.notes import WORM_ALONE, notes_of, of_saving, settled_by
from asperity.drive.protocols.rest import Rest, at_rest, over_the_same
from asperity.drive.protocols.saving import LEAST, Saving, saving
from asperity.drive.reduced.mesh_model import MeshModel
from asperity.drive.reduced.model import ReducedModel
from asperity.drive.result import Bands, CycleMeans, DriveLedger, DriveResult, HeldWheel
from asperity.errors import ConvergenceError
from asperity.results.ledger import NOTED, guard
from asperity.results.settled import smaller_step
from asperity.runs import Run
from asperity.runs.key import code_key, key

_SHOWN_CYCLES, _ROWS_A_CYCLE = 4, 200
_AFTER_SECONDS = 40e-3
# Of the vibration's own speed, the least by which a creep that has to stay is measured.
_CREEP = 0.1
# Of the step, what a march that does not settle is tried with once more.
_TRIED = 0.5
_AT_REST = 1e-3  # of the wheel's speed with the motor on, in the second half of that time
_BLOCKS = 3  # that a state is judged by
_POWERS = ("drive", "actuator", "load", "friction", "damping", "stored")


def solve_shaken(
    problem: DriveProblem,
    model: MeshModel,
    run: Run,
    stop: npt.NDArray[np.int64] | None = None,
) -> DriveResult:
    """Return the answer of a problem's protocol.

    Parameters
    ----------
    problem, model : DriveProblem, MeshModel
        The drive and its mesh.
    run : Run
        Who is told how far it is, and where it is kept.
    stop : ndarray of int64, shape (1,), optional
        Set it to 1 from another thread to have it raise `asperity.runs.Stopped`.

    Raises
    ------
    ConvergenceError
        The powers do not balance, or the motion left the finite numbers.
    """
    locked = problem.drive.protocol == "back-drive"
    moving = system(problem, model, motor=not locked)
    rest = at_rest(problem, model, moving, stop)
    march = March(model, moving, rest.states, rest.committed, run, stop)
    if kept := run.resume(key(code_key(__name__, type(model).__module__), asked(problem))):
        march.restore(kept)
        if march.finer != 1.0:
            rest = at_rest(problem, model, march.system, stop)
    window = problem.drive.window
    power = rest.torque * problem.worm_speed
    with run.interruptible():
        shown: Records | None = None
        others: tuple[str, ...] = ()
        if problem.drive.protocol == "window":
            # Of what is no state that lasts, no step makes the error.
            judged, off = _first_cycles(march, window, rest.torque, power), None
        else:
            judged, off, rest = _settled(problem, model, march, rest, stop)
        last = march.rows[-judged.cycles :]
        creep = steady_speed(last["rolled"], last["time"]) if locked else None
        held = _held_after(problem, model, march, run)
        if judged.settled:
            wanted = _wanted(problem, rest, model, march)
            others = other_state(problem, model, march, judged, rest, wanted, run)
        began = float(march.states[0]["time"])
        if run.detailed:
            shown = march.stretches(_SHOWN_CYCLES * _ROWS_A_CYCLE, march.cycle / _ROWS_A_CYCLE)
    rest = over_the_same(problem, model, march, judged.cycles, rest)
    answer = _summarise(problem, model, march, judged, rest, off)
    return dataclasses.replace(
        answer,
        creep=creep,
        held_after=held,
        notes=(*others, *answer.notes),
        bands=None if shown is None else Bands(**bands_of(shown, began)),
    )


def _settled(
    problem: DriveProblem,
    model: MeshModel,
    march: March,
    rest: Rest,
    stop: npt.NDArray[np.int64] | None,
) -> tuple[Judgement, StepError | None, Rest]:
    """March until the state is periodic, in steps as short as that takes where none was given."""
    while True:
        measure, scale = _measured(problem, rest, model)
        power = rest.torque * problem.worm_speed
        judged = march.settle(**_wanted(problem, rest, model, march))
        off = step_error(march, measure, scale, power) if judged.settled else None
        # Of elastic teeth steps are dear: of them the error is told alone.
        chosen = problem.solve.step is None and model.pitch is None
        finer = None
        if chosen and off is not None:
            finer = off.finer(march.finer, march.off)
            if finer is not None and sensitive(march, measure, scale, power):
                finer = None
        elif chosen and problem.solve.duration is None and march.finer == 1.0:
            # What has a period may lose it to a step that is too long.
            finer = _TRIED
        if finer is None:
            if off is not None:
                off = beside(off, march, measure, judged.spread)
            return judged, off, rest
        told = math.nan if off is None else measure_of(march, measure)
        rest = at_rest(problem, model, refined(march.system, finer), stop)
        march.restart(
            finer, math.inf if off is None else off.off, told, rest.states, rest.committed
        )


def asked(problem: DriveProblem) -> str:
    """Return all that is asked of a drive; a study asks otherwise than its case says."""
    case = problem.case.canonical() if problem.case is not None else repr(problem)
    changed = (table.model_dump_json() for table in (problem.drive, problem.vibrated[0]))
    return "\n".join((case, *changed))


def kind_of(problem: DriveProblem) -> type[DriveResult]:
    """Return the kind of answer that a problem's protocol has."""
    return HeldWheel if problem.drive.protocol == "held-wheel" else DriveResult


def _measured(problem: DriveProblem, rest: Rest, model: MeshModel) -> tuple[str, float]:
    """Return what of a protocol's motion has to stay, and what it is measured by."""
    if problem.drive.protocol == "back-drive":
        return "rolled", least_creep(problem, model.point)
    if problem.drive.protocol == "held-wheel":
        return "wheel_torque", problem.load
    return "torque", rest.torque


def _wanted(problem: DriveProblem, rest: Rest, model: MeshModel, march: March) -> dict[str, Any]:
    """Return what a march is to settle to, as `March.settle` takes it."""
    measure, scale = _measured(problem, rest, model)
    driven = bool(march.system.speed) and march.system.rolls
    return {
        "window": problem.drive.window,
        "measure": measure,
        "scale": scale,
        "power": rest.torque * problem.worm_speed,
        "duration": problem.solve.duration,
        "pitch": model.pitch if march.system.speed else None,
        "ratio": model.point.ratio if driven else None,
    }


def least_creep(problem: DriveProblem, point: MeshPoint) -> float:
    """Return the wheel's speed by which a creep that has to stay is measured at least, rad/s."""
    speed = problem.velocity / point.length or problem.worm_speed
    return _CREEP * speed / point.ratio


def _first_cycles(march: March, window: int, torque: float, power: float) -> Judgement:
    """March the first cycles alone; they are not a periodic state, whatever they look like."""
    march.go(window - march.rows.size)
    rows = march.rows
    spread = float(np.ptp(rows["torque"] / rows["time"])) / torque
    stored = march.into_store(window, power)
    return Judgement(False, False, spread, march.balance(rows), stored, 0.0, window)


def _held_after(problem: DriveProblem, model: MeshModel, march: March, run: Run) -> bool | None:
    """Whether the gearset holds once vibration and motor are off; None where it is not asked."""
    if problem.drive.protocol != "on-demand":
        return None
    still, left = switched_off(problem, model, march.system, march.states)
    after = March(model, still, left, march.committed.copy(), run, march.stop, march.tree)
    after.go(math.ceil(_AFTER_SECONDS * still.frequency))
    return abs(_drift(after.rows)) < _AT_REST * problem.worm_speed / model.point.ratio


def _drift(rows: Records) -> float:
    """Return the wheel's speed over the second half of rows, rad/s, its ringing left out.

    Of a wheel that rings on its teeth, mean places tell how it creeps; the ends of a time would
    tell its swing.
    """
    place, quarter = np.cumsum(rows["rolled"]), rows.size // 4
    earlier, later = place[-2 * quarter : -quarter], place[-quarter:]
    return float((later.mean() - earlier.mean()) / rows["time"][-quarter:].sum())


def _summarise(
    problem: DriveProblem, model: MeshModel, march: March, judged: Judgement, rest: Rest,
    off: StepError | None,
) -> DriveResult:  # fmt: skip
    rows, moving = march.rows, march.system
    residual = float(rows["residual"].max())
    last = rows[-judged.cycles :]
    time = float(last["time"].sum())
    whole = rows.size == judged.cycles
    before = march.stored if whole else float(rows[-judged.cycles - 1]["stored"])
    ledger = DriveLedger(
        drive=mean(last, "drive"),
        actuator=mean(last, "actuator"),
        load=mean(last, "load"),
        friction=mean(last, "friction"),
        damping=mean(last, "contact_damping") + mean(last, "shaft_damping"),
        stored=float(last["stored"][-1] - before) / time,
    )
    over = max(ledger.residual / NOTED, 1.0)
    advice = smaller_step(moving.longest, over, given=problem.solve.step is not None, sure=False)
    guarded = guard(ledger, advice, reached={"torque_balance": judged.balance})
    torque = rest.torque
    driven, kind = bool(moving.speed), kind_of(problem)
    first = rows[: problem.drive.window]
    power = torque * problem.worm_speed
    put_in = ledger.drive + ledger.actuator
    taken = _demand(problem, moving, ledger)
    touched = bool(np.isfinite(rows["advantage_min"]).any())
    unit = torque / problem.load
    measured = mean(last, "torque") if driven else None
    ratio = None if measured is None else measured / torque
    if kind is HeldWheel:
        # The motor pushes as it does without vibration, and the wheel's torque is what changes.
        measured, ratio = torque, rest.wheel_torque / mean(last, "wheel_torque")
    settled = judged.settled and rest.settled
    saved = None
    if settled and driven:
        saved = saving(rows, judged, rest, off, problem.load, power)
    efficiency = None
    if driven and taken is not None and ledger.drive + taken.electrical_power > 0.0:
        efficiency = system_efficiency(ledger.load, ledger.drive, taken.electrical_power)
    return kind(
        problem=problem,
        k_w=problem.velocity_ratio,
        torque_static=torque,
        torque=measured,
        torque_ratio=ratio,
        torque_ratio_closed_form=_closed_form(problem, model),
        torque_balance=judged.balance,
        settled=settled,
        settled_by=settled_by(problem, judged, rest),
        step_error=None if off is None or not math.isfinite(off.ratio) else off.ratio,
        spread=judged.spread if math.isfinite(judged.spread) else None,
        torque_ratio_window=mean(first, "torque") / torque if driven else None,
        window_balance=march.balance(first),
        floor_reversed=model.reversed_torque / torque,
        open_share=mean(last, "open"),
        second_flank_share=mean(last, "second"),
        force_max=_greatest(last[-(judged.cycles // _BLOCKS) :] if settled else last),
        force_run_in=_greatest(rows),
        force_static=rest.normal,
        advantage_min=float(rows["advantage_min"].min()) / unit if touched else None,
        advantage_max=float(rows["advantage_max"].max()) / unit if touched else None,
        ledger=ledger,
        energy_ratio=put_in / power if driven else None,
        **_told(saved, ledger, power),
        actuator_electrical=None if taken is None else taken.electrical_power,
        actuator_apparent=None if taken is None else taken.apparent_power,
        system_efficiency=efficiency,
        efficiency_static=problem.load / (model.point.ratio * torque),
        **_resonances(model, moving),
        tooth_mode=model.tooth_mode,
        course=CycleMeans(
            cycle_end=np.cumsum(rows["time"]),
            cycle_torque=rows["torque"] / rows["time"],
            cycle_wheel=rows["wheel_torque"] / rows["time"],
        ),
        notes=(
            *notes_of(problem, model, judged, rest, off, moving.longest),
            *of_saving(saved, judged, moving.longest),
            *guarded,
        ),
        residual=residual,
        steps=march.steps,
        seconds=march.seconds,
    )


def _greatest(rows: Records) -> float:
    """Return the greatest normal force of rows, whichever the flank."""
    return float(max(rows["driving_max"].max(), rows["back_max"].max()))


def _told(saved: Saving | None, ledger: DriveLedger, power: float) -> dict[str, Any]:
    """Return what is told of a saving, and how far off its powers are."""
    if saved is None:
        return {}
    ratio, error = saved.per_actuator(ledger.actuator, LEAST * power) or (None, None)
    ringing = abs(power - ledger.drive - saved.power)
    return {
        "saved_power": saved.power if saved.told else None,
        "saved_power_error": _finite(saved.error),
        "saved_per_actuator": ratio,
        "saved_per_actuator_error": error,
        "energy_ratio_error": _finite((ringing + saved.error + saved.actuator_error) / power),
    }


def _finite(value: float) -> float | None:
    return value if math.isfinite(value) else None


def _demand(problem: DriveProblem, moving: System, ledger: DriveLedger) -> Demand | None:
    """What the actuator takes, at its resonance or as far from it as is said; None without one."""
    if problem.actuator is None or moving.shake_wheel:
        return None
    # Amplitudes are of displacements: the rate of the waveform makes them velocities.
    unit = problem.velocity / problem.amplitude if problem.amplitude else 0.0
    energy = 0.0
    resonance = problem.actuator.resonance
    away = 1.0 if resonance is None else moving.frequency / resonance
    turn = moving.shake_worm_turn or moving.shake_motor
    shift = moving.shake_worm_shift or moving.shake_seat
    if turn:
        energy += elastic_energy(problem.worm_inertia, unit * turn, away)
    if shift:
        energy += elastic_energy(problem.worm_mass, unit * shift, away)
    return demand(
        ledger.actuator,
        energy,
        moving.frequency,
        coupling=problem.actuator.coupling,
        quality_factor=problem.actuator.quality_factor,
        efficiency=problem.actuator.efficiency,
        frequency_ratio=away,
    )


def _closed_form(problem: DriveProblem, model: MeshModel) -> float | None:
    """Ratio of a screw far above the resonances; None where there is no such form."""
    slides = problem.mode == "screw" and problem.drive.protocol not in WORM_ALONE
    sine = problem.vibrated[0].waveform == "sine"
    constant = problem.drive.friction == "constant" and not of_speed(problem.friction)
    if not (slides and sine and constant):
        return None
    return float(screw_ratio(model.point, model.friction, problem.velocity_ratio))


def _resonances(model: MeshModel, moving: System) -> dict[str, Any]:
    normal, _ = model.stiffness
    wheel = (model.point.normal_z * model.point.arm) ** 2 * normal
    turn = 0.5 / math.pi
    return {
        "resonance_worm": turn * math.sqrt(moving.torsion / moving.worm_inertia)
        if moving.torsion
        else None,
        "resonance_wheel": turn * math.sqrt(wheel / moving.wheel_inertia) if moving.rolls else None,
    }


def check(problem: DriveProblem, model: ReducedModel) -> None:
    """Refuse what a march would stumble over, before it begins."""
    moving = system(problem, model, motor=problem.drive.protocol != "back-drive")
    _ = model.mesh
    if problem.actuator is not None:
        _demand(problem, moving, DriveLedger(**dict.fromkeys(_POWERS, 0.0)))
    if not math.isfinite(moving.longest) or moving.longest <= 0.0:
        raise ConvergenceError("there is no step that the march is stable with", reached={})

"""A valve actuator that shakes its gearset only where the seat asks for torque.

The stroke of a valve: torque is high where it leaves its seat and where it comes into it, low
between. Without vibration the motor must give the seat's torque; with vibration there it gives
less, for as long as the seat lasts, and the gearset must hold once both have stopped.
"""

import dataclasses
from collections.abc import Mapping
from typing import Any, ClassVar

import numpy as np

from asperity.arrays import FloatArray
from asperity.casefile import Case
from asperity.drive.friction import rating_inputs
from asperity.drive.life import Life, life
from asperity.drive.motor import Exchange, Service, exchange, of_another_speed
from asperity.drive.problem import DriveProblem
from asperity.drive.reduced.mesh_model import MeshModel
from asperity.drive.result import DriveResult
from asperity.errors import InputError
from asperity.rating.demands import DEMANDS
from asperity.rating.verdict import Safety
from asperity.results import quantity
from asperity.results.table import Table

_PARTS = ("part",)


class OnDemand(DriveResult):
    """What vibration at the seats alone is worth in a stroke, beside what the drive does there."""

    title: ClassVar[str] = "Vibration on demand in a valve actuator's stroke"
    drawings: ClassVar[Mapping[str, str]] = {
        **DriveResult.drawings,
        "drive_stroke": "asperity.drive.studies.plots:plot_on_demand",
    }

    part_turn: FloatArray = quantity(
        "", "rad", "turn of the wheel where the part ends", dims=_PARTS
    )
    part_time: FloatArray = quantity("", "s", "time of the part", dims=_PARTS)
    part_load: FloatArray = quantity("", "N m", "torque of the wheel", dims=_PARTS)
    part_plain: FloatArray = quantity("", "N m", "torque of the motor without", dims=_PARTS)
    part_shaken: FloatArray = quantity(
        "", "N m", "torque of the motor, shaken at the seats", dims=_PARTS
    )
    share_shaken: float = quantity("", "", "share of the time between strokes that is shaken")
    energy_plain: float = quantity("", "J", "mechanical energy a stroke without vibration")
    energy_shaken: float = quantity("", "J", "of the motor, mechanical, and actuator, electrical")
    energy_actuator: float = quantity("", "J", "electrical energy of the actuator a stroke")
    motor_plain: str = quantity("", "", "lightest motor that does without vibration")
    motor_shaken: str = quantity("", "", "lightest motor that does with it")
    motor_plain_mass: float = quantity("", "kg", "mass of the motor without vibration")
    motor_shaken_mass: float = quantity("", "kg", "mass of the motor with it")
    actuator_mass: float = quantity("", "kg", "of the actuator with its generator, estimated")
    saved_mass: float = quantity("", "kg", "saved by motor and actuator together")
    saved_cost: float = quantity("", "GBP", "saved by the motor alone", key="saved_cost_GBP")
    safety_wear_plain: float | None = quantity("S_W", "", "safety against wear without vibration")
    safety_wear: float | None = quantity("S_W", "", "safety against wear with it")
    sump_rise: float | None = quantity("", "K", "how much hotter the oil gets by it")

    def headline(self) -> tuple[str, ...]:
        """Return what vibration does at the seats, to the stroke, and what fails."""
        torque, energy, *_ = super().headline()
        known = self.actuator_electrical is not None
        least, most = ("", "") if known else ("at least ", "at most ")
        less = self.energy_shaken < (1.0 - self.equal) * self.energy_plain
        word = ", less" if less else ", no less"
        if not known and less:
            word = ""
        stroke = (
            f"a stroke takes {least}{self.energy_shaken:.3g} J for {self.energy_plain:.3g}{word}"
        )
        motor = f"motor {self.motor_shaken} for {self.motor_plain}"
        if self.motor_shaken == self.motor_plain:
            motor = f"the same motor, {self.motor_plain}"
        lighter = self.saved_mass > 0.0
        light = f"{abs(self.saved_mass):.2g} kg {'lighter' if lighter else 'heavier'}"
        light = f"{most if lighter else least}{light}" if self.saved_mass else "as heavy"
        holds = "holds" if self.held_after else "does NOT hold"
        said = [f"{stroke}; {motor}, {light} with the actuator", f"it {holds} after"]
        if self.safety_wear is not None:
            said.append(f"wear by ISO/TR 14521 {_wear(self.safety_wear)}")
        return torque, energy, "; ".join(said)

    def tables(self) -> tuple[Table, ...]:
        """Return the rows; beside each safety stands what is asked of it."""
        (table,) = super().tables()
        safeties = {
            "safety against wear without vibration": self.safety_wear_plain,
            "safety against wear with it": self.safety_wear,
        }
        rows = [
            (*row[:3], _wear(value).split(maxsplit=2)[2])
            if (value := safeties.get(row[0])) is not None
            else row
            for row in table.rows
        ]
        return (dataclasses.replace(table, rows=tuple(rows)),)


def _wear(value: float) -> str:
    """Return a safety against wear with what the standard asks for."""
    demand = next(d for d in DEMANDS if d.path == "iso14521.safety_wear")
    return Safety(demand, value).said


def in_a_stroke(problem: DriveProblem, model: MeshModel, shaken: DriveResult) -> DriveResult:
    """Return what a drive that is shaken on demand is worth in its stroke.

    Parameters
    ----------
    problem : DriveProblem
        ``operation.output_torque`` is the seat's, ``operation.through_travel_torque`` that between
        (if left out, as ``operation.service`` has it).
    model : MeshModel
        Its mesh.
    shaken : DriveResult
        Its answer at the seat's torque.

    Returns
    -------
    DriveResult
        An `OnDemand`; ``shaken`` with a note where there is no torque to choose a motor by, no
        motor that does, or no ``[actuator]``.
    """
    if problem.actuator is None:
        return _untold(shaken, "the table [actuator] is missing, on which what is put in depends")
    if not shaken.settled or shaken.torque is None:
        return _untold(shaken, "the state at the seat is no periodic one to choose a motor by")
    try:
        return _told(problem, model, shaken, shaken.torque)
    except InputError as error:
        return _untold(shaken, str(error))


def _untold(shaken: DriveResult, why: str) -> DriveResult:
    return dataclasses.replace(shaken, notes=(*shaken.notes, f"the stroke is not told: {why}"))


def _told(problem: DriveProblem, model: MeshModel, shaken: DriveResult, torque: float) -> OnDemand:
    drive, operation = problem.drive, problem.operation
    seat = operation.output_torque
    between = operation.through_travel_torque
    if between is None:
        between = operation.travel_share * seat
    turns = np.array([drive.stroke_seat, drive.stroke - 2.0 * drive.stroke_seat, drive.stroke_seat])
    free = model.point.worm_torque(between, model.friction)
    unshaken = np.array([shaken.torque_static, free, shaken.torque_static])
    with_it = np.array([torque, free, torque])
    time = turns / (problem.worm_speed / model.point.ratio)
    shaking, moving = float(time[0] + time[2]), float(time.sum())
    electrical, apparent = _taken(problem, shaken)

    def service(torques: FloatArray) -> Service:
        parts = [(float(t), float(s)) for t, s in zip(torques, time, strict=True)]
        return Service((*parts, *(((0.0, drive.stroke_rest),) if drive.stroke_rest else ())))

    found = exchange(service(unshaken), service(with_it), electrical, apparent)
    # The standard's life is running time: at rest nothing wears.
    worn = _worn(problem.case, problem, shaken, shaking / moving)
    per_stroke = problem.worm_speed * time
    actuator = electrical * shaking
    return OnDemand(
        **{field.name: getattr(shaken, field.name) for field in dataclasses.fields(shaken)}
        | {
            "part_turn": np.cumsum(turns),
            "part_time": time,
            "part_load": np.array([seat, between, seat]),
            "part_plain": unshaken,
            "part_shaken": with_it,
            "share_shaken": shaking / (moving + drive.stroke_rest),
            "energy_plain": float(unshaken @ per_stroke),
            "energy_shaken": float(with_it @ per_stroke) + actuator,
            "energy_actuator": actuator,
            **_exchanged(found),
            **_lives(worn),
            "notes": (
                *shaken.notes,
                "masses of motors, actuator and generator are from memory, to some 15 %, and a "
                "factor of 2 for the latter two",
                *_least(shaken, electrical),
                *of_another_speed((found.before, found.after), problem.worm_speed),
                *_of_life(problem, worn is not None),
            ),
        }
    )


def _least(shaken: DriveResult, electrical: float) -> tuple[str, ...]:
    """Return the line about an actuator of which nothing but its work is known."""
    if shaken.actuator_electrical is not None:
        return ()
    return (
        f"of the actuator only the {shaken.ledger.actuator:.3g} W are counted that it gives to the "
        f"gearset, {electrical:.3g} W from the mains: with the mass of the wheel, which is not "
        "known, it takes and weighs more",
    )


def _taken(problem: DriveProblem, shaken: DriveResult) -> tuple[float, float]:
    """Real power from the mains and apparent power of the actuator, or the least of both.

    What swings in it follows from the mass that it moves; what it gives to the gearset does not.
    """
    if shaken.actuator_electrical is not None and shaken.actuator_apparent is not None:
        return shaken.actuator_electrical, shaken.actuator_apparent
    given = shaken.ledger.actuator
    efficiency = 1.0 if problem.actuator is None else problem.actuator.efficiency
    return max(given, 0.0) / efficiency, abs(given)


def _of_life(problem: DriveProblem, told: bool) -> tuple[str, ...]:
    """Return what wear and heat do not say by themselves."""
    if not told:
        return ("[rating] does not apply, so wear and heat are not told",)
    if problem.operation.steps is None:
        return ()
    return (
        "wear goes by the parts of operation.duty_cycle and heat by the hottest: each is taken to "
        "be shaken for the share of its time, and at the friction, of the stroke",
    )


def _exchanged(exchange: Exchange) -> dict[str, Any]:
    return {
        "motor_plain": exchange.before.name,
        "motor_shaken": exchange.after.name,
        "motor_plain_mass": exchange.before.mass,
        "motor_shaken_mass": exchange.after.mass,
        "actuator_mass": exchange.actuator_mass,
        "saved_mass": exchange.saved_mass,
        "saved_cost": exchange.saved_cost,
    }


def _worn(
    case: Case | None, problem: DriveProblem, shaken: DriveResult, share: float
) -> tuple[Life, Life] | None:
    """Life without and with vibration, where the standard applies."""
    if case is None:
        return None
    try:
        given = rating_inputs(case)
        plain = life(given)
        # Work of friction over its force is the path, the normal force in it.
        path = shaken.ledger.friction / (
            shaken.torque_static * problem.worm_speed - shaken.ledger.load
        )
        heat = max(shaken.ledger.damping, 0.0)
        return plain, life(given, share, path, heat)
    except InputError:
        return None


def _lives(worn: tuple[Life, Life] | None) -> dict[str, Any]:
    if worn is None:
        return dict.fromkeys(("safety_wear_plain", "safety_wear", "sump_rise"))
    plain, shaken = worn
    return {
        "safety_wear_plain": plain.safety_wear,
        "safety_wear": shaken.safety_wear,
        "sump_rise": shaken.sump_temperature - plain.sump_temperature,
    }

"""A valve actuator that shakes its gearset only where the seat asks for torque.

The stroke of a valve: torque is high where it leaves its seat and where it comes into it, low
between. Without vibration the motor must give the seat's torque; with vibration there it gives
less, for as long as the seat lasts, and the gearset must hold once both have stopped.
"""

import dataclasses
import math
from collections.abc import Mapping
from typing import Any, ClassVar

import numpy as np

from asperity.arrays import FloatArray
from asperity.casefile import Case
from asperity.drive.friction import rating_inputs
from asperity.drive.life import Life, life
from asperity.drive.motor import Exchange, Service, exchange, of_another_speed
from asperity.drive.problem import DriveProblem
from asperity.drive.protocols.solve import solve_shaken
from asperity.drive.reduced.model import ReducedModel
from asperity.drive.reduced.reduction import reduction
from asperity.drive.result import DriveResult, inputs
from asperity.drive.solve import prepare
from asperity.errors import ConvergenceError, InputError
from asperity.rating.inputs import THROUGH_TRAVEL
from asperity.results import Result, quantity
from asperity.runs import Run

_PARTS = ("part",)


@dataclasses.dataclass(frozen=True)
class Stroke:
    """A stroke from seat to seat.

    Attributes
    ----------
    turn : float
        Of the wheel, rad; a quarter for a ball or butterfly valve.
    seat : float
        Of that turn at either end with the seat's torque, rad.
    rest : float
        Until the next stroke, s.
    """

    turn: float = 0.5 * math.pi
    seat: float = math.radians(4.5)
    rest: float = 0.0

    def __post_init__(self) -> None:
        if not (self.turn > 0.0 and 0.0 < 2.0 * self.seat < self.turn and self.rest >= 0.0):
            raise InputError(
                f"the stroke turns the wheel by {math.degrees(self.turn):g} deg with "
                f"{math.degrees(self.seat):g} deg at either seat and rests {self.rest:g} s; both "
                "seats must leave some of the turn, and no rest is below 0"
            )


class OnDemand(Result):
    """What vibration at the seats alone is worth in a stroke.

    The ratio means nothing without ``torque_balance`` and ``settled``, which stand beside it.
    """

    title: ClassVar[str] = "Vibration on demand in a valve actuator's stroke"
    stem: ClassVar[str] = "on_demand"
    drawings: ClassVar[Mapping[str, str]] = {
        "on_demand": "asperity.drive.studies.plots:plot_on_demand"
    }

    problem: DriveProblem
    part_turn: FloatArray = quantity(
        "", "rad", "turn of the wheel where the part ends", dims=_PARTS
    )
    part_time: FloatArray = quantity("", "s", "time of the part", dims=_PARTS)
    part_load: FloatArray = quantity("", "N m", "torque of the wheel", dims=_PARTS)
    part_plain: FloatArray = quantity("", "N m", "torque of the motor without", dims=_PARTS)
    part_shaken: FloatArray = quantity(
        "", "N m", "torque of the motor, shaken at the seats", dims=_PARTS
    )
    torque_ratio: float = quantity("T_Bv/T_Bs", "", "at the seats, over that without vibration")
    torque_balance: float = quantity("T_m/T_R - 1", "", "balance of the wheel there")
    settled: bool = quantity("", "", "periodic and balanced")
    share_shaken: float = quantity("", "", "share of the time between strokes that is shaken")
    energy_plain: float = quantity("", "J", "mechanical energy a stroke without vibration")
    energy_shaken: float = quantity("", "J", "of the motor, mechanical, and actuator, electrical")
    energy_actuator: float = quantity("", "J", "electrical energy of the actuator a stroke")
    motor_plain: str = quantity("", "", "lightest motor that does without vibration")
    motor_shaken: str = quantity("", "", "lightest motor that does with it")
    motor_plain_mass: float = quantity("", "kg", "its mass")
    motor_shaken_mass: float = quantity("", "kg", "its mass")
    actuator_mass: float = quantity("", "kg", "of the actuator with its generator, estimated")
    saved_mass: float = quantity("", "kg", "saved by motor and actuator together")
    saved_cost: float = quantity("", "GBP", "saved by the motor alone", key="saved_cost_GBP")
    actuator_power: float = quantity("P_e", "W", "real power of the actuator while it shakes")
    actuator_apparent: float = quantity("S", "VA", "apparent power of its generator")
    holds_after: bool = quantity("", "", "whether the gearset holds once both have stopped")
    safety_wear_plain: float | None = quantity("S_W", "", "safety against wear without vibration")
    safety_wear: float | None = quantity("S_W", "", "safety against wear with it")
    sump_rise: float | None = quantity("", "K", "how much hotter the oil gets by it")

    @property
    def inputs(self) -> Mapping[str, Any]:
        """What was asked, by ``table.key``."""
        return inputs(self.problem)


def on_demand(case: Case, stroke: Stroke | None = None, run: Run | None = None) -> OnDemand:
    """Return what vibration at the seats is worth.

    Parameters
    ----------
    case : Case
        Of a drive with ``[vibration]`` and ``[actuator]``: ``operation.output_torque`` is the
        seat's, ``operation.through_travel_torque`` that between (a third if left out).
    stroke : Stroke, optional
        A quarter turn with a twentieth of it at either seat if left out.
    run : Run, optional
        Who is told how far it is.

    Raises
    ------
    InputError
        The case has no ``[actuator]``, or no motor known does.
    ConvergenceError
        The state at the seats is no periodic one, so that there is no torque to choose a motor by.
    """
    way, doing = stroke or Stroke(), Run() if run is None else run
    problem = prepare(case)
    if problem.actuator is None:
        raise InputError(
            "the table [actuator] is missing; what the vibration takes depends on it: add it"
        )
    plain = problem.drive.model_copy(update={"protocol": "on-demand"}, units="SI")
    problem = dataclasses.replace(problem, drive=plain)
    model = ReducedModel(problem, reduction(problem, doing))
    shaken = solve_shaken(problem, model, doing)
    if not shaken.settled or shaken.torque is None:
        raise ConvergenceError(
            "the vibration comes to no periodic state at the seat's torque, so that there is no "
            "torque to choose a motor by; change its frequency or amplitude",
            reached={"torque_balance": shaken.torque_balance},
        )
    operation = problem.operation
    seat = operation.output_torque
    between = operation.through_travel_torque or THROUGH_TRAVEL * seat
    turns = np.array([way.seat, way.turn - 2.0 * way.seat, way.seat])
    load = np.array([seat, between, seat])
    free = model.point.worm_torque(between, model.friction)
    unshaken = np.array([shaken.torque_static, free, shaken.torque_static])
    with_it = np.array([shaken.torque, free, shaken.torque])
    time = turns / (problem.worm_speed / model.point.ratio)
    cycle = float(time.sum()) + way.rest
    shaking = float(time[0] + time[2])
    electrical, apparent = shaken.actuator_electrical or 0.0, shaken.actuator_apparent or 0.0

    def service(torques: FloatArray) -> Service:
        parts = [(float(t), float(s)) for t, s in zip(torques, time, strict=True)]
        return Service((*parts, *(((0.0, way.rest),) if way.rest > 0.0 else ())))

    found = exchange(service(unshaken), service(with_it), electrical, apparent)
    # The standard's life is running time: at rest nothing wears.
    worn = _worn(case, problem, shaken, shaking / float(time.sum()))
    per_stroke = problem.worm_speed * time
    actuator = electrical * shaking
    return OnDemand(
        problem=problem,
        part_turn=np.cumsum(turns),
        part_time=time,
        part_load=load,
        part_plain=unshaken,
        part_shaken=with_it,
        torque_ratio=shaken.torque / shaken.torque_static,
        torque_balance=shaken.torque_balance,
        settled=shaken.settled,
        share_shaken=shaking / cycle,
        energy_plain=float(unshaken @ per_stroke),
        energy_shaken=float(with_it @ per_stroke) + actuator,
        energy_actuator=actuator,
        **_exchanged(found),
        actuator_power=electrical,
        actuator_apparent=apparent,
        holds_after=bool(shaken.held_after),
        **_lives(worn),
        notes=(
            *shaken.notes,
            "masses of motors, actuator and generator are from memory, to some 15 %, and a factor "
            "of 2 for the latter two",
            *of_another_speed((found.before, found.after), problem.worm_speed),
            *(() if worn else ("[rating] does not apply, so wear and heat are not told",)),
        ),
    )


def _exchanged(found: Exchange) -> dict[str, Any]:
    return {
        "motor_plain": found.before.name,
        "motor_shaken": found.after.name,
        "motor_plain_mass": found.before.mass,
        "motor_shaken_mass": found.after.mass,
        "actuator_mass": found.actuator_mass,
        "saved_mass": found.saved_mass,
        "saved_cost": found.saved_cost,
    }


def _worn(
    case: Case, problem: DriveProblem, shaken: DriveResult, share: float
) -> tuple[Life, Life] | None:
    """Life without and with vibration, where the standard applies."""
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

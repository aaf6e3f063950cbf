"""Shaken gearsets marched, for `asperity.thesis.drive.simulations` and the pictures over time."""

import dataclasses
from collections.abc import Sequence

import numpy as np

from asperity.arrays import FloatArray
from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.drive.motion.system import STATE
from asperity.drive.problem import DriveProblem
from asperity.drive.protocols.equations_of_motion import begin, system
from asperity.drive.protocols.march import March, Records
from asperity.drive.protocols.solve import solve_shaken
from asperity.drive.reduced.model import ReducedModel
from asperity.drive.reduced.reduction import reduction
from asperity.drive.solve import answer, prepare
from asperity.drive.static.solve import solve_static
from asperity.drive.studies.on_demand import OnDemand
from asperity.runs import Run

LOADING, RUN_UP, STEADY = 8e-3, 8e-3, 4e-3
"""How long the load rises, the motor runs up and runs on before anything shakes, s: many cycles of
the mesh's own vibration. The thesis's times are lost with its Table 7.1."""

_PIECES = 400  # in which speed and load stay as they are

_KEPT = 200
"""First cycles of which the means are shown."""


@dataclasses.dataclass(frozen=True, eq=False)
class Shaken:
    """What is shown of a march: its end, and its first cycles.

    Attributes
    ----------
    static : float
        Torque without vibration, N m.
    ratio, balance, spread : float
        Mean torque over it at the end, what the mesh gives the wheel beyond its load, over it, and
        how far three blocks of cycles are apart.
    settled : bool
        Whether the end is a periodic state.
    window, window_balance : float
        The same ratio and balance over the first three cycles.
    open, second : float
        Shares of time without contact, and on the flank that does not drive.
    force : float
        Greatest normal force, N.
    drive, actuator, load, friction : float
        Mean powers, W.
    closure : float
        Of the ledger.
    cycle_torque, cycle_wheel : ndarray
        Means over each cycle from the first on: torque of the worm and of the mesh on the wheel,
        N m.
    electrical, apparent : float or None
        What the actuator takes, W and VA.
    """

    static: float
    ratio: float
    balance: float
    spread: float
    settled: bool
    window: float
    window_balance: float
    open: float
    second: float
    force: float
    drive: float
    actuator: float
    load: float
    friction: float
    closure: float
    cycle_torque: FloatArray
    cycle_wheel: FloatArray
    electrical: float | None
    apparent: float | None


@dataclasses.dataclass(frozen=True)
class Loaded:
    """What is shown of elastic teeth under load, means over a pitch.

    Attributes
    ----------
    torque, frictionless, turned_round : float
        Of the worm as it is, without friction, and with friction turned round, N m.
    efficiency : float
        Of the mesh.
    deflection, error : float
        Turn of the wheel under load, and transmission error from peak to peak, rad.
    radius : float
        On the worm, mean by force, m.
    sliding_speed : float
        Mean by force, m/s.
    pressure : float
        Greatest at a node, Pa.
    nodes : int
        Of a flank.
    """

    torque: float
    frictionless: float
    turned_round: float
    efficiency: float
    deflection: float
    error: float
    radius: float
    sliding_speed: float
    pressure: float
    nodes: int


@dataclasses.dataclass(frozen=True)
class Stroke:
    """What vibration on demand does to an actuator's stroke.

    Attributes
    ----------
    energy_plain, energy_shaken : float
        A stroke, J.
    safety_plain, safety_shaken : float
        Against wear.
    motor_plain, motor_shaken, actuator : float
        Masses, kg.
    share : float
        Of the time, shaken.
    """

    energy_plain: float
    energy_shaken: float
    safety_plain: float
    safety_shaken: float
    motor_plain: float
    motor_shaken: float
    actuator: float
    share: float


def stroke(case: str, settings: Sequence[str]) -> Stroke:
    """Solve a shipped actuator's stroke, as ``asperity drive`` does."""
    problem = prepare(read_case(case, case_tables(), settings))
    found = answer(problem, Run())
    if not isinstance(found, OnDemand) or found.safety_wear is None:
        raise ValueError("no stroke with vibration on demand")
    return Stroke(
        energy_plain=found.energy_plain,
        energy_shaken=found.energy_shaken,
        safety_plain=found.safety_wear_plain or np.nan,
        safety_shaken=found.safety_wear,
        motor_plain=found.motor_plain_mass,
        motor_shaken=found.motor_shaken_mass,
        actuator=found.actuator_mass,
        share=found.share_shaken,
    )


def load(case: str, settings: Sequence[str]) -> Loaded:
    """Solve a shipped gearset's teeth under load, as ``asperity drive --static`` does."""
    problem = prepare(read_case(case, case_tables(), settings), static=True)
    found = solve_static(problem, Run())
    return Loaded(
        torque=found.input_torque,
        frictionless=found.input_torque_frictionless,
        turned_round=found.input_torque_reversed,
        efficiency=found.efficiency,
        deflection=found.deflection,
        error=found.transmission_error,
        radius=1e-3 * found.friction_radius,
        sliding_speed=found.sliding_speed,
        pressure=1e6 * found.pressure_nodal,
        nodes=found.teeth_nodes,
    )


def _model(case: str, settings: Sequence[str]) -> tuple[DriveProblem, ReducedModel]:
    problem = prepare(read_case(case, case_tables(), settings))
    return problem, ReducedModel(problem, reduction(problem, Run()))


def march(case: str, settings: Sequence[str]) -> Shaken:
    """March a shipped drive, as ``asperity drive`` does."""
    problem, model = _model(case, settings)
    found = solve_shaken(problem, model, Run())
    ledger, course = found.ledger, found.course
    window, balance = found.torque_ratio_window, found.window_balance
    if found.torque_ratio is None or window is None or balance is None or course is None:
        raise ValueError("a march without a motor")
    return Shaken(
        static=found.torque_static,
        ratio=found.torque_ratio,
        balance=found.torque_balance,
        spread=found.spread if found.spread is not None else np.inf,
        settled=found.settled,
        window=window,
        window_balance=balance,
        open=found.open_share,
        second=found.second_flank_share,
        force=found.force_max,
        drive=ledger.drive,
        actuator=ledger.actuator,
        load=ledger.load,
        friction=ledger.friction,
        closure=found.closure,
        cycle_torque=course.cycle_torque[:_KEPT],
        cycle_wheel=course.cycle_wheel[:_KEPT],
        electrical=found.actuator_electrical,
        apparent=found.actuator_apparent,
    )


def from_start(
    case: str, settings: Sequence[str], cycles: int, rows: int
) -> dict[str, FloatArray | float]:
    """March the first cycles of a shipped drive and return their motion over time.

    Returns
    -------
    dict
        ``time``, ``torque``, ``normal``, ``wheel`` (torque of the mesh on the wheel), means of so
        many stretches a cycle, ``open``, the share of each without contact, and ``static``.
    """
    problem, model = _model(case, settings)
    moving = system(problem, model)
    run = March(model, moving, *begin(problem, model, moving), Run())
    found = _over_time(run.stretches(cycles * rows, run.cycle / rows))
    return {**found, "static": model.worm_torque}


def from_load(
    case: str, settings: Sequence[str], cycles: int, rows: int
) -> dict[str, FloatArray | float]:
    """March a shipped drive as the thesis's steps have it: load, run-up, vibration.

    The flanks begin where they touch. As the motor's end stands, the load rises to its torque;
    then the motor runs up, both as half a cosine; then the worm is shaken.

    Returns
    -------
    dict
        As of `from_start`, from the load on, the first two steps in stretches of `LOADING` and
        `RUN_UP` over ``_PIECES``; ``steps`` are the times at which run-up, steady running and
        vibration begin, s; ``frequency`` is its, Hz.
    """
    problem, model = _model(case, settings)
    still = system(problem, model, shaken=False)
    pose = np.zeros(5)
    states = np.zeros(1, STATE)
    states[0]["step"], states[0]["corner"] = still.longest, np.inf
    run = March(model, still, states, model.settled_in(pose, 0.0), Run())
    found = []
    rise = 0.5 - 0.5 * np.cos(np.pi * (np.arange(_PIECES) + 0.5) / _PIECES)
    for share in rise:
        # The motor's end stands at its angle 0.
        run.system = still._replace(load=share * still.load, speed=0.0)
        found.append(run.stretches(1, LOADING / _PIECES))
    angle = 0.0
    for share in rise:
        speed = share * still.speed
        # The motor's end stands at speed times time, which is told so that it goes on from where
        # it is: nothing else asks for the time before anything shakes.
        run.states[0]["time"] = angle / speed
        run.system = still._replace(speed=speed)
        found.append(run.stretches(1, RUN_UP / _PIECES))
        angle += speed * RUN_UP / _PIECES
    run.system, begun = still, angle / still.speed
    run.states[0]["time"] = begun
    # To the end of a whole cycle of what is to shake, a while on.
    whole = np.ceil((begun + STEADY) * still.frequency) / still.frequency
    steady = float(whole - begun)
    found.append(run.stretches(_PIECES, steady / _PIECES))
    run.system = system(problem, model)
    run.states[0]["corner"] = begin(problem, model, run.system)[0][0]["corner"] + whole
    found.append(run.stretches(cycles * rows, run.cycle / rows))
    return {
        **_over_time(np.concatenate(found)),
        "static": model.worm_torque,
        "frequency": still.frequency,
        "steps": np.cumsum([LOADING, RUN_UP, steady]),
    }


def _over_time(sums: Records) -> dict[str, FloatArray | float]:
    span = sums["time"]
    return {
        "time": np.cumsum(span) - 0.5 * span,
        "torque": sums["torque"] / span,
        "normal": sums["driving"] / span,
        "wheel": sums["wheel_torque"] / span,
        "open": sums["open"] / span,
    }


def holding(case: str, settings: Sequence[str]) -> tuple[float | None, bool | None]:
    """Return the wheel's creep with the motor off, rad/s, and whether the gearset holds after."""
    found = solve_shaken(*_model(case, settings), Run())
    return found.creep, found.held_after

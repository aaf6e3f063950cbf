"""A protocol's freedoms and imposed motions, and the state that a march begins in."""

import math

import numpy as np
import numpy.typing as npt

from asperity.arrays import FloatArray
from asperity.drive.interface import AT
from asperity.drive.motion.system import STATE, System
from asperity.drive.problem import DriveProblem
from asperity.drive.reduced.mesh_model import MeshModel
from asperity.drive.shafts import Bending, MeshAction, bending_of, bends
from asperity.errors import InputError
from asperity.vibration.waveform import (
    AT_REST,
    SAMPLED,
    SQUARE,
    TRIANGLE,
    Shape,
    Wave,
    displacement_at,
)

_STABLE = 0.25  # of a step, times the highest natural frequency
_STIFFER = 3.0  # that the normal contact may be than without vibration
_LANDING = 1.0 / 20.0  # of the approach without vibration, in a step
# Of what teeth and a shaft that bends do to each other at the start, and m that they agree by.
_ROUNDS, _CLOSE = 20, 1e-8


def shakes(problem: DriveProblem, model: MeshModel) -> dict[str, float]:
    """Return the amplitude of what is imposed where, by the names of `System`; rad and m.

    A screw turns and shifts so that it slides in itself. The part along the flank alone, protocol
    ``tangential``, is that of a screw.
    """
    vibration, _ = problem.vibrated
    amplitude, radius = problem.amplitude, problem.reference_radius
    point, seat = model.point, vibration.applied_to == "seat"
    if problem.drive.protocol == "tangential":
        turn = {
            "axial": -point.lead * amplitude / point.length**2,
            "torsional": point.radius**2 * amplitude / (radius * point.length**2),
            "wheel-axial": -point.radius * amplitude / point.length**2,
            "screw": amplitude / radius,
        }[problem.mode]
        return {"shake_worm_turn": turn, "shake_worm_shift": -point.lead * turn}
    if problem.mode == "axial":
        return {"shake_seat" if seat else "shake_worm_shift": amplitude}
    if problem.mode == "wheel-axial":
        return {"shake_wheel": amplitude}
    turn = amplitude / radius
    if problem.mode == "torsional":
        motor = vibration.applied_to == "motor"
        return {"shake_motor" if motor else "shake_worm_turn": turn}
    shift = "shake_seat" if seat else "shake_worm_shift"
    return {"shake_worm_turn": turn, shift: -point.lead * turn}


_SMOOTH = np.zeros(0)


def corners_of(shape: Shape) -> FloatArray:
    """Return the phases at which a waveform's velocity jumps, in cycles; none of a smooth one."""
    if shape.code == TRIANGLE:
        return np.array([0.25, 0.75])
    if shape.code == SQUARE:
        half = 0.5 * shape.rise
        return np.unique([half, 0.5 - half, 0.5 + half, 1.0 - half])
    return _SMOOTH


def system(
    problem: DriveProblem, model: MeshModel, *, shaken: bool = True, motor: bool = True
) -> System:
    """Return freedoms and imposed motions of a problem's protocol.

    Parameters
    ----------
    problem : DriveProblem
        What is asked.
    model : MeshModel
        Its mesh.
    shaken : bool
        Whether it vibrates.
    motor : bool
        Whether the motor turns the shaft; else the worm is free of it.

    Raises
    ------
    InputError
        The step that was asked for is too coarse for how fast the surfaces approach.
    """
    shaft, drive = problem.shaft, problem.drive
    held = drive.protocol == "held-wheel"
    driven = motor and not held
    turns = shaft.torsion is not None or not driven
    torsion = shaft.torsion if driven and shaft.torsion is not None else 0.0
    inertia = problem.worm_inertia if turns else 1.0
    seat = shaft.axial
    mass = problem.worm_mass if seat is not None else 1.0
    ratio = shaft.damping_ratio
    _, shape = problem.vibrated
    gives = bends(shaft)
    bent = _RIGID
    if gives:
        bent = bending_of(shaft, model.point.radius, problem.worm_mass)
    found = System(
        worm_inertia=inertia,
        worm_mass=mass,
        wheel_inertia=drive.load_inertia or 0.0,
        torsion=torsion,
        torsion_damping=2.0 * ratio * math.sqrt(torsion * inertia),
        seat=seat or 0.0,
        seat_damping=2.0 * ratio * math.sqrt((seat or 0.0) * mass),
        bent_mass=bent.mass,
        bent_stiffness=bent.stiffness,
        bent_damping=2.0 * ratio * np.sqrt(bent.stiffness * bent.mass),
        motor_torque=model.worm_torque if held else 0.0,
        load=problem.load,
        speed=problem.worm_speed if driven else 0.0,
        turns=turns,
        shifts=seat is not None,
        rolls=not held,
        bends=gives,
        **(dict.fromkeys(SHAKES, 0.0) | (shakes(problem, model) if shaken else {})),
        wave=shape.wave() if shaken else AT_REST,
        frequency=shape.frequency,
        corners=corners_of(shape) if shaken else _SMOOTH,
        longest=problem.step,
        landing=_LANDING * model.indentation,
    )
    return found._replace(longest=_longest(problem, model, found))


_RIGID = Bending(np.zeros(3), np.ones(3))
SHAKES = ("shake_worm_turn", "shake_worm_shift", "shake_seat", "shake_wheel", "shake_motor")


def _longest(problem: DriveProblem, model: MeshModel, system: System) -> float:
    """Return the longest step that is stable and lands well, or refuse the one asked for."""
    normal, along = model.stiffness
    normal *= _STIFFER
    point = model.point
    n_z, tilt = point.normal_z, point.lead / point.length
    squares = [0.0]
    if system.turns:
        turning = (n_z * point.lead) ** 2 * normal + (point.radius**2 / point.length) ** 2 * along
        squares.append((system.torsion + turning) / system.worm_inertia)
    if system.shifts:
        squares.append((system.seat + n_z**2 * normal + tilt**2 * along) / system.worm_mass)
    if system.bends:
        across = point.normal_across * tilt, point.normal_radial, point.normal_across
        sides = (
            n_z**2 * normal + tilt**2 * along,
            across[0] ** 2 * normal + (point.radius / point.length) ** 2 * along,
            across[1] ** 2 * normal + across[2] ** 2 * along,
        )
        squares += list((system.bent_stiffness + np.array(sides)) / system.bent_mass)
    if system.rolls:
        wheel = point.arm**2 * (n_z**2 * normal + tilt**2 * along)
        squares.append(wheel / system.wheel_inertia)
    fastest = math.sqrt(sum(squares))
    stable = _STABLE / fastest if fastest > 0.0 else math.inf
    given = problem.solve.step
    if given is None:
        return min(problem.step, stable)
    if given > 4.0 * stable:
        raise InputError(
            f"solve.step is {given:g} s, too coarse for the mesh's own vibration of "
            f"{fastest / (2.0 * math.pi):.3g} Hz; it may be at most {4.0 * stable:.3g} s"
        )
    if given * problem.approach_speed > system.landing:
        raise InputError(
            f"solve.step is {given:g} s, too coarse for flanks that approach at "
            f"{problem.approach_speed:.3g} m/s; it may be at most "
            f"{system.landing / problem.approach_speed:.3g} s, a twentieth of their approach under "
            "the load"
        )
    return given


def begin(
    problem: DriveProblem, model: MeshModel, moving: System, early: float = 0.0
) -> tuple[npt.NDArray[np.void], FloatArray]:
    """Return the state without vibration: loaded, sliding steadily where a motor turns the worm.

    It is that of a time ``early`` before the vibration begins, s.

    Returns
    -------
    states : record array of one `STATE`
        Motion and forces.
    committed : ndarray
        What the mesh remembers.
    """
    point = model.point
    locked = not moving.speed and not moving.motor_torque
    share, friction = 1.0, model.friction
    force, torque = model.normal_force, model.worm_torque
    if locked:
        # The worm holds without a torque, by as much friction as that takes.
        at_rest = model.holding
        friction = -min(point.holding_share(at_rest), 1.0) * at_rest
        force = point.normal_force(problem.load, friction)
        torque = point.worm_torque(problem.load, friction)
        # The mesh counts friction by that of the sliding worm.
        share = friction / model.friction
    thrust = -problem.load / point.arm
    states = np.zeros(1, STATE)
    state = states[0]
    state["time"] = -early
    state["step"] = moving.longest
    state["corner"] = moving.corners[0] / moving.frequency if moving.corners.size else math.inf
    state["turn_rate"] = moving.speed
    state["roll_rate"] = moving.speed / point.ratio
    # A waveform need not begin at nothing: the wheel follows to where the worm is put.
    wave = displacement_at(moving.wave, 0.0)
    state["wave"] = wave
    state["turn"] = moving.shake_motor * wave - moving.speed * early
    twist = torque / moving.torsion if moving.torsion else 0.0
    state["turn"] -= twist
    state["shift"] = moving.shake_seat * wave
    if moving.shifts:
        state["shift"] += thrust / moving.seat
        state["seat_force"] = -thrust
    turn = state["turn"] + moving.shake_worm_turn * wave
    shift = state["shift"] + moving.shake_worm_shift * wave
    aside = moving.shake_wheel * wave
    nearer = 0.0
    if moving.bends:
        pressed = -problem.load * MeshAction.of(point, friction).force
        state["bent"] = bent = pressed / moving.bent_stiffness
        shift, aside, nearer = shift + bent[0], aside - bent[1], bent[2]
    approach = model.law.approach_at(force)
    state["roll"] = (
        point.lead * (turn - aside / point.radius)
        + shift
        - (approach - point.normal_radial * nearer) / point.normal_z
    ) / point.arm
    state["driving"] = force
    state["torque"] = 0.0 if locked else torque
    state["worm_torque"], state["worm_force"] = -torque, thrust
    state["wheel_torque"] = problem.load
    pose = np.array([turn, shift, state["roll"], aside, nearer])
    stored = None if locked else _balance(model, moving, state, pose, problem.load)
    if stored is None:
        stored = model.stored(approach, share)
    state["stored"] = (
        stored
        + 0.5 * moving.worm_inertia * state["turn_rate"] ** 2 * moving.turns
        + 0.5 * moving.wheel_inertia * state["roll_rate"] ** 2
        + 0.5 * moving.torsion * twist**2
        + (0.5 * thrust**2 / moving.seat if moving.shifts else 0.0)
        + 0.5 * float(moving.bent_stiffness @ state["bent"] ** 2)
    )
    return states, model.settled_in(pose, share)


def _balance(
    model: MeshModel, moving: System, state: np.void, pose: FloatArray, load: float
) -> float | None:
    """Let a mesh that has no closed form find its own balance: ``state`` and ``pose`` follow.

    Returns its energy; None of a mesh in balance.
    """
    signs = np.array([1.0, -1.0, 1.0])
    stored = None
    for _ in range(_ROUNDS):
        forces = model.balanced(pose, load)
        if forces is None:
            break
        state["roll"], stored = pose[2], float(forces[AT.stored])
        if not moving.bends:
            break
        pressed = signs * forces[[AT.worm_force, AT.wheel_force, AT.worm_radial]]
        # Half of it: edges that come into mesh push back as stiffly as a thin shaft.
        more = 0.5 * (pressed / moving.bent_stiffness - state["bent"])
        if np.abs(more).max() <= _CLOSE:
            break
        state["bent"] += more
        pose[[1, 3, 4]] += signs * more
    return stored


def switched_off(
    problem: DriveProblem, model: MeshModel, moving: System, states: npt.NDArray[np.void]
) -> tuple[System, npt.NDArray[np.void]]:
    """Return what moves once vibration and motor are off, and the state it begins in.

    What was imposed stays where it is. Its speed is the own of a worm that is free from here on;
    what is held goes on without.
    """
    still = system(problem, model, shaken=False, motor=False)
    wave, rate = float(states[0]["wave"]), float(states[0]["wave_rate"])
    places = {name: getattr(moving, name) for name in SHAKES}
    still = still._replace(wave=Wave(SAMPLED, 0.0, np.full(2, wave)), **places)
    left = states.copy()
    state = left[0]
    if not moving.turns:
        # A worm on a rigid shaft is told with what was imposed on it.
        state["turn"] -= moving.shake_worm_turn * wave
        state["turn_rate"] = moving.speed
    state["turn_rate"] += moving.shake_worm_turn * rate
    state["turn_push"] = state["worm_torque"] / still.worm_inertia
    if still.shifts:
        state["shift_rate"] += moving.shake_worm_shift * rate
        held = still.seat * (moving.shake_seat * wave - state["shift"])
        held -= still.seat_damping * state["shift_rate"]
        state["seat_force"] = held
        state["seat_loss"] = -still.seat_damping * state["shift_rate"]
        state["shift_push"] = (held + state["worm_force"]) / still.worm_mass
    for name in ("torque", "shaft_loss", "wave_rate"):
        state[name] = 0.0
    state["corner"] = math.inf
    return still, left

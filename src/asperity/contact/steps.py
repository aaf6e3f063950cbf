r"""A condensed body on a rigid surface, step after step: loading at rest, then motion.

One `System` holds what stays the same; a `SystemState` is everything a step starts from, and no
step changes it. A step that finds no equilibrium is taken again in two halves, and those in halves
if need be.
"""

import dataclasses
import functools

import numpy as np
import numpy.typing as npt

from asperity.contact import hht, ledger
from asperity.contact import motion as mo
from asperity.contact.friction_point import PointFriction
from asperity.contact.increment import (
    ContactState,
    Drift,
    IncrementProblem,
    IncrementResult,
    SurfaceMotion,
    solve_increment,
)
from asperity.contact.normal import NormalLaw
from asperity.contact.rigid import Pose, RigidSurface
from asperity.contact.surface import ContactSurface
from asperity.errors import ConvergenceError, InputError
from asperity.vibration import Shape, fill_increments

FloatArray = npt.NDArray[np.float64]

MOST_CUTS = 8
_MOST_STATIC = 50
_AT_REST = 1e-9
# Steps of loading are so long that the inertia is this share of the stiffness on the contact.
_INERTIA_AT_REST = 1e-4


@dataclasses.dataclass(frozen=True, eq=False)
class Shaking:
    """In-plane vibration of the base or of the body as a contact sees it.

    Attributes
    ----------
    shape : Shape
        Waveform.
    way : tuple of 2 floats
        Displacement amplitude along x and y, m.
    start : float
        When it begins, s.
    transfer : float
        Share of lateral motion that reaches the contact: of the base, or of the body.
    on_body : bool
        Whether the body is shaken: its prescribed motion is added to its own.
    """

    shape: Shape
    way: tuple[float, float]
    start: float = 0.0
    transfer: float = 1.0
    on_body: bool = False

    def increment(self, begin: float, end: float) -> float:
        """Increment of the unit displacement between two times."""
        frequency = self.shape.frequency
        room = np.empty(1)
        fill_increments(
            *self.shape.kernel_arguments(), (begin - self.start) * frequency,
            (end - begin) * frequency, room,
        )  # fmt: skip
        return float(room[0])


@dataclasses.dataclass(frozen=True, eq=False)
class System:
    """A condensed body, what holds and loads it, and what it slides on.

    Attributes
    ----------
    mechanism : Mechanism
        The body.
    surface : ContactSurface
        Its faces that may touch.
    counter, pose : RigidSurface, Pose
        What it meets, and where that stands.
    normal : NormalLaw
        Pressure against overclosure.
    friction : PointFriction
        Friction law.
    shaking : Shaking or None
        Vibration.
    drive_velocity : float
        Of the drive's far end, or of a held first coordinate, m/s.
    full_friction : float
        Drive force that counts as breakaway, N.
    alpha : float
        Parameter of the time integration.
    """

    mechanism: mo.Mechanism
    surface: ContactSurface
    counter: RigidSurface
    normal: NormalLaw
    friction: PointFriction
    pose: Pose = dataclasses.field(default_factory=Pose)
    shaking: Shaking | None = None
    drive_velocity: float = 0.0
    full_friction: float = np.inf
    alpha: float = hht.ALPHA

    @functools.cached_property
    def weights(self) -> FloatArray:
        """Area of each point of the surface, m^2."""
        return np.ascontiguousarray(self.surface.weights.ravel())

    @functools.cached_property
    def _moving(self) -> dict[float, tuple[mo.MotionStep, IncrementProblem]]:
        return {}

    def stepping(self, step: float) -> tuple[mo.MotionStep, IncrementProblem]:
        """What a length of the step makes of body and contact; made once for each."""
        if step not in self._moving:
            moving = mo.motion_step(self.mechanism, step, alpha=self.alpha)
            self._moving[step] = moving, self._problem(moving.compliance, step)
        return self._moving[step]

    def _problem(self, compliance: FloatArray, step: float) -> IncrementProblem:
        return IncrementProblem(
            compliance, self.surface, self.counter, self.normal, self.friction, step
        )

    def surface_motion(self, begin: float, end: float) -> tuple[SurfaceMotion, FloatArray]:
        """Motion of the base over a step, and the displacement x, y, whole y that makes the slip.

        A body that is shaken is one at rest on a base that moves the other way, but for the share
        of its own lateral motion that the contact sees.
        """
        shaking = self.shaking
        if shaking is None:
            return SurfaceMotion(pose=self.pose), np.zeros(3)
        unit = shaking.increment(begin, end)
        sign = -1.0 if shaking.on_body else 1.0
        x, y = sign * unit * shaking.way[0], sign * unit * shaking.way[1]
        through = shaking.transfer * y
        one_sided = end <= shaking.start * (1.0 + 1e-12)
        return SurfaceMotion(
            self.pose,
            Drift(np.array([x, 0.0, 0.0])),
            Drift(np.array([0.0, through, 0.0])),
            np.diag([1.0, 0.0, 1.0]) if shaking.on_body else np.eye(3),
            np.diag([0.0, shaking.transfer, 0.0]) if shaking.on_body else np.zeros((3, 3)),
            one_sided,
        ), np.array([x, through, y])


@dataclasses.dataclass(frozen=True, eq=False)
class SystemState:
    """All that a step starts from.

    Attributes
    ----------
    time : float
        s.
    coordinates : ndarray, shape (6, m)
        Rows as in `asperity.contact.hht`.
    drive : ndarray, shape (6,)
        Places as in `asperity.contact.motion`.
    contact : IncrementResult
        Of the last increment.
    forces : ndarray, shape (6,)
        Resultants, see `asperity.contact.ledger`.
    load : float
        Share of the loads.
    """

    time: float
    coordinates: FloatArray
    drive: FloatArray
    contact: IncrementResult
    forces: FloatArray
    load: float

    def energies(self, system: System) -> ledger.Energies:
        """Energies of body and contact."""
        contact = self.contact
        over, asperities = ledger.surface_energies(
            contact.pressure, contact.distance, contact.state.deflection, system.weights,
            system.normal.parameters, system.friction.mu, system.friction.limit,
        )  # fmt: skip
        kinetic, elastic, spring = ledger.body_energies(
            system.mechanism, self.coordinates, self.drive, contact.force, self.load
        )
        return ledger.Energies(kinetic, elastic, spring, float(over), float(asperities))


def rest_under_load(system: System, loads: tuple[mo.Port, ...]) -> SystemState:
    """Bring a body to rest under loads that come one after the other, friction and all.

    Parameters
    ----------
    system : System
        The body; its drive and shaking wait.
    loads : tuple of Port
        Loads as they stand after each step, as gravity, then gravity and pressure.

    Returns
    -------
    SystemState
        At time zero, the drive just taut.

    Raises
    ------
    ConvergenceError
        No equilibrium was found: the loads do not press the body on the surface, or it tips over.
    """
    mechanism = system.mechanism
    long = float(np.sqrt(mechanism.mass[0, 0] / (_INERTIA_AT_REST * _stiffness(system))))
    waiting = dataclasses.replace(mechanism, drive=None, load=None)
    first = mo.motion_step(waiting, long, alpha=0.0)
    problem = system._problem(first.compliance, long)
    contact = ContactState.rest(problem)
    coordinates = hht.rest(mechanism.size)
    drive = np.zeros(mo.DRIVE_STATE)
    still = SurfaceMotion(pose=system.pose)
    result = None
    for number, load in enumerate(loads, start=1):
        moving = mo.motion_step(dataclasses.replace(waiting, load=load), long, alpha=0.0)
        for _ in range(_MOST_STATIC):
            try:
                result, coordinates, drive, _ = _one_step(
                    system, moving, problem, still, contact, coordinates, drive, (0.0, 0.0, 1.0)
                )
            except ConvergenceError as error:
                raise ConvergenceError(
                    f"no equilibrium at rest under load {number} of {len(loads)}: {error}",
                    reached={"load": float(number), **error.reached},
                ) from error
            contact = result.state
            # What the inertia still bears; each step starts anew without a velocity.
            left = float(np.abs(coordinates[hht.FORCE]).max())
            coordinates[1:] = 0.0
            if left <= _AT_REST * float(np.abs(load.generalised).max()):
                break
        else:
            raise ConvergenceError(
                f"the body does not come to rest under load {number} of {len(loads)}; it is not "
                "pressed on its base, or tips over",
                reached={"load": float(number), "active": float(result.active if result else 0)},
            )
    if result is None:
        raise InputError("no load presses the body on its base; give gravity or a pressure")
    whole = dataclasses.replace(system, mechanism=dataclasses.replace(mechanism, load=loads[-1]))
    return _at_start(whole, result, coordinates)


def _stiffness(system: System) -> float:
    """Stiffness of contact and body under a pressure spread evenly over the contact, N/m."""
    surface = system.surface
    spread = (-surface.nodal_normals * surface.nodal_area[:, None] / surface.area).ravel()
    body = float(spread @ (system.mechanism.flexibility @ spread))
    return 1.0 / (1.0 / (system.normal.stiffness * surface.area) + body)


def _at_start(system: System, result: IncrementResult, coordinates: FloatArray) -> SystemState:
    mechanism = system.mechanism
    drive = np.zeros(mo.DRIVE_STATE)
    if mechanism.drive is not None:
        port = mechanism.drive.port
        drive[mo.STRAIN] = port.response @ result.force
        drive[mo.WAY] = port.generalised @ coordinates[hht.PLACE] + drive[mo.STRAIN]
        drive[mo.REACH] = drive[mo.WAY]
    else:
        coordinates[hht.VELOCITY, 0] = system.drive_velocity if mechanism.held[0] else 0.0
        drive[mo.REACH] = drive[mo.WAY] = coordinates[hht.PLACE, 0]
    forces = _forces(system, result, coordinates, 1.0)
    return SystemState(0.0, coordinates, drive, result, forces, 1.0)


def _forces(
    system: System, result: IncrementResult, coordinates: FloatArray, share: float
) -> FloatArray:
    forces = np.empty(ledger.FORCES)
    ledger.resultants(
        result.pressure, result.traction, result.normal, result.state.deflection, system.weights,
        forces,
    )  # fmt: skip
    load = system.mechanism.load
    forces[ledger.LOAD_WAY] = 0.0
    if load is not None and share > 0.0:
        forces[ledger.LOAD_WAY] = load.generalised @ coordinates[hht.PLACE]
        forces[ledger.LOAD_WAY] += load.response @ result.force
    return forces


def _one_step(
    system: System,
    moving: mo.MotionStep,
    problem: IncrementProblem,
    surface_motion: SurfaceMotion,
    contact: ContactState,
    coordinates: FloatArray,
    drive: FloatArray,
    imposed: tuple[float, float, float],
) -> tuple[IncrementResult, FloatArray, FloatArray, float]:
    """Solve a step; ``imposed`` is the drive's far end, its velocity, and the share of the loads.

    Returns the contact, coordinates, drive, and the energy the method took.
    """
    operator = moving.operator
    size = coordinates.shape[1]
    place, velocity, room = np.empty(size), np.empty(size), np.empty(size)
    free = np.empty(len(moving.lift))
    far, speed, load = imposed
    free_force = mo.approach(
        coordinates, drive, far, speed, load, operator.carry, operator.compliance,
        operator.scalars, moving.shapes, moving.lift, moving.drive, moving.drive_shape,
        moving.load_force, moving.load_response, place, velocity, room, free,
    )  # fmt: skip
    result = solve_increment(problem, free, surface_motion, contact)
    after, drive_after = np.empty_like(coordinates), np.empty_like(drive)
    lost = mo.settle(
        coordinates, after, drive, drive_after, far, speed, load, free_force, result.force,
        place, velocity, room, operator.mass, operator.stiffness, operator.held,
        operator.compliance, operator.scalars, moving.shapes, moving.drop, moving.drive,
        moving.drive_shape, moving.drive_response, moving.load_force,
    )  # fmt: skip
    return result, after, drive_after, float(lost)


class Walker:
    """Takes a system from state to state and keeps the sums of what happens on the way.

    Attributes
    ----------
    system : System
        What moves.
    state : SystemState
        Where it is.
    sums : ndarray
        See `asperity.contact.ledger`.
    mean_pressure : ndarray, shape (q,)
        Pressure times time at each point since the sums were cleared, Pa s.
    cuts : int
        Steps that were taken again in halves.
    """

    def __init__(self, system: System, state: SystemState) -> None:
        self.system = system
        self.state = state
        self.sums = np.zeros(ledger.SUMS)
        self.sums[ledger.BREAKAWAY] = -1.0
        self.mean_pressure = np.zeros(system.weights.size)
        self.cuts = 0
        ledger.clear(self.sums)

    def snapshot(self) -> tuple[SystemState, FloatArray, FloatArray, int]:
        """Return all that changes: state, sums, pressures, cuts."""
        return self.state, self.sums, self.mean_pressure, self.cuts

    def restore(self, snapshot: tuple[SystemState, FloatArray, FloatArray, int]) -> None:
        """Go back to a snapshot."""
        self.state, self.sums, self.mean_pressure, self.cuts = snapshot

    def clear(self) -> None:
        """Begin the sums anew."""
        self.sums = self.sums.copy()
        ledger.clear(self.sums)
        self.mean_pressure = np.zeros_like(self.mean_pressure)

    def step_to(self, end: float, step: float) -> None:
        """Go on to a time in one step, or in parts where it does not converge.

        Parameters
        ----------
        end : float
            Time at its end, s.
        step : float
            The length whose operators are used, s; ``end`` less the present time but for rounding.

        Raises
        ------
        ConvergenceError
            Not even a step of 1/256 converges; with time, residual and points in contact.
        """
        self._step_to(end, step, 0)

    def _step_to(self, end: float, step: float, cut: int) -> None:
        begin = self.state.time
        try:
            self._take(end, step)
        except ConvergenceError as error:
            if cut >= MOST_CUTS:
                raise ConvergenceError(
                    f"no equilibrium of the contact at {begin:.9g} s, in a step of {step:.3g} s "
                    f"(cut in half {cut} times): {error}",
                    reached={"time_s": begin, **error.reached},
                ) from error
            self.cuts += 1
            self._step_to(begin + 0.5 * step, 0.5 * step, cut + 1)
            self._step_to(end, 0.5 * step, cut + 1)

    def _take(self, end: float, step: float) -> None:
        system, state = self.system, self.state
        moving, problem = system.stepping(step)
        surface_motion, base = system.surface_motion(state.time, end)
        far = state.drive[mo.REACH] + system.drive_velocity * step
        result, coordinates, drive, lost = _one_step(
            system, moving, problem, surface_motion, state.contact.state, state.coordinates,
            state.drive, (far, system.drive_velocity, state.load),
        )  # fmt: skip
        if system.mechanism.drive is None and system.mechanism.held[0]:
            drive[mo.FORCE] = coordinates[hht.REACTION, 0]
            drive[mo.WAY] = drive[mo.REACH] = coordinates[hht.PLACE, 0]
        forces = _forces(system, result, coordinates, state.load)
        shaking = system.shaking
        seen = shaking.transfer if shaking is not None and shaking.on_body else 1.0
        imposed = np.array([
            step, end, base[0], base[1], base[2], state.load, state.load, lost,
            float(result.iterations), seen, system.full_friction,
        ])  # fmt: skip
        before = state.contact
        # Copies, so that whoever stops in the middle of a step finds the state before it whole.
        sums, mean_pressure = self.sums.copy(), self.mean_pressure.copy()
        ledger.account(
            sums, imposed, state.forces, forces, state.drive, drive,
            before.displacement, result.displacement, before.force, result.force,
            before.pressure, before.traction, before.normal, before.distance,
            result.pressure, result.traction, result.normal, result.distance,
            result.slip_1, result.slip_2, system.weights, mean_pressure,
        )  # fmt: skip
        self.sums, self.mean_pressure = sums, mean_pressure
        self.state = SystemState(end, coordinates, drive, result, forces, state.load)

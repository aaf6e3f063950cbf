"""A condensed body on a rigid surface: what stays the same, and all that a step starts from."""

import dataclasses
import functools

import numpy as np

from asperity.arrays import FloatArray
from asperity.contact.increment.problem import IncrementProblem, IncrementResult
from asperity.contact.interface.counter_motion import Drift, SurfaceMotion
from asperity.contact.interface.friction import PointFriction
from asperity.contact.interface.normal import NormalLaw
from asperity.contact.interface.rigid import Pose, RigidSurface
from asperity.contact.interface.surface import ContactSurface
from asperity.contact.motion.hht import ALPHA, Coordinates, coefficients
from asperity.contact.motion.march import (
    BaseMotion,
    ShakingNumbers,
    Standing,
    SystemNumbers,
    base_motion,
)
from asperity.contact.motion.mechanism import DriveState, Mechanism, MotionStep, motion_step
from asperity.contact.motion.works import Asperities, Resultants
from asperity.vibration.waveform import AT_REST, Shape

# A mass thrown on a spring leaves it at its speed, in the root mean square over the moment of
# touching, up to this angle of its oscillation in a step; at 3 it leaves 17 % faster.
_RESOLVED = 2.0


@dataclasses.dataclass(frozen=True, eq=False)
class Shaking:
    """Vibration of a plane base or of the body as a contact sees it."""

    shape: Shape  #: Waveform
    #: Displacement amplitude along x, y, and z (up, against the pressure), m
    amplitude: tuple[float, float, float]
    start: float = 0.0  #: When it begins, s
    #: Share of lateral motion that reaches the contact: of the base, or of the body
    transfer: float = 1.0
    on_body: bool = False  #: Whether the body is shaken: its prescribed motion is added to its own

    @functools.cached_property
    def body(self) -> tuple[FloatArray, FloatArray]:
        """What each part of the slip sees of the body's own displacement, (3, 3) each."""
        if not self.on_body:
            return np.eye(3), np.zeros((3, 3))
        return np.diag([1.0, 0.0, 1.0]), np.diag([0.0, self.transfer, 0.0])

    @property
    def numbers(self) -> ShakingNumbers:
        """The vibration as kernels take it.

        A body that is shaken is one at rest on a base that moves the other way, but for the share
        of its own lateral motion that the contact sees.
        """
        sign = -1.0 if self.on_body else 1.0
        x, y, z = (sign * float(amplitude) for amplitude in self.amplitude)
        return ShakingNumbers(
            self.shape.wave(), float(self.shape.frequency), float(self.start), x, y, z,
            float(self.transfer),
        )  # fmt: skip


@dataclasses.dataclass(frozen=True, eq=False)
class System:
    """A condensed body, what holds and loads it, and what it slides on."""

    mechanism: Mechanism  #: The body
    surface: ContactSurface  #: Its faces that may touch
    #: counter, pose: What it meets, and where that stands
    counter: RigidSurface
    normal: NormalLaw  #: Pressure against overclosure
    friction: PointFriction  #: Friction law
    pose: Pose = dataclasses.field(default_factory=Pose)
    shaking: Shaking | None = None  #: Vibration
    drive_velocity: float = 0.0  #: Of the drive's far end, or of a held first coordinate, m/s
    full_friction: float = np.inf  #: Drive force that counts as breakaway, N
    alpha: float = ALPHA  #: Parameter of the time integration

    @functools.cached_property
    def weights(self) -> FloatArray:
        """Area of each point of the surface, m^2."""
        return np.ascontiguousarray(self.surface.weights.ravel())

    @property
    def asperities(self) -> Asperities:
        """What the energy of the asperities follows from."""
        friction = self.friction
        return Asperities(friction.mu / friction.limit, float(friction.reference))

    def motion_step(self, step: float) -> MotionStep:
        """What a length of the step makes of the body."""
        return motion_step(self.mechanism, step, alpha=self.alpha, impact=self.impact(step))

    @functools.cached_property
    def bounce(self) -> float:
        """Highest angular frequency of the body on its contact, rad/s.

        Of motion normal to the surface, all of it in contact, the body's own give in series; what
        the body would do without contact is no part of it.
        """
        mechanism, surface = self.mechanism, self.surface
        normals = surface.nodal_normals
        moving = ~mechanism.held
        shapes = np.einsum("na,nam->nm", normals, mechanism.shapes.reshape(*normals.shape, -1))
        blocks = mechanism.flexibility.reshape(*normals.shape, *normals.shape)
        give = np.einsum("na,nabc,bc->nb", normals, blocks, normals)
        give += np.diag(1.0 / (self.normal.stiffness * surface.nodal_area))
        stiffness = shapes.T @ np.linalg.solve(give, shapes)
        inner = np.ix_(moving, moving)
        squares = np.linalg.eigvals(np.linalg.solve(mechanism.mass[inner], stiffness[inner])).real
        return float(np.sqrt(max(squares.max(initial=0.0), 0.0)))

    def impact(self, step: float) -> bool:
        """Whether a step does not resolve the contact: a hard one, or too stiff a one."""
        return self.normal.name == "hard" or self.bounce * step > _RESOLVED

    @property
    def resolving_step(self) -> float:
        """Longest step that resolves the contact, s; 0 for a hard one, which none resolves."""
        if self.normal.name == "hard":
            return 0.0
        return _RESOLVED / self.bounce if self.bounce > 0.0 else np.inf

    def newmark_beta(self, step: float) -> float:
        """Return the parameter the time integration takes for a length of the step."""
        return coefficients(self.alpha, impact=self.impact(step))[0]

    def increments(self, compliance: FloatArray, step: float) -> IncrementProblem:
        """Return what the increments of a contact with this flexibility have in common."""
        return IncrementProblem(
            compliance, self.surface, self.counter, self.normal, self.friction, step
        )

    @property
    def unseen(self) -> float:
        """Share of the body's own lateral motion that the contact does not see."""
        shaking = self.shaking
        return 1.0 - shaking.transfer if shaking is not None and shaking.on_body else 0.0

    @functools.cached_property
    def shaken(self) -> ShakingNumbers:
        """Its vibration as kernels take it."""
        still = ShakingNumbers(AT_REST, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0)
        return still if self.shaking is None else self.shaking.numbers

    def numbers(self, problem: IncrementProblem) -> SystemNumbers:
        """Return the system as kernels take it, with increments of one length."""
        mechanism = self.mechanism
        still, _ = self.surface_motion(0.0, 0.0)
        return SystemNumbers(
            problem.interface,
            self.asperities,
            dataclasses.replace(still, pose=self.pose).numbers(),
            self.shaken,
            float(self.drive_velocity),
            mechanism.drive is None and bool(mechanism.held[0]),
            float(self.full_friction),
            float(self.unseen),
            problem.reach,
            problem.by_digits,
            problem.tolerance,
        )

    def surface_motion(self, begin: float, end: float) -> tuple[SurfaceMotion, BaseMotion]:
        """Return how the base moves over a step."""
        base = base_motion(self.shaken, begin, end)
        return SurfaceMotion(
            Pose(self.pose.rotation, self.pose.translation + np.array([0.0, 0.0, base.height])),
            Drift(np.array([base.x, 0.0, 0.0])),
            Drift(np.array([0.0, base.y, 0.0])),
            *(self.shaking.body if self.shaking is not None else (np.eye(3), np.zeros((3, 3)))),
            end <= self.shaken.start * (1.0 + 1e-12),
        ), base


@dataclasses.dataclass(frozen=True, eq=False)
class SystemState:
    """All that a step starts from."""

    time: float  #: s
    coordinates: Coordinates  #: Of the body
    drive: DriveState  #: Of what pulls it
    contact: IncrementResult  #: Of the last increment
    forces: Resultants  #: Of the contact
    load: float  #: Share of the loads

    @property
    def standing(self) -> Standing:
        """The state as kernels take it."""
        contact = self.contact
        return Standing(
            self.time, self.load, self.coordinates, self.drive, contact.displacement,
            contact.force, contact.points, self.forces,
        )  # fmt: skip

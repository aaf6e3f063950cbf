"""A drive's mesh as its protocols know it: what it is without vibration, and how it is marched."""

import abc
import dataclasses
import functools
from typing import ClassVar

import numpy as np
import numpy.typing as npt

from asperity.arrays import FloatArray
from asperity.drive.friction import friction_curve, rating_inputs
from asperity.drive.friction_curve import FrictionCurve, friction_at
from asperity.drive.lugre import static_ratio, steady_friction
from asperity.drive.motion.system import System
from asperity.drive.point import MeshPoint
from asperity.drive.problem import DriveProblem
from asperity.drive.reduced.law import NormalLaw
from asperity.drive.reduced.reduction import Reduction
from asperity.errors import InputError

_FASTER = 3.0  # than sliding and vibration together, up to where friction is tabulated
# Coulomb's friction on rigid teeth gives by so much of the normal approach at full friction.
_GIVE = 2e-3


@dataclasses.dataclass(frozen=True)
class MeshModel(abc.ABC):
    """The mesh of a problem, whatever teeth it is marched with.

    Where it touches, friction, stiffness for the step and approach under the load are those of the
    teeth reduced.

    Attributes
    ----------
    problem : DriveProblem
        What it is a model of.
    reduction : Reduction
        What the teeth are reduced to.
    step_seconds : float
        What a step of the march takes, about, s.
    """

    problem: DriveProblem
    reduction: Reduction

    step_seconds: ClassVar[float]

    @property
    @abc.abstractmethod
    def worm_torque(self) -> float:
        """Without vibration, N m; the mean over a pitch."""

    @property
    @abc.abstractmethod
    def reversed_torque(self) -> float:
        """Of the worm if all friction were turned round, N m; the mean over a pitch."""

    @property
    @abc.abstractmethod
    def torque_off(self) -> float:
        """Share that the torque without vibration may be off by."""

    @abc.abstractmethod
    def torque_over(self, first: float, last: float) -> tuple[float, float]:
        """Mean without vibration over angles of the worm, N m, and what share it may be off by."""

    @property
    @abc.abstractmethod
    def tooth_mode(self) -> float | None:
        """Lowest natural frequency of a tooth, Hz; None where teeth are not known."""

    @property
    @abc.abstractmethod
    def pitch(self) -> float | None:
        """Time from tooth to tooth, s; None of a mesh that is the same at all of them."""

    @abc.abstractmethod
    def march(
        self,
        system: System,
        states: npt.NDArray[np.void],
        committed: FloatArray,
        stretch: float,
        rows: npt.NDArray[np.void],
        stop: npt.NDArray[np.int64],
    ) -> int:
        """March so many stretches as there are rows, see `asperity.drive.reduced.march.march`."""

    @abc.abstractmethod
    def stored(self, indentation: float, traction_ratio: float) -> float:
        """Elastic energy of the driving flank at an indentation, slid to a traction ratio, J."""

    @abc.abstractmethod
    def settled_in(self, pose: FloatArray, traction_ratio: float) -> FloatArray:
        """Return what the mesh remembers, loaded at a pose and slid to a traction ratio."""

    @abc.abstractmethod
    def balanced(self, pose: FloatArray, load: float) -> FloatArray | None:
        """Turn the wheel, in place, to where the mesh carries a load, and return its answer there.

        None of a mesh that is in balance as it stands.
        """

    @functools.cached_property
    def point(self) -> MeshPoint:
        """Where it touches."""
        return self.problem.point(self.reduction.radius)

    @functools.cached_property
    def curve(self) -> FrictionCurve:
        """Coefficient of friction over the sliding speed."""
        problem = self.problem
        if problem.drive.friction == "constant":
            return FrictionCurve(1.0, np.array([problem.friction.mu]))
        if problem.case is None:
            raise InputError("drive.friction is 'iso14521', which needs a case with [operation]")
        return friction_curve(rating_inputs(problem.case), self.fastest)

    @functools.cached_property
    def friction(self) -> float:
        """Coefficient of friction without vibration."""
        problem = self.problem
        return steady_friction(
            problem.friction, self.kinetic, self.point, problem.load, self.sliding_speed
        )

    @functools.cached_property
    def kinetic(self) -> float:
        """The same; of LuGre without what its speed adds."""
        return float(friction_at(self.curve, self.sliding_speed))

    @property
    def holding(self) -> float:
        """Coefficient of friction up to which the flanks hold."""
        return float(friction_at(self.curve, 0.0)) * static_ratio(self.problem.friction)

    @property
    def fastest(self) -> float:
        """Sliding speed that is not passed, m/s."""
        speed = self.sliding_speed
        if self.problem.vibration is not None:
            speed += self.problem.velocity
        return _FASTER * speed

    @property
    def sliding_speed(self) -> float:
        """Of the worm where it touches, m/s."""
        return self.point.sliding_speed(self.problem.worm_speed)

    @functools.cached_property
    def normal_force(self) -> float:
        """Without vibration, N."""
        return self.point.normal_force(self.problem.load, self.friction)

    @functools.cached_property
    def law(self) -> NormalLaw:
        """Normal force against approach."""
        return NormalLaw.of(self.point, self.reduction.deflection, self.friction)

    @functools.cached_property
    def indentation(self) -> float:
        """Of the flanks without vibration, m."""
        return self.law.approach_at(self.normal_force)

    @functools.cached_property
    def elastic_slip(self) -> float:
        """Way along the flank from none to full friction without vibration, m."""
        full = self.kinetic * self.normal_force
        bending = self.reduction.compliance * full
        if self.problem.friction.model == "coulomb":
            return bending or _GIVE * self.indentation
        return bending + self.problem.friction.deflection_limit(self.normal_force)

    @property
    def stiffness(self) -> tuple[float, float]:
        """Of the mesh without vibration along the normal and along the flank, N/m."""
        slope = float(self.law.exact(np.array([self.indentation]))[1][0])
        full, law = self.kinetic * self.normal_force, self.problem.friction
        along = full / self.elastic_slip
        damping = law.contact_damping + law.viscous_damping
        if damping > 0.0:
            # Over a short step dampings hold the asperities fast, behind what the teeth give.
            held = full / law.deflection_limit(self.normal_force) + damping / self.problem.step
            along = 1.0 / (self.reduction.compliance + 1.0 / held)
        return slope, along

"""A drive's mesh reduced: its closed form without vibration, and the mesh as kernels take it."""

import dataclasses
import functools
import math
from typing import ClassVar

import numpy as np
import numpy.typing as npt

from asperity.arrays import FloatArray
from asperity.drive.friction import friction_curve, rating_inputs
from asperity.drive.friction_curve import FrictionCurve, friction_at
from asperity.drive.interface import OUTS, POSES
from asperity.drive.lugre import check_passive, static_ratio, steady_friction
from asperity.drive.motion.system import System
from asperity.drive.point import MeshPoint
from asperity.drive.problem import DriveProblem
from asperity.drive.reduced.law import NormalLaw, force_and_energy
from asperity.drive.reduced.lugre import LuGre
from asperity.drive.reduced.march import march
from asperity.drive.reduced.mesh import STATES, Mesh, settle_in
from asperity.drive.reduced.reduction import Reduction
from asperity.errors import InputError
from asperity.friction.lugre import stribeck_share

_FASTER = 3.0  # than sliding and vibration together, up to where friction is tabulated
# Coulomb's friction on rigid teeth gives by so much of the normal approach at full friction.
_GIVE = 2e-3


@dataclasses.dataclass(frozen=True)
class ReducedModel:
    """The reduced mesh of a problem.

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

    step_seconds: ClassVar[float] = 0.3e-6

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

    @property
    def worm_torque(self) -> float:
        """Without vibration, N m."""
        return self.point.worm_torque(self.problem.load, self.friction)

    def torque_over(self, first: float, last: float) -> float:
        """Mean without vibration over angles of the worm, N m: the same at all of them."""
        return self.worm_torque

    @property
    def reversed_torque(self) -> float:
        """Of the worm if all friction were turned round, N m."""
        return self.point.worm_torque(self.problem.load, -self.friction)

    @functools.cached_property
    def law(self) -> NormalLaw:
        """Normal force against approach."""
        return NormalLaw.of(self.point, self.reduction.deflection, self.friction)

    @functools.cached_property
    def approach(self) -> float:
        """Of the flanks without vibration, m."""
        return self.law.approach_at(self.normal_force)

    @functools.cached_property
    def elastic_slip(self) -> float:
        """Way along the flank from none to full friction without vibration, m."""
        full = self.kinetic * self.normal_force
        bending = self.reduction.compliance * full
        if self.problem.friction.model == "coulomb":
            return bending or _GIVE * self.approach
        return bending + self.problem.friction.deflection_limit(self.normal_force)

    @functools.cached_property
    def mesh(self) -> Mesh:
        """Numbers for the kernels."""
        problem, point = self.problem, self.point
        cell, rows = self.law.table(self.normal_force)
        limit, exponent, compliance_ratio = self.elastic_slip, 0.0, 0.0
        if problem.friction.model != "coulomb":
            limit = problem.friction.deflection_limit(self.normal_force)
            exponent = problem.friction.exponent
            compliance_ratio = self.elastic_slip / limit - 1.0
        return Mesh(
            lead=point.lead,
            radius=point.radius,
            length=point.length,
            arm=point.arm,
            across=point.normal_across,
            radial=point.normal_radial,
            backlash=self._backlash,
            cell=cell,
            rows=rows,
            damping=problem.drive.contact_damping or 0.0,
            reference=self.normal_force,
            limit=limit,
            exponent=exponent,
            compliance_ratio=compliance_ratio,
            curve=self.curve,
            friction=self.kinetic,
            lugre=self.lugre,
        )

    @functools.cached_property
    def lugre(self) -> LuGre:
        """LuGre's numbers; refuses dampings that make energy."""
        law = self.problem.friction
        if law.model != "lugre":
            return LuGre(damps=False)
        full = self.kinetic * self.normal_force
        check_passive(law, full, self.fastest)
        stiffness = full / law.deflection_limit(self.normal_force)
        return LuGre(
            damps=True,
            static_ratio=static_ratio(law),
            stribeck_speed=law.stribeck_velocity,
            rate_time=law.contact_damping / stiffness,
            slip_time=law.viscous_damping / stiffness,
        )

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
        room = np.zeros_like(committed), np.empty((2, POSES)), np.empty(OUTS)
        done: int = march(self.mesh, system, states, committed, *room, stretch, rows, stop)
        return done

    def stored(self, approach: float, share: float) -> float:
        """Elastic energy of the driving flank at an approach, slid to a share of friction, J."""
        mesh = self.mesh
        force, energy = force_and_energy(mesh.cell, mesh.rows, approach)
        asperities, dampings, _ = self._shares(share)
        bent, damped = (each * force / mesh.reference for each in (asperities, dampings))
        unit = mesh.friction * mesh.reference * mesh.limit
        teeth = mesh.compliance_ratio * damped * (2.0 * bent + damped)
        return float(energy + 0.5 * unit * ((1.0 + mesh.compliance_ratio) * bent * bent + teeth))

    def _shares(self, share: float) -> tuple[float, float, float]:
        """A share of full friction over the kinetic one: of asperities, dampings, and Stribeck's.

        Flanks that hold, which have a share below 0, do not slide.
        """
        law = self.lugre
        if not law.damps:
            return share, 0.0, 1.0
        whole = share * self.friction / self.kinetic
        if share < 0.0:
            return whole, 0.0, law.static_ratio
        stribeck = stribeck_share(self.sliding_speed, law.static_ratio, law.stribeck_speed)
        return share * stribeck, whole - share * stribeck, stribeck

    def settled_in(self, pose: FloatArray, share: float) -> FloatArray:
        """Return what the mesh remembers, loaded at a pose and slid to a share of friction."""
        committed = np.zeros(STATES)
        settle_in(self.mesh, committed, pose, *self._shares(share))
        return committed

    @property
    def tooth_mode(self) -> float | None:
        """Lowest natural frequency of a tooth, Hz; None where teeth are not known."""
        return self.reduction.mode

    @property
    def pitch(self) -> float | None:
        """Time from tooth to tooth, s; None of a mesh that is the same at all of them."""
        return None

    def balanced(self, pose: FloatArray, load: float) -> FloatArray | None:
        """Turn the wheel, in place, to where the mesh carries a load, and return its answer there.

        None: this mesh is in balance as it stands.
        """
        return None

    @property
    def _backlash(self) -> float:
        if self.problem.drive.flanks == "driving":
            return math.inf
        return self.problem.backlash

    @property
    def stiffness(self) -> tuple[float, float]:
        """Of the mesh without vibration along the normal and along the flank, N/m."""
        slope = float(self.law.exact(np.array([self.approach]))[1][0])
        full, law = self.kinetic * self.normal_force, self.problem.friction
        along = full / self.elastic_slip
        damping = law.contact_damping + law.viscous_damping
        if damping > 0.0:
            # Over a short step dampings hold the asperities fast, behind what the teeth give.
            held = full / law.deflection_limit(self.normal_force) + damping / self.problem.step
            along = 1.0 / (self.reduction.compliance + 1.0 / held)
        return slope, along

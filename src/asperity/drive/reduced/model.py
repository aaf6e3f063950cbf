"""A drive's mesh reduced: closed forms without vibration, and the mesh as kernels take it."""

import dataclasses
import functools
import math
from typing import ClassVar

import numpy as np
import numpy.typing as npt

from asperity.arrays import FloatArray
from asperity.drive.interface import OUTS, POSES
from asperity.drive.lugre import check_passive, static_ratio
from asperity.drive.motion.system import System
from asperity.drive.reduced.in_series import COULOMB
from asperity.drive.reduced.law import force_and_energy
from asperity.drive.reduced.lugre import LuGre
from asperity.drive.reduced.march import march
from asperity.drive.reduced.mesh import STATES, Mesh, settle_in
from asperity.drive.reduced.mesh_model import MeshModel
from asperity.friction.lugre import stribeck_share


@dataclasses.dataclass(frozen=True)
class ReducedModel(MeshModel):
    """The reduced mesh of a problem."""

    step_seconds: ClassVar[float] = 0.3e-6

    @property
    def worm_torque(self) -> float:
        """Without vibration, N m."""
        return self.point.worm_torque(self.problem.load, self.friction)

    @property
    def torque_off(self) -> float:
        """Share that the torque without vibration may be off by: it is in closed form."""
        return 0.0

    def torque_over(self, first: float, last: float) -> tuple[float, float]:
        """Mean without vibration over angles of the worm, N m: the same at all of them."""
        return self.worm_torque, self.torque_off

    @property
    def reversed_torque(self) -> float:
        """Of the worm if all friction were turned round, N m."""
        return self.point.worm_torque(self.problem.load, -self.friction)

    @functools.cached_property
    def mesh(self) -> Mesh:
        """Numbers for the kernels."""
        problem, point = self.problem, self.point
        cell, rows = self.law.table(self.normal_force)
        limit, exponent, compliance_ratio = self.elastic_slip, COULOMB, 0.0
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

    def stored(self, indentation: float, traction_ratio: float) -> float:
        """Elastic energy of the driving flank at an indentation, slid to a traction ratio, J."""
        mesh = self.mesh
        force, energy = force_and_energy(mesh.cell, mesh.rows, indentation)
        asperities, dampings, _ = self._traction_ratios(traction_ratio)
        bent, damped = (each * force / mesh.reference for each in (asperities, dampings))
        unit = mesh.friction * mesh.reference * mesh.limit
        teeth = mesh.compliance_ratio * damped * (2.0 * bent + damped)
        return float(energy + 0.5 * unit * ((1.0 + mesh.compliance_ratio) * bent * bent + teeth))

    def _traction_ratios(self, traction_ratio: float) -> tuple[float, float, float]:
        """A traction ratio over the kinetic one: of asperities, dampings, and Stribeck's.

        Flanks that hold, which have one below 0, do not slide.
        """
        law = self.lugre
        if not law.damps:
            return traction_ratio, 0.0, 1.0
        whole = traction_ratio * self.friction / self.kinetic
        if traction_ratio < 0.0:
            return whole, 0.0, law.static_ratio
        stribeck = stribeck_share(self.sliding_speed, law.static_ratio, law.stribeck_speed)
        return traction_ratio * stribeck, whole - traction_ratio * stribeck, stribeck

    def settled_in(self, pose: FloatArray, traction_ratio: float) -> FloatArray:
        """Return what the mesh remembers, loaded at a pose and slid to a traction ratio."""
        committed = np.zeros(STATES)
        settle_in(self.mesh, committed, pose, *self._traction_ratios(traction_ratio))
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

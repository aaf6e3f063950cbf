"""A drive's mesh as elastic teeth: what the protocols march in place of the reduced mesh."""

import dataclasses
import functools
import math
from typing import ClassVar

import numpy as np
import numpy.typing as npt

from asperity.arrays import FloatArray
from asperity.contact.candidates.records import Answer, Candidates, Kept, Laws, Work
from asperity.contact.interface.friction import DAHL, PointFriction
from asperity.contact.interface.records import Committed
from asperity.contact.interface.rigid import RigidSurface
from asperity.drive.elastic.friction import Sliding
from asperity.drive.elastic.march import march
from asperity.drive.elastic.memory import states
from asperity.drive.elastic.mesh import solve_teeth
from asperity.drive.elastic.records import GATHERED, Mesh
from asperity.drive.elastic.rim import rim_of
from asperity.drive.interface import AT, OUTS, POSES
from asperity.drive.motion.system import System
from asperity.drive.problem import DriveProblem
from asperity.drive.reduced.mesh_model import MeshModel
from asperity.drive.reduced.reduction import Reduction
from asperity.drive.static.equilibrium import Equilibrium
from asperity.drive.static.solve import condensed
from asperity.drive.static.sweep import (
    REVERSED,
    LoadCase,
    PitchSweep,
    phases_of,
    sweep,
    touching_angles,
)
from asperity.drive.teeth.contact import CONTACT_STIFFNESS, KEPT, TeethContact
from asperity.drive.teeth.mode import lowest_mode
from asperity.drive.teeth.sector import Sector
from asperity.flanks.meshing.backlash import set_backlash
from asperity.flanks.meshing.transmission import transmission
from asperity.flanks.wheel.enveloped import Wheel
from asperity.friction.dahl import VECTOR
from asperity.runs import Run

_MILLIMETRES = 1e3
_PHASES = 8
# A pitch, of a mean torque: where teeth come in and go out it has corners.
_PLACES = 36
_MOST_PITCHES = 4.0  # whose corners matter one by one
# Asperities of Coulomb's friction: a deflection far below what the teeth bend.
_BRITTLE = 2e-8
# Turn of the worm that slides all asperities through, rad.
_SLIDE = 1e-3
# Turns of the wheel on the way to its balance, rad, and how near to it is near enough.
_SHIFT, _FALL, _BALANCED = 1e-6, 1e-4, 1e-6
_TOLERANCE = 2e-7
_STEPS = 40


@dataclasses.dataclass(frozen=True)
class TeethModel(MeshModel):
    """The mesh as elastic teeth.

    Attributes
    ----------
    sector : Sector
        The condensed teeth, the worm's threads as thick as the backlash asks for.
    """

    sector: Sector

    step_seconds: ClassVar[float] = 0.4e-3

    @classmethod
    def of(cls, problem: DriveProblem, reduction: Reduction, run: Run) -> "TeethModel":
        """Return the model of a problem; ``reduction`` is that of the same teeth."""
        sector = condensed(problem, run)
        if problem.drive.flanks == "both":
            sector = _with_backlash(sector, problem)
        return cls(problem, reduction, sector)

    @functools.cached_property
    def contact(self) -> TeethContact:
        """The teeth held against the worm."""
        return TeethContact(self.sector, self.friction)

    @functools.cached_property
    def sweeps(self) -> tuple[PitchSweep, PitchSweep, float]:
        """Forward and reversed without vibration, and the mean pressure where it touches, Pa."""
        contact = self.contact
        phases = phases_of(contact, _PHASES)
        touching = touching_angles(contact, phases)
        sums = np.zeros(2)

        def evaluate(_number: int, _balance: object) -> None:
            for k in range(contact.slots):
                n = 4 * int(contact.candidates.counts[k, 0])
                pressure, area = contact.answer.pressure[k, :n], contact.candidates.weights[k, :n]
                sums[:] += pressure @ area, area[pressure > 0.0].sum()

        load = self.problem.load
        asked = [LoadCase(load, evaluate=evaluate), LoadCase(load, REVERSED)]
        forward, back = sweep(Equilibrium(contact), phases, touching, asked)
        return forward, back, float(sums[0] / sums[1])

    @property
    def worm_torque(self) -> float:
        """Without vibration, mean over a pitch, N m."""
        return self._over_a_pitch[0]

    @property
    def torque_off(self) -> float:
        """Share that the torque without vibration may be off by."""
        return self._over_a_pitch[1]

    @functools.cached_property
    def _over_a_pitch(self) -> tuple[float, float]:
        return self.torque_over(0.0, self.pitch_angle)

    def torque_over(self, first: float, last: float) -> tuple[float, float]:
        """Mean without vibration over angles of the worm, N m, and what share it may be off by.

        That is what a third of the places is off, each in the middle of three.
        """
        contact = self.contact
        pitches = (last - first) / self.pitch_angle
        count = max(_PLACES * min(max(pitches, 1.0), _MOST_PITCHES), _PHASES * pitches)
        count = 3 * math.ceil(count / 3)
        places = (np.arange(count) + 0.5) / count
        phases = np.asarray(first + (last - first) * places, np.float64)
        touching = touching_angles(contact, phases)
        (course,) = sweep(Equilibrium(contact), phases, touching, [LoadCase(self.problem.load)])
        mean = float(course.worm_torque.mean())
        return mean, abs(float(course.worm_torque[1::3].mean()) / mean - 1.0)

    @property
    def reversed_torque(self) -> float:
        """Of the worm if all friction were turned round, mean over a pitch, N m."""
        forward, back, _ = self.sweeps
        return self.worm_torque * float(back.worm_torque.mean() / forward.worm_torque.mean())

    @functools.cached_property
    def teeth(self) -> Mesh:
        """The mesh as the march takes it."""
        contact, body, problem = self.contact, self.sector.body, self.problem
        count = contact.slots
        flanks = 2 if problem.drive.flanks == "both" else 1
        places = flanks * count
        pressure = self.sweeps[2]
        table = problem.friction
        limit, exponent = _BRITTLE, 0.0
        if table.model == "dahl":
            limit, exponent = table.deflection_limit(self.normal_force), table.exponent
        point = PointFriction(
            DAHL, self.friction, limit, VECTOR, exponent, reference=pressure
        ).numbers(0.0)
        forward = contact.laws(self.friction)
        interface = forward.interface._replace(friction=point)
        laws = Laws(interface, _TOLERANCE, forward.floor, _STEPS)
        other = RigidSurface.worm(self.sector.wheel.pair.worm, side=-1).numbers
        gathered = np.zeros(places, GATHERED)
        gathered["tooth"] = np.inf
        return Mesh(
            body=body,
            stand=contact.stand,
            rim=(rim := rim_of(self.sector.neighbours, self.sector.surface.nodal_area, places)),
            laws=laws,
            back=laws._replace(interface=interface._replace(counter=other)),
            teeth=count,
            flanks=flanks,
            ahead=contact.touching_angle(0.0, np.zeros(3)),
            damping=problem.drive.contact_damping or 0.0,
            sliding=self._sliding,
            friction_stiffness=self.friction * pressure / limit,
            stiffness=CONTACT_STIFFNESS,
            candidates=Candidates.workspace(body, places),
            answer=Answer.workspace(body, places),
            kept=Kept.workspace(body, places, KEPT),
            history=Committed.none(body.nodes, len(body.weights)),
            earlier=np.zeros((len(body.weights), 3)),
            work=Work.workspace(body, len(body.weights)),
            gathered=gathered,
            shape=np.zeros((places, 3 * body.nodes)),
            rotation=np.zeros((2, 3, 3)),
            translation=np.zeros((2, 3)),
            vectors=np.zeros((2, 3)),
            wrench=np.zeros(6),
            drift=np.zeros((3, 3)),
            shift=np.zeros(3),
            nothing=np.zeros((3, 3)),
            still=np.zeros(3),
            moved=np.zeros(3),
            one=np.eye(3),
            damped=np.zeros(POSES),
            amplitude=np.zeros(rim.shapes.shape[1]),
            numbers=np.zeros(places, np.int64),
            counted=np.zeros(1, np.int64),
        )

    @property
    def _sliding(self) -> Sliding:
        point = self.point
        return Sliding(
            self.curve, self.friction, point.lead, point.radius, point.length, point.arm,
            point.normal_across, point.normal_radial, np.ones(2),
        )  # fmt: skip

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
        done: int = march(self.teeth, system, states, committed, stretch, rows, stop)
        return done

    def _slid(self, pose: FloatArray, sense: float) -> tuple[FloatArray, FloatArray]:
        """What the mesh remembers at a pose after sliding, and its answer."""
        before = np.zeros(states(self.teeth))
        # As fast as the drive runs; what holds is at rest.
        self.teeth.sliding.share[:] = 1.0 if sense > 0.0 else self.holding / self.friction
        after = np.zeros_like(before)
        out = np.zeros(OUTS)
        turn = sense * _SLIDE
        # Asperities that only just touch are slid through by a second step.
        for _ in range(2):
            before[:POSES] = pose - np.array([turn, 0.0, turn / self.point.ratio, 0.0, 0.0])
            solve_teeth(self.teeth, before, after, pose, np.zeros(POSES), 1.0, out)
            before = after.copy()
        return after, out

    @functools.cached_property
    def tooth_mode(self) -> float:
        """Lowest natural frequency of a tooth cut out with its rim, Hz."""
        return lowest_mode(self.sector.wheel, self.problem.gearset.wheel_material)

    @property
    def pitch(self) -> float:
        """Time from tooth to tooth, s."""
        return self.pitch_angle / self.problem.worm_speed

    @property
    def pitch_angle(self) -> float:
        """Turn of the worm from tooth to tooth, rad."""
        return 2.0 * math.pi / self.problem.gearset.starts

    def balanced(self, pose: FloatArray, load: float) -> FloatArray | None:
        """Turn the wheel, in place, to where the teeth carry a load, and return their answer."""
        out = self._slid(pose, 1.0)[1]
        torque, move = out[AT.wheel_torque], -_SHIFT
        for _ in range(_STEPS):
            pose[2] += move
            out = self._slid(pose, 1.0)[1]
            missing = load - out[AT.wheel_torque]
            if abs(missing) <= _BALANCED * load:
                break
            slope = (out[AT.wheel_torque] - torque) / move
            torque = out[AT.wheel_torque]
            # Open flanks have no slope: the wheel falls back against the worm.
            move = missing / slope if slope < 0.0 else -_FALL
            move = float(np.clip(move, -_FALL, _FALL))
        return out

    def settled_in(self, pose: FloatArray, traction_ratio: float) -> FloatArray:
        """Return what the mesh remembers, loaded at a pose and slid to a traction ratio."""
        return self._slid(pose, 1.0 if traction_ratio >= 0.0 else -1.0)[0]

    def stored(self, indentation: float, traction_ratio: float) -> float:
        """Elastic energy of the driving flank at an indentation, slid to a traction ratio, J."""
        roll = -indentation / (self.point.normal_z * self.point.arm)
        out = self._slid(
            np.array([0.0, 0.0, roll, 0.0, 0.0]), 1.0 if traction_ratio >= 0.0 else -1.0
        )[1]
        return float(out[AT.stored])


def _with_backlash(sector: Sector, problem: DriveProblem) -> Sector:
    """The teeth under a worm whose threads leave the backlash."""
    wheel = sector.wheel
    meshes = {side: transmission(wheel.pair, wheel.flank(side)) for side in (1, -1)}
    thinned = set_backlash(meshes, _MILLIMETRES * problem.backlash)[1].search.pair
    return dataclasses.replace(sector, wheel=Wheel(thinned))

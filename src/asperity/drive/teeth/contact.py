"""The worm held against elastic teeth: forces for a given place of both, quasi-static."""

from __future__ import annotations

import dataclasses
from functools import cached_property

import numpy as np

from asperity.arrays import FloatArray
from asperity.contact.candidates import newton
from asperity.contact.candidates.faces import collect, least_gap
from asperity.contact.candidates.newton import spread
from asperity.contact.candidates.records import (
    Answer,
    Candidates,
    Kept,
    Laws,
    Work,
    answer_of,
    candidates_of,
)
from asperity.contact.candidates.several import solve_all
from asperity.contact.candidates.wrench import wrench, wrench_slope
from asperity.contact.interface.friction import COULOMB, PointFriction
from asperity.contact.interface.normal import NormalLaw
from asperity.contact.interface.records import Committed, Interface
from asperity.contact.interface.rigid import RigidSurface
from asperity.drive.teeth.placing import Stand, place_worm, sliding, to_space, tooth_numbers
from asperity.drive.teeth.sector import Sector
from asperity.errors import ConvergenceError
from asperity.kernels.compiled import kernel

CONTACT_STIFFNESS = 5e14
"""Of the flanks' surfaces, Pa/m; from there to hard contact the torque moves by 0.2 %."""

NEAR = 30e-6
"""Faces this near to the worm are looked at, m."""

KEPT = 160
"""Points that an inverse is kept of at most."""

_TOLERANCE = 1e-9
_STEPS = 60
_ROUNDING = 16.0 * np.finfo(float).eps
_ELASTIC_SLIP = 1e-9
_TOUCH = 1e-10
_BESIDE = 1e-6  # of a pitch, that half a pitch is made out by


class FullError(ConvergenceError):
    """More of the teeth touches than could be."""


@dataclasses.dataclass(frozen=True, eq=False)
class Action:
    """What the worm does to the wheel, about the wheel's centre and axes, right-handed."""

    wrench: FloatArray  #: (6,): Force, N, and moment, N m, on the wheel
    #: (6, 6): Its derivative by a shift and a turn of the worm about the wheel's centre
    slope: FloatArray
    teeth: tuple[int, ...]  #: Numbers of the teeth that may be in mesh
    forces: FloatArray  #: (K, 3): On each of them, N, in space
    normal: FloatArray  #: (K,): Normal force on each, N
    residual: float
    iterations: int  #: Evaluations of teeth


@kernel
def _act(body, side, angles, candidates, answer, work, out, slope, forces):
    """Sum up what all teeth feel; whether all contacts have a stiffness."""
    part = np.empty(6)
    local = np.empty((6, 6))
    two = np.empty((2, 3))
    square = np.empty((3, 3))
    turned = np.empty((3, 3))
    for k in range(angles.shape[0]):
        own = candidates_of(candidates, k)
        if own.counts[0] == 0:
            continue
        part[:] = 0.0
        wrench(body, own, answer_of(answer, k), part)
        for c in range(3):
            two[0, c] = part[c]
            two[1, c] = part[3 + c]
        to_space(angles[k], side, two)
        for c in range(3):
            forces[k, c] = two[0, c]
            out[c] += two[0, c]
            out[3 + c] += two[1, c]
        local[:] = 0.0
        if not wrench_slope(body, own, answer_of(answer, k), work, local):
            return False
        for i in range(2):
            for j in range(2):
                for c in range(3):
                    for e in range(3):
                        square[c, e] = local[3 * i + c, 3 * j + e]
                # R L R^T, rows first: the vectors of `to_space` are rows.
                to_space(angles[k], side, square)
                for c in range(3):
                    for e in range(3):
                        turned[e, c] = square[c, e]
                to_space(angles[k], side, turned)
                for c in range(3):
                    for e in range(3):
                        slope[3 * i + c, 3 * j + e] += turned[e, c]
    return True


class TeethContact:
    """The wheel's elastic teeth against a worm, on one flank.

    Parameters
    ----------
    sector : Sector
        The condensed teeth.
    friction : float
        Coefficient of friction.
    side : int
        Flank of the teeth, 1 (driving) or -1.
    coupled : bool
        Whether teeth give way to what loads their neighbours.
    most : int, optional
        Teeth that may be in mesh, odd; three, or those of the sector if left out.
    """

    def __init__(
        self,
        sector: Sector,
        friction: float,
        *,
        side: int = 1,
        coupled: bool = True,
        most: int | None = None,
    ) -> None:
        self.sector = sector
        self.side = side
        self.stand = Stand.of(sector.wheel.pair)
        self.slots = most or max(3, sector.teeth)
        body = sector.body
        self.candidates = Candidates.workspace(body, self.slots)
        self.answer = Answer.workspace(body, self.slots)
        self.kept = Kept.workspace(body, self.slots, KEPT)
        self.work = Work.workspace(body, len(body.weights) // 2)
        size = len(body.flexibility)
        self.blocks = (
            np.stack(sector.neighbours)
            if coupled and sector.neighbours
            else np.empty((0, size, size))
        )
        self._friction = friction
        self._history = Committed.none(body.nodes, len(body.weights))
        self._collected: FloatArray | None = None

    @cached_property
    def worm(self) -> RigidSurface:
        """The counter-surface."""
        return RigidSurface.worm(self.sector.wheel.pair.worm, side=self.side)

    def laws(self, friction: float) -> Laws:
        """Return the laws with a coefficient of friction, sliding fully."""
        body, surface = self.sector.body, self.sector.surface
        point = PointFriction(COULOMB, friction, _ELASTIC_SLIP)
        interface = Interface(
            body.faces, body.shapes, body.weights, body.places, self.worm.numbers,
            NormalLaw("linear", CONTACT_STIFFNESS).numbers, point.numbers(0.0),
        )  # fmt: skip
        reach = float(np.abs(body.places).max()) + float(np.abs(self.stand.origin).max())
        floor = _ROUNDING * reach * CONTACT_STIFFNESS * float(np.linalg.norm(surface.nodal_area))
        return Laws(interface, _TOLERANCE, floor, _STEPS)

    def numbers(self, beta: float) -> range:
        """Return the numbers of the teeth that may be in mesh while the worm stands at an angle.

        They go by the worm, which stands still while the wheel is sought: half a pitch from a
        tooth the next set would begin in the middle of the search. Just there it is the set on the
        side to which the play lets the wheel go, so that both flanks have theirs half a turn about
        the tooth from each other.
        """
        pitch = self.sector.pitch
        return tooth_numbers(
            beta / self.stand.ratio - self.side * _BESIDE * pitch, pitch, self.slots
        )

    def placed(
        self, beta: float, phi: float, shift: FloatArray
    ) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return angles of the teeth, (K,), and the worm's pose as each sees it."""
        numbers = self.numbers(beta)
        angles = phi + self.sector.pitch * np.array(numbers, dtype=np.float64)
        rotation, translation = np.empty((len(angles), 3, 3)), np.empty((len(angles), 3))
        for k, angle in enumerate(angles):
            place_worm(self.stand, beta, shift, angle, 0.0, self.side, rotation[k], translation[k])
        return angles, rotation, translation

    def least_gap(self, beta: float, phi: float, shift: FloatArray) -> float:
        """Return the least distance between the undeformed teeth and the worm, m."""
        _, rotation, translation = self.placed(beta, phi, shift)
        body = self.sector.body
        gaps = [
            least_gap(body, self.worm.numbers, r, t)
            for r, t in zip(rotation, translation, strict=True)
        ]
        return float(min(gaps))

    def touching_angle(self, beta: float, shift: FloatArray) -> float:
        """Return the angle of the wheel at which it touches the worm unloaded, rad."""
        phi = beta / self.stand.ratio
        side = self.side
        step = 1e-5
        gap = self.least_gap(beta, phi, shift)
        for _ in range(_STEPS):
            further = self.least_gap(beta, phi + side * step, shift)
            slope = (further - gap) / step
            if not slope > 0.0:
                break
            move = -gap / slope
            phi += side * move
            gap = self.least_gap(beta, phi, shift)
            if abs(gap) <= _TOUCH:
                return phi
            step = max(1e-7, min(1e-5, abs(move)))
        raise ConvergenceError(
            "the worm reaches no tooth of the wheel: look at mount.centre_distance_error and "
            "mount.axial_offset",
            reached={"gap_m": gap},
        )

    def act(
        self,
        beta: float,
        phi: float,
        shift: FloatArray,
        *,
        sense: int = 1,
        tolerance: float = _TOLERANCE,
    ) -> Action:
        """Return what a worm at a place does to the wheel.

        Parameters
        ----------
        beta, phi : float
            Angles of worm and wheel, rad.
        shift : ndarray, shape (3,)
            Of the worm along the axes of its own frame, m.
        sense : int
            1: both turn forwards; -1 backwards; 0: without friction.
        tolerance : float
            To which teeth that give way to each other agree, of the forces.

        Raises
        ------
        FullError
            More of a tooth touches than could be.
        ConvergenceError
            No equilibrium.
        """
        body, stand = self.sector.body, self.stand
        numbers = self.numbers(beta)
        angles, rotation, translation = self.placed(beta, phi, shift)
        self._collect(beta, phi, shift, numbers, rotation, translation)
        slip, turn = np.zeros((len(angles), 3)), np.zeros((len(angles), 3, 3))
        for k in range(len(angles)):
            sliding(stand, rotation[k], translation[k], self.side, float(sense), slip[k], turn[k])
        laws = self.laws(self._friction if sense else 0.0)
        residual, iterations = solve_all(
            body, self.side * np.array(numbers), self.blocks, self.candidates,
            (rotation, translation, slip, turn), laws, self._history, self.answer, self.kept,
            self.work, tolerance, True,
        )  # fmt: skip
        if residual == newton.FULL:
            raise FullError("more of the teeth touches the worm than could be")
        if residual > 1e3 * _TOLERANCE:
            raise ConvergenceError(
                "the teeth find no equilibrium with the worm at this load: take a smaller torque",
                reached={"residual": residual, "iterations": float(iterations)},
            )
        total, slope, forces = np.zeros(6), np.zeros((6, 6)), np.zeros((len(angles), 3))
        if not _act(
            body, self.side, angles, self.candidates, self.answer, self.work, total, slope, forces
        ):
            raise ConvergenceError(
                "the teeth's contact has no stiffness at this load: take another torque",
                reached={"residual": residual},
            )
        return Action(
            total, slope, tuple(numbers), forces, self._normal_forces(), residual, iterations
        )

    def nodal_forces(self) -> FloatArray:
        """Return the forces on the nodes of all teeth, (K, 3n), N, each in its own frame."""
        body = self.sector.body
        found = np.zeros((self.slots, 3 * body.nodes))
        for k in range(self.slots):
            self.spread(k, self.answer.force[k], found[k])
        return found

    def spread(self, k: int, force: FloatArray, nodal: FloatArray) -> None:
        """Write the nodal forces of forces at the candidates of a tooth, N."""
        spread(self.candidates.of(k), self.sector.body.shapes, force, nodal)

    def _normal_forces(self) -> FloatArray:
        counts = 4 * self.candidates.counts[:, 0]
        return np.array(
            [
                float(self.answer.pressure[k, :n] @ self.candidates.weights[k, :n])
                for k, n in enumerate(counts)
            ]
        )

    def _collect(
        self, beta: float, phi: float, shift: FloatArray, numbers: range, rotation: FloatArray,
        translation: FloatArray,
    ) -> None:  # fmt: skip
        """Gather the faces near the worm, anew where it has gone half as far as they reach."""
        body = self.sector.body
        here = np.array([
            beta * self.stand.lead, phi * float(body.places[:, 1].max()), *shift, numbers[0]
        ])  # fmt: skip
        last = self._collected
        if last is not None and np.abs(here - last).sum() <= 0.5 * NEAR:
            return
        self._collected = here
        self.answer.force[:] = 0.0
        still = np.zeros(3 * body.nodes)
        for k in range(len(numbers)):
            collect(
                body, self.worm.numbers, rotation[k], translation[k], still, NEAR,
                self.candidates.of(k),
            )  # fmt: skip

r"""Pressures on all teeth in mesh at one angle of the worm, resolved beyond the mesh of the teeth.

The condensed teeth and the balance of the drive say where the worm stands, what load the teeth
bear together, how friction bends them, and what they give smoothly: their flexibility less that of
a half-space at their nodes. A strip of patches on each tooth has the rest, half-spaces of wheel and
worm, and the exact gap, with the rounding of the worm's tip and the wheel's edges. All patches of
all teeth are solved together, under the moment of the normal forces about the wheel's axis that the
condensed teeth bear: how teeth share it is found anew, as each gives with its resolved dent.

Strips are made finer, each about what bears on it, until the largest pressures of flank and edges
change by less than `CLOSE`, or stand at the pressure at which the softer body flows.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator

import numpy as np
from scipy import sparse

from asperity.arrays import FloatArray, IntArray
from asperity.contact.halfspace.conjugate_gradients import Bearing, bear
from asperity.contact.halfspace.influence import HalfSpace, HalfSpaces
from asperity.drive.resolved.flank import ExactFlank
from asperity.drive.resolved.pressures import CLOSE, Change, Resolved, ToothPressure
from asperity.drive.resolved.strip import FACE_END, WHEEL_TIP, Frame, Strip, ToothPose
from asperity.drive.teeth.contact import TeethContact
from asperity.errors import ConvergenceError

# Near: less than this part of the greatest inward motion of the nodes, and this at least.
_NEAR, _LEAST_NEAR = 0.1, 1e-6
# Patches across and along from strip to strip.
_LEVELS = ((96, 64), (192, 80), (384, 96), (768, 112))
# Force of an edge over that of the tooth from which on its peak counts.
_COUNTS = 1e-3
_TRIES = 12


class ResolvedContact:
    """Resolves the pressures of balances of one drive.

    Parameters
    ----------
    flank : ExactFlank
        The flank of a tooth and what it gives smoothly.
    modulus : float
        E* of both bodies, Pa.
    cap : float, optional
        Pressure at which the softer body flows, Pa; none if left out.
    rigid_share : float
        Of what the patches give as half-spaces, what is rigid in the balance: the worm's, or
        nothing.
    """

    def __init__(
        self, flank: ExactFlank, modulus: float, cap: float | None = None, rigid_share: float = 0.0
    ) -> None:
        self.flank = flank
        self.modulus = modulus
        self.cap = cap
        self.rigid_share = rigid_share

    def mesh_error(self, found: Resolved) -> float:
        """Return by how much the points of the mesh hold the wheel too far ahead, rad.

        Patches bear wherever worm and wheel touch, the condensed teeth at the points of their mesh.
        Of a body that is rigid in the balance the give is left out as Hertz has it: it goes by the
        power 2/3 of 1/E*, and a contact's mean sink by pressure is four fifths of its approach.
        """
        rigid = float(1.0 - (1.0 - self.rigid_share) ** (2.0 / 3.0))
        return found.approach - 1.25 * rigid * found.sink

    def resolve(
        self,
        contact: TeethContact,
        beta: float,
        phi: float,
        shift: FloatArray,
        *,
        finer: bool = True,
    ) -> Resolved:
        """Return the pressures where worm and wheel stand, about what was last solved there.

        Parameters
        ----------
        contact : TeethContact
            Holds the fields of `TeethContact.act` at this place.
        beta, phi : float
            Angles of worm and wheel, rad.
        shift : ndarray, shape (3,)
            Of the worm along the axes of its own frame, m.
        finer : bool
            Whether strips are made finer until the peaks stand; the first ones are some 50 patches
            across and along what is near.

        Raises
        ------
        ConvergenceError
            No equilibrium of the patches, or all of them at the pressure of plastic flow.
        """
        teeth = _Teeth.of(self, contact, beta, phi, shift)
        strips, found = teeth.solve_within(teeth.first_strips(), [None] * len(teeth.numbers))
        iterations = found.iterations
        done = [False] * len(strips)
        changes: list[tuple[Change, ...]] = [()] * len(strips)
        for shape in _LEVELS if finer else ():
            before = teeth.pressures(strips, found)
            next_strips = [
                strip if ready else teeth.finer(strip, tooth, shape)
                for strip, tooth, ready in zip(strips, before, done, strict=True)
            ]
            start = [
                None if tooth is None or new is None else new.taken(tooth.strip, tooth.force)
                for new, tooth in zip(next_strips, before, strict=True)
            ]
            strips, found = teeth.solve_within(next_strips, start)
            iterations += found.iterations
            after = teeth.pressures(strips, found)
            changes = [
                () if one is None or two is None or ready else tuple(self._changes(one, two))
                for one, two, ready in zip(before, after, done, strict=True)
            ]
            done = [not each for each in changes]
            if all(done):
                break
        pressures = teeth.pressures(strips, found)
        return Resolved(
            tuple(tooth for tooth in pressures if tooth is not None),
            found.approach, max(0.0, -float(found.gap.min())), iterations, found.residual,
            found.sink, tuple(change for each in changes for change in each),
        )  # fmt: skip

    def _changes(self, before: ToothPressure, after: ToothPressure) -> Iterator[Change]:
        """Yield the peaks that count, change much and are not at the cap."""
        old, new = before.peaks(), after.peaks()
        counts = np.maximum(before.forces(), after.forces()) > _COUNTS * after.normal
        # The wheel's edges are sharp: the finer the patches, the higher the peak.
        counts[[WHEEL_TIP, FACE_END]] = False
        moved = np.abs(new - old) > CLOSE * np.maximum(new, old)
        if self.cap is not None:
            moved &= np.minimum(old, new) < 0.999 * self.cap
        for zone in np.flatnonzero(moved & counts):
            share = float(abs(new[zone] - old[zone]) / max(new[zone], old[zone]))
            yield Change(after.number, int(zone), share)


@dataclasses.dataclass(frozen=True, eq=False)
class _Borne(Bearing):
    """What was found, and what the half-spaces sink."""

    sink: float  #: As `Resolved.sink`


@dataclasses.dataclass(frozen=True, eq=False)
class _Teeth:
    """The teeth in mesh at one angle, ready for their strips."""

    contact: ResolvedContact
    numbers: tuple[int, ...]  #: In their row
    order: IntArray  #: As the condensed teeth give way to each other: numbers times the side
    approaches: tuple[ToothPose, ...]
    rubbed: FloatArray  #: (K, n): Inward motion of the nodes under friction, m
    moment: float  #: Of the normal forces about the wheel's axis, N m

    @classmethod
    def of(
        cls,
        owner: ResolvedContact,
        contact: TeethContact,
        beta: float,
        phi: float,
        shift: FloatArray,
    ) -> _Teeth:
        sector = contact.sector
        _, rotation, translation = contact.placed(beta, phi, shift)
        body = sector.body
        numbers = tuple(contact.numbers(beta))
        order = contact.side * np.array(numbers)
        normals = sector.surface.nodal_normals
        worm = contact.worm.numbers.worm
        whole: list[FloatArray] = []
        rubbing: list[FloatArray] = []
        moment = 0.0
        for k in range(contact.slots):
            count = 4 * int(contact.candidates.counts[k, 0])
            out = contact.answer.normal[k, :count]
            pressed = contact.answer.pressure[k, :count] * contact.candidates.weights[k, :count]
            place = contact.candidates.places[k, :count]
            moment += float(pressed @ (place[:, 0] * out[:, 1] - place[:, 1] * out[:, 0]))
            for values, friction in ((whole, False), (rubbing, True)):
                force = contact.answer.force[k, :count].copy()
                if friction:
                    force -= np.einsum("qi,qi->q", force, out)[:, None] * out
                nodal = np.zeros(3 * body.nodes)
                if count:
                    full = np.zeros_like(contact.answer.force[k])
                    full[:count] = force
                    contact.spread(k, full, nodal)
                values.append(nodal)
        moved = _response(body.flexibility, contact.blocks, order, np.array(whole))
        rubbed = _response(body.flexibility, contact.blocks, order, np.array(rubbing))
        inward = -np.einsum("kni,ni->kn", rubbed, normals)
        approaches = tuple(
            ToothPose(rotation[k], translation[k], worm, moved[k]) for k in range(contact.slots)
        )
        return cls(owner, numbers, order, approaches, inward, moment)

    def first_strips(self) -> list[Strip | None]:
        """Return a strip over what is near the worm on each tooth; None where nothing is."""
        flank = self.contact.flank
        points, normals, *_ = flank.grid
        strips: list[Strip | None] = []
        for approach in self.approaches:
            moved = flank.on_grid @ approach.moved
            gap, *_ = approach.gaps(points + moved)
            if flank.worn is not None:
                gap = gap + flank.worn
            size = float(np.linalg.norm(moved, axis=1).max())
            near = gap < max(_NEAR * size, _LEAST_NEAR)
            if not near.any():
                strips.append(None)
                continue
            weight = np.maximum(max(_NEAR * size, _LEAST_NEAR) - gap[near], 0.0)
            frame = Frame.about(points[near], normals[near], weight, flank.least_reach)
            strips.append(Strip.of(flank, frame, approach))
        return strips

    def finer(
        self, strip: Strip | None, tooth: ToothPressure | None, shape: tuple[int, int]
    ) -> Strip | None:
        """Return a strip about what bears, of more patches; None where nothing does."""
        if strip is None or tooth is None:
            return None
        frame = strip.cropped(tooth.force > 0.0, shape)
        k = self.numbers.index(tooth.number)
        return Strip.of(self.contact.flank, frame, self.approaches[k])

    def pressures(self, strips: list[Strip | None], bearing: Bearing) -> list[ToothPressure | None]:
        """Return the pressures on each tooth; None where it bears nothing."""
        teeth: list[ToothPressure | None] = []
        cap = np.inf if self.contact.cap is None else self.contact.cap
        at = 0
        for number, strip in zip(self.numbers, strips, strict=True):
            if strip is None:
                teeth.append(None)
                continue
            force = bearing.force[at : at + len(strip.area)]
            at += len(strip.area)
            # Where it flows the cap itself, which the quotient misses by its rounding.
            pressure = np.minimum(force / strip.area, cap)
            some = ToothPressure(number, strip, pressure, force)
            teeth.append(some if force.any() else None)
        return teeth

    def solve_within(
        self, strips: list[Strip | None], start: list[FloatArray | None]
    ) -> tuple[list[Strip | None], _Borne]:
        """Solve, with strips that grow where what bears comes to their border."""
        for _ in range(_TRIES):
            found = self.solve(strips, start)
            grown = False
            pressures = self.pressures(strips, found)
            for k, tooth in enumerate(pressures):
                if tooth is None:
                    continue
                strip = tooth.strip
                start[k] = tooth.force
                frame = strip.grown(tooth.force > 0.0)
                if frame is None:
                    continue
                grown = True
                wider = Strip.of(self.contact.flank, frame, self.approaches[k])
                strips[k], start[k] = wider, wider.taken(strip, tooth.force)
            if not grown:
                return strips, found
        raise ConvergenceError("the pressures of the teeth find no bounds on the flank")

    def solve(self, strips: list[Strip | None], start: list[FloatArray | None]) -> _Borne:
        """Return the forces of all patches, those of one tooth after the other."""
        owner = self.contact
        some = [(k, strip) for k, strip in enumerate(strips) if strip is not None]
        if not some:
            raise ConvergenceError("no tooth is near the worm")
        spaces = HalfSpaces(
            [HalfSpace(s.frame.shape, s.frame.spacing, owner.modulus) for _, s in some]
        )
        smooth = self._smooth([k for k, _ in some])
        # All teeth at once: on the first strips calls would cost more than what they compute.
        to_patches = sparse.block_diag([strip.nodes for _, strip in some], format="csr")
        to_nodes = to_patches.T.tocsr()

        def deflection(force: FloatArray) -> FloatArray:
            # Threads of BLAS cost more than they save here.
            moved = np.einsum("ij,j->i", smooth, to_nodes @ force)
            moved_to: FloatArray = spaces.deflection(force) + to_patches @ moved
            return moved_to

        gap = np.concatenate([s.gap + s.nodes @ self.rubbed[k] for k, s in some])
        arm = np.concatenate([s.arm for _, s in some])
        area = np.concatenate([s.area for _, s in some])
        inside = np.concatenate([s.inside for _, s in some])
        begun = [
            _guess(strip) if first is None else first
            for (_, strip), first in ((pair, start[pair[0]]) for pair in some)
        ]
        most = np.where(inside, (np.inf if owner.cap is None else owner.cap) * area, 0.0)
        found = bear(
            gap, deflection, arm, self.moment, most=most, start=np.concatenate(begun)
        )  # fmt: skip
        sunk = np.einsum("i,i->", found.force, spaces.deflection(found.force))
        return _Borne(**vars(found), sink=float(sunk) / self.moment)

    def _smooth(self, teeth: list[int]) -> FloatArray:
        """What teeth give each other and themselves at their nodes, (K n, K n), m/N."""
        blocks = self.contact.flank.smooth
        rows = []
        for k in teeth:
            row = []
            for j in teeth:
                way = int(self.order[k] - self.order[j])
                if abs(way) >= len(blocks):
                    row.append(np.zeros_like(blocks[0]))
                else:
                    row.append(blocks[way] if way >= 0 else blocks[-way].T)
            rows.append(np.hstack(row))
        return np.vstack(rows)


def _guess(strip: Strip) -> FloatArray:
    return np.where(strip.inside & (strip.gap < strip.gap.min() + 1e-6), strip.area, 0.0)


def _response(
    flexibility: FloatArray, blocks: FloatArray, order: IntArray, force: FloatArray
) -> FloatArray:
    """Displacement of the nodes of all teeth under nodal forces (K, 3n), shape (K, n, 3), m."""
    moved = np.zeros_like(force)
    for k in range(len(order)):
        for j in np.flatnonzero(force.any(axis=1)):
            way = int(order[k] - order[j])
            if abs(way) <= len(blocks):
                block = flexibility if way == 0 else blocks[abs(way) - 1]
                sums = "ij,j->i" if way >= 0 else "ji,j->i"
                moved[k] += np.einsum(sums, block, force[j])
    return moved.reshape(len(order), -1, 3)

r"""Stress at the fillets of a loaded tooth, from the forces of the condensed contact.

Three teeth on their rim, whose inside is held or moves as its web lets it, are meshed anew with
27-node hexahedra, their nodes on the exact fillets. The forces on the flank of a tooth and on those
beside it, from the loaded contact, are given to the nodes about where they act. Nothing presses
on a fillet, so that what its surface is strained by says all of its stress. That is found at the
2 x 2 points of Gauss of its faces, where quadratic elements are best, and carried on to its nodes;
what faces that share a node differ by tells how far the mesh can be trusted.
"""

from __future__ import annotations

import dataclasses
import math
from functools import cached_property

import numpy as np

from asperity.arrays import FloatArray, IntArray
from asperity.contact.elastic import ElasticMaterial, elastic_body
from asperity.contact.elastic.body import ElasticBody
from asperity.contact.interface.surface import ContactSurface, contact_surface
from asperity.drive.teeth.rim_moves import MovingRim
from asperity.drive.teeth.sector import DENSITY, RIM, lattice
from asperity.flanks.mesh.section import flank_shares
from asperity.flanks.mesh.tooth import Counts, tooth
from asperity.flanks.wheel.enveloped import Wheel
from asperity.flanks.wheel.frame import turned
from asperity.gearset.materials import Material
from asperity.mesh import HexMesh
from asperity.mesh.shape import REFERENCE_FACE_NODES, face_shapes, gauss

COUNTS = Counts(flank=12, face=10, thickness=8, rim=4, land=2, low_fillet=4, high_fillet=4)
"""Hexahedra of a tooth.

Along the flank they are as long as those of the contact in the mean, and shorter towards its foot.
Twice as long ones spread a force at its foot, and the fillet's stress then is 3 % less.
"""

COARSER = COUNTS._replace(thickness=6)
"""Of another mesh, by which that of `COUNTS` is judged: coarser where the stress varies most."""

GRADING = 2.0
"""How much thinner hexahedra are towards the fillets: a thirtieth of the tooth.

A fillet's radius is a few tenths of a module; evenly thick hexahedra tell half of its stress.
"""

TEETH = 3
"""Without those beside it, over whose roots the stress goes on, a tooth has half the stress."""

_NODES = 9  # of a face
_PAIRS = ((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0))
_SIDES = ("fillet_plus", "fillet_minus")
# Points of Gauss a direction on a face of a flank, over which tractions go up and down.
_RULE = 8


@dataclasses.dataclass(frozen=True, eq=False)
class Fillet:
    """The nodes of a fillet with the root beside it, of the middle tooth.

    They are in rows over the face, the first row at the foot of the flank, the last in the middle
    of the tooth space.
    """

    nodes: IntArray  #: (f,): In the mesh
    grid: IntArray  #: (rows, columns): Their numbers among ``nodes``
    places: FloatArray  #: (f, 3): In the tooth's own frame, m
    faces: IntArray  #: (m, 9): Nodes of its faces, in the mesh


@dataclasses.dataclass(frozen=True, eq=False)
class Roots:
    """Stresses at both fillets under some loads; a row a load."""

    #: (q, f, 6) each: Its xx, yy, zz, xy, yz, zx at the loaded fillet and the other, Pa
    stress: tuple[FloatArray, FloatArray]
    jump: tuple[FloatArray, FloatArray]  #: (q, f): What elements differ by at a node, Pa
    residual: float = 0.0  #: Largest of the loads, over their forces

    def principal(self, side: int) -> FloatArray:
        """Return the principal stresses at a fillet, 0 loaded, 1 other, (q, f, 3), rising, Pa."""
        xx, yy, zz, xy, yz, zx = np.moveaxis(self.stress[side], -1, 0)
        matrix = np.stack(
            [np.stack(row, -1) for row in ((xx, xy, zx), (xy, yy, yz), (zx, yz, zz))], -2
        )
        return np.linalg.eigvalsh(matrix)


class RootModel:
    """Three teeth with fine fillets, held at the inside of their rim.

    Parameters
    ----------
    wheel : Wheel
        Right-handed, as it is cut.
    material : Material
        What it is made of.
    counts : Counts
        Hexahedra of a tooth.
    teeth : int
        Of them the middle one is looked at; an odd number.
    grading : float
        As `GRADING`.

    Raises
    ------
    InputError
        The rim leaves no valid elements, or the mesh does not fit into the memory.
    """

    def __init__(
        self,
        wheel: Wheel,
        material: Material,
        counts: Counts = COUNTS,
        teeth: int = TEETH,
        grading: float = GRADING,
    ) -> None:
        self.counts, self.teeth, self.grading = counts, teeth, grading
        self.pitch = 2.0 * math.pi / wheel.pair.geometry.wheel_teeth
        self.material = ElasticMaterial(material.youngs_modulus, material.poisson_ratio, DENSITY)
        made = tooth(wheel, counts, teeth=teeth, order=2, grading=grading)
        self.mesh: HexMesh = made.converted("m")

    @cached_property
    def body(self) -> ElasticBody:
        """The teeth, factorised when they are first loaded."""
        return elastic_body(self.mesh, self.material, tied=RIM)

    @property
    def unknowns(self) -> int:
        """Displacements of its nodes."""
        return 3 * len(self.mesh.points)

    def _turn(self, place: int) -> FloatArray:
        """What turns a tooth's own frame to its place in the mesh."""
        return turned(place * self.pitch)

    @cached_property
    def _flanks(self) -> list[ContactSurface]:
        """The loaded flanks of all teeth."""
        one = self.teeth == 1
        names = ["flank_plus"] if one else [f"flank_plus_{k}" for k in range(self.teeth)]
        return [contact_surface(self.mesh, name, _RULE) for name in names]

    @cached_property
    def fillets(self) -> tuple[Fillet, Fillet]:
        """Those of the middle tooth: of its loaded flank, and of the other."""
        loaded, other = (self._fillet(name) for name in _SIDES)
        return loaded, other

    def _fillet(self, name: str) -> Fillet:
        middle = self.teeth // 2
        faces = self.mesh.face_sets[name]
        one = len(self.mesh.cells) // self.teeth
        faces = faces[faces[:, 0] // one == middle]
        of_faces = self.mesh.face_nodes(faces)
        nodes = np.unique(of_faces)
        places = self.mesh.points[nodes] @ self._turn(middle)
        face, angle = np.round(places[:, 2], 9), np.abs(np.arctan2(places[:, 0], places[:, 1]))
        grid = np.lexsort((angle, face)).reshape(len(np.unique(face)), -1).T
        return Fillet(nodes, grid, places, of_faces)

    def nodal(self, surface: ContactSurface, forces: FloatArray) -> FloatArray:
        """Return the nodal forces of the mesh, (3N,), of those on the teeth's flanks.

        Parameters
        ----------
        surface : ContactSurface
            The flank of a tooth in its own frame, n nodes.
        forces : ndarray, shape (k, n, 3)
            On an odd number of teeth in the order of the mesh, the looked at one in the middle,
            each in its own frame, N; on those that the mesh does not have they are left out.
        """
        nodes = lattice(surface)
        rows, columns = nodes.shape
        z_own = surface.positions[nodes[0], 2]
        beside = (len(forces) - self.teeth) // 2
        tractions = forces[beside : beside + self.teeth] / surface.nodal_area[:, None]
        out = np.zeros((len(self.mesh.points), 3))
        for place, (fine, own) in enumerate(zip(self._flanks, tractions, strict=True)):
            # The other mesh has its rows at equal shares of the way from the fillet to the tip.
            grid = lattice(dataclasses.replace(fine, positions=fine.positions @ self._turn(place)))
            share = np.empty(grid.size)
            own_rows = flank_shares(self.counts.flank, 2, self.grading)
            share[grid] = (rows - 1.0) * own_rows[:, None]
            u, z = fine.to_points(share), fine.to_points(fine.positions[:, 2])
            i = np.clip(u.astype(np.int64), 0, rows - 2)
            j = np.clip(np.searchsorted(z_own, z, side="right") - 1, 0, columns - 2)
            v = np.clip((z - z_own[j]) / (z_own[j + 1] - z_own[j]), 0.0, 1.0)
            u = u - i
            field = np.zeros((*u.shape, 3))
            for a, b in ((0, 0), (0, 1), (1, 0), (1, 1)):
                weight = (u if a else 1.0 - u) * (v if b else 1.0 - v)
                field += weight[..., None] * own[nodes[i + a, j + b]]
            out[fine.nodes] += fine.to_forces(field @ self._turn(place).T)
        return out.reshape(-1)

    def on_web(self, rim: MovingRim, forces: FloatArray) -> FloatArray:
        """Return how the rim's inside moves on a web, (3N,), m.

        Parameters
        ----------
        rim : MovingRim
            Of the wheel.
        forces : ndarray, shape (k, n, 3)
            On teeth as of `nodal`, on the nodes that the rim knows, N.
        """
        turn, tied = self._turn(self.teeth // 2), self.body.tied
        at = {k - len(forces) // 2: each for k, each in enumerate(forces)}
        found = np.zeros((len(self.mesh.points), 3))
        found[tied] = rim.at(self.mesh.points[tied] @ turn, at) @ turn.T
        return found.reshape(-1)

    def solve(self, loads: FloatArray, held: FloatArray | None = None) -> Roots:
        """Return the stresses at both fillets under nodal forces, (3N, q), N.

        ``held`` is the displacement of the rim's inside, (3N, q), m, 0 elsewhere; left out it
        stands still.
        """
        held = np.zeros_like(loads) if held is None else held
        moved = self.body.carried(loads, held)
        found = [self.stress(fillet, moved) for fillet in self.fillets]
        residual = self.body.residual(loads, moved)
        return Roots((found[0][0], found[1][0]), (found[0][1], found[1][1]), residual)

    def stress(self, fillet: Fillet, moved: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the stress at the nodes of a fillet, (q, f, 6), and what elements differ by."""
        places, of = self.mesh.points[fillet.faces], np.searchsorted(fillet.nodes, fillet.faces)
        at, _ = gauss(2, 2)
        _, slopes = face_shapes(at, _NODES)
        _, ends = face_shapes(REFERENCE_FACE_NODES, _NODES)
        # Linear through the points of Gauss, as far as the nodes.
        out, _ = face_shapes(REFERENCE_FACE_NODES * math.sqrt(3.0), 4)
        points, _ = face_shapes(at * math.sqrt(3.0), 4)
        carried = out @ np.linalg.inv(points)
        along = np.einsum("qnj,mni->mqji", slopes, places)
        axes, nodal_axes = _axes(along), _axes(np.einsum("qnj,mni->mqji", ends, places))
        back = np.linalg.inv(np.einsum("mqji,mqai->mqja", along, axes))
        first, second = self.material.lame
        # Of a surface that nothing presses on.
        evenly = 2.0 * first * second / (first + 2.0 * second)
        loads = moved.shape[1]
        stress = np.zeros((loads, len(fillet.nodes), 6))
        jump = np.zeros((loads, len(fillet.nodes)))
        count = np.bincount(of.ravel(), minlength=len(fillet.nodes))
        for q in range(loads):
            u = moved[:, q].reshape(-1, 3)[fillet.faces]
            slope = back @ np.einsum("qnj,mni->mqji", slopes, u)
            strain = np.einsum("mqai,mqbi->mqab", slope, axes)
            trace = np.trace(strain, axis1=2, axis2=3)[..., None, None]
            own = second * (strain + strain.swapaxes(2, 3)) + evenly * trace * np.eye(2)
            at_nodes = np.einsum("nq,mqab->mnab", carried, own)
            whole = np.einsum("mnai,mnab,mnbj->mnij", nodal_axes, at_nodes, nodal_axes)
            values = np.stack([whole[..., i, j] for i, j in _PAIRS], axis=-1)
            np.add.at(stress[q], of, values)
            stress[q] /= count[:, None]
            np.maximum.at(jump[q], of, np.abs(values - stress[q][of]).max(axis=-1))
        return stress, jump


def _axes(along: FloatArray) -> FloatArray:
    """Unit vectors in a surface, (..., 2, 3), of tangents to it: along the first, and across."""
    normal = np.cross(along[..., 0, :], along[..., 1, :])
    pair = np.stack([along[..., 0, :], np.cross(normal, along[..., 0, :])], axis=-2)
    return np.asarray(pair / np.linalg.norm(pair, axis=-1, keepdims=True))

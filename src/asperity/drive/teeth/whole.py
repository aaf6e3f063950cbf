r"""A whole wheel by one of its teeth: rim, web and hub, by cyclic symmetry.

A sector of some teeth has free cut faces: on a thick rim, or on a web, it is a cantilever. A whole
wheel is :math:`N` equal teeth in a ring. What one tooth is loaded by is a sum of loads that turn
round the wheel, :math:`\mathbf f_j = \frac 1N \sum_n \mathbf f e^{i j \theta_n}` with
:math:`\theta_n = 2\pi n/N`, and under each of them all teeth move alike but for the phase: the two
cut faces of a tooth are tied by

.. math:: \mathbf u_+ = e^{i\theta_n}\,\mathbf R\,\mathbf u_- ,

:math:`\mathbf R` turning by a pitch (D. L. Thomas, Dynamics of rotationally periodic structures,
Int. J. Numer. Meth. Eng. 14, 1979, 81-102). One tooth with its part of rim and web is condensed to
its flank and its cut faces; the rest is small dense systems, one for each :math:`n`.

The web is a disc as wide as `WheelBody.web_width`, in mid-face, from the inside of the rim down to
the hub, which holds it: what hub and shaft give is not in it.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable
from typing import Self

import numpy as np

from asperity.arrays import FloatArray, IntArray
from asperity.contact.elastic import ElasticMaterial
from asperity.contact.elastic.assembly import stiffness_matrix
from asperity.contact.elastic.body import freedoms_of
from asperity.contact.elastic.solver import factorise
from asperity.contact.interface.surface import ContactSurface
from asperity.flanks.wheel.frame import turned
from asperity.gearset.blanks import WheelBody, rim_radius
from asperity.gearset.geometry import Geometry
from asperity.kernels.closure import source_key
from asperity.mesh import HexMesh
from asperity.runs.cache import Cache
from asperity.runs.key import key

FURTHER = 4
"""Teeth further about the axis whose displacement under forces on one is returned."""

_LAYERS = 6
_SAME = 1e-6  # mm
# Of how much a corner of a hexahedron lies along, outwards and over the face.
_CORNERS = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))


def with_web(one: HexMesh, body: WheelBody, geometry: Geometry) -> tuple[HexMesh, IntArray]:
    """Return a tooth with its part of the web below, and the nodes that the hub holds.

    The tooth's own nodes keep their numbers. The web begins at the columns of the rim's inside that
    are nearest to its width, and is as wide as it is from its second layer on.
    """
    inside = one.node_sets["inner"]
    inner = rim_radius(geometry)
    if body.hub_radius >= inner - _SAME:
        return one, inside
    x, y, z = one.points[inside].T
    angle = np.arctan2(x, y)
    columns = np.unique(np.round(z, 6))
    top = inside[np.lexsort((angle, np.round(z, 6)))].reshape(len(columns), -1).T
    half = 0.5 * body.web_width
    wanted = np.abs(columns) <= half + 0.5 * np.diff(columns).max()
    # At least two elements wide, and as many on both sides.
    middle = np.sort(np.argsort(np.abs(columns), kind="stable")[: 2 + len(columns) % 2])
    wanted[middle[0] : middle[-1] + 1] = True
    top, at = top[:, wanted], columns[wanted]
    places = at * half / at[-1]
    turn = np.arctan2(*one.points[top][..., :2].transpose(2, 0, 1))
    radii = np.linspace(inner, body.hub_radius, _LAYERS + 1)[1:]
    radius, first, over = np.broadcast_arrays(radii[:, None, None], turn, places)
    made = np.stack([radius * np.sin(first), radius * np.cos(first), over], axis=-1)
    numbers = len(one.points) + np.arange(made[..., 0].size).reshape(made.shape[:3])
    # By place along, outwards and over the face.
    lattice = np.concatenate([top[None], numbers])[::-1].transpose(1, 0, 2)
    count = [size - 1 for size in lattice.shape]
    low = np.stack(np.meshgrid(*(np.arange(n) for n in count), indexing="ij"), -1).reshape(-1, 1, 3)
    corner = low + np.array(_CORNERS)
    cells = lattice[corner[..., 0], corner[..., 1], corner[..., 2]]
    sets = {
        "cut_minus": np.union1d(one.node_sets["cut_minus"], lattice[0]),
        "cut_plus": np.union1d(one.node_sets["cut_plus"], lattice[-1]),
    }
    mesh = HexMesh(
        np.concatenate([one.points, made.reshape(-1, 3)]), np.concatenate([one.cells, cells]),
        sets, {}, one.unit,
    )  # fmt: skip
    return mesh, lattice[:, 0].ravel()


@dataclasses.dataclass(frozen=True, eq=False)
class Ring:
    """Equal teeth in a ring, each condensed to its flank and its cut faces.

    Attributes
    ----------
    teeth : int
        Of the wheel.
    stiffness : ndarray, shape (f + 2 c, f + 2 c)
        Of a tooth at the freedoms of its flank, its first cut and its second, N/m.
    flank : int
        Freedoms of the flank.
    """

    teeth: int
    stiffness: FloatArray
    flank: int

    @classmethod
    def of(
        cls, mesh: HexMesh, held: IntArray, flank: IntArray, material: ElasticMaterial, teeth: int
    ) -> Self:
        """Condense a tooth.

        Parameters
        ----------
        mesh : HexMesh
            With node sets ``cut_minus`` and ``cut_plus``, the one turned by a pitch on the other.
        held : ndarray of int
            Nodes that stand still.
        flank : ndarray of int
            Nodes that are loaded.
        material : ElasticMaterial
            What it is made of.
        teeth : int
            Of the wheel.
        """
        first, second = _paired(mesh, turned(2.0 * math.pi / teeth))
        free = ~np.isin(first, held)
        first, second = first[free], second[free]
        outer = freedoms_of(np.concatenate([flank, first, second]))
        kept = np.ones(3 * len(mesh.points), dtype=bool)
        kept[freedoms_of(held)] = False
        kept[outer] = False
        inner = np.flatnonzero(kept)
        whole = stiffness_matrix(mesh.converted("m"), material, "hex8i")
        rows = whole[inner]
        between = rows[:, outer].toarray()
        own = factorise(rows[:, inner])
        left = whole[outer][:, outer].toarray() - between.T @ own.solve(between)
        return cls(teeth, 0.5 * (left + left.T), 3 * len(flank))

    def under(self, order: int) -> FloatArray:
        """Return the flank's flexibility under a load that turns so many times, (f, f), complex."""
        angle = 2.0 * math.pi * order / self.teeth
        cut = (len(self.stiffness) - self.flank) // 2
        tied = np.kron(np.eye(cut // 3), turned(2.0 * math.pi / self.teeth)) * np.exp(1j * angle)
        f, one, two = (
            slice(0, self.flank), slice(self.flank, self.flank + cut),
            slice(self.flank + cut, None),
        )  # fmt: skip
        k, back = self.stiffness, tied.conj().T
        across = k[f, one] + k[f, two] @ tied
        faces = k[one, one] + k[one, two] @ tied + back @ k[two, one] + back @ k[two, two] @ tied
        return np.asarray(np.linalg.inv(k[f, f] - across @ np.linalg.solve(faces, across.conj().T)))

    def blocks(self, further: int = FURTHER) -> list[FloatArray]:
        """Return the displacement of the teeth 0, 1 .. pitches further about +Z, (f, f), m/N.

        Under forces on one tooth, each tooth in its own frame.
        """
        found = [np.zeros((self.flank, self.flank)) for _ in range(further + 1)]
        for order in range(self.teeth // 2 + 1):
            part = self.under(order)
            # Orders n and N - n are each other's conjugates.
            twice = 1.0 if order in (0, self.teeth / 2) else 2.0
            for m, block in enumerate(found):
                # The mesh's teeth follow one another about -Z.
                turn = np.exp(-2j * math.pi * m * order / self.teeth)
                block += twice / self.teeth * (turn * part).real
        found[0] = 0.5 * (found[0] + found[0].T)
        return found


def _paired(mesh: HexMesh, turn: FloatArray) -> tuple[IntArray, IntArray]:
    """Nodes of the first cut, and those of the second that they are turned on by a pitch."""
    from scipy.spatial import KDTree

    first, second = mesh.node_sets["cut_minus"], mesh.node_sets["cut_plus"]
    _, at = KDTree(mesh.points[second]).query(mesh.points[first] @ turn.T)
    return first, second[at]


def whole_wheel(
    one: HexMesh,
    surface: ContactSurface,
    body: WheelBody,
    geometry: Geometry,
    material: ElasticMaterial,
    notify: Callable[[str], None] | None = None,
) -> list[FloatArray]:
    """Return `Ring.blocks` of a wheel, or find them among those that are kept.

    Parameters
    ----------
    one : HexMesh
        A tooth with its rim, in its own frame.
    surface : ContactSurface
        Its flank.
    body : WheelBody
        Web and hub.
    geometry : Geometry
        Of the gearset.
    material : ElasticMaterial
        What it is made of.
    notify : callable, optional
        Takes one line about a kept file that is damaged.
    """
    mesh, held = with_web(one, body, geometry)
    return kept_blocks(mesh, held, surface.nodes, material, geometry.wheel_teeth, notify)


def kept_blocks(
    mesh: HexMesh,
    held: IntArray,
    loaded: IntArray,
    material: ElasticMaterial,
    teeth: int,
    notify: Callable[[str], None] | None = None,
) -> list[FloatArray]:
    """Return `Ring.blocks`, or find them among those that are kept; parameters as of `Ring.of`."""
    cache = Cache.of_this_user("condensed", notify)
    name = key(
        source_key("asperity.contact.elastic"), source_key(__name__), mesh.points, mesh.cells,
        held, loaded, repr((material, teeth, FURTHER)),
    )  # fmt: skip
    kept = cache.get(name)
    if kept is not None:
        return list(np.asarray(kept["blocks"]))
    found = Ring.of(mesh, held, loaded, material, teeth).blocks()
    cache.put(name, {"blocks": np.array(found)})
    return found

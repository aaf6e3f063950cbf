r"""A sector of the wheel condensed to the flanks of its middle teeth.

A tooth cut out of the wheel is far too soft, since the rim under it is a cantilever. So several
teeth are condensed on one rim, whose inside is held, and the middle one serves for all: a tooth
:math:`m` is the middle one turned about the wheel's axis by :math:`m` pitches. What a loaded tooth
does to its neighbours goes through the rim and is small and smooth: it is taken from the coarse
mesh for all densities. So is what rim, web and hub give of a whole wheel
(`asperity.drive.teeth.whole`), where they count.

Lengths are in m. A tooth's own frame is the wheel's, with the tooth about +Y.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from scipy import sparse

from asperity.arrays import FloatArray, IntArray
from asperity.contact.candidates.records import Body
from asperity.contact.elastic import CondensedBody, ElasticMaterial, condense
from asperity.contact.interface.surface import ContactSurface, contact_surface
from asperity.drive.teeth.rim_moves import MovingRim
from asperity.drive.teeth.whole import whole_wheel
from asperity.errors import InputError
from asperity.flanks.mesh.tooth import Counts, contact_counts, tooth
from asperity.flanks.wheel.enveloped import Wheel
from asperity.flanks.wheel.flank import FlankGrid
from asperity.flanks.wheel.frame import turned
from asperity.gearset.blanks import WheelBody
from asperity.gearset.materials import WheelMaterial
from asperity.mesh import HexMesh

_MILLIMETRES = 1e3
_COARSE = "coarse"
_LOADED = "loaded"

ELEMENT, RIM = "hex8i", "inner"
"""Finite elements of the teeth, and where they are held."""

DENSITY = 7500.0
"""kg/m3, about that of bronze and iron; nothing here has inertia."""


@dataclasses.dataclass(frozen=True, eq=False)
class Sector:
    """The middle tooth of a sector, ready for contact."""

    wheel: Wheel
    density: str  #: By name
    counts: Counts  #: Hexahedra of a tooth
    teeth: int  #: Teeth on the condensed rim
    surface: ContactSurface  #: Flank ``s = +1`` of the middle tooth, in its own frame
    body: Body  #: As the kernels take it, its points on the exact flank
    #: Exact flank about the points, and each point's row and column in it
    exact_grid: tuple[FlankGrid, IntArray, IntArray]
    #: Displacement of the teeth 1, 2 .. pitches further about +Z under forces on this one, each in
    #: its own frame, (3n, 3n) each, m/N; none for one tooth alone
    neighbours: tuple[FloatArray, ...]
    seconds: float  #: What condensing took, s
    residual: float  #: Of its solutions

    @property
    def pitch(self) -> float:
        """Angle between teeth, rad."""
        return 2.0 * math.pi / self.wheel.pair.geometry.wheel_teeth

    @property
    def mesh(self) -> HexMesh:
        """The sector's hexahedra, its middle tooth about +Y, in mm."""
        mesh = tooth(right_handed(self.wheel), self.counts, teeth=self.teeth)
        return mesh.transformed(_middle(self.wheel, self.teeth).T)

    @property
    def mean_compliance(self) -> float:
        """Mean deflection along the normal under a force spread evenly over the flank, m/N."""
        force = self.surface.to_forces(self.surface.normals / self.surface.area).reshape(-1)
        return float(force @ self.body.flexibility @ force)


def sector(
    wheel: Wheel,
    material: WheelMaterial,
    *,
    density: str = _COARSE,
    teeth: int = 5,
    body: WheelBody | None = None,
    notify: Callable[[str], None] | None = None,
) -> Sector:
    """Condense a sector of the wheel, or find it among those that are kept.

    Parameters
    ----------
    wheel : Wheel
        The cut wheel.
    material : WheelMaterial
        What it is made of.
    density : {'coarse', 'intermediate', 'fine'}
        Of the flank.
    teeth : int
        Teeth on the rim, an odd number; the middle one serves for all.
    body : WheelBody, optional
        Web and hub that the rim of the whole wheel stands on; left out: its inside is held.
    notify : callable, optional
        Takes one line about a kept file that is damaged.

    Raises
    ------
    InputError
        There is no such density or sector, or it does not fit into this machine's memory.
    """
    if teeth < 1 or teeth % 2 == 0:
        raise InputError(f"drive.teeth is {teeth}; it must be odd: there is a middle tooth")
    counts = contact_counts(density)
    made = _whole if body is not None else _on_held_rim
    middle, neighbours, seconds, residual = made(wheel, material, counts, teeth, body, notify)
    surface = _own_surface(wheel, counts)
    grid, row, column = exact = _exact(wheel, surface)
    # Between the nodes of a coarse mesh its faces lie micrometres off the flank, as much as it
    # gives way under load: contact is looked for on the flank itself.
    places = np.ascontiguousarray(grid.points[row, column]) / _MILLIMETRES
    points = Body.of(surface, middle)._replace(places=places)
    return Sector(
        wheel, density, counts, teeth, surface, points, exact, neighbours, seconds,
        residual,
    )  # fmt: skip


class _Blocks(NamedTuple):
    """Flexibility of the middle tooth, and what it does to those 1, 2 .. pitches further."""

    own: FloatArray
    neighbours: tuple[FloatArray, ...]
    seconds: float = 0.0
    residual: float = 0.0


def _on_held_rim(
    wheel: Wheel,
    material: WheelMaterial,
    counts: Counts,
    teeth: int,
    _body: WheelBody | None = None,
    notify: Callable[[str], None] | None = None,
) -> _Blocks:
    # One tooth has no neighbours; the others have theirs from the coarse mesh.
    coarse = contact_counts(_COARSE)
    together = counts == coarse
    found = _condensed(wheel, material, counts, teeth, together, notify)
    surface = _own_surface(wheel, counts)
    size = len(surface.positions)
    turn = _middle(wheel, teeth)
    middle = _block(found, teeth, size, 0, 0, together, turn, turn)
    if teeth == 1:
        return _Blocks(middle, (), found.seconds, found.residual)
    if not together:
        rim = _on_held_rim(wheel, material, coarse, teeth, None, notify)
        to = _to_finer(wheel, coarse, surface)
        neighbours = tuple(_taken(to, block) for block in rim.neighbours)
        seconds, residual = found.seconds + rim.seconds, max(found.residual, rim.residual)
        return _Blocks(middle, neighbours, seconds, residual)
    pitch = 2.0 * math.pi / wheel.pair.geometry.wheel_teeth
    # In the mesh teeth follow one another about -Z: the tooth before is further about +Z.
    turns = {k: turn @ turned(-k * pitch) for k in (-1, 0, 1)}
    neighbours = tuple(
        _block(found, teeth, size, row, column, True, turns[row], turns[column])
        for row, column in ((1, 0), (1, -1))
    )
    return _Blocks(middle, neighbours, found.seconds, found.residual)


def _whole(
    wheel: Wheel,
    material: WheelMaterial,
    counts: Counts,
    teeth: int,
    body: WheelBody | None,
    notify: Callable[[str], None] | None = None,
) -> _Blocks:
    """The same of a whole wheel; a finer tooth is that of the sector, on the coarse one's wheel."""
    assert body is not None
    coarse = contact_counts(_COARSE)
    one, surface = own_mesh(wheel, coarse), _own_surface(wheel, coarse)
    elastic = ElasticMaterial(material.youngs_modulus, material.poisson_ratio, DENSITY)
    own, *further = whole_wheel(one, surface, body, wheel.pair.geometry, elastic, notify)
    if counts == coarse:
        return _Blocks(own, tuple(further))
    held = _on_held_rim(wheel, material, coarse, teeth, None, notify)
    found = _on_held_rim(wheel, material, counts, teeth, None, notify)
    to = _to_finer(wheel, coarse, _own_surface(wheel, counts))
    middle = found.own + _taken(to, own - held.own)
    neighbours = tuple(_taken(to, block) for block in further)
    return _Blocks(middle, neighbours, found.seconds, found.residual)


def moving_rim(
    sector: Sector,
    material: WheelMaterial,
    body: WheelBody,
    notify: Callable[[str], None] | None = None,
) -> MovingRim:
    """Return how the rim's inside moves on a web under forces on the flanks of the coarse mesh."""
    wheel, coarse = sector.wheel, contact_counts(_COARSE)
    elastic = ElasticMaterial(material.youngs_modulus, material.poisson_ratio, DENSITY)
    one, surface = own_mesh(wheel, coarse), _own_surface(wheel, coarse)
    return MovingRim.of(one, surface, body, wheel.pair.geometry, elastic, notify)


def on_coarse(sector: Sector, forces: FloatArray) -> FloatArray:
    """Return forces on the nodes of a flank, (..., n, 3), N, as they are on the coarse mesh's."""
    coarse = contact_counts(_COARSE)
    if sector.counts == coarse:
        return forces
    between = _interpolation(_own_surface(sector.wheel, coarse), sector.surface)
    return np.asarray(np.einsum("nm,...ni->...mi", between.toarray(), forces))


def _to_finer(wheel: Wheel, coarse: Counts, surface: ContactSurface) -> sparse.csr_array:
    between = _interpolation(_own_surface(wheel, coarse), surface)
    return sparse.csr_array(sparse.kron(between, sparse.eye_array(3), format="csr"))


def _taken(to: sparse.csr_array, block: FloatArray) -> FloatArray:
    """A block of the coarse flank at the nodes of a finer one."""
    return np.ascontiguousarray(to @ (to @ block.T).T)


def right_handed(wheel: Wheel) -> Wheel:
    """Everything is solved in the frame of the right-handed gearset."""
    return dataclasses.replace(wheel, pair=dataclasses.replace(wheel.pair, hand="right"))


def _middle(wheel: Wheel, teeth: int) -> FloatArray:
    """What turns a tooth's own frame to that of the middle tooth of a mesh of so many."""
    return turned((teeth // 2) * 2.0 * math.pi / wheel.pair.geometry.wheel_teeth)


def _flank(teeth: int, shift: int = 0) -> str:
    return "flank_plus" if teeth == 1 else f"flank_plus_{teeth // 2 + shift}"


def _condensed(
    wheel: Wheel,
    material: WheelMaterial,
    counts: Counts,
    teeth: int,
    neighbours: bool,
    notify: Callable[[str], None] | None,
) -> CondensedBody:
    mesh = tooth(right_handed(wheel), counts, teeth=teeth)
    shifts = (-1, 0, 1) if neighbours and teeth > 1 else (0,)
    faces = np.concatenate([mesh.face_sets[_flank(teeth, k)] for k in shifts])
    mesh = dataclasses.replace(mesh, face_sets={**mesh.face_sets, _LOADED: faces})
    elastic = ElasticMaterial(material.youngs_modulus, material.poisson_ratio, DENSITY)
    return condense(mesh, elastic, _LOADED, element=ELEMENT, tied=RIM, notify=notify)


def _own_surface(wheel: Wheel, counts: Counts) -> ContactSurface:
    """The middle tooth's flank in its own frame; that of a mesh of one tooth is the same."""
    return contact_surface(own_mesh(wheel, counts), _flank(1))


def own_mesh(wheel: Wheel, counts: Counts) -> HexMesh:
    """Return a tooth cut out with its rim, in its own frame, in mm."""
    return tooth(right_handed(wheel), counts)


def _exact(wheel: Wheel, surface: ContactSurface) -> tuple[FlankGrid, IntArray, IntArray]:
    """The exact flank about the quadrature points: a grid, and each point's row and column."""
    nodes = lattice(surface)
    rows = np.linspace(0.0, 1.0, len(nodes))
    share, z = np.empty(nodes.size), surface.positions[:, 2]
    share[nodes] = rows[:, None]
    at = np.stack([surface.to_points(share), surface.to_points(z)], axis=-1).reshape(-1, 2)
    shares, row = np.unique(np.round(at[:, 0], 12), return_inverse=True)
    places, column = np.unique(np.round(at[:, 1], 12), return_inverse=True)
    grid = wheel.flank(1).at_shares(shares, _MILLIMETRES * places)
    return grid, row, column


def _block(
    body: CondensedBody,
    teeth: int,
    size: int,
    row: int,
    column: int,
    neighbours: bool,
    row_turn: FloatArray,
    column_turn: FloatArray,
) -> FloatArray:
    """Displacement of one tooth under forces on another, each in its own frame.

    Teeth count from the middle one about +Z; the condensed body has them the other way round.
    """
    first = 1 if neighbours and teeth > 1 else 0
    rows, columns = (
        slice(3 * size * (first - k), 3 * size * (first - k + 1)) for k in (row, column)
    )
    block = body.flexibility[rows, columns].reshape(size, 3, size, 3)
    own = np.einsum("ca,mcnd,db->manb", row_turn, block, column_turn, optimize=True)
    return np.ascontiguousarray(own.reshape(3 * size, 3 * size))


def _interpolation(coarse: ContactSurface, fine: ContactSurface) -> sparse.csr_array:
    """Values at the nodes of a fine flank from those of a coarse one, bilinear over the flank."""
    rows: list[IntArray] = []
    columns: list[IntArray] = []
    values: list[FloatArray] = []
    grids = [lattice(surface) for surface in (coarse, fine)]
    shape, target = grids[0].shape, grids[1].shape
    places = [np.linspace(0.0, n - 1.0, m) for n, m in zip(shape, target, strict=True)]
    low = [np.minimum(p.astype(np.int64), n - 2) for p, n in zip(places, shape, strict=True)]
    share = [p - k for p, k in zip(places, low, strict=True)]
    for i in (0, 1):
        for j in (0, 1):
            weight = np.outer(share[0] if i else 1.0 - share[0], share[1] if j else 1.0 - share[1])
            rows.append(grids[1].reshape(-1))
            columns.append(grids[0][np.ix_(low[0] + i, low[1] + j)].reshape(-1))
            values.append(weight.reshape(-1))
    entries = np.concatenate(values), (np.concatenate(rows), np.concatenate(columns))
    size = len(fine.positions), len(coarse.positions)
    return sparse.csr_array(sparse.coo_array(entries, shape=size))


def lattice(surface: ContactSurface) -> IntArray:
    """Return the nodes of a flank by row, from the inside out, and by column over the face."""
    x, y, z = surface.positions.T
    order = np.lexsort((np.hypot(x, y), np.round(z, 9)))
    columns = len(np.unique(np.round(z, 9)))
    return np.asarray(order.reshape(columns, -1).T)

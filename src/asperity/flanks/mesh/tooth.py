"""Structured hexahedra of one wheel tooth, or of several, with fillets and rim."""

import math
from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from asperity.arrays import FloatArray, IntArray
from asperity.errors import InputError, one_of
from asperity.flanks.mesh.section import Blocks, fill, flank_shares
from asperity.flanks.wheel.enveloped import Wheel
from asperity.flanks.wheel.frame import on_cylinder, turned
from asperity.mesh import HexMesh
from asperity.mesh.shape import REFERENCE_NODES
from asperity.units import split_unit, to_si

_MILLIMETRES = 1e3

COARSE = 0.2
"""Size of a coarse element on the flank, in axial modules."""

DENSITIES: Mapping[str, float] = {"coarse": 1.0, "intermediate": 0.75, "fine": 0.5}
"""Element sizes by name, in coarse ones; thesis 7.4.2 and Table 7.4."""

CONTACT_FLANKS: Mapping[str, tuple[int, int]] = {
    "coarse": (11, 13),
    "intermediate": (15, 18),
    "fine": (23, 27),
}
"""Elements over the height and the face of a flank for a loaded contact, by density.

The contact lines run across the face at a slant: they are as well resolved as on elements that are
as long as high at a third of the unknowns.
"""

MEMORY = 2 * 1024**3
"""Memory that a mesh may take while it is made, bytes; a finer one is refused."""

# Twice what was measured per node while a mesh of 8-node elements is made.
_BYTES_PER_NODE = 400

# Least elements along half the root, the fillet below the tooth's block and the fillet beside it,
# and what these lengths are in modules of any gearset, for the numbers to follow the element size.
_LEAST = (2, 3, 2)
_LENGTHS = (0.6, 0.9, 0.6)
# Of a tooth whose flank is to touch: through its thickness, through the rim, land and fillets.
_COARSE_INSIDE = (4, 3, 2, 3, 2)
_FINE_INSIDE = (6, 4, 3, 4, 3)
# Elements are shorter over the face, where the section changes most: the volume of 8-node elements
# then is within 1e-4 at the intermediate density.
_OVER_FACE = 0.8


class Counts(NamedTuple):
    """Hexahedra of one tooth along its directions.

    ``land`` is along half the root, ``low_fillet`` and ``high_fillet`` along the fillet's parts
    below and beside the tooth's block.
    """

    flank: int
    face: int
    thickness: int
    rim: int
    land: int
    low_fillet: int
    high_fillet: int

    @property
    def elements(self) -> int:
        """Hexahedra of a tooth."""
        along = 2 * (self.land + self.low_fillet) + self.thickness
        return self.face * (self.thickness * (self.flank + self.high_fillet) + along * self.rim)

    def nodes(self, order: int) -> int:
        """Nodes of a tooth."""
        face, across = order * self.face + 1, order * self.thickness + 1
        along = 2 * order * (self.land + self.low_fillet) + across
        rows = order * (self.flank + self.high_fillet)
        return face * (across * rows + along * (order * self.rim + 1))


def read_density(text: str) -> str | float:
    """Return a density by its name, or an element size on the flank in mm from text."""
    if text in DENSITIES:
        return text
    if split_unit(text) is None:
        raise InputError(f"--density is {text!r}; {_expected(text)}")
    try:
        size = to_si(text, "m") * _MILLIMETRES
    except InputError as error:
        raise InputError(f"--density is {text!r}; {_expected(text)}: {error}") from None
    if not size > 0.0:
        raise InputError(f"--density is {text!r}; an element size must be positive")
    return size


def element_size(wheel: Wheel, density: str) -> float:
    """Return the element size of a named density, mm."""
    if density not in DENSITIES:
        raise InputError(f"density is {density!r}; {_expected(density)}")
    return COARSE * DENSITIES[density] * wheel.pair.geometry.axial_module


def _expected(text: str) -> str:
    return f"{one_of(DENSITIES, text)}, or an element size such as '0.5 mm'"


def flank_height(wheel: Wheel) -> float:
    """Return the height of a flank along its slant at mid-face, mm."""
    g = wheel.pair.geometry
    height = (g.wheel_throat_diameter - g.wheel_root_diameter) / 2.0 - g.clearance
    return height / math.cos(g.axial_pressure_angle)


def counts(wheel: Wheel, size: float) -> Counts:
    """Return how many hexahedra an element size on the flank makes of a tooth; size in mm."""
    g = wheel.pair.geometry
    slant = flank_height(wheel)
    thickness = math.pi * g.axial_module / 2.0

    def cells(length: float, least: int) -> int:
        return max(least, math.ceil(length / size - 1e-9))

    modules = zip(_LENGTHS, _LEAST, strict=True)
    land, low, high = (max(n, round(x * g.axial_module / size)) for x, n in modules)
    # Within the tooth and the rim stresses vary less than along the flank.
    return Counts(
        flank=cells(slant, 4),
        face=cells(g.wheel_face_width / _OVER_FACE, 6),
        thickness=cells(thickness / 1.5, 4),
        rim=cells(g.rim_thickness / 1.5, 3),
        land=land,
        low_fillet=low,
        high_fillet=high,
    )


def contact_counts(density: str) -> Counts:
    """Return the hexahedra of a tooth whose flank is to touch, by the density of its flank.

    Raises
    ------
    InputError
        There is no such density.
    """
    if density not in CONTACT_FLANKS:
        raise InputError(f"density is {density!r}; {one_of(CONTACT_FLANKS, density)}")
    flank, face = CONTACT_FLANKS[density]
    inner = _FINE_INSIDE if density == "fine" else _COARSE_INSIDE
    return Counts(flank, face, *inner)


def tooth(
    wheel: Wheel,
    size: float | str | Counts = "intermediate",
    *,
    teeth: int = 1,
    order: int = 1,
    memory: float = MEMORY,
    grading: float = 0.0,
) -> HexMesh:
    r"""Return a mesh of structured hexahedra of wheel teeth with fillets and rim, in mm.

    The nodes of the flanks, the fillets and the root lie on the exact surfaces, those of the tip on
    the blank. The first tooth is the one that stands in the worm's thread space at phase 0; each
    further tooth follows at the pitch angle of the side ``s = +1`` and shares its cut face, and a
    whole wheel closes on itself.

    Parameters
    ----------
    wheel : Wheel
        The cut wheel.
    size : float, {'coarse', 'intermediate', 'fine'} or Counts
        Element size on the flank, mm, a named density, or the numbers of elements themselves.
    teeth : int
        Number of teeth, 1 to that of the wheel.
    order : {1, 2}
        8 or 27 nodes a hexahedron.
    memory : float
        Bound on the memory, bytes.
    grading : float
        Above 0 hexahedra are thinner towards flanks, fillets and root, the outermost about
        :math:`2 g / \sinh 2 g` of the mean, and those of a flank shorter towards its foot
        (`flank_shares`).

    Returns
    -------
    HexMesh
        Face and node sets: ``flank_plus`` and ``flank_minus`` (``s = +1, -1``), ``fillet_plus``,
        ``fillet_minus`` (with the root), ``tip``, ``inner`` (the rim's inside), ``cut_minus`` and
        ``cut_plus`` (in the middle of the tooth spaces), ``face_low`` and ``face_high`` (the ends);
        with several teeth also ``flank_plus_0``, ``flank_plus_1`` ...

    Raises
    ------
    InputError
        A mesh beyond the memory bound, or a rim that leaves no valid elements.
    """
    most = wheel.pair.geometry.wheel_teeth
    if not 1 <= teeth <= most:
        raise InputError(f"teeth is {teeth}; the wheel has 1 to {most}")
    if order not in (1, 2):
        raise InputError(f"order is {order}; allowed: 1 (8 nodes), 2 (27 nodes)")
    number = _counted(wheel, size)
    _check_memory(number, teeth, order, memory)
    _check_rim(wheel)
    points, lattice = _numbered(_fill(wheel, number, order, grading))
    one = _one_tooth(points, lattice, number, order)
    worst = float(one.scaled_jacobian().min())
    if worst <= 0.0:
        raise InputError(
            f"elements of the mesh are turned inside out (least scaled Jacobian {worst:.2g}) under "
            f"a rim of {wheel.pair.geometry.rim_thickness:.4g} mm: take a larger "
            "gearset.rim_thickness or a smaller element size"
        )
    several = _repeated(one, lattice, teeth, most)
    return _named(several, wheel.pair.mirror)


def _counted(wheel: Wheel, size: float | str | Counts) -> Counts:
    if isinstance(size, Counts):
        if min(size) < 1:
            raise InputError(f"the numbers of elements are {tuple(size)}; each must be at least 1")
        return size
    length = element_size(wheel, size) if isinstance(size, str) else float(size)
    if not (math.isfinite(length) and length > 0.0):
        raise InputError(f"the element size is {length:g} mm; it must be positive")
    module = wheel.pair.geometry.axial_module
    if length > module:
        raise InputError(
            f"the element size is {length:.5g} mm; it must be at most the axial module of "
            f"{module:.5g} mm"
        )
    return counts(wheel, length)


def _check_rim(wheel: Wheel) -> None:
    g = wheel.pair.geometry
    most = 0.9 * g.wheel_root_diameter / 2.0
    if not 0.0 < g.rim_thickness <= most:
        raise InputError(
            f"gearset.rim_thickness is {g.rim_thickness:.5g} mm; the wheel's root radius of "
            f"{g.wheel_root_diameter / 2.0:.5g} mm has room for at most {most:.4g} mm: take less"
        )


def _check_memory(number: Counts, teeth: int, order: int, memory: float) -> None:
    needed = _BYTES_PER_NODE * number.nodes(order) * float(teeth)
    if needed > memory:
        raise InputError(
            f"the mesh would have {number.elements * teeth:.3g} elements and take "
            f"{needed / 2**30:.3g} GiB; at most {memory / 2**30:.3g} GiB is allowed: take a larger "
            "element size or fewer teeth"
        )


def _fill(wheel: Wheel, number: Counts, order: int, grading: float) -> tuple[Blocks, FloatArray]:
    """The blocks of every section, and where the sections are."""
    z = wheel.blank.columns(number.face + 1)
    if order == 2:
        middle = 0.5 * (z[1:] + z[:-1])
        z = np.sort(np.concatenate([z, middle]))
    outlines = []
    for side in (-1, 1):
        flank = wheel.flank(side)
        root = flank.root(order * number.land + 1, z)
        fillet = flank.fillet(order * (number.low_fillet + number.high_fillet) + 1, z)
        face = flank.at_shares(flank_shares(number.flank, order, grading), z)
        parts = [root, fillet, face]
        rows = [np.stack([part.radius, part.angle], axis=-1) for part in parts]
        outlines.append(np.concatenate([rows[0], rows[1][1:], rows[2][1:]]))
    g = wheel.pair.geometry
    blocks = fill(
        outlines[0],
        outlines[1],
        split=order * (number.land + number.low_fillet),
        across=order * number.thickness,
        layers=order * number.rim,
        inner=g.wheel_root_diameter / 2.0 - g.rim_thickness,
        grading=grading,
    )
    return blocks, z


class _Lattice(NamedTuple):
    """The nodes' numbers by place: along, outwards and over the face."""

    rim: IntArray
    tooth: IntArray


def _numbered(filled: tuple[Blocks, FloatArray]) -> tuple[FloatArray, _Lattice]:
    """Points of one tooth, x, y, z, and their numbers; the blocks share the tooth's base."""
    blocks, z = filled
    rim: IntArray = np.arange(blocks.rim[..., 0].size).reshape(*blocks.rim.shape[:3])
    upper = blocks.tooth[1:]
    tooth: IntArray = np.empty(blocks.tooth.shape[:3], dtype=np.int64)
    tooth[0] = rim[blocks.first : blocks.first + tooth.shape[1], -1, :]
    tooth[1:] = rim.size + np.arange(upper[..., 0].size).reshape(*upper.shape[:3])
    points = [
        on_cylinder(block[..., 0], block[..., 1], z).reshape(-1, 3) for block in (blocks.rim, upper)
    ]
    return np.concatenate(points), _Lattice(rim, tooth.transpose(1, 0, 2))


def _cells(ids: IntArray, order: int) -> tuple[IntArray, IntArray]:
    """Cells of a lattice of nodes, shape (m, 8 or 27), and their numbers by place."""
    offsets = (order * (REFERENCE_NODES[: 8 if order == 1 else 27] + 1) / 2).astype(np.int64)
    count = [(size - 1) // order for size in ids.shape]
    first = np.stack(np.meshgrid(*(order * np.arange(n) for n in count), indexing="ij"), axis=-1)
    at = first.reshape(-1, 1, 3) + offsets
    return ids[at[..., 0], at[..., 1], at[..., 2]], np.arange(len(at)).reshape(count)


def _faces(numbers: IntArray, local: int) -> IntArray:
    return np.column_stack([numbers.reshape(-1), np.full(numbers.size, local)])


def _one_tooth(points: FloatArray, lattice: _Lattice, number: Counts, order: int) -> HexMesh:
    rim, at_rim = _cells(lattice.rim, order)
    tooth, at_tooth = _cells(lattice.tooth, order)
    at_tooth = at_tooth + len(rim)
    base, high = number.land + number.low_fillet, number.high_fillet
    sets = {
        "flank_minus": _faces(at_tooth[0, high:], 0),
        "flank_plus": _faces(at_tooth[-1, high:], 1),
        "fillet_minus": np.concatenate(
            [_faces(at_rim[:base, -1], 3), _faces(at_tooth[0, :high], 0)]
        ),
        "fillet_plus": np.concatenate(
            [_faces(at_rim[-base:, -1], 3), _faces(at_tooth[-1, :high], 1)]
        ),
        "tip": _faces(at_tooth[:, -1], 3),
        "inner": _faces(at_rim[:, 0], 2),
        "cut_minus": _faces(at_rim[0], 0),
        "cut_plus": _faces(at_rim[-1], 1),
        "face_low": np.concatenate([_faces(at_rim[..., 0], 4), _faces(at_tooth[..., 0], 4)]),
        "face_high": np.concatenate([_faces(at_rim[..., -1], 5), _faces(at_tooth[..., -1], 5)]),
    }
    return HexMesh(points, np.concatenate([rim, tooth]), {}, sets, "mm")


def _repeated(one: HexMesh, lattice: _Lattice, teeth: int, most: int) -> HexMesh:
    """Return a tooth and those that follow it, joined at the cut faces."""
    if teeth == 1:
        return one
    nodes, cells = len(one.points), len(one.cells)
    low, high = lattice.rim[0].reshape(-1), lattice.rim[-1].reshape(-1)
    own = np.setdiff1d(np.arange(nodes), low)
    points = [one.points]
    maps = [np.arange(nodes)]
    for k in range(1, teeth):
        turn = turned(2.0 * math.pi * k / most)
        number = np.empty(nodes, dtype=np.int64)
        number[low] = maps[-1][high]
        mine = own
        if k == most - 1:
            # The last tooth of a whole wheel meets the first.
            number[high] = low
            mine = np.setdiff1d(own, high)
        number[mine] = sum(map(len, points)) + np.arange(len(mine))
        points.append(one.points[mine] @ turn.T)
        maps.append(number)
    whole = teeth == most
    sets = {}
    for name, faces in one.face_sets.items():
        wanted = range(teeth)
        if name.startswith("cut_"):
            wanted = (
                range(0) if whole else range(1) if name == "cut_minus" else range(teeth - 1, teeth)
            )
        parts = [faces + np.array([k * cells, 0]) for k in wanted]
        if parts:
            sets[name] = np.concatenate(parts)
        if name.startswith("flank_"):
            sets.update({f"{name}_{k}": part for k, part in enumerate(parts)})
    return HexMesh(
        np.concatenate(points), np.concatenate([m[one.cells] for m in maps]), {}, sets, one.unit
    )


def _named(mesh: HexMesh, mirror: int) -> HexMesh:
    """Return a mesh in the gearset's own frame, with node sets of its face sets."""
    own = mesh if mirror > 0 else mesh.transformed(np.diag([1.0, 1.0, -1.0]))
    sets = {name: np.unique(own.face_nodes(name)) for name in own.face_sets}
    return HexMesh(own.points, own.cells, sets, own.face_sets, own.unit)

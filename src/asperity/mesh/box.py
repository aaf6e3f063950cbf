"""A cuboid of equal hexahedra."""

from collections.abc import Sequence

import numpy as np

from asperity.errors import InputError
from asperity.mesh.hexmesh import HexMesh, Unit
from asperity.mesh.shape import REFERENCE_NODES

_MOST_ELEMENTS = 10_000_000


def box(
    size: Sequence[float], elements: Sequence[int], order: int = 1, *, unit: Unit = "m"
) -> HexMesh:
    """Return a cuboid of equal hexahedra that stands on the middle of its bottom face.

    It spans -size/2 to +size/2 in x and y, and 0 to size in z. Its faces are face sets and node
    sets: ``bottom`` (z = 0, the face that is in contact), ``top``, ``left`` (-x), ``right`` (+x),
    ``front`` (-y) and ``back`` (+y).

    Parameters
    ----------
    size : sequence of 3 float
        Edges along x, y and z, in `unit`; positive.
    elements : sequence of 3 int
        Hexahedra along x, y and z; at least 1 each.
    order : {1, 2}
        8 or 27 nodes a hexahedron.
    unit : {'m', 'mm'}
        Unit of the size.

    Returns
    -------
    HexMesh
        Nodes and cells run fastest along x, slowest along z.

    Raises
    ------
    InputError
        A size that is not positive, a number of elements below 1, or an order other than 1 or 2.
    """
    extent = np.asarray(size, dtype=float)
    counts = np.asarray(elements)
    if extent.shape != (3,) or not (np.isfinite(extent) & (extent > 0)).all():
        raise InputError(f"size is {list(size)}; give three positive lengths")
    if counts.shape != (3,) or counts.dtype.kind not in "iu" or (counts < 1).any():
        raise InputError(f"elements are {list(elements)}; give three whole numbers of at least 1")
    if np.prod(counts, dtype=float) > _MOST_ELEMENTS:
        raise InputError(f"elements are {list(elements)}; at most {_MOST_ELEMENTS} in all")
    if order not in (1, 2):
        raise InputError(f"order is {order}; allowed: 1 (8 nodes), 2 (27 nodes)")
    steps = order * counts
    origin = extent * [-0.5, -0.5, 0.0]
    axes = [origin[i] + extent[i] * np.arange(steps[i] + 1) / steps[i] for i in range(3)]
    z, y, x = np.meshgrid(*axes[::-1], indexing="ij")
    points = np.column_stack([x.ravel(), y.ravel(), z.ravel()])

    stride = np.array([1, steps[0] + 1, (steps[0] + 1) * (steps[1] + 1)])
    nodes = REFERENCE_NODES[: 8 if order == 1 else 27]
    local = (order * (nodes + 1) / 2).astype(np.int64) @ stride
    k, j, i = np.meshgrid(*(order * np.arange(count) for count in counts[::-1]), indexing="ij")
    first = np.column_stack([i.ravel(), j.ravel(), k.ravel()]) @ stride
    cells = first[:, None] + local

    number = np.arange(len(cells)).reshape(counts[::-1])
    layers = {
        "bottom": (number[0], 4),
        "top": (number[-1], 5),
        "left": (number[:, :, 0], 0),
        "right": (number[:, :, -1], 1),
        "front": (number[:, 0], 2),
        "back": (number[:, -1], 3),
    }
    face_sets = {
        name: np.column_stack([layer.ravel(), np.full(layer.size, face)])
        for name, (layer, face) in layers.items()
    }
    bare = HexMesh(points, cells, face_sets=face_sets, unit=unit)
    node_sets = {name: np.unique(bare.face_nodes(name)) for name in face_sets}
    return HexMesh(points, cells, node_sets, face_sets, unit)

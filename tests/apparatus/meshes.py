"""Meshes made of others, and whether a skin is closed."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import KDTree

from asperity.arrays import IntArray
from asperity.errors import InputError
from asperity.mesh import HexMesh, shape
from asperity.mesh.surface import Surface

_CORNERS = [[0, 1, 2], [0, 2, 3]]
# A 9-node face as four quadrilaterals round its middle, two triangles each.
_NINE = [[0, 4, 8], [0, 8, 7], [4, 1, 5], [4, 5, 8], [8, 5, 2], [8, 2, 6], [7, 8, 6], [7, 6, 3]]
_NO_FACES = np.empty((0, 2), np.int64)


def merged(meshes: Sequence[HexMesh], tolerance: float | None = None) -> HexMesh:
    """Return one mesh of several, whose skins share the nodes at which they coincide.

    Sets of one name become one set. Faces at which two meshes meet leave their face sets, and
    their nodes the node sets of those names.

    Parameters
    ----------
    meshes : sequence of HexMesh
        Meshes of one order and unit.
    tolerance : float, optional
        Distance at which nodes coincide, in the meshes' unit; default 1e-9 of the largest extent.

    Raises
    ------
    InputError
        No meshes, orders or units that differ, or a tolerance that would join nodes of one mesh.
    """
    if not meshes or len({(mesh.order, mesh.unit) for mesh in meshes}) != 1:
        raise InputError("merged needs meshes, all of one order and one unit")
    first_node = np.cumsum([0, *(len(mesh.points) for mesh in meshes)])
    first_cell = np.cumsum([0, *(len(mesh.cells) for mesh in meshes)])
    points = np.concatenate([mesh.points for mesh in meshes])
    if tolerance is None:
        tolerance = 1e-9 * float(np.ptp(points, axis=0).max())
    skins = [np.unique(mesh.face_nodes(mesh.skin_faces())) for mesh in meshes]
    outer = np.concatenate([nodes + first for nodes, first in zip(skins, first_node, strict=False)])
    pairs = outer[KDTree(points[outer]).query_pairs(tolerance, output_type="ndarray")]
    count = len(points)
    graph = coo_array((np.ones(len(pairs)), (pairs[:, 0], pairs[:, 1])), shape=(count, count))
    # Numbered by the first node of each group, so that the order of the nodes is kept.
    _, group = connected_components(graph, directed=False)
    _, first, number = np.unique(group, return_index=True, return_inverse=True)
    for mesh, start in zip(meshes, first_node, strict=False):
        if len(np.unique(number[start : start + len(mesh.points)])) < len(mesh.points):
            raise InputError(f"tolerance is {tolerance:g}; it joins nodes of one mesh: give less")
    cells = np.concatenate(
        [number[mesh.cells + start] for mesh, start in zip(meshes, first_node, strict=False)]
    )
    bare = HexMesh(points[first], cells, unit=meshes[0].unit)

    joined = np.setdiff1d(
        np.concatenate(
            [
                _keys(mesh.skin_faces()) + 6 * start
                for mesh, start in zip(meshes, first_cell, strict=False)
            ]
        ),
        _keys(bare.skin_faces()),
    )
    face_sets: dict[str, IntArray] = {}
    for name in dict.fromkeys(name for mesh in meshes for name in mesh.face_sets):
        faces = np.concatenate(
            [
                mesh.face_sets.get(name, _NO_FACES) + np.array([start, 0])
                for mesh, start in zip(meshes, first_cell, strict=False)
            ]
        )
        face_sets[name] = faces[~np.isin(_keys(faces), joined)]
    node_sets: dict[str, IntArray] = {}
    for name in dict.fromkeys(name for mesh in meshes for name in mesh.node_sets):
        if name in face_sets:
            node_sets[name] = np.unique(bare.face_nodes(face_sets[name]))
            continue
        held = [
            number[mesh.node_sets[name] + start]
            for mesh, start in zip(meshes, first_node, strict=False)
            if name in mesh.node_sets
        ]
        node_sets[name] = np.unique(np.concatenate(held))
    return replace(bare, node_sets=node_sets, face_sets=face_sets)


def _keys(faces: IntArray) -> IntArray:
    keys: IntArray = 6 * faces[:, 0] + faces[:, 1]
    return keys


def quadratic(mesh: HexMesh) -> HexMesh:
    """Return a mesh with 27 nodes a cell: the new nodes lie in the middle of the old ones.

    A face set stays. A node set that is named like a face set holds that set's nodes; another
    gains a new node where it holds all corners of the new node's edge, face or cell.
    """
    if mesh.order == 2:
        return mesh
    cells, points = [mesh.cells], [mesh.points]
    whole = np.arange(8)[None, :]
    parents: list[tuple[IntArray, int]] = []
    start = len(mesh.points)
    for local in (shape.EDGES, shape.FACES, whole):
        owners = np.sort(mesh.cells[:, local].reshape(-1, local.shape[1]), axis=1)
        unique, index = np.unique(owners, axis=0, return_inverse=True)
        points.append(mesh.points[unique].mean(axis=1))
        cells.append(start + index.reshape(len(mesh.cells), len(local)))
        parents.append((unique, start))
        start += len(unique)
    made = HexMesh(
        np.concatenate(points), np.concatenate(cells, axis=1), {}, mesh.face_sets, mesh.unit
    )
    node_sets = {}
    for name, nodes in mesh.node_sets.items():
        held = np.zeros(len(mesh.points), dtype=bool)
        held[nodes] = True
        gained = [first + np.flatnonzero(held[owner].all(axis=1)) for owner, first in parents]
        if name in mesh.face_sets:
            gained = [np.setdiff1d(made.face_nodes(name), nodes)]
        node_sets[name] = np.concatenate([nodes, *gained])
    return replace(made, node_sets=node_sets)


def open_edges(mesh: HexMesh) -> IntArray:
    """Return the edges of a mesh's skin that do not join exactly two faces of it, shape (k, 2)."""
    quads = mesh.skin()
    edges = np.stack([quads, np.roll(quads, -1, axis=1)], axis=-1).reshape(-1, 2)
    directed, count = np.unique(edges, axis=0, return_counts=True)
    keys = directed @ np.array([len(mesh.points), 1])
    reverse = directed[:, ::-1] @ np.array([len(mesh.points), 1])
    wrong = (count > 1) | ~np.isin(reverse, keys)
    return directed[wrong]


def is_watertight(mesh: HexMesh) -> bool:
    """Return whether the skin is closed: every edge once in each direction."""
    return not len(open_edges(mesh))


def skin(mesh: HexMesh) -> Surface:
    """Return the skin of a mesh as triangles; a 9-node face becomes eight."""
    faces = mesh.face_nodes(mesh.skin_faces())
    local = np.array(_CORNERS if mesh.order == 1 else _NINE)
    nodes, triangles = np.unique(faces[:, local].reshape(-1, 3), return_inverse=True)
    return Surface(mesh.points[nodes], triangles.reshape(-1, 3), mesh.unit)

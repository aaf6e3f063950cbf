"""Several meshes joined into one where their skins coincide."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import KDTree

from asperity.arrays import IntArray
from asperity.errors import InputError
from asperity.mesh.hexmesh import HexMesh

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

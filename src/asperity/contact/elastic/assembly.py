"""Stiffness and mass of a hexahedral mesh, through scikit-fem's elements.

scikit-fem gives the shape functions, the map from the reference cell and the quadrature; what it
does not give, incompatible modes, stands in `asperity.contact.elastic.hex8i`. Its own loop over
pairs of shape functions runs in Python; here a chunk of cells is one product of matrices.
"""

from collections.abc import Iterator
from typing import Any, Literal

import numpy as np
from scipy import sparse

from asperity.arrays import FloatArray, IntArray
from asperity.contact.elastic import hex8i
from asperity.contact.elastic.material import ElasticMaterial
from asperity.errors import InputError, choices
from asperity.mesh import HexMesh
from asperity.mesh.shape import REFERENCE_NODES

ElementName = Literal["hex27", "hex8", "hex8i"]

NODES = {"hex27": 27, "hex8": 8, "hex8i": 8}
"""Nodes of a cell by the element's name."""

_CELLS_AT_A_TIME = 1000
# Two Gauss points a direction for linear, three for quadratic shape functions: the usual full
# integration, exact for parallelepipeds.
_ORDER_OF_RULE = {8: 3, 27: 5}


def element_of(mesh: HexMesh, element: str | None) -> ElementName:
    """Return the element's name, by default that of the mesh's order.

    Raises
    ------
    InputError
        There is no such element, or the mesh's cells have another number of nodes.
    """
    count = mesh.cells.shape[1]
    name = element if element is not None else ("hex8" if count == 8 else "hex27")
    if name not in NODES:
        raise InputError(f"element is {name!r}; allowed: {choices(NODES)}")
    if NODES[name] != count:
        raise InputError(f"element is {name!r}, with {NODES[name]} nodes; the mesh has {count}")
    return name  # type: ignore[return-value]


def scikit_fem_basis(mesh: HexMesh) -> tuple[Any, Any, IntArray]:
    """Return a mesh as scikit-fem knows it, its scalar element, and the order of its nodes.

    The order, shape (8,) or (27,), is the node of a cell, in VTK's order, at which scikit-fem's
    i-th function is 1. Coordinates stay in their unit.
    """
    import skfem

    count = mesh.cells.shape[1]
    element = skfem.ElementHex1() if count == 8 else skfem.ElementHex2()
    places = 2.0 * element.doflocs - 1.0
    distance = np.abs(places[:, None] - REFERENCE_NODES[None, :count]).sum(axis=2)
    order = np.argmin(distance, axis=1)
    corners, cells = np.unique(mesh.cells[:, order[:8]], return_inverse=True)
    cells = np.ascontiguousarray(cells.reshape(-1, 8).T, dtype=np.int32)
    linear = skfem.MeshHex1(np.ascontiguousarray(mesh.points[corners].T), cells)
    if count == 8:
        return linear, element, order
    dofs = skfem.Dofs(linear, element)
    points = np.empty((3, dofs.N))
    points[:, dofs.element_dofs] = mesh.points[mesh.cells[:, order].T].transpose(2, 0, 1)
    return skfem.MeshHex2(points, cells), element, order


def _bases(mesh: HexMesh) -> Iterator[tuple[slice, Any, IntArray]]:
    import skfem

    converted, element, order = scikit_fem_basis(mesh)
    rule = _ORDER_OF_RULE[mesh.cells.shape[1]]
    for first in range(0, len(mesh.cells), _CELLS_AT_A_TIME):
        cells = np.arange(first, min(first + _CELLS_AT_A_TIME, len(mesh.cells)))
        basis = skfem.Basis(converted, element, intorder=rule, elements=cells)
        yield slice(cells[0], cells[-1] + 1), basis, order


def _stiffness_of_cells(
    mesh: HexMesh, material: ElasticMaterial, element: ElementName
) -> Iterator[tuple[slice, FloatArray]]:
    if element == "hex8i":
        for first in range(0, len(mesh.cells), _CELLS_AT_A_TIME):
            cells = slice(first, first + _CELLS_AT_A_TIME)
            yield cells, hex8i.element_stiffness(mesh.points[mesh.cells[cells]], material)
        return
    for cells, basis, order in _bases(mesh):
        gradients = np.empty((*basis.dx.shape, len(order), 3))
        for number, (function,) in enumerate(basis.basis):
            gradients[:, :, order[number]] = function.grad.transpose(1, 2, 0)
        products = hex8i.products_of_gradients(gradients, basis.dx)
        yield cells, hex8i.stiffness_of_products(products, material)


def _pattern(mesh: HexMesh) -> tuple[IntArray, IntArray, IntArray]:
    """Which nodes share a cell: CSR rows and columns, and each cell's place in them."""
    count = len(mesh.points)
    keys = (mesh.cells[:, :, None] * count + mesh.cells[:, None, :]).reshape(-1)
    pairs, place = np.unique(keys, return_inverse=True)
    starts = np.searchsorted(pairs, count * np.arange(count + 1))
    return starts, pairs % count, place.reshape(len(mesh.cells), -1)


def stiffness_matrix(
    mesh: HexMesh, material: ElasticMaterial, element: ElementName
) -> sparse.csr_array:
    """Return the stiffness of a mesh in m, (3N, 3N), N/m; the freedoms of a node stand together."""
    starts, columns, places = _pattern(mesh)
    blocks = np.zeros((9, len(columns)))
    nodes = mesh.cells.shape[1]
    for cells, stiffness in _stiffness_of_cells(mesh, material, element):
        here = places[cells].reshape(-1)
        parts = stiffness.reshape(-1, nodes, 3, nodes, 3)
        for row in range(3):
            for column in range(3):
                values = parts[:, :, row, :, column].reshape(-1)
                blocks[3 * row + column] += np.bincount(here, values, len(columns))
    data = blocks.T.reshape(-1, 3, 3)
    size = 3 * len(mesh.points)
    return sparse.csr_array(sparse.bsr_array((data, columns, starts), shape=(size, size)))


def mass_matrix(mesh: HexMesh, density: float) -> sparse.csr_array:
    """Return the consistent mass of one displacement component, (N, N), kg; lengths in m."""
    starts, columns, places = _pattern(mesh)
    data = np.zeros(len(columns))
    for cells, basis, order in _bases(mesh):
        values = np.empty((*basis.dx.shape, len(order)))
        for number, (function,) in enumerate(basis.basis):
            values[:, :, order[number]] = np.asarray(function)
        mass = (values * basis.dx[:, :, None]).transpose(0, 2, 1) @ values
        data += np.bincount(places[cells].reshape(-1), mass.reshape(-1), len(columns))
    count = len(mesh.points)
    return sparse.csr_array((density * data, columns, starts), shape=(count, count))

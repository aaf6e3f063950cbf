r"""The 8-node hexahedron with incompatible modes: it bends without locking, and passes patch tests.

Wilson's three quadratic modes a displacement component, with the correction of Taylor, Beresford
and Wilson (A non-conforming element for stress analysis, Int. J. Numer. Meth. Engng 10, 1976,
1211-1219): the modes' gradients are taken with the Jacobian at the element's middle and scaled by
:math:`\det J_0 / \det J`, so that they do no work on a constant stress in any shape of element.
"""

import numpy as np

from asperity.arrays import FloatArray
from asperity.contact.elastic.material import ElasticMaterial
from asperity.mesh import shape

_MODES = 3


def products_of_gradients(gradients: FloatArray, weights: FloatArray) -> FloatArray:
    r"""Return :math:`H_{aibj} = \int \partial_i N_a\, \partial_j N_b`, shape (m, n, 3, n, 3).

    The gradients of n functions in m cells at q points, 1/m, have the shape (m, q, n, 3),
    quadrature weights times the Jacobian's determinant, m^3, (m, q).
    """
    cells, points, functions, _ = gradients.shape
    flat = gradients.reshape(cells, points, 3 * functions)
    products = (flat * weights[:, :, None]).transpose(0, 2, 1) @ flat
    return products.reshape(cells, functions, 3, functions, 3)


def stiffness_of_products(products: FloatArray, material: ElasticMaterial) -> FloatArray:
    r"""Return the stiffness of isotropic elasticity, shape (m, 3n, 3n), N/m.

    :math:`K_{aibj} = \lambda H_{aibj} + \mu H_{ajbi} + \mu\,\delta_{ij} H_{akbk}`.
    """
    first, second = material.lame
    stiffness = first * products + second * products.transpose(0, 1, 4, 3, 2)
    trace = second * np.einsum("makbk->mab", products)
    for axis in range(3):
        stiffness[:, :, axis, :, axis] += trace
    size = 3 * products.shape[1]
    return stiffness.reshape(len(products), size, size)


def element_stiffness(corners: FloatArray, material: ElasticMaterial) -> FloatArray:
    """Return the elements' stiffness, N/m, (m, 24, 24), with the incompatible modes condensed out.

    The corners, in m, stand in VTK's order, (m, 8, 3); freedoms run node by node.
    """
    at, rule = shape.gauss(2, 3)
    _, slopes = shape.cell_shapes(at, 8)
    _, middle = shape.cell_shapes(np.zeros((1, 3)), 8)
    jacobian = np.einsum("mni,qnj->mqij", corners, slopes, optimize=True)
    at_middle = np.einsum("mni,nj->mij", corners, middle[0], optimize=True)
    size = np.linalg.det(jacobian)
    compatible = np.einsum("qnj,mqji->mqni", slopes, np.linalg.inv(jacobian), optimize=True)
    # The modes 1 - x^2, 1 - y^2, 1 - z^2 of the reference cell.
    mode_slopes = -2.0 * at[:, :, None] * np.eye(_MODES)
    modes = np.einsum("qnj,mji->mqni", mode_slopes, np.linalg.inv(at_middle), optimize=True)
    modes *= (np.linalg.det(at_middle)[:, None] / size)[:, :, None, None]
    gradients = np.concatenate([compatible, modes], axis=2)
    whole = stiffness_of_products(products_of_gradients(gradients, size * rule), material)
    coupling = whole[:, :24, 24:]
    eliminated = np.linalg.solve(whole[:, 24:, 24:], coupling.transpose(0, 2, 1))
    condensed = whole[:, :24, :24] - coupling @ eliminated
    return np.asarray(0.5 * (condensed + condensed.transpose(0, 2, 1)))

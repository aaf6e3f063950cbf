r"""What a frozen tangent leaves out, put back smoothly: friction follows pressure and slip.

With the residual :math:`R` of the nodal forces the frozen iteration corrects :math:`h` by
:math:`R`. Newton's method would correct it by :math:`(I - C G)^{-1} R`, where :math:`C` is the
tangent less the frozen stiffness :math:`K`. Two parts of it matter. Tangential forces press the
body on harder here and less there, :math:`D R` at the nodes with :math:`D = n^T K G`, and friction
follows pressure in the ratio :math:`\rho` of tangential to normal force at the node. And friction
follows the mean slip :math:`E R` by the tangent :math:`T` of a point with the mean deflection and
slip of all. So the correction is, with the nodes' areas :math:`a`,

.. math:: h \to h + R' + a\,T\,(I - E a T)^{-1} E R', \qquad R' = R + \rho\,D R .

It changes the number of iterations and not what they lead to.
"""

import math

import numpy as np

from asperity.compiled import kernel
from asperity.contact.friction_point import MU, share_and_tangent
from asperity.contact.increment_kernels import (
    NORMAL,
    ONE_SIDED,
    PRESSURE,
    SLIP_1,
    SLIP_2,
    first_tangent,
)


@kernel
def ratios(force, dofs, normals, out):
    """Write tangential over normal force at nodes with a normal force; 0 at others.

    Parameters
    ----------
    force : ndarray, shape (3n,)
        Nodal forces, N.
    dofs : ndarray of int, shape (3k,)
        Unknowns of the nodes.
    normals : ndarray, shape (k, 3)
        Their unit normals.
    out : ndarray, shape (k, 3)
        Written.
    """
    for a in range(normals.shape[0]):
        x = force[dofs[3 * a]]
        y = force[dofs[3 * a + 1]]
        z = force[dofs[3 * a + 2]]
        normal = x * normals[a, 0] + y * normals[a, 1] + z * normals[a, 2]
        # The ratio is about mu; what is far beyond it is no friction.
        ratio = 0.0
        if x * x + y * y + z * z < 4.0 * normal * normal:
            ratio = 1.0 / normal
        out[a, 0] = x * ratio - normals[a, 0]
        out[a, 1] = y * ratio - normals[a, 1]
        out[a, 2] = z * ratio - normals[a, 2]
        if ratio == 0.0:
            out[a] = 0.0


@kernel
def mean_tangent(points, deflection0, size0, weights, friction, motion, out):
    """Write the tangential stiffness of a point with the mean of all points in contact, 3 x 3.

    Parameters
    ----------
    points, deflection0, size0, weights, friction, motion : ndarray
        As `asperity.contact.increment_kernels.tractions` takes and writes them.
    out : ndarray, shape (3, 3)
        Written: derivative of the traction by the slip, Pa/m.

    Returns
    -------
    float
        Area in contact, m^2.
    """
    out[:] = 0.0
    area = 0.0
    p = 0.0
    size = 0.0
    normal = np.zeros(3)
    slip_1 = np.zeros(3)
    slip_2 = np.zeros(3)
    bent = np.zeros(3)
    for q in range(points.shape[0]):
        if points[q, PRESSURE] <= 0.0:
            continue
        weight = weights[q]
        area += weight
        p += weight * points[q, PRESSURE]
        size += weight * size0[q]
        for c in range(3):
            normal[c] += weight * points[q, NORMAL + c]
            slip_1[c] += weight * points[q, SLIP_1 + c]
            slip_2[c] += weight * points[q, SLIP_2 + c]
            bent[c] += weight * deflection0[q, c]
    length = math.sqrt(normal[0] ** 2 + normal[1] ** 2 + normal[2] ** 2)
    if friction[MU] == 0.0 or length <= 0.5 * area:
        return area
    nx = normal[0] / length
    ny = normal[1] / length
    nz = normal[2] / length
    ex, ey, ez = first_tangent(nx, ny, nz)
    fx = ny * ez - nz * ey
    fy = nz * ex - nx * ez
    fz = nx * ey - ny * ex
    _, _, _, _, _, t1, _ = share_and_tangent(
        (bent[0] * ex + bent[1] * ey + bent[2] * ez) / area,
        (bent[0] * fx + bent[1] * fy + bent[2] * fz) / area,
        size / area,
        (slip_1[0] * ex + slip_1[1] * ey + slip_1[2] * ez) / area,
        (slip_1[0] * fx + slip_1[1] * fy + slip_1[2] * fz) / area,
        (slip_2[0] * ex + slip_2[1] * ey + slip_2[2] * ez) / area,
        (slip_2[0] * fx + slip_2[1] * fy + slip_2[2] * fz) / area,
        motion[ONE_SIDED] > 0.0,
        friction,
    )
    scale = -friction[MU] * p / area
    e = (ex, ey, ez)
    f = (fx, fy, fz)
    for i in range(3):
        for j in range(3):
            out[i, j] = scale * (
                (t1[0] * e[i] + t1[2] * f[i]) * e[j] + (t1[1] * e[i] + t1[3] * f[i]) * f[j]
            )
    return area


@kernel
def mean_correction(tangent, spread, out):
    """Write ``T (I - F T)^-1`` for a mean flexibility ``F``; 0 where that has no inverse."""
    matrix = np.eye(3) - spread @ tangent
    out[:] = 0.0
    if abs(np.linalg.det(matrix)) > 1e-3:
        out[:] = tangent @ np.linalg.inv(matrix)


@kernel
def couple(rest, shares, pressing, moving, areas, correction, pressed, mean, out):
    """Write the correction of ``h`` for a residual.

    Parameters
    ----------
    rest : ndarray, shape (3k,)
        Residual, N.
    shares : ndarray, shape (k, 3)
        Ratios of tangential to normal force.
    pressing, moving : ndarray, shapes (k, 3k), (3, 3k)
        D and E.
    areas : ndarray, shape (k,)
        m^2.
    correction : ndarray, shape (3, 3)
        ``T (I - F T)^-1``, Pa/m.
    pressed, mean : ndarray, shapes (k,), (3,)
        Room.
    out : ndarray, shape (3k,)
        Written, N.
    """
    np.dot(pressing, rest, pressed)
    for a in range(areas.shape[0]):
        for c in range(3):
            out[3 * a + c] = rest[3 * a + c] + shares[a, c] * pressed[a]
    np.dot(moving, out, mean)
    for c in range(3):
        push = 0.0
        for e in range(3):
            push += correction[c, e] * mean[e]
        for a in range(areas.shape[0]):
            out[3 * a + c] += areas[a] * push

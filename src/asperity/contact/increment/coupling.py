r"""What a frozen tangent leaves out, put back smoothly: friction follows pressure and slip.

With the residual :math:`R` of the nodal forces the frozen iteration corrects :math:`h` by
:math:`R`. Newton's method would correct it by :math:`(I - C G)^{-1} R`, where :math:`C` is the
tangent less the frozen stiffness :math:`K`. Two parts of it matter. Tangential forces press the
body on harder here and less there, :math:`D R` at the nodes with :math:`D = n^T K G`, and friction
follows pressure in the ratio :math:`\rho` of tangential to normal force at the node, or as far of
it as a point with the mean of all does where its limit follows the pressure. And friction follows
the slip by the tangent :math:`T` of a point with the mean deflection and slip of all, in proportion
to the pressure :math:`p`; of the displacement :math:`G R` it takes the smooth part :math:`E R`, in
fields :math:`\varphi_r` orthonormal over the areas :math:`a` of the nodes. So

.. math:: R' = R + \rho\,D R' + \frac{p}{\bar p}\,a \sum_r \varphi_r T\,(E R')_r ,

solved by repeated insertion, but for the constant field, the largest part, at once. All that is
taken with single precision, for it changes the number of iterations and not what they lead to.
"""

import math

from asperity.contact.interface.friction import share_and_tangent
from asperity.contact.interface.tractions import first_tangent
from asperity.kernels.compiled import kernel
from asperity.kernels.dense import multiply
from asperity.kernels.elimination import eliminate

# Insertions: with one, a fourth evaluation of the contact in an increment is the rule.
PASSES = 2


@kernel
def ratios(force, dofs, normals, smooth, out, load):
    """Write the ratio of tangential to normal force at k nodes, and their pressure over its mean.

    Forces, N, are those of all nodes, ``dofs`` (3k,) and ``normals`` (k, 3) say of which;
    ``smooth`` are smooth fields times areas, (r, k), the first constant. The ratio, ``out`` (k, 3),
    is 0 at nodes without a normal force.
    """
    total = 0.0
    area = 0.0
    for a in range(normals.shape[0]):
        x = force[dofs[3 * a]]
        y = force[dofs[3 * a + 1]]
        z = force[dofs[3 * a + 2]]
        normal = x * normals[a, 0] + y * normals[a, 1] + z * normals[a, 2]
        # The ratio is about mu; what is far beyond it is no friction.
        load[a] = normal / smooth[0, a]
        total += normal
        area += smooth[0, a]
        ratio = 0.0
        if x * x + y * y + z * z < 4.0 * normal * normal:
            ratio = 1.0 / normal
        out[a, 0] = x * ratio - normals[a, 0]
        out[a, 1] = y * ratio - normals[a, 1]
        out[a, 2] = z * ratio - normals[a, 2]
        if ratio == 0.0:
            out[a] = 0.0
    for a in range(normals.shape[0]):
        load[a] *= area / total if total != 0.0 else 0.0


@kernel
def mean_tangent(points, committed, interface, motion, out):
    """Write the tangential stiffness of a point with the mean of all in contact, 3 x 3, Pa/m.

    The points are as `asperity.contact.interface.tractions.tractions` writes them. Returns the
    derivative of that point's friction by its pressure, over their ratio: 1 where friction follows
    the pressure at once.
    """
    weights, friction = interface.weights, interface.friction
    deflection0, size0 = committed.deflection, committed.size
    pressures, normals = points.pressure, points.normal
    slips_1, slips_2 = points.slip_1, points.slip_2
    out[:] = 0.0
    area = 0.0
    p = 0.0
    size = 0.0
    mx = my = mz = 0.0
    ax = ay = az = 0.0
    bx = by = bz = 0.0
    cx = cy = cz = 0.0
    for q in range(pressures.shape[0]):
        if pressures[q] <= 0.0:
            continue
        weight = weights[q]
        area += weight
        p += weight * pressures[q]
        size += weight * size0[q]
        mx += weight * normals[q, 0]
        my += weight * normals[q, 1]
        mz += weight * normals[q, 2]
        ax += weight * slips_1[q, 0]
        ay += weight * slips_1[q, 1]
        az += weight * slips_1[q, 2]
        bx += weight * slips_2[q, 0]
        by += weight * slips_2[q, 1]
        bz += weight * slips_2[q, 2]
        cx += weight * deflection0[q, 0]
        cy += weight * deflection0[q, 1]
        cz += weight * deflection0[q, 2]
    length = math.sqrt(mx * mx + my * my + mz * mz)
    if friction.mu == 0.0 or length <= 0.5 * area:
        return 1.0
    nx = mx / length
    ny = my / length
    nz = mz / length
    ex, ey, ez = first_tangent(nx, ny, nz)
    fx = ny * ez - nz * ey
    fy = nz * ex - nx * ez
    fz = nx * ey - ny * ex
    _, _, _, wx, wy, t1, _, by_p = share_and_tangent(
        (cx * ex + cy * ey + cz * ez) / area,
        (cx * fx + cy * fy + cz * fz) / area,
        size / area,
        (ax * ex + ay * ey + az * ez) / area,
        (ax * fx + ay * fy + az * fz) / area,
        (bx * ex + by * ey + bz * ez) / area,
        (bx * fx + by * fy + bz * fz) / area,
        motion.one_sided,
        friction,
        p / area,
    )
    scale = -friction.mu * p / area
    e = (ex, ey, ez)
    f = (fx, fy, fz)
    for i in range(3):
        for j in range(3):
            out[i, j] = scale * (
                (t1[0] * e[i] + t1[2] * f[i]) * e[j] + (t1[1] * e[i] + t1[3] * f[i]) * f[j]
            )
    square = wx * wx + wy * wy
    return (wx * by_p[0] + wy * by_p[1]) / square if square > 0.0 else 1.0


@kernel
def mean_correction(tangent, spread, matrix, out):
    """Write ``T (I - F T)^-1`` for a mean flexibility ``F``; 0 where that has no inverse.

    ``matrix`` is room for 3 x 3.
    """
    for r in range(3):
        # Of the transposed equations, whose solution for each row of T is one of what is sought.
        for i in range(3):
            for j in range(3):
                total = 1.0 if i == j else 0.0
                for k in range(3):
                    total -= spread[j, k] * tangent[k, i]
                matrix[i, j] = total
            out[r, i] = tangent[r, i]
        if r == 0:
            m = matrix
            determinant = (
                m[0, 0] * (m[1, 1] * m[2, 2] - m[1, 2] * m[2, 1])
                - m[0, 1] * (m[1, 0] * m[2, 2] - m[1, 2] * m[2, 0])
                + m[0, 2] * (m[1, 0] * m[2, 1] - m[1, 1] * m[2, 0])
            )
            if not abs(determinant) > 1e-3:
                out[:] = 0.0
                return
        eliminate(matrix, out[r], 3, 0.0)


@kernel
def couple(
    rest, shares, pressing, smooth, moving, tangent, correction, load, single, pressed, moved, out
):
    """Write the correction of ``h`` for a residual, ``rest`` and ``out`` (3k,), N.

    With the ratios (k, 3) and pressures over their mean (k,) of the nodes; D, and E by smooth
    fields, both transposed, (3k, k), (r, k), (3k, 3r); T and ``T (I - F T)^-1``, Pa/m. ``single``,
    ``pressed`` and ``moved``, (3k,), (k,), (3r,), are room of single precision.
    """
    for c in range(rest.shape[0]):
        out[c] = rest[c]
    for _ in range(PASSES):
        for c in range(rest.shape[0]):
            single[c] = out[c]
        multiply(pressing, single, pressed)
        for a in range(shares.shape[0]):
            for c in range(3):
                out[3 * a + c] = rest[3 * a + c] + shares[a, c] * pressed[a]
        for c in range(rest.shape[0]):
            single[c] = out[c]
        multiply(moving, single, moved)
        for r in range(smooth.shape[0]):
            for c in range(3):
                push = 0.0
                for e in range(3):
                    push += (tangent if r else correction)[c, e] * moved[3 * r + e]
                for a in range(shares.shape[0]):
                    out[3 * a + c] += push * load[a] * smooth[r, a]

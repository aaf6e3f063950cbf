r"""Contact tractions at the quadrature points, their sum at the nodes, and their derivative.

On a body with the displacement :math:`u`, at a point :math:`x` with the distance :math:`d`, normal
:math:`n` and Hessian :math:`H` of the counter-surface,

.. math:: t = p\,n - \mu p\,S, \qquad p = p(-d), \qquad S = T\,\sigma(T^T s_0, T^T v_1, T^T v_2),

:math:`T` being two unit vectors of the tangent plane and :math:`v_j` the two parts of the slip. The
laws do not depend on which two, so the derivative may carry them along without a turn,
:math:`dT = -n\,(dn^T T)`, and

.. math:: \frac{\partial t}{\partial u} = -p'(n - \mu S)\,n^T + p H + \mu p\,n\,(S^T H)
   - \mu p \sum_j T \frac{\partial\sigma}{\partial D_j} T^T
   \left(\frac{\partial v_j}{\partial u} - (n\cdot v_j) H\right) .
"""

import math

from asperity.contact.interface.friction import (
    augmented_slip,
    share_and_tangent,
    share_of,
)
from asperity.contact.interface.normal import augmented_overclosure, pressure
from asperity.contact.interface.rigid import distance
from asperity.kernels.compiled import kernel


@kernel
def _apply(m, x, y, z):
    return (
        m[0, 0] * x + m[0, 1] * y + m[0, 2] * z,
        m[1, 0] * x + m[1, 1] * y + m[1, 2] * z,
        m[2, 0] * x + m[2, 1] * y + m[2, 2] * z,
    )


@kernel
def _place(x, y, z, surface, r, translation):
    """Distance, normal and Hessian of a surface where it stands."""
    x -= translation[0]
    y -= translation[1]
    z -= translation[2]
    d, gx, gy, gz, hxx, hyy, hzz, hxy, hxz, hyz = distance(
        r[0, 0] * x + r[1, 0] * y + r[2, 0] * z,
        r[0, 1] * x + r[1, 1] * y + r[2, 1] * z,
        r[0, 2] * x + r[1, 2] * y + r[2, 2] * z,
        surface,
    )
    nx, ny, nz = _apply(r, gx, gy, gz)
    if hxx == 0.0 and hyy == 0.0 and hzz == 0.0:
        return d, nx, ny, nz, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    # H in space: R H R^T.
    ax, bx, cx = _apply(r, hxx, hxy, hxz)
    ay, by, cy = _apply(r, hxy, hyy, hyz)
    az, bz, cz = _apply(r, hxz, hyz, hzz)
    return (
        d, nx, ny, nz,
        ax * r[0, 0] + ay * r[0, 1] + az * r[0, 2],
        bx * r[1, 0] + by * r[1, 1] + bz * r[1, 2],
        cx * r[2, 0] + cy * r[2, 1] + cz * r[2, 2],
        ax * r[1, 0] + ay * r[1, 1] + az * r[1, 2],
        ax * r[2, 0] + ay * r[2, 1] + az * r[2, 2],
        bx * r[2, 0] + by * r[2, 1] + bz * r[2, 2],
    )  # fmt: skip


@kernel
def first_tangent(nx, ny, nz):
    """Unit vector of the tangent plane along x, the drive; along y where x is the normal."""
    if abs(nx) < 0.9:
        size = math.sqrt(1.0 - nx * nx)
        return size, -nx * ny / size, -nx * nz / size
    size = math.sqrt(1.0 - ny * ny)
    return -nx * ny / size, size, -ny * nz / size


@kernel
def tractions(u, committed, interface, motion, force, points, stiffness, with_tangent):
    """Evaluate the contact for a displacement of its nodes; see `augmented_tractions`."""
    touching, _ = augmented_tractions(
        u, committed, interface, motion, force, points, stiffness, with_tangent,
        points.traction, 0.0,
    )  # fmt: skip
    return touching


@kernel
def augmented_tractions(
    u, committed, interface, motion, force, points, stiffness, with_tangent, assumed, augmentation
):
    r"""Evaluate the contact for a displacement of its nodes, or near it.

    With an augmentation :math:`r > 0` the laws are taken not at the slip and overclosure :math:`D`
    of the displacement, where a law much stiffer than the body says little, but at the
    :math:`\hat D` with :math:`t(\hat D) + r \hat D = t_a + r D`, from the tractions :math:`t_a`
    assumed at the points; what is written is then the tangent there, continued to :math:`D`. Both
    meet in the solution.

    Parameters
    ----------
    u : ndarray, shape (3n,)
        Trial displacement, m.
    committed : Committed
        Where the increment starts from.
    interface : Interface
        What stays the same.
    motion : MotionNumbers
        Of the counter-surface.
    force : ndarray, shape (3n,)
        Written: nodal forces on the body, N.
    points : ContactPoints
        Written.
    stiffness : ndarray, shape (q, 3, 3)
        Written with ``with_tangent``: derivative of the traction by the displacement, Pa/m.
    with_tangent : bool
        Whether to write it.
    assumed : ndarray, shape (q, 3)
        Tractions assumed, Pa; not looked at without an augmentation.
    augmentation : float
        r, Pa/m; 0: at the displacement itself.

    Returns
    -------
    touching : int
        Number of points in contact.
    off : float
        Integral of the squared difference between the laws' tractions and those assumed, N^2/m^2.
    """
    # Taken out of their tuples once: in the loop each would be counted as one more owner.
    faces, shapes, weights = interface.faces, interface.shapes, interface.weights
    places, surface = interface.places, interface.counter
    law, friction = interface.law, interface.friction
    u0, deflection0 = committed.displacement, committed.deflection
    size0, multiplier = committed.size, committed.multiplier
    rotation, translation = motion.rotation, motion.translation
    shift_1, turn_1, body_1 = motion.shift_1, motion.turn_1, motion.body_1
    shift_2, turn_2, body_2 = motion.shift_2, motion.turn_2, motion.body_2
    traction, deflection, size = points.traction, points.deflection, points.size
    pressures, distances, normals = points.pressure, points.distance, points.normal
    slip_1, slip_2 = points.slip_1, points.slip_2
    force[:] = 0.0
    mu = friction.mu
    touching = 0
    off = 0.0
    aimed = augmentation > 0.0
    px = 0.0
    py = 0.0
    pz = 0.0
    far = 0.0
    lx = 0.0
    ly = 0.0
    lz = 0.0
    ex = 0.0
    ey = 0.0
    ez = 0.0
    fx = 0.0
    fy = 0.0
    fz = 0.0
    one_sided = motion.one_sided
    width = faces.shape[1]
    rule = shapes.shape[0]
    for q in range(faces.shape[0] * rule):
        face = q // rule
        at = q - face * rule
        ux = 0.0
        uy = 0.0
        uz = 0.0
        dx = 0.0
        dy = 0.0
        dz = 0.0
        lam = 0.0
        for a in range(width):
            i = faces[face, a]
            shape = shapes[at, a]
            j = 3 * i
            ux += shape * u[j]
            uy += shape * u[j + 1]
            uz += shape * u[j + 2]
            dx += shape * (u[j] - u0[j])
            dy += shape * (u[j + 1] - u0[j + 1])
            dz += shape * (u[j + 2] - u0[j + 2])
            lam += shape * multiplier[i]
        x = places[q, 0] + ux
        y = places[q, 1] + uy
        z = places[q, 2] + uz
        d, nx, ny, nz, hxx, hyy, hzz, hxy, hxz, hyz = _place(
            x, y, z, surface, rotation, translation
        )
        if aimed:
            px = assumed[q, 0]
            py = assumed[q, 1]
            pz = assumed[q, 2]
            over = augmented_overclosure(
                px * nx + py * ny + pz * nz - augmentation * d, augmentation, lam, law
            )
            far = over + d
            p, slope = pressure(over, lam, law)
        else:
            p, slope = pressure(-d, lam, law)
        pressures[q] = p
        distances[q] = d
        normals[q, 0] = nx
        normals[q, 1] = ny
        normals[q, 2] = nz
        bx, by, bz = _apply(turn_1, x, y, z)
        ax, ay, az = _apply(body_1, dx, dy, dz)
        v1x = ax - bx - shift_1[0]
        v1y = ay - by - shift_1[1]
        v1z = az - bz - shift_1[2]
        bx, by, bz = _apply(turn_2, x, y, z)
        ax, ay, az = _apply(body_2, dx, dy, dz)
        v2x = ax - bx - shift_2[0]
        v2y = ay - by - shift_2[1]
        v2z = az - bz - shift_2[2]
        along_1 = v1x * nx + v1y * ny + v1z * nz
        along_2 = v2x * nx + v2y * ny + v2z * nz
        slip_1[q, 0] = v1x - along_1 * nx
        slip_1[q, 1] = v1y - along_1 * ny
        slip_1[q, 2] = v1z - along_1 * nz
        slip_2[q, 0] = v2x - along_2 * nx
        slip_2[q, 1] = v2y - along_2 * ny
        slip_2[q, 2] = v2z - along_2 * nz
        if p <= 0.0:
            # An asperity that touches nothing stands straight.
            for c in range(3):
                traction[q, c] = 0.0
                deflection[q, c] = 0.0
            size[q] = 0.0
            if with_tangent:
                stiffness[q] = 0.0
            off += weights[q] * (px * px + py * py + pz * pz)
            continue
        touching += 1
        tx = p * nx
        ty = p * ny
        tz = p * nz
        sx = 0.0
        sy = 0.0
        sz = 0.0
        qx = 0.0
        qy = 0.0
        qz = 0.0
        if mu > 0.0:
            if nx != lx or ny != ly or nz != lz:
                # On a plane one frame serves all points; roots and quotients are what costs here.
                ex, ey, ez = first_tangent(nx, ny, nz)
                fx = ny * ez - nz * ey
                fy = nz * ex - nx * ez
                fz = nx * ey - ny * ex
                lx = nx
                ly = ny
                lz = nz
            # The committed deflection, turned into the plane of now with its length kept.
            gx = deflection0[q, 0]
            gy = deflection0[q, 1]
            gz = deflection0[q, 2]
            s1 = gx * ex + gy * ey + gz * ez
            s2 = gx * fx + gy * fy + gz * fz
            if gx * nx + gy * ny + gz * nz != 0.0:
                flat = math.sqrt(s1 * s1 + s2 * s2)
                if flat > 0.0:
                    keep = math.sqrt(gx * gx + gy * gy + gz * gz) / flat
                    s1 *= keep
                    s2 *= keep
            a1 = v1x * ex + v1y * ey + v1z * ez
            a2 = v1x * fx + v1y * fy + v1z * fz
            b1 = v2x * ex + v2y * ey + v2z * ez
            b2 = v2x * fx + v2y * fy + v2z * fz
            m1 = 0.0
            m2 = 0.0
            if aimed:
                m1, m2 = augmented_slip(
                    s1, s2, size0[q], a1, a2, b1, b2, one_sided, friction, mu * p, augmentation,
                    augmentation * (a1 + b1) - (px * ex + py * ey + pz * ez),
                    augmentation * (a2 + b2) - (px * fx + py * fy + pz * fz),
                )  # fmt: skip
                a1 += m1
                a2 += m2
            if with_tangent:
                s1, s2, new_size, w1, w2, t1, t2, by_p = share_and_tangent(
                    s1, s2, size0[q], a1, a2, b1, b2, one_sided, friction, p
                )
                _tangent(
                    stiffness[q], mu * p, t1, t2, along_1, along_2,
                    ex, ey, ez, fx, fy, fz, hxx, hyy, hzz, hxy, hxz, hyz,
                    turn_1, body_1, turn_2, body_2,
                )  # fmt: skip
            else:
                t1 = (0.0, 0.0, 0.0, 0.0)
                s1, s2, new_size, w1, w2 = share_of(
                    s1, s2, size0[q], a1, a2, b1, b2, one_sided, friction, p
                )
                by_p = (w1, w2)
            deflection[q, 0] = s1 * ex + s2 * fx
            deflection[q, 1] = s1 * ey + s2 * fy
            deflection[q, 2] = s1 * ez + s2 * fz
            size[q] = new_size
            sx = mu * (w1 * ex + w2 * fx)
            sy = mu * (w1 * ey + w2 * fy)
            sz = mu * (w1 * ez + w2 * fz)
            qx = mu * (by_p[0] * ex + by_p[1] * fx)
            qy = mu * (by_p[0] * ey + by_p[1] * fy)
            qz = mu * (by_p[0] * ez + by_p[1] * fz)
            tx -= p * sx
            ty -= p * sy
            tz -= p * sz
            if aimed:
                off += weights[q] * ((tx - px) ** 2 + (ty - py) ** 2 + (tz - pz) ** 2)
                c1 = mu * p * (t1[0] * m1 + t1[1] * m2)
                c2 = mu * p * (t1[2] * m1 + t1[3] * m2)
                tx += c1 * ex + c2 * fx - slope * far * (nx - qx)
                ty += c1 * ey + c2 * fy - slope * far * (ny - qy)
                tz += c1 * ez + c2 * fz - slope * far * (nz - qz)
        else:
            if aimed:
                off += weights[q] * ((tx - px) ** 2 + (ty - py) ** 2 + (tz - pz) ** 2)
                tx -= slope * far * nx
                ty -= slope * far * ny
                tz -= slope * far * nz
            deflection[q] = 0.0
            size[q] = 0.0
            if with_tangent:
                stiffness[q] = 0.0
        if with_tangent:
            k = stiffness[q]
            # S^T H, the turn of the tangent plane towards the normal.
            gx = p * (sx * hxx + sy * hxy + sz * hxz) - slope * nx
            gy = p * (sx * hxy + sy * hyy + sz * hyz) - slope * ny
            gz = p * (sx * hxz + sy * hyz + sz * hzz) - slope * nz
            k[0, 0] += nx * gx + p * hxx + slope * qx * nx
            k[0, 1] += nx * gy + p * hxy + slope * qx * ny
            k[0, 2] += nx * gz + p * hxz + slope * qx * nz
            k[1, 0] += ny * gx + p * hxy + slope * qy * nx
            k[1, 1] += ny * gy + p * hyy + slope * qy * ny
            k[1, 2] += ny * gz + p * hyz + slope * qy * nz
            k[2, 0] += nz * gx + p * hxz + slope * qz * nx
            k[2, 1] += nz * gy + p * hyz + slope * qz * ny
            k[2, 2] += nz * gz + p * hzz + slope * qz * nz
        traction[q, 0] = tx
        traction[q, 1] = ty
        traction[q, 2] = tz
        weight = weights[q]
        for a in range(width):
            j = 3 * faces[face, a]
            share = weight * shapes[at, a]
            force[j] += share * tx
            force[j + 1] += share * ty
            force[j + 2] += share * tz
    return touching, off


@kernel
def _tangent(
    k, scale, t1, t2, along_1, along_2, ex, ey, ez, fx, fy, fz,
    hxx, hyy, hzz, hxy, hxz, hyz, turn_1, body_1, turn_2, body_2,
):  # fmt: skip
    """Write the share's part of a point's tangent."""
    for c in range(3):
        if c == 0:
            gx, gy, gz = hxx, hxy, hxz
        elif c == 1:
            gx, gy, gz = hxy, hyy, hyz
        else:
            gx, gy, gz = hxz, hyz, hzz
        # Column c of dv_j/du - (n.v_j) H, in the tangent plane.
        ax = body_1[0, c] - turn_1[0, c] - along_1 * gx
        ay = body_1[1, c] - turn_1[1, c] - along_1 * gy
        az = body_1[2, c] - turn_1[2, c] - along_1 * gz
        bx = body_2[0, c] - turn_2[0, c] - along_2 * gx
        by = body_2[1, c] - turn_2[1, c] - along_2 * gy
        bz = body_2[2, c] - turn_2[2, c] - along_2 * gz
        a1 = ax * ex + ay * ey + az * ez
        a2 = ax * fx + ay * fy + az * fz
        b1 = bx * ex + by * ey + bz * ez
        b2 = bx * fx + by * fy + bz * fz
        w1 = -scale * (t1[0] * a1 + t1[1] * a2 + t2[0] * b1 + t2[1] * b2)
        w2 = -scale * (t1[2] * a1 + t1[3] * a2 + t2[2] * b1 + t2[3] * b2)
        k[0, c] = w1 * ex + w2 * fx
        k[1, c] = w1 * ey + w2 * fy
        k[2, c] = w1 * ez + w2 * fz

r"""The conjugate point in closed form: where a point of the hob's curve last touches the wheel.

The wheel's axis is Z, the hob's origin :math:`(0, a, \Delta z)`, its axes
:math:`e_x = -Y`, :math:`e_z = \cos\eta\,X + \sin\eta\,Z`, :math:`e_y = e_z \times e_x`. With the
standing angle :math:`\psi = \theta + \varphi_1` and :math:`i = z_2/z_1` the normal
:math:`n = (-s z'\rho, -\rho' p, \rho'\rho)` in :math:`(e_\rho, e_\psi, e_z)` does not depend on the
axial place :math:`\zeta`, and the equation of meshing :math:`n \cdot v_{12} = 0` is linear in it:

.. math:: \zeta = \frac{i \rho\, n_\psi - r_X n_Y + r_Y n_X}{\cos\eta\; n_Y},

with :math:`r` perpendicular to the hob's axis. Then
:math:`\varphi_1 = \psi - (\zeta - s z)/p`, and the wheel has turned by :math:`\varphi_1/i`. The
pole :math:`n_Y = 0` is where the hob would have to be infinitely long.

Lengths are in mm, angles in rad; the frame is that of the right-handed gearset. ``hob`` is a
`~asperity.flanks.worm.curve.Thread`, ``cut`` a `~asperity.flanks.worm.setting.Stand`.
"""

import math

from asperity.flanks.worm.curve import curve
from asperity.kernels.compiled import kernel


@kernel
def to_axes(x, y, z, stand):
    """Coordinates of a point of the wheel's standing frame in the helicoid's standing axes."""
    dz = z - stand.axial_offset
    return (
        stand.centre_distance - y,
        x * stand.sine - dz * stand.cosine,
        x * stand.cosine + dz * stand.sine,
    )


@kernel
def turned(point, cosine, sine):
    """Coordinates of a point of the wheel once the wheel has turned by an angle."""
    return point[0] * cosine - point[1] * sine, point[0] * sine + point[1] * cosine, point[2]


@kernel
def conjugate(u, psi, side, hob, cut):
    """Point of contact, phase and normal at ``(u, psi)``, in the standing frame of the wheel.

    Returns ``(x, y, z, phase, nx, ny, nz)``; the unit normal points out of the wheel's tooth.
    """
    rho, place, rho1, place1, _, _ = curve(u, hob)
    p = hob.form.lead
    ce, se = cut.cosine, cut.sine
    c, s = math.cos(psi), math.sin(psi)
    nr = -side * place1 * rho
    nt = -rho1 * p
    na = rho1 * rho
    nx = (nr * s + nt * c) * se + na * ce
    ny = nt * s - nr * c
    nz = -(nr * s + nt * c) * ce + na * se
    rx = rho * s * se
    ry = cut.centre_distance - rho * c
    zeta = (cut.ratio * rho * nt - rx * ny + ry * nx) / (ce * ny)
    size = side / math.sqrt(nr * nr + nt * nt + na * na)
    return (
        rx + zeta * ce,
        ry,
        cut.axial_offset - rho * s * ce + zeta * se,
        psi - (zeta - side * place) / p,
        nx * size,
        ny * size,
        nz * size,
    )


@kernel
def conjugate_rates(u, psi, side, hob, cut):
    """How the wheel's point moves with ``u`` and ``psi``, seen from the wheel.

    Returns ``(x, y, z, xu, yu, zu, xp, yp, zp, regularity, pole)`` in the standing frame:
    ``regularity`` is the wheel's area element along the normal for one of the hob's surface,
    negative where the surface has turned back on itself (undercut); ``pole`` changes its sign where
    ``zeta`` is infinite.
    """
    rho, _, rho1, place1, rho2, place2 = curve(u, hob)
    p = hob.form.lead
    ratio = cut.ratio
    ce, se = cut.cosine, cut.sine
    c, s = math.cos(psi), math.sin(psi)
    nr = -side * place1 * rho
    nt = -rho1 * p
    na = rho1 * rho
    nr_u = -side * (place2 * rho + place1 * rho1)
    nt_u = -rho2 * p
    na_u = rho2 * rho + rho1 * rho1
    nx = (nr * s + nt * c) * se + na * ce
    nx_u = (nr_u * s + nt_u * c) * se + na_u * ce
    nx_p = (nr * c - nt * s) * se
    ny = nt * s - nr * c
    ny_u = nt_u * s - nr_u * c
    ny_p = nt * c + nr * s
    nz = -(nr * s + nt * c) * ce + na * se
    rx = rho * s * se
    ry = cut.centre_distance - rho * c
    d = ce * ny
    zeta = (ratio * rho * nt - rx * ny + ry * nx) / d
    top_u = (
        ratio * (rho1 * nt + rho * nt_u)
        - rho1 * s * se * ny
        - rx * ny_u
        - rho1 * c * nx
        + ry * nx_u
    )
    top_p = -rho * c * se * ny - rx * ny_p + rho * s * nx + ry * nx_p
    zeta_u = (top_u - zeta * ce * ny_u) / d
    zeta_p = (top_p - zeta * ce * ny_p) / d
    x = rx + zeta * ce
    z = cut.axial_offset - rho * s * ce + zeta * se
    turn_u = -(zeta_u - side * place1) / (p * ratio)
    turn_p = (1.0 - zeta_p / p) / ratio
    xu = rho1 * s * se + zeta_u * ce + turn_u * ry
    yu = -rho1 * c - turn_u * x
    zu = -rho1 * s * ce + zeta_u * se
    xp = rho * c * se + zeta_p * ce + turn_p * ry
    yp = rho * s - turn_p * x
    zp = -rho * c * ce + zeta_p * se
    size = math.sqrt(nr * nr + nt * nt + na * na)
    along = nx * (yu * zp - zu * yp) + ny * (zu * xp - xu * zp) + nz * (xu * yp - yu * xp)
    return x, ry, z, xu, yu, zu, xp, yp, zp, along / (size * size), ny * side / size


@kernel
def conjugate_each(u, psi, side, hob, cut, points, normals, phases):
    """Points and normals on the wheel, where the tooth stands at phase 0, and the phases."""
    for k in range(u.size):
        x, y, z, phase, nx, ny, nz = conjugate(u[k], psi[k], side, hob, cut)
        turn = phase / cut.ratio
        c, s = math.cos(turn), math.sin(turn)
        points[k, 0] = x * c + y * s
        points[k, 1] = y * c - x * s
        points[k, 2] = z
        normals[k, 0] = nx * c + ny * s
        normals[k, 1] = ny * c - nx * s
        normals[k, 2] = nz
        phases[k] = phase

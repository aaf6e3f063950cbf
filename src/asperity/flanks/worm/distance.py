r"""Distance of any point to a worm, with gradient and Hessian, compiled.

The worm is a solid: threads with flanks, rounded tips and tip lands, on a core. The distance
:math:`d` is positive outside. It is exact where the nearest point of the surface is unique; where
thread and core meet, the smaller of both distances is taken.

For ZI the parallel surface of the flank is the flank itself, shifted along the axis. So the
distance is a closed form, :math:`d = \cos\gamma_b\,[w(\rho) - s(\zeta - p\,\psi)]`, as long as the
foot lies above the base cylinder; it is also the distance's own gradient that makes it fast. Any
other flank, the tip's rounding and the radial flank below the base cylinder take Newton's method in
two parameters (`asperity.flanks.worm.foot`). With :math:`I` the metric of the surface,
:math:`B_{ab} = g \cdot S_{,ab}` its curvature along the outward normal :math:`g`, and
:math:`M = I - dB`, the Hessian is :math:`-S_{,a}\,(I^{-1} B M^{-1})_{ab}\,S_{,b}`.

Coordinates are those of the worm's own frame with its axis along z, right-handed, in mm. A worm
turned by :math:`\varphi` is the same solid moved by :math:`-p\,\varphi` along its axis.
"""

import math
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from asperity.arrays import FloatArray
from asperity.errors import InputError
from asperity.flanks.worm.foot import on_arc, on_flank
from asperity.kernels.compiled import kernel

if TYPE_CHECKING:
    # No kernel follows from it.
    from asperity.flanks.worm.helicoid import Helicoid

CLOSED = 0
FLANK = 1
ARC = 2
CYLINDER = 3


# Both are small once inlined, and a call of each costs as much as what it does.
@kernel(inline="always")
def place(x, y, z, worm):
    """``(s, v)``: the side that is nearest or asked for, and the axial place mirrored to s = 1.

    The place counts from the middle of the thread space that the point is in or next to.
    """
    form = worm.form
    pitch = 2.0 * form.half_pitch
    side = form.side
    # The wheel is where x is positive, and there the quotient's angle is twice as fast.
    q = z - form.lead * (math.atan(y / x) if x > 0.0 else math.atan2(y, x))
    q -= pitch * math.floor(q / pitch + 0.5)
    if side == 0.0:
        side = -1.0 if q < 0.0 else 1.0
    return side, side * q


@kernel
def search(rho, v, worm, radial):
    """`nearest` where there is no closed form."""
    form = worm.form
    tip = form.tip
    p = form.lead
    if rho <= 0.5 * form.root:
        return CYLINDER, rho - form.root, rho, 0.0, 0.0, 0.0
    if rho >= tip and v >= form.arc_z:
        return CYLINDER, rho - tip, rho, 0.0, 0.0, 0.0
    kind = FLANK
    r, theta, w, w1, w2, _ = on_flank(rho, v, worm, radial)
    a, b = 1.0, w1
    if r > form.flank_end:
        beta, theta, _ = on_arc(rho, v, worm)
        if beta < 0.0:
            return CYLINDER, rho - tip, rho, 0.0, 0.0, 0.0
        kind = ARC
        w1 = min(beta, form.arc_angle)
        a, b = math.sin(w1), math.cos(w1)
        r = form.arc_radius + form.rounding * b
        w = form.arc_z - form.rounding * a
    dr = rho * math.cos(theta) - r
    dt = -rho * math.sin(theta)
    dz = v - w - p * theta
    lean = p * a / r
    d = (b * dr + lean * dt - a * dz) / math.sqrt(a * a + b * b + lean * lean)
    return kind, d, r, theta, w1, w2


@kernel(inline="always")
def nearest(rho, v, worm):
    """``(kind, d, r, theta, w', w'')``: which surface is nearest, how far, and where its foot is.

    On the flank ``r`` is the foot's radius and the derivatives are the flank's; on the tip's
    rounding the fifth number is the arc's angle; on a cylinder ``r`` is the point's radius.
    """
    form = worm.form
    base = form.base
    t2 = rho * rho - base * base
    closed = radial = False
    kind = CLOSED
    r = rho
    d = theta = w1 = w2 = 0.0
    if base > 0.0:
        radial = t2 <= 0.0
        if not radial:
            t = math.sqrt(t2)
            x = t / base
            d = form.cos_base * (form.lead * (x - math.atan(x)) + form.shift - v)
            foot = t - d * form.sin_base
            radial = foot < 0.0
            closed = not radial and form.closed_from <= foot <= form.closed_to
            w1 = form.lead * x / rho
            w2 = form.lead / (x * rho * rho)
    if not closed:
        kind, d, r, theta, w1, w2 = search(rho, v, worm, radial)
    if d < 0.0 and v >= form.arc_z and rho - form.tip > d:
        return CYLINDER, rho - form.tip, rho, 0.0, 0.0, 0.0
    if rho - form.root < d:
        return CYLINDER, rho - form.root, rho, 0.0, 0.0, 0.0
    return kind, d, r, theta, w1, w2


@kernel
def bend(a, b, a2, b2, r, p, gr, gt, gz, d):
    """``K`` of the Hessian ``K_ab S_a S_b`` from the tangents (a, 0, b) and (0, r, p)."""
    i11 = a * a + b * b
    i12 = b * p
    i22 = r * r + p * p
    b11 = gr * a2 + gz * b2
    b12 = gt * a
    b22 = -gr * r
    m11 = i11 - d * b11
    m12 = i12 - d * b12
    m22 = i22 - d * b22
    m = m11 * m22 - m12 * m12
    x11 = (b11 * m22 - b12 * m12) / m
    x12 = (b12 * m11 - b11 * m12) / m
    x21 = (b12 * m22 - b22 * m12) / m
    x22 = (b22 * m11 - b12 * m12) / m
    i = i11 * i22 - i12 * i12
    k11 = -(i22 * x11 - i12 * x21) / i
    k12 = -(i22 * x12 - i12 * x22) / i
    k22 = -(i11 * x22 - i12 * x12) / i
    return k11, k12, k22


@kernel
def distance_only(x, y, z, worm):
    """Distance of a point to the worm, mm; ``worm`` from `Helicoid.facing`."""
    rho = math.sqrt(x * x + y * y)
    _, v = place(x, y, z, worm)
    _, d, _, _, _, _ = nearest(rho, v, worm)
    return d


@kernel
def distance(x, y, z, worm):
    """``(d, gx, gy, gz, hxx, hyy, hzz, hxy, hxz, hyz)`` of the distance to the worm, in mm.

    ``worm`` from `Helicoid.facing`. The gradient has unit length.
    """
    form = worm.form
    rho = math.sqrt(x * x + y * y)
    s, v = place(x, y, z, worm)
    kind, d, r, theta, w1, w2 = nearest(rho, v, worm)
    cosine = 1.0
    sine = 0.0
    if rho > 0.0:
        cosine = x / rho
        sine = y / rho
    p = form.lead
    if kind == CLOSED:
        size = form.cos_base
        gr = size * w1
        gt = size * s * p / rho
        gz = -size * s
        hrr = size * w2
        htt = size * w1 / rho
        hrt = -gt / rho
        hrz = htz = hzz = 0.0
    elif kind == CYLINDER:
        gr = 1.0
        gt = gz = hrr = hrt = hrz = htz = hzz = 0.0
        htt = 1.0 / max(rho, 1e-9 * form.tip)
    else:
        if kind == FLANK:
            a, b, a2, b2 = 1.0, w1, 0.0, w2
        else:
            arc = form.rounding
            a, b = arc * math.sin(w1), arc * math.cos(w1)
            a2, b2 = -b, a
        lean = p * a / r
        size = math.sqrt(a * a + b * b + lean * lean)
        gr = b / size
        gt = lean / size
        gz = -a / size
        k11, k12, k22 = bend(a, b, a2, b2, r, p, gr, gt, gz, d)
        hrr = k11 * a * a
        htt = k22 * r * r
        hzz = k11 * b * b + 2.0 * k12 * b * p + k22 * p * p
        hrt = k12 * a * r * s
        hrz = (k11 * b + k12 * p) * a * s
        htz = (k12 * b + k22 * p) * r
        gt *= s
        gz *= s
        turned = math.sin(theta) * s
        straight = math.cos(theta)
        cosine, sine = cosine * straight - sine * turned, sine * straight + cosine * turned
    cc = cosine * cosine
    ss = sine * sine
    cs = cosine * sine
    return (
        d,
        gr * cosine - gt * sine,
        gr * sine + gt * cosine,
        gz,
        hrr * cc - 2.0 * hrt * cs + htt * ss,
        hrr * ss + 2.0 * hrt * cs + htt * cc,
        hzz,
        (hrr - htt) * cs + hrt * (cc - ss),
        hrz * cosine - htz * sine,
        hrz * sine + htz * cosine,
    )


@kernel
def distance_only_each(points, worm, out):
    """`distance_only` of every row of ``points``."""
    for i in range(points.shape[0]):
        out[i] = distance_only(points[i, 0], points[i, 1], points[i, 2], worm)


@kernel
def feet_each(points, worm, out, kinds):
    """`distance_only` of every row of ``points``, and on which surface of the worm its foot is."""
    for i in range(points.shape[0]):
        x, y = points[i, 0], points[i, 1]
        rho = math.sqrt(x * x + y * y)
        _, v = place(x, y, points[i, 2], worm)
        kind, d, _, _, _, _ = nearest(rho, v, worm)
        out[i] = d
        kinds[i] = kind


def _rows(points: npt.ArrayLike) -> tuple[FloatArray, tuple[int, ...]]:
    given = np.asarray(points, dtype=np.float64)
    if given.shape[-1:] != (3,):
        raise InputError(f"the points have the shape {given.shape}; it must end with 3")
    if not np.isfinite(given).all():
        raise InputError("a point is not finite; distances are between finite points")
    return np.ascontiguousarray(given.reshape(-1, 3)), given.shape[:-1]


def distances(points: npt.ArrayLike, helicoid: "Helicoid", side: int = 0) -> FloatArray:
    """Return the distances of points (..., 3) in the worm's own frame, mm, positive outside.

    ``side`` is the flank of the thread space that counts, 1 or -1; 0: the nearest.

    Raises
    ------
    InputError
        The points are not finite, or not points.
    """
    rows, shape = _rows(points)
    out = np.empty(rows.shape[0])
    distance_only_each(rows, helicoid.facing(side), out)
    return out.reshape(shape)

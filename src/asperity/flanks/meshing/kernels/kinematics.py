r"""Where a point of the wheel comes nearest to a turning helicoid, and how they move there.

A point fixed to the wheel stands at :math:`r(\beta)`; the helicoid has turned by
:math:`\varphi` and the wheel by :math:`\beta = \varphi/i + e`. In the helicoid's standing axes the
distance is :math:`F(\varphi) = d(r - O, \varphi)`, and with the turning of both for one radian of
the helicoid, :math:`\Omega_1 = e_z` and :math:`\Omega_2 = Z/i`,

.. math::
    w &= \Omega_2 \times r - \Omega_1 \times (r - O), \qquad F' = g \cdot w, \\
    F'' &= w \cdot H w + g \cdot [\Omega_2 \times (\Omega_2 \times r)
           - \Omega_1 \times (\Omega_1 \times (r - O)) - 2\, \Omega_1 \times w], \\
    f &= \partial F'/\partial r = H w + g \times (\Omega_2 - \Omega_1),

with the gradient :math:`g` and the Hessian :math:`H` of the distance. :math:`F' = 0` is the
equation of meshing. Where it holds, the phase of nearest approach changes along the wheel's flank
by :math:`\nabla\varphi = -f_t/F''`, and the surface that the helicoid envelops has the second
fundamental form :math:`H_t - f_t f_t^T/F''`: the index :math:`t` is the part in the tangent plane.

Lengths are in mm, angles in rad; the frame is that of the right-handed gearset.
"""

import math

from asperity.compiled import kernel
from asperity.flanks.wheel.cutting.conjugate import CENTRE, COSINE, OFFSET, RATIO, SINE
from asperity.flanks.worm.curve import FLANK_END, LEAD
from asperity.flanks.worm.distance import distance

PHASE = 0
DISTANCE = 1
GRADIENT = 2
HESSIAN = 5
VELOCITY = 11
CHANGE = 14
SECOND = 17
PLACE = 18
CONVERGED = 21
REACH = 22
WIDTH = 23

_STEPS = 80
_NEWTON = 12
_SMALL = 1e-11
_LARGEST_STEP = 0.1


@kernel
def to_axes(x, y, z, mount):
    """Coordinates of a point of the wheel's standing frame in the helicoid's standing axes."""
    dz = z - mount[OFFSET]
    return (
        mount[CENTRE] - y,
        x * mount[SINE] - dz * mount[COSINE],
        x * mount[COSINE] + dz * mount[SINE],
    )


@kernel
def turned(point, beta):
    """Coordinates of a point of the wheel once the wheel has turned by ``beta``."""
    c, s = math.cos(beta), math.sin(beta)
    return point[0] * c - point[1] * s, point[0] * s + point[1] * c, point[2]


@kernel
def meet(point, phase, ahead, mount, params, row):
    """Fill ``row`` with what holds at a phase; the indices above say where."""
    ratio = mount[RATIO]
    x, y, z = turned(point, phase / ratio + ahead)
    a, b, c = to_axes(x, y, z, mount)
    d, ga, gb, gc, haa, hbb, hcc, hab, hac, hbc = distance(a, b, c + params[LEAD] * phase, params)
    ce, se = mount[COSINE] / ratio, mount[SINE] / ratio
    # The wheel's own turning and the place seen from its axis, in the helicoid's axes.
    wheel_a = a - mount[CENTRE]
    wheel_b = b - mount[COSINE] * mount[OFFSET]
    wheel_c = c + mount[SINE] * mount[OFFSET]
    va = -ce * wheel_c - se * wheel_b
    vb = se * wheel_a
    vc = ce * wheel_a
    wa, wb, wc = va + b, vb - a, vc
    # Relative acceleration: of the wheel, less that of the turning axes and Coriolis's.
    aa = -ce * vc - se * vb + a + 2.0 * wb
    ab = se * va + b - 2.0 * wa
    ac = ce * va
    ha = haa * wa + hab * wb + hac * wc
    hb = hab * wa + hbb * wb + hbc * wc
    hc = hac * wa + hbc * wb + hcc * wc
    oc = se - 1.0
    row[PHASE] = phase
    row[DISTANCE] = d
    row[GRADIENT], row[GRADIENT + 1], row[GRADIENT + 2] = ga, gb, gc
    row[HESSIAN], row[HESSIAN + 1], row[HESSIAN + 2] = haa, hbb, hcc
    row[HESSIAN + 3], row[HESSIAN + 4], row[HESSIAN + 5] = hab, hac, hbc
    row[VELOCITY], row[VELOCITY + 1], row[VELOCITY + 2] = wa, wb, wc
    row[CHANGE] = ha + gb * oc + gc * ce
    row[CHANGE + 1] = hb - ga * oc
    row[CHANGE + 2] = hc - ga * ce
    row[SECOND] = wa * ha + wb * hb + wc * hc + ga * aa + gb * ab + gc * ac
    row[PLACE], row[PLACE + 1], row[PLACE + 2] = a, b, c
    foot = math.hypot(a - d * ga, b - d * gb)
    row[REACH] = params[FLANK_END] - foot
    return ga * wa + gb * wb + gc * wc, row[SECOND]


@kernel
def meet_each(points, phases, ahead, mount, params, rows):
    """`meet` of points each at its own phase."""
    for k in range(points.shape[0]):
        meet(points[k], phases[k], ahead, mount, params, rows[k])
        rows[k, CONVERGED] = 1.0


@kernel
def approach_each(points, phases, ahead, mount, params, rows):
    """`meet` of points at the phase of nearest approach, by Newton's method from a guess.

    It is bracketed, since the curvature jumps where the worm's flank goes over into its tip.
    """
    for k in range(points.shape[0]):
        phase = phases[k]
        low, high = -math.inf, math.inf
        rows[k, CONVERGED] = 0.0
        for n in range(_STEPS):
            rate, second = meet(points[k], phase, ahead, mount, params, rows[k])
            if rate < 0.0:
                low = phase
            else:
                high = phase
            # Downhill also where the distance is not convex over the phase.
            step = -rate / second if second > 0.0 else -math.copysign(_LARGEST_STEP, rate)
            step = min(max(step, -_LARGEST_STEP), _LARGEST_STEP)
            following = phase + step
            if not low <= following <= high or (n > _NEWTON and math.isfinite(high - low)):
                following = 0.5 * (low + high)
            # At the minimum, what is left counts with its square.
            if abs(following - phase) <= _SMALL:
                rows[k, CONVERGED] = 1.0
                break
            phase = following

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

import numpy as np

from asperity.flanks.wheel.cutting.conjugate import to_axes, turned
from asperity.flanks.worm.distance import distance
from asperity.kernels.compiled import kernel

MEETING = np.dtype(
    [
        ("phase", np.float64),
        ("distance", np.float64),
        ("gradient", np.float64, 3),
        ("hessian", np.float64, 6),
        ("velocity", np.float64, 3),
        ("change", np.float64, 3),
        ("second", np.float64),
        ("place", np.float64, 3),
        ("converged", np.bool_),
        ("reach", np.float64),
    ],
    align=True,
)
"""What holds where a point is nearest, in the order of the equations above, and where that is."""

_STEPS = 80
_NEWTON = 12
_SMALL = 1e-11
_LARGEST_STEP = 0.1


@kernel
def fill(three, a, b, c):
    """Write three numbers."""
    three[0], three[1], three[2] = a, b, c


@kernel
def meet(point, phase, ahead, mount, worm, row):
    """Fill a `MEETING` with what holds at a phase."""
    ratio = mount.ratio
    turn = phase / ratio + ahead
    x, y, z = turned(point, math.cos(turn), math.sin(turn))
    a, b, c = to_axes(x, y, z, mount)
    along = c + worm.form.lead * phase
    d, ga, gb, gc, haa, hbb, hcc, hab, hac, hbc = distance(a, b, along, worm)
    ce, se = mount.cosine / ratio, mount.sine / ratio
    # The wheel's own turning and the place seen from its axis, in the helicoid's axes.
    wheel_a = a - mount.centre_distance
    wheel_b = b - mount.cosine * mount.axial_offset
    wheel_c = c + mount.sine * mount.axial_offset
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
    row.phase = phase
    row.distance = d
    fill(row.gradient, ga, gb, gc)
    fill(row.hessian, haa, hbb, hcc)
    fill(row.hessian[3:], hab, hac, hbc)
    fill(row.velocity, wa, wb, wc)
    fill(row.change, ha + gb * oc + gc * ce, hb - ga * oc, hc - ga * ce)
    row.second = wa * ha + wb * hb + wc * hc + ga * aa + gb * ab + gc * ac
    fill(row.place, a, b, c)
    foot = math.hypot(a - d * ga, b - d * gb)
    row.reach = worm.form.flank_end - foot
    return ga * wa + gb * wb + gc * wc, row.second


@kernel
def meet_each(points, phases, ahead, mount, worm, rows):
    """`meet` of points each at its own phase."""
    for k in range(points.shape[0]):
        meet(points[k], phases[k], ahead, mount, worm, rows[k])
        rows[k].converged = True


@kernel
def approach_each(points, phases, ahead, mount, worm, rows):
    """`meet` of points at the phase of nearest approach, by Newton's method from a guess.

    It is bracketed, since the curvature jumps where the worm's flank goes over into its tip.
    """
    for k in range(points.shape[0]):
        phase = phases[k]
        low, high = -math.inf, math.inf
        rows[k].converged = False
        for n in range(_STEPS):
            rate, second = meet(points[k], phase, ahead, mount, worm, rows[k])
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
                rows[k].converged = True
                break
            phase = following

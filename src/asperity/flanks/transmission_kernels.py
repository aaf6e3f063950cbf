r"""The place of a wheel's tooth that bears first on the worm, found below any grid.

A worm that turns touches a point of the tooth, held where the wheel has turned by :math:`\beta`,
when the axial way between both is used up. Since a turn :math:`\varphi` carries the thread by
:math:`p\varphi`, the angle is a closed form for any flank,

.. math:: s\varphi = s\psi + [w(\rho) - s\zeta]/p ,

with the point's cylindrical coordinates :math:`(\rho, \psi, \zeta)` in the worm's standing axes;
beyond the worm's tip there is no such angle. The least :math:`s\varphi` over the tooth is where it
bears. It is looked for column by column along the wheel's axis, in each by radius, with parabolas
in a bracket: a minimum on the flank's edge is one as well.

The same search takes the least distance to the worm at a given phase instead (``mode``).
"""

import math

import numpy as np

from asperity.compiled import kernel
from asperity.flanks.conjugate import RATIO, conjugate
from asperity.flanks.curve import ARC_RADIUS, ARC_Z, FLANK_END, LEAD, ROUNDING, TIP, width
from asperity.flanks.distance import distance_only
from asperity.flanks.kinematics_kernels import to_axes
from asperity.flanks.trim import FIELDS, NODES, PSI, RADIUS, REACHED, U, locate
from asperity.flanks.undercut import section

TURN = 0
NEAR = 1

CENTRE = 0
THROAT = 1
OUTSIDE = 2
HALF_FACE = 3

_STEPS = 40
_GOLDEN = 0.381966011250105
# Of a bracket's width; the value is then off by its square.
_NARROW = 1e-7
# Where values differ by rounding only, as along the contact line of an identical hob.
_EVEN = 1e-15


@kernel
def half_space(rho, worm):
    """Half the axial width of the worm's thread space, the tip's rounding included."""
    if rho <= worm[FLANK_END]:
        return width(rho, worm)[0]
    if rho >= worm[TIP]:
        return math.inf
    x = rho - worm[ARC_RADIUS]
    return worm[ARC_Z] - math.sqrt(max(worm[ROUNDING] ** 2 - x * x, 0.0))


@kernel
def measure(x, y, z, beta, phase, mode, side, worm, mount):
    """What is minimised at a point: the turn ``s phi`` to contact, or the distance at a phase."""
    c, s = math.cos(beta), math.sin(beta)
    a, b, q = to_axes(x * c - y * s, x * s + y * c, z, mount)
    if mode == NEAR:
        return distance_only(a, b, q + worm[LEAD] * phase, worm)
    return side * math.atan2(b, a) + (half_space(math.hypot(a, b), worm) - side * q) / worm[LEAD]


@kernel
def next_place(a, fa, b, fb, c, fc):
    """Where to look next between ``a <= b <= c``, of which ``b`` is the lowest."""
    left, right = b - a, c - b
    if left > 0.0 and right > 0.0:
        down, up = (fa - fb) / left, (fc - fb) / right
        t = b + 0.5 * (down * right - up * left) / (down + up)
        if a < t < c and abs(t - b) > 0.0:
            return t
    return b + _GOLDEN * right if right > left else b - _GOLDEN * left


@kernel
def narrowed(a, fa, b, fb, c, fc, t, ft):
    """The bracket with one more place ``t``."""
    if ft <= fb:
        if t > b:
            return b, fb, t, ft, c, fc
        return a, fa, t, ft, b, fb
    if t > b:
        return a, fa, b, fb, t, ft
    return t, ft, b, fb, c, fc


@kernel
def of_node(u, psi, beta, phase, mode, side, hob, cut, worm, mount):
    """`measure` of the point of the wheel that the hob cuts at ``(u, psi)``."""
    x, y, z, own, _, _, _ = conjugate(u, psi, side, hob, cut)
    return measure(x, y, z, beta - own / cut[RATIO], phase, mode, side, worm, mount)


@kernel
def tip_radius(z, blank):
    """Radius of the blank at a place on its axis."""
    throat = blank[CENTRE] - math.sqrt(max(blank[THROAT] ** 2 - z * z, 0.0))
    return min(throat, blank[OUTSIDE])


@kernel
def least_on_column(z, beta, phase, mode, side, hob, cut, worm, mount, blank, nodes):
    """``(value, radius)`` of the least measure on the flank at a place ``z``; inf if there is none.

    The nodes of the traced section bracket it.
    """
    stop = tip_radius(z, blank)
    _, flank, count, status, _ = section(z, stop, side, hob, cut, nodes)
    if status != REACHED:
        return math.inf, 0.0
    u, psi = locate(stop, flank, count - 1, z, side, hob, cut, nodes)
    last = count - 1
    nodes[last, U], nodes[last, PSI], nodes[last, RADIUS] = u, psi, stop
    a, b, c = nodes[flank, RADIUS], nodes[flank, RADIUS], stop
    fb = math.inf
    fa = fc = fb
    before = fb
    rising = False
    for k in range(flank, count):
        value = of_node(nodes[k, U], nodes[k, PSI], beta, phase, mode, side, hob, cut, worm, mount)
        if value < fb:
            a, fa = nodes[max(k - 1, flank), RADIUS], before if k > flank else value
            b, fb = nodes[k, RADIUS], value
            c, fc = b, fb
            rising = True
        elif rising:
            c, fc = nodes[k, RADIUS], value
            rising = False
        before = value
    if fb == math.inf:
        return fb, 0.0
    narrow = _NARROW * (c - a)
    for _ in range(_STEPS):
        if c - a <= 2.0 * narrow or fa + fc - 2.0 * fb <= _EVEN * (1.0 + abs(fb)):
            break
        t = next_place(a, fa, b, fb, c, fc)
        if abs(t - b) < narrow:
            # The parabola has found it; what is left of the bracket is not looked at.
            if a < b < c:
                break
            t = b + narrow if c > b else b - narrow
        u, psi = locate(t, flank, last, z, side, hob, cut, nodes)
        ft = of_node(u, psi, beta, phase, mode, side, hob, cut, worm, mount)
        a, fa, b, fb, c, fc = narrowed(a, fa, b, fb, c, fc, t, ft)
    return fb, b


@kernel
def least_on_tooth(columns, start, beta, phase, mode, side, hob, cut, worm, mount, blank):
    """``(value, radius, z)`` of the least measure on the flank, from the column nearest to it."""
    nodes = np.empty((NODES, FIELDS))
    given = (beta, phase, mode, side, hob, cut, worm, mount, blank, nodes)
    j = start
    b = columns[j]
    fb, radius = least_on_column(b, *given)
    low = max(j - 1, 0)
    high = min(j + 1, columns.size - 1)
    a, c = columns[low], columns[high]
    fa = least_on_column(a, *given)[0] if low < j else fb
    fc = least_on_column(c, *given)[0] if high > j else fb
    while fa < fb or fc < fb:
        if fa < fc:
            c, fc, b, fb = b, fb, a, fa
            low -= 1
            a = columns[max(low, 0)]
            fa = least_on_column(a, *given)[0] if low >= 0 else fb
        else:
            a, fa, b, fb = b, fb, c, fc
            high += 1
            c = columns[min(high, columns.size - 1)]
            fc = least_on_column(c, *given)[0] if high < columns.size else fb
        radius = least_on_column(b, *given)[1]
    narrow = _NARROW * (c - a)
    for _ in range(_STEPS):
        even = fa + fc - 2.0 * fb <= _EVEN * (1.0 + abs(fb))
        if c - a <= 2.0 * narrow or fb == math.inf or even:
            break
        t = next_place(a, fa, b, fb, c, fc)
        if abs(t - b) < narrow:
            if a < b < c:
                break
            t = b + narrow if c > b else b - narrow
        ft, found = least_on_column(t, *given)
        if ft <= fb:
            radius = found
        a, fa, b, fb, c, fc = narrowed(a, fa, b, fb, c, fc, t, ft)
    return fb, radius, b


@kernel
def scan(points, beta, phase, mode, side, worm, mount):
    """``(value, column)`` of the least measure over the points of a grid."""
    best = math.inf
    at = -1
    for j in range(points.shape[1]):
        for i in range(points.shape[0]):
            x, y, z = points[i, j, 0], points[i, j, 1], points[i, j, 2]
            value = measure(x, y, z, beta, phase, mode, side, worm, mount)
            if value < best:
                best = value
                at = j
    return best, at


@kernel
def least_each(points, columns, betas, phases, mode, side, hob, cut, worm, mount, blank, near, out):
    """Least measures at every place of the wheel: value, radius and z by columns of ``out``.

    Those above ``near`` are left as they are at the points of the grid, and have no radius.
    """
    for k in range(betas.size):
        out[k, 0], at = scan(points, betas[k], phases[k], mode, side, worm, mount)
        out[k, 1] = 0.0
        out[k, 2] = columns[max(at, 0)]
        if at >= 0 and out[k, 0] <= near[k]:
            out[k, 0], out[k, 1], out[k, 2] = least_on_tooth(
                columns, at, betas[k], phases[k], mode, side, hob, cut, worm, mount, blank
            )

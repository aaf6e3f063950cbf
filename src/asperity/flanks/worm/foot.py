"""The point of a worm nearest to a given one, as compiled functions.

A point is given by its radius and its axial place ``v`` from the middle of a thread space, mirrored
so that the flank is ``zeta = w(rho) + p theta``. Angles count from the point's own. The foot is
where the way to the point stands square on both tangents of the surface: two equations, solved by
Newton's method with the surface's curvature, and without it where that would lead to a saddle.
"""

import math

from asperity.flanks.worm.curve import width
from asperity.kernels.compiled import kernel

MOST_ITERATIONS = 60
# A step this small, as a part of the tip radius, leaves nothing after it but rounding.
_SMALL = 1e-8
_LEAST_DETERMINANT = 0.05


@kernel
def newton_step(e1, e2, i11, i12, i22, c11, c12, c22):
    """Step of both parameters from what is left of the two equations.

    The metric ``i`` less the curvature times the distance ``c`` is the exact matrix.
    """
    m11 = i11 - c11
    m12 = i12 - c12
    m22 = i22 - c22
    determinant = m11 * m22 - m12 * m12
    bound = i11 * i22 - i12 * i12
    if m11 <= 0.0 or determinant < _LEAST_DETERMINANT * bound:
        m11, m12, m22, determinant = i11, i12, i22, bound
    return (m22 * e1 - m12 * e2) / determinant, (m11 * e2 - m12 * e1) / determinant


@kernel
def width_of(r, worm, radial):
    """`width`, or that of the radial flank below the base cylinder of ZI."""
    if radial:
        return worm.form.shift, 0.0, 0.0
    return width(r, worm)


@kernel
def on_flank(rho, v, worm, radial):
    """``(r, theta, w, w', w'', steps)`` of the foot on the flank, as if it had no end.

    ``radial`` takes the flank as it is below the base cylinder of ZI.
    """
    form = worm.form
    p = form.lead
    tip = form.tip
    reach = tip - form.root
    most = tip + reach
    least = 0.1 * form.root
    r = min(rho, most)
    w, w1, w2 = width_of(r, worm, radial)
    gap = (w - v) / (1.0 + w1 * w1 + p * p / (r * r))
    theta = -gap * p / (r * r)
    r -= gap * w1
    steps = 0
    while steps < MOST_ITERATIONS:
        steps += 1
        r = min(max(r, least), most)
        w, w1, w2 = width_of(r, worm, radial)
        dr = rho * math.cos(theta) - r
        dt = -rho * math.sin(theta)
        dz = v - w - p * theta
        step, turn = newton_step(
            dr + w1 * dz,
            r * dt + p * dz,
            1.0 + w1 * w1,
            w1 * p,
            r * r + p * p,
            w2 * dz,
            dt,
            -r * dr,
        )
        step = min(max(step, -0.5 * reach), 0.5 * reach)
        turn = min(max(turn, -0.5), 0.5)
        r += step
        theta += turn
        if step * step + r * r * turn * turn <= (_SMALL * tip) ** 2:
            break
    w, w1, w2 = width_of(r, worm, radial)
    return r, theta, w, w1, w2, steps


@kernel
def on_arc(rho, v, worm):
    """``(beta, theta, steps)`` of the foot on the tip's rounding; ``beta`` is 0 at the land."""
    form = worm.form
    p = form.lead
    arc = form.rounding
    centre = form.arc_radius
    whole = form.arc_angle
    beta = math.atan2(form.arc_z - v, rho - centre)
    beta = min(max(beta, 0.0), whole)
    r = centre + arc * math.cos(beta)
    theta = p * (v - form.arc_z + arc * math.sin(beta)) / (r * r + p * p)
    steps = 0
    while steps < MOST_ITERATIONS:
        steps += 1
        sine = arc * math.sin(beta)
        cosine = arc * math.cos(beta)
        r = centre + cosine
        dr = rho * math.cos(theta) - r
        dt = -rho * math.sin(theta)
        dz = v - form.arc_z + sine - p * theta
        step, turn = newton_step(
            -sine * dr - cosine * dz,
            r * dt + p * dz,
            arc * arc,
            -cosine * p,
            r * r + p * p,
            sine * dz - cosine * dr,
            -sine * dt,
            -r * dr,
        )
        step = min(max(step, -0.5), 0.5)
        turn = min(max(turn, -0.5), 0.5)
        before = beta
        beta = min(max(beta + step, -0.5), whole + 0.5)
        theta += turn
        step = arc * (beta - before)
        if step * step + r * r * turn * turn <= (_SMALL * form.tip) ** 2:
            break
    return beta, theta, steps

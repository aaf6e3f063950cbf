"""The generating curve of a worm or hob: flank, tip rounding and tip land, as compiled functions.

A helicoid is one array of numbers here, laid out by the indices below, with those of its
`AxialProfile` at the end. The thread space's middle is at ``zeta = p theta``; ``z`` is the distance
from there, so that both sides have the same curve.
"""

import math

from asperity.compiled import kernel
from asperity.flanks.worm.profiles import axial_at

SIDE = 0
LEAD = 1
HALF_PITCH = 2
SHIFT = 3
ROOT = 4
TIP = 5
ROUNDING = 6
ARC_RADIUS = 7
ARC_Z = 8
ARC_ANGLE = 9
FLANK_END = 10
RELIEF_FROM = 11
RELIEF = 12
BASE = 13
COS_BASE = 14
SIN_BASE = 15
CLOSED_TO = 16
PROFILE = 17


@kernel
def width(rho, params):
    """``(w, w', w'')``: half the thread space at a radius, as the flank goes on."""
    w, w1, w2 = axial_at(rho, params, PROFILE)
    w += params[SHIFT]
    x = rho - params[RELIEF_FROM]
    if x > 0.0:
        c = params[RELIEF]
        w += c * x * x * x
        w1 += 3.0 * c * x * x
        w2 += 6.0 * c * x
    return w, w1, w2


@kernel
def curve(u, params):
    """``(rho, z, rho', z', rho'', z'')`` of the generating curve, derivatives by ``u``.

    ``u`` runs from 0 at the root to 1 at the end of the flank, to 2 round the tip, and to 3 in the
    middle of the thread. Direction and normal have no jump; the derivatives' size has, at 1 and 2.
    """
    if u <= 1.0:
        root = params[ROOT]
        length = params[FLANK_END] - root
        rho = root + u * length
        w, w1, w2 = width(rho, params)
        return rho, w, length, w1 * length, 0.0, w2 * length * length
    if u <= 2.0:
        r = params[ROUNDING]
        whole = params[ARC_ANGLE]
        beta = whole * (2.0 - u)
        cosine = r * math.cos(beta)
        sine = r * math.sin(beta)
        return (
            params[ARC_RADIUS] + cosine,
            params[ARC_Z] - sine,
            sine * whole,
            cosine * whole,
            -cosine * whole * whole,
            sine * whole * whole,
        )
    length = params[HALF_PITCH] - params[ARC_Z]
    return params[TIP], params[ARC_Z] + (u - 2.0) * length, 0.0, length, 0.0, 0.0


@kernel
def curve_each(u, params, out):
    """`curve` at every ``u``, by columns of ``out``."""
    for i in range(u.size):
        out[0, i], out[1, i], out[2, i], out[3, i], out[4, i], out[5, i] = curve(u[i], params)


@kernel
def width_each(rho, params, out):
    """`width` at every radius, by columns of ``out``."""
    for i in range(rho.size):
        out[0, i], out[1, i], out[2, i] = width(rho[i], params)

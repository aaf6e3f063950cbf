"""The generating curve of a worm or hob: flank, tip rounding and tip land, as compiled functions.

The thread space's middle is at ``zeta = p theta``; ``z`` is the distance from there, so that both
sides have the same curve.
"""

import math
from typing import Any, NamedTuple

import numpy as np

from asperity.arrays import FloatArray
from asperity.flanks.worm.profiles import SECTION, axial
from asperity.kernels.compiled import kernel

FORM = np.dtype(
    [
        *(
            (name, np.float64)
            for name in (
                *("side", "lead", "half_pitch", "shift", "root", "tip", "rounding"),
                *("arc_radius", "arc_z", "arc_angle", "flank_end", "relief_from", "relief"),
                *("root_relief_from", "root_relief_to", "root_relief"),
                *("base", "cos_base", "sin_base", "closed_from", "closed_to"),
            )
        ),
        ("section", SECTION),
    ]
)
"""Numbers of a helicoid, lengths in mm.

``side`` is the flank that counts, 0 for the nearest; ``lead`` is for one radian; ``shift`` is what
the axial section lacks to half the thread space; the arc is that of the tip's rounding, with its
middle's radius and axial place; ``closed_from`` and ``closed_to`` are between which lengths of its
generator from the base cylinder the distance to an involute helicoid is a closed form.
"""


class Thread(NamedTuple):
    """A helicoid as the kernels take it: a record of `FORM`, and the table of its axial section."""

    form: Any
    table: FloatArray


@kernel
def width(rho, worm):
    """``(w, w', w'')``: half the thread space at a radius, as the flank goes on."""
    form = worm.form
    w, w1, w2 = axial(rho, form.section, worm.table)
    w += form.shift
    x = rho - form.relief_from
    if x > 0.0:
        c = form.relief
        w += c * x * x * x
        w1 += 3.0 * c * x * x
        w2 += 6.0 * c * x
    if rho < form.root_relief_from:
        length = form.root_relief_from - form.root_relief_to
        t = min((form.root_relief_from - rho) / length, 1.0)
        c = form.root_relief
        w += c * t * t * t * (10.0 - t * (15.0 - 6.0 * t))
        c *= 30.0 * t * (1.0 - t) / length
        w1 -= c * t * (1.0 - t)
        w2 += 2.0 * c * (1.0 - 2.0 * t) / length
    return w, w1, w2


@kernel
def curve(u, worm):
    """``(rho, z, rho', z', rho'', z'')`` of the generating curve, derivatives by ``u``.

    ``u`` runs from 0 at the root to 1 at the end of the flank, to 2 round the tip, and to 3 in the
    middle of the thread. Direction and normal have no jump; the derivatives' size has, at 1 and 2.
    """
    form = worm.form
    if u <= 1.0:
        root = form.root
        length = form.flank_end - root
        rho = root + u * length
        w, w1, w2 = width(rho, worm)
        return rho, w, length, w1 * length, 0.0, w2 * length * length
    if u <= 2.0:
        r = form.rounding
        whole = form.arc_angle
        beta = whole * (2.0 - u)
        cosine = r * math.cos(beta)
        sine = r * math.sin(beta)
        return (
            form.arc_radius + cosine,
            form.arc_z - sine,
            sine * whole,
            cosine * whole,
            -cosine * whole * whole,
            sine * whole * whole,
        )
    length = form.half_pitch - form.arc_z
    return form.tip, form.arc_z + (u - 2.0) * length, 0.0, length, 0.0, 0.0


@kernel
def curve_each(u, worm, out):
    """`curve` at every ``u``, by columns of ``out``."""
    for i in range(u.size):
        out[0, i], out[1, i], out[2, i], out[3, i], out[4, i], out[5, i] = curve(u[i], worm)


@kernel
def width_each(rho, worm, out):
    """`width` at every radius, by columns of ``out``."""
    for i in range(rho.size):
        out[0, i], out[1, i], out[2, i] = width(rho[i], worm)

r"""Areas of the wheel's sections across its axis, by Gauss's rule on the exact surfaces.

A side's share of the area of a section, from the wheel's axis to the surface and from the middle of
the tooth to the middle of the tooth space, is by parts

.. math:: \tfrac12\int R^2\,d\varphi = \tfrac12 R_m^2\varphi_m + \int_m^{tip} \varphi R\,dR

with :math:`m` the middle of the tooth space. Lengths in mm.
"""

import numpy as np

from asperity.compiled import kernel
from asperity.flanks.wheel.cutting.trim import NODE, NODES, REACHED, first_psi, locate, slide
from asperity.flanks.wheel.cutting.undercut import body_angle, section


@kernel
def piece(start, end, psi, z, side, hob, cut, knots, weights):
    """``(integral of phi R dR over u from start to end, psi at its last knot)``."""
    total = 0.0
    for k in range(knots.size):
        u = start + (end - start) * 0.5 * (1.0 + knots[k])
        found = slide(u, psi, 0.0, 1.0, z, side, hob, cut)
        psi, radius = found.psi, found.radius
        rate = found.radius_u - found.radius_psi * found.z_u / found.z_psi
        total += weights[k] * body_angle(u, psi, side, hob, cut) * radius * rate
    return 0.5 * (end - start) * total, psi


@kernel
def side_areas(z, stop, side, hob, cut, knots, weights, areas, status):
    """Area of every section on a side of the tooth, mm^2."""
    nodes = np.empty(NODES, NODE)
    for k in range(z.size):
        arc, flank, count, status[k], _ = section(z[k], stop[k], side, hob, cut, nodes)
        if status[k] != REACHED:
            continue
        found = slide(3.0, first_psi(3.0, z[k], hob, cut), 0.0, 1.0, z[k], side, hob, cut)
        psi, radius = found.psi, found.radius
        total = 0.5 * radius * radius * body_angle(3.0, psi, side, hob, cut)
        part, _ = piece(3.0, 2.0, psi, z[k], side, hob, cut, knots, weights)
        total += part
        part, _ = piece(2.0, nodes[arc].u, nodes[0].psi, z[k], side, hob, cut, knots, weights)
        total += part
        half = 0.5 * (stop[k] - nodes[flank].radius)
        for j in range(knots.size):
            radius = nodes[flank].radius + half * (1.0 + knots[j])
            u, psi = locate(radius, flank, count - 1, z[k], side, hob, cut, nodes)
            total += half * weights[j] * body_angle(u, psi, side, hob, cut) * radius
        areas[k] = side * total

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
from typing import Any, NamedTuple

import numpy as np

from asperity.flanks.wheel.cutting.bracket import compiled_minimum
from asperity.flanks.wheel.cutting.conjugate import conjugate, to_axes
from asperity.flanks.wheel.cutting.trim import NODE, NODES, REACHED, keep, locate
from asperity.flanks.wheel.cutting.undercut import section
from asperity.flanks.worm.curve import width
from asperity.flanks.worm.distance import distance_only
from asperity.kernels.compiled import kernel

TURN = 0
NEAR = 1

_STEPS = 80
# Of a bracket's width; the value is then off by its square.
_NARROW = 1e-7
# Where values differ by rounding only, as along the contact line of an identical hob.
_EVEN = 1e-15
# Between points of a grid the flank may come this much nearer than at them, mm.
_DEEPER = 2e-3


class Search(NamedTuple):
    """What is looked for, and of what: the wheel's angle, the worm's phase, `measure`'s mode."""

    beta: float
    phase: float
    mode: int
    side: float
    hob: Any
    cut: Any
    worm: Any
    mount: Any


@kernel
def half_space(rho, worm):
    """Half the axial width of the worm's thread space, the tip's rounding included."""
    form = worm.form
    if rho <= form.flank_end:
        return width(rho, worm)[0]
    if rho >= form.tip:
        return math.inf
    x = rho - form.arc_radius
    return form.arc_z - math.sqrt(max(form.rounding**2 - x * x, 0.0))


@kernel
def measure(x, y, z, beta, phase, mode, side, worm, mount):
    """What is minimised at a point: the turn ``s phi`` to contact, or the distance at a phase."""
    c, s = math.cos(beta), math.sin(beta)
    a, b, q = to_axes(x * c - y * s, x * s + y * c, z, mount)
    if mode == NEAR:
        return distance_only(a, b, q + worm.form.lead * phase, worm)
    way = half_space(math.hypot(a, b), worm) - side * q
    return side * math.atan2(b, a) + way / worm.form.lead


@kernel
def of_node(u, psi, given):
    """`measure` of the point of the wheel that the hob cuts at ``(u, psi)``."""
    x, y, z, own, _, _, _ = conjugate(u, psi, given.side, given.hob, given.cut)
    beta = given.beta - own / given.cut.ratio
    return measure(x, y, z, beta, given.phase, given.mode, given.side, given.worm, given.mount)


@kernel
def resolution(given):
    """How much less a measure may be between points of a grid than at them."""
    return _DEEPER if given.mode == NEAR else _DEEPER / given.worm.form.lead


@kernel
def tip_radius(z, blank):
    """Radius of the blank at a place on its axis."""
    throat = blank.centre_distance - math.sqrt(max(blank.throat_radius**2 - z * z, 0.0))
    return min(throat, blank.outside_radius)


@kernel
def at_radius(radius, z, given, nodes, flank, last):
    """`measure` at a radius of a section."""
    u, psi = locate(radius, flank, last, z, given.side, given.hob, given.cut, nodes)
    return of_node(u, psi, given)


@kernel
def least_between(low, k, high, values, z, given, nodes, flank, last):
    """``(radius, value)`` of the least measure round the node ``k`` of a section."""
    a, b, c = nodes[low].radius, nodes[k].radius, nodes[high].radius
    fa, fb, fc = values[low], values[k], values[high]
    section = (z, given, nodes, flank, last)
    narrow = _NARROW * (c - a)
    return compiled_minimum(at_radius, section, a, fa, b, fb, c, fc, narrow, _STEPS, _EVEN)


@kernel
def least_on_column(z, given, blank, nodes, values):
    """``(value, radius)`` of the least measure on the flank at a place ``z``; inf if there is none.

    ``given`` is a `Search`. The nodes of the traced section bracket every minimum; ``values`` is
    room for theirs.
    """
    side, hob, cut = given.side, given.hob, given.cut
    stop = tip_radius(z, blank)
    _, flank, count, status, _ = section(z, stop, side, hob, cut, nodes)
    if status != REACHED:
        return math.inf, 0.0
    last = count - 1
    u, psi = locate(stop, flank, last, z, side, hob, cut, nodes)
    keep(nodes[last], u, psi, stop, nodes[last].regularity)
    least = math.inf
    for k in range(flank, count):
        values[k] = of_node(nodes[k].u, nodes[k].psi, given)
        least = min(least, values[k])
    best, radius = math.inf, 0.0
    if least == math.inf:
        return best, radius
    limit = least + resolution(given)
    for k in range(flank, count):
        low, high = max(k - 1, flank), min(k + 1, last)
        # Of two equal ones the first.
        behind = values[low] > values[k] or low == k
        if behind and values[high] >= values[k] and values[k] <= limit:
            at, value = least_between(low, k, high, values, z, given, nodes, flank, last)
            if value < best:
                best, radius = value, at
    return best, radius


@kernel
def of_column(z, given, blank, nodes, values, lowest):
    """The value of `least_on_column`; the ``lowest`` and its radius are kept."""
    value, radius = least_on_column(z, given, blank, nodes, values)
    if value <= lowest[0]:
        lowest[0], lowest[1] = value, radius
    return value


@kernel
def least_near(j, columns, found, given, blank, nodes, values, lowest):
    """``(value, radius, z)`` of the least measure round the column ``j``.

    ``found`` has values and radii of the columns; ``lowest`` is room for one of each.
    """
    low, high = max(j - 1, 0), min(j + 1, columns.size - 1)
    a, b, c = columns[low], columns[j], columns[high]
    fa, fb, fc = found[0, low], found[0, j], found[0, high]
    lowest[0], lowest[1] = fb, found[1, j]
    column = (given, blank, nodes, values, lowest)
    narrow = _NARROW * (c - a)
    z, value = compiled_minimum(of_column, column, a, fa, b, fb, c, fc, narrow, _STEPS, _EVEN)
    return value, lowest[1], z


@kernel
def place_of_least(values):
    """Place of the least value, of two equal ones the first."""
    place = 0
    for j in range(1, values.size):
        if values[j] < values[place]:
            place = j
    return place


@kernel
def least_on_tooth(columns, rough, given, blank, nodes, values, found, lowest):
    """``(value, radius, z)`` of the least measure on the flank.

    ``rough`` has the least value of each column on a grid. Columns that may hold the least are
    looked at themselves, and every minimum among them is followed between the columns. The others
    are room for the nodes of a section and their values, for columns, (2, n), and for one, (2,).
    """
    reach = resolution(given)
    last = columns.size - 1
    limit = rough[place_of_least(rough)] + reach
    for j in range(columns.size):
        found[0, j] = found[1, j] = math.inf
        near = min(rough[j], rough[max(j - 1, 0)], rough[min(j + 1, last)])
        if near <= limit:
            found[0, j], found[1, j] = least_on_column(columns[j], given, blank, nodes, values)
    best = math.inf
    radius = z = 0.0
    # A minimum between columns is less deep below them than one between points.
    limit = found[0, place_of_least(found[0])] + 0.2 * reach
    before = math.inf
    for j in range(columns.size):
        value = found[0, j]
        after = found[0, min(j + 1, last)]
        if value < before - _EVEN and value <= after + _EVEN and value <= limit:
            value, r, at = least_near(j, columns, found, given, blank, nodes, values, lowest)
            if value < best:
                best, radius, z = value, r, at
        before = found[0, j]
    return best, radius, z


@kernel
def scan(points, beta, phase, mode, side, worm, mount, rough):
    """Fill ``rough`` with the least measure of each column of a grid, and return the least."""
    for j in range(points.shape[1]):
        rough[j] = math.inf
        for i in range(points.shape[0]):
            x, y, z = points[i, j, 0], points[i, j, 1], points[i, j, 2]
            rough[j] = min(rough[j], measure(x, y, z, beta, phase, mode, side, worm, mount))
    return rough[place_of_least(rough)]


@kernel
def least_each(points, columns, betas, phases, mode, side, hob, cut, worm, mount, blank, near, out):
    """Least measures at every place of the wheel: value, radius and z by columns of ``out``.

    Those above ``near`` are left as they are at the points of the grid, and have no radius.
    """
    nodes = np.empty(NODES, NODE)
    values = np.empty(NODES)
    rough = np.empty(columns.size)
    found = np.empty((2, columns.size))
    lowest = np.empty(2)
    for k in range(betas.size):
        out[k, 0] = scan(points, betas[k], phases[k], mode, side, worm, mount, rough)
        out[k, 1] = 0.0
        out[k, 2] = columns[place_of_least(rough)]
        if out[k, 0] < math.inf and out[k, 0] <= near[k]:
            given = Search(betas[k], phases[k], mode, side, hob, cut, worm, mount)
            out[k, 0], out[k, 1], out[k, 2] = least_on_tooth(
                columns, rough, given, blank, nodes, values, found, lowest
            )

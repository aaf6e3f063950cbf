r"""Deflection of a stepped shaft on two bearings: an Euler beam, and what shear adds.

Between two places the bending moment is linear and the section constant, so that
:math:`E I v'' = M` is integrated exactly. Shear adds :math:`v' = -V/(\kappa G A)` (Timoshenko),
with :math:`\kappa` of a round section after Cowper, :math:`6 (1 + \nu)/(7 + 6 \nu)`.
"""

import itertools
import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from asperity.arrays import FloatArray
from asperity.shafts.statics import PointLoad, Reactions, moments, reactions

POISSON = 0.3
"""Of steel, for shear."""


class Stretch(NamedTuple):
    """A part of a shaft of one diameter, all in mm and MPa.

    Attributes
    ----------
    start, end : float
        Positions, mm.
    diameter : float
        That it bends with, mm.
    """

    start: float
    end: float
    diameter: float


class Deflection(NamedTuple):
    """How a shaft bends.

    Attributes
    ----------
    at : ndarray, shape (places,)
        Positions, mm.
    bent, sheared : ndarray, shape (places, 2)
        By y and z: deflection by bending alone, and what shear adds, mm.
    slope : ndarray, shape (places, 2)
        Of bending, along s, rad.
    """

    at: FloatArray
    bent: FloatArray
    sheared: FloatArray
    slope: FloatArray


def places_of(
    stretches: Sequence[Stretch], others: Sequence[float], between: int = 0
) -> FloatArray:
    """Return where something changes, and so many places between any two, mm.

    Parameters
    ----------
    stretches : sequence of Stretch
        In their order, without gaps, from 0 on.
    others : sequence of float
        Further positions, of bearings and loads, mm.
    between : int
        Places between any two of them.

    Returns
    -------
    ndarray, shape (places,)
        Rising, mm.
    """
    length = stretches[-1].end
    marks = {0.0, length, *(each.start for each in stretches), *others}
    places = np.array(sorted(marks))
    if between:
        finer = [np.linspace(a, b, between + 2)[:-1] for a, b in itertools.pairwise(places)]
        places = np.concatenate([*finer, places[-1:]])
    return places


def deflection(
    stretches: Sequence[Stretch],
    loads: Sequence[PointLoad],
    bearings: tuple[float, float],
    modulus: float,
    *,
    radial_compliance: tuple[float, float] = (0.0, 0.0),
    between: int = 0,
    carried: Reactions | None = None,
) -> Deflection:
    """Return how a shaft bends under point loads.

    Parameters
    ----------
    stretches : sequence of Stretch
        In their order, without gaps, from 0 on.
    loads : sequence of PointLoad
        On the shaft.
    bearings : tuple of float
        Positions, mm.
    modulus : float
        Young's modulus, MPa.
    radial_compliance : tuple of float
        Radial compliance of each bearing, mm/N.
    between : int
        Places between any two where something changes.
    carried : Reactions, optional
        What the bearings carry, where it is known.

    Returns
    -------
    Deflection
        By bending, what shear adds, and slope.
    """
    found = carried or reactions(loads, *bearings)
    at = places_of(stretches, [*bearings, *(load.at for load in loads)], between)
    m = moments(at, loads, found, bearings, (0.0, 0.0))
    ends = np.array([each.end for each in stretches])
    of = np.minimum(np.searchsorted(ends, at[:-1], side="right"), len(stretches) - 1)
    diameter = np.array([each.diameter for each in stretches])[of]
    stiffness = modulus * math.pi / 64.0 * diameter**4
    shape = 6.0 * (1.0 + POISSON) / (7.0 + 6.0 * POISSON)
    shear_stiffness = shape * modulus / (2.0 * (1.0 + POISSON)) * math.pi / 4.0 * diameter**2
    step = np.diff(at)[:, None]
    here, there = m.bending[:-1, 1], m.bending[1:, 0]
    turned = step * (here + there) / (2.0 * stiffness[:, None])
    slope = np.vstack([np.zeros(2), np.cumsum(turned, axis=0)])
    rise = step * slope[:-1] + step**2 * (2.0 * here + there) / (6.0 * stiffness[:, None])
    bent = np.vstack([np.zeros(2), np.cumsum(rise, axis=0)])
    slid = -step * m.shear[:-1, 1] / shear_stiffness[:, None]
    sheared = np.vstack([np.zeros(2), np.cumsum(slid, axis=0)])
    first, second = (int(np.argmin(np.abs(at - place))) for place in bearings)
    along = ((at - at[first]) / (at[second] - at[first]))[:, None]
    rest = [np.array(force) * give for force, give in
            zip((found.first, found.second), radial_compliance, strict=True)]  # fmt: skip

    def seated(values: FloatArray, ends: Sequence[FloatArray]) -> FloatArray:
        a, b = values[first] - ends[0], values[second] - ends[1]
        return np.asarray(values - (a + along * (b - a)))

    tilt = (bent[second] - rest[1] - bent[first] + rest[0]) / (at[second] - at[first])
    return Deflection(at, seated(bent, rest), seated(sheared, [np.zeros(2)] * 2), slope - tilt)


def at_position(
    deflection: Deflection, position: float
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return bending, shear and slope at a place where something changes, by y and z.

    Parameters
    ----------
    deflection : Deflection
        Of the shaft.
    position : float
        One of its positions, mm.

    Returns
    -------
    bent, sheared, slope : ndarray, shape (2,)
        By y and z; mm, mm and rad.
    """
    index = int(np.argmin(np.abs(deflection.at - position)))
    return deflection.bent[index], deflection.sheared[index], deflection.slope[index]


def mesh_compliance(
    stretches: Sequence[Stretch],
    bearings: tuple[float, float],
    mesh: float,
    modulus: float,
) -> FloatArray:
    """Return deflection and slope in one plane under a unit force and couple at the mesh.

    By bending; the deflection under the force has that of shear too.

    Parameters
    ----------
    stretches : sequence of Stretch
        In their order, without gaps, from 0 on.
    bearings : tuple of float
        Positions, mm, of bearings that do not give way.
    mesh : float
        Position of the mesh, mm.
    modulus : float
        Young's modulus, MPa.

    Returns
    -------
    ndarray, shape (2, 2)
        Deflection and slope along s (rows) per force and couple that turns along the slope
        (columns): mm/N, rad/N; mm/(N mm), rad/(N mm).
    """
    columns: list[tuple[float, float]] = []
    for load in (
        PointLoad(mesh, (0.0, 1.0, 0.0)),
        PointLoad(mesh, (0.0, 0.0, 0.0), (0.0, 0.0, -1.0)),
    ):
        bent, sheared, slope = at_position(deflection(stretches, [load], bearings, modulus), mesh)
        columns.append((bent[0] + (0.0 if columns else sheared[0]), slope[0]))
    return np.array(columns).T

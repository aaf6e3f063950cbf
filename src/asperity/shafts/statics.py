r"""Loads of a shaft, what its two bearings carry, and the moments between.

Axes: x along the shaft, towards the end it is driven at (a wheel's: the end it drives from); y from
the wheel's axis to the worm's; z completes them. Positions s go from that end into the shaft, so
that x = -s. Forces on bearings are those of the shaft on them.
"""

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from asperity.arrays import FloatArray
from asperity.formulas.traced import total

Vector = tuple[float, float, float]


class PointLoad(NamedTuple):
    """A load at a place of a shaft.

    Attributes
    ----------
    at : float
        Position, mm.
    force : tuple of float
        By x, y and z, N.
    couple : tuple of float
        About x, y and z, N mm.
    """

    at: float
    force: Vector
    couple: Vector = (0.0, 0.0, 0.0)


class Reactions(NamedTuple):
    """What the bearings of a shaft carry.

    Attributes
    ----------
    first, second : tuple of float
        y and z of each, N.
    axial : float
        Along x, N, of both together.
    torque : float
        About x, of what is coupled to the end, N mm.
    """

    first: tuple[float, float]
    second: tuple[float, float]
    axial: float
    torque: float

    @property
    def radial(self) -> tuple[float, float]:
        """Resultant of each, N."""
        return resultant(*self.first), resultant(*self.second)


def resultant(y: Any, z: Any) -> Any:
    """Return the length of a vector across the shaft.

    Parameters
    ----------
    y, z : float or ndarray, same shape
        Its parts.

    Returns
    -------
    float or ndarray, same shape
        In their unit.
    """
    return math.hypot(y, z) if isinstance(y, float) else np.sqrt(y**2 + z**2)


def mesh_load(at: float, force: Vector, radius: float) -> PointLoad:
    """Return the load of teeth that touch at y = ``radius`` from the shaft's axis, mm.

    Parameters
    ----------
    at : float
        Position, mm.
    force : tuple of float
        On the shaft, by x, y and z, N.
    radius : float
        Where the teeth touch, mm.

    Returns
    -------
    PointLoad
        The force at the axis, and the couple of its arm.
    """
    fx, _, fz = force
    return PointLoad(at, force, (radius * fz, 0.0, -radius * fx))


def reactions(loads: Sequence[PointLoad], first: float, second: float) -> Reactions:
    """Return what bearings at two places carry.

    Parameters
    ----------
    loads : sequence of PointLoad
        On the shaft.
    first, second : float
        Positions of the bearings, mm; different.

    Returns
    -------
    Reactions
        By equilibrium of forces and couples.
    """
    span = second - first
    fy, fz, moment_y, moment_z = [0.0], [0.0], [0.0], [0.0]
    for load in loads:
        arm = second - load.at  # from the second bearing towards +x
        fy.append(load.force[1])
        fz.append(load.force[2])
        moment_z.append(arm * load.force[1] + load.couple[2])
        moment_y.append(arm * load.force[2] - load.couple[1])
    a_y, a_z = total(moment_z) / span, total(moment_y) / span
    return Reactions(
        (a_y, a_z),
        (total((*fy, -a_y)), total((*fz, -a_z))),
        total(load.force[0] for load in loads),
        -total(load.couple[0] for load in loads),
    )


class Moments(NamedTuple):
    """What sections of a shaft carry, just before (side 0) and behind (side 1) each place.

    Attributes
    ----------
    at : ndarray, shape (places,)
        Positions, mm.
    shear, bending : ndarray, shape (places, 2, 2)
        By side and plane (y, z): N and N mm. Bending is the second derivative of the deflection
        times E I.
    torque, axial : ndarray, shape (places, 2)
        N mm and N.
    """

    at: FloatArray
    shear: FloatArray
    bending: FloatArray
    torque: FloatArray
    axial: FloatArray


def _in_balance(
    loads: Sequence[PointLoad],
    carried: Reactions,
    bearings: tuple[Any, Any],
    fixed: tuple[Any, Any],
) -> list[PointLoad]:
    """Return the loads with what bearings and coupling put against them."""
    every = list(loads)
    for place, (fy, fz), fx in zip(bearings, (carried.first, carried.second), fixed, strict=True):
        every.append(PointLoad(place, (-fx, -fy, -fz)))
    every.append(PointLoad(0.0, (0.0, 0.0, 0.0), (carried.torque, 0.0, 0.0)))
    return every


def section(
    at: Any,
    loads: Sequence[PointLoad],
    carried: Reactions,
    bearings: tuple[Any, Any],
    fixed: tuple[Any, Any],
    *,
    behind: bool,
) -> tuple[Any, Any, Any]:
    """Return bending moment and torque in N mm and axial force in N of one section.

    As `moments` has them of many; all numbers may be traced.

    Parameters
    ----------
    at : float
        Position, mm.
    loads, carried : sequence of PointLoad, Reactions
        As in `moments`.
    bearings, fixed : tuple of float
        As in `moments`.
    behind : bool
        Whether the side away from the end is meant, else that before the section.

    Returns
    -------
    bending, torque, axial : float
        N mm, N mm and N.
    """
    every = _in_balance(loads, carried, bearings, fixed)
    before = [load for load in every if (load.at <= at if behind else load.at < at)]
    bending_y = total([(at - load.at) * load.force[1] + load.couple[2] for load in before] or [0.0])
    bending_z = total([(at - load.at) * load.force[2] - load.couple[1] for load in before] or [0.0])
    return (
        resultant(bending_y, bending_z),
        total([load.couple[0] for load in before] or [0.0]),
        total([load.force[0] for load in before] or [0.0]),
    )


def moments(
    places: FloatArray,
    loads: Sequence[PointLoad],
    carried: Reactions,
    bearings: tuple[float, float],
    fixed: tuple[float, float],
) -> Moments:
    """Return what the sections at some places carry.

    Parameters
    ----------
    places : ndarray, shape (places,)
        Positions, mm.
    loads : sequence of PointLoad
        On the shaft.
    carried : Reactions
        What the bearings carry of them.
    bearings : tuple of float
        Where they are, mm.
    fixed : tuple of float
        Axial force of each of them, along x, N.

    Returns
    -------
    Moments
        On either side of each place.
    """
    every = _in_balance(loads, carried, bearings, fixed)
    at = np.array([load.at for load in every])
    force = np.array([load.force for load in every])
    couple = np.array([load.couple for load in every])
    sides = []
    for behind in (False, True):
        # What stands nearer to the end of s = 0 than the section.
        before = at <= places[:, None] if behind else at < places[:, None]
        arm = np.where(before, places[:, None] - at, 0.0)
        # A couple about z turns x, which is -s, towards y; one about y turns it away from z.
        bending_y = arm @ force[:, 1] + before @ couple[:, 2]
        bending_z = arm @ force[:, 2] - before @ couple[:, 1]
        sides.append(
            (
                before @ force[:, 1:],
                np.stack([bending_y, bending_z], axis=-1),
                before @ couple[:, 0],
                before @ force[:, 0],
            )
        )
    shear, bending, torque, axial = (np.stack(pair, axis=1) for pair in zip(*sides, strict=True))
    return Moments(places, shear, bending, torque, axial)

"""Works and energies at the points of a surface in contact, as kernels."""

from typing import NamedTuple

import numpy as np

from asperity.contact.interface.normal import HARD, TWO_STAGE, pressure
from asperity.kernels.compiled import kernel


class Resultants(NamedTuple):
    """What a contact does as a whole."""

    friction_x: float  #: Friction against the slip, N
    friction_y: float
    normal: float  #: Normal force, N
    deflection_x: float  #: Of the asperities, mean by pressure, m
    deflection_y: float


class SurfaceWorks(NamedTuple):
    """Works over a step, J, and the greatest pressure at its end, Pa."""

    slip: float  #: Of friction on the slip, trapezoidal
    asperities: float  #: Put into the asperities
    pressure: float  #: Put into the overclosure, trapezoidal
    overclosure: float  #: Put into the overclosure, by the law along the way
    greatest: float
    #: Of friction at the end on the slip, less what goes into asperities, where points give it
    gained: float


class Asperities(NamedTuple):
    """What of a `asperity.contact.interface.friction.PointFriction` their energy follows from."""

    bristle: float  #: mu over the deflection at full friction, 1/m
    reference: float  #: Pressure that belongs to it where their stiffness stays, Pa; else 0


@kernel
def asperity_stiffness(pressure, asperities):
    """Stiffness of the asperities of a point, Pa/m; 0 where it is open."""
    if pressure <= 0.0:
        return 0.0
    if asperities.reference > 0.0:
        return asperities.bristle * asperities.reference
    return asperities.bristle * pressure


@kernel
def resultants(points, weights):
    """Friction, normal force and mean deflection of a contact: `Resultants`."""
    normal, traction, deflection = points.normal, points.traction, points.deflection
    fx = 0.0
    fy = 0.0
    fn = 0.0
    sx = 0.0
    sy = 0.0
    for q in range(weights.size):
        p = points.pressure[q]
        if p <= 0.0:
            continue
        w = weights[q]
        fx -= w * (traction[q, 0] - p * normal[q, 0])
        fy -= w * (traction[q, 1] - p * normal[q, 1])
        fn += w * p
        sx += w * p * deflection[q, 0]
        sy += w * p * deflection[q, 1]
    share = 1.0 / fn if fn > 0.0 else 0.0
    return Resultants(fx, fy, fn, share * sx, share * sy)


@kernel
def overclosure_work(begin, end, law):
    """Work per area of a pressure law without memory from one overclosure to another, J/m^2.

    By Simpson's rule between the kinks of the law's pressure, which is exact: it is at most
    quadratic there. The hard law stores nothing, see `potential`.
    """
    if law.code == HARD:
        return 0.0
    work = 0.0
    least = 0.0
    for part in range(3):
        most = np.inf
        if law.code == TWO_STAGE and part < 2:
            most = law.start if part == 0 else law.end
        low = min(max(begin, least), most)
        high = min(max(end, least), most)
        if low != high:
            p0, _ = pressure(low, 0.0, law)
            middle, _ = pressure(0.5 * (low + high), 0.0, law)
            p1, _ = pressure(high, 0.0, law)
            work += (p0 + 4.0 * middle + p1) * (high - low) / 6.0
        if most == np.inf:
            break
        least = most
    return work


@kernel
def works(one, other, weights, law, asperities):
    """Works over a step, from the `ContactPoints` at both ends.

    ``weights`` are the areas of the points, m^2.
    """
    deflection_0, deflection_1 = one.deflection, other.deflection
    slip_1, slip_2 = other.slip_1, other.slip_2
    traction_0, traction_1 = one.traction, other.traction
    normal_0, normal_1 = one.normal, other.normal
    distance_0, distance_1 = one.distance, other.distance
    on_slip = 0.0
    into_asperities = 0.0
    gained = 0.0
    trapezoidal = 0.0
    by_law = 0.0
    most = 0.0
    for q in range(weights.size):
        p0 = one.pressure[q]
        p1 = other.pressure[q]
        if p0 <= 0.0 and p1 <= 0.0:
            continue
        w = weights[q]
        most = max(most, p1)
        work = 0.0
        last = 0.0
        # k s^2 / 2 grows by this, however far k and s go in the step.
        k0 = asperity_stiffness(p0, asperities)
        k1 = asperity_stiffness(p1, asperities)
        into = 0.0
        for c in range(3):
            s0 = deflection_0[q, c]
            s1 = deflection_1[q, c]
            into += (k0 * s0 + k1 * s1) * (s1 - s0) + (k1 - k0) * s0 * s1
            slip = slip_1[q, c] + slip_2[q, c]
            work -= slip * (
                traction_0[q, c] - p0 * normal_0[q, c] + traction_1[q, c] - p1 * normal_1[q, c]
            )
            last -= slip * (traction_1[q, c] - p1 * normal_1[q, c])
        on_slip += 0.5 * w * work
        gained += w * max(0.5 * into - last, 0.0)
        into_asperities += 0.5 * w * into
        trapezoidal += 0.5 * w * (p0 + p1) * (distance_0[q] - distance_1[q])
        by_law += w * overclosure_work(-distance_0[q], -distance_1[q], law)
    return SurfaceWorks(on_slip, into_asperities, trapezoidal, by_law, most, gained)


@kernel
def potential(over, law):
    """Energy of the overclosure per area for a pressure law without memory, J/m^2.

    The multipliers of the hard law make it depend on its history: it stores nothing.
    """
    if over <= 0.0 or law.code == HARD:
        return 0.0
    stiffness = law.stiffness
    if law.code != TWO_STAGE:
        return 0.5 * stiffness * over * over
    soft = law.initial
    first = law.start
    last = law.end
    if over <= first:
        return 0.5 * soft * over * over
    rise = (stiffness - soft) / (last - first)
    way = min(over, last) - first
    upto = first + way
    energy = 0.5 * soft * upto * upto + rise * way * way * way / 6.0
    if over > last:
        further = over - last
        pressure = soft * last + 0.5 * rise * way * way
        energy += pressure * further + 0.5 * stiffness * further * further
    return energy


@kernel
def surface_energies(pressure, distance, deflection, weights, law, asperities):
    """Energy in the overclosure and in the asperities of a contact, J."""
    over = 0.0
    bristles = 0.0
    for q in range(weights.size):
        over += weights[q] * potential(-distance[q], law)
        stiffness = asperity_stiffness(pressure[q], asperities)
        size = 0.0
        for c in range(3):
            size += deflection[q, c] * deflection[q, c]
        bristles += 0.5 * weights[q] * stiffness * size
    return over, bristles

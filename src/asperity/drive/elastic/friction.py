"""Friction of elastic teeth by the sliding speed: the law of a step, and what it leaves as it was.

The speed is that of the rigid worm at the point that the mesh reduces to, on each flank. Asperities
keep their stiffness: with the coefficient of friction the limit of their deflection changes.
"""

import math
from typing import NamedTuple

from asperity.arrays import FloatArray
from asperity.contact.candidates.records import Laws
from asperity.contact.interface.friction import PointNumbers
from asperity.contact.interface.records import Interface
from asperity.drive.friction_curve import FrictionCurve, friction_at
from asperity.kernels.compiled import kernel


class Sliding(NamedTuple):
    """How friction follows the speed, with room for what it is; SI."""

    curve: FrictionCurve  #: Coefficient of friction over the speed
    friction: float  #: That without vibration
    lead: float  #: Reduced lead
    radius: float  #: Of the point
    length: float  #: Way of the thread in a radian
    arm: float  #: The wheel's lever
    across: float  #: Part of the normal across the sliding
    radial: float  #: Its radial part
    share: FloatArray  #: (2,): Friction of driving and other flank over that without vibration


@kernel
def find_shares(sliding, v):
    """Write the friction of both flanks at rates of the poses."""
    if sliding.curve.values.size == 1:
        return
    r = sliding.radius / sliding.length
    p = sliding.lead / sliding.length
    turned = sliding.radius * v[0] - v[3]
    shifted = v[1] - sliding.arm * v[2]
    along = r * turned - p * shifted
    aside = sliding.radial * (p * turned + r * shifted)
    inward = sliding.across * v[4]
    for flank in range(2):
        over = inward - aside if flank == 0 else inward + aside
        speed = math.sqrt(along * along + over * over)
        sliding.share[flank] = friction_at(sliding.curve, speed) / sliding.friction


@kernel
def point_at(friction, share):
    """A point's law with a share of its friction, asperities as stiff as before."""
    return PointNumbers(
        friction.model, friction.law, share * friction.mu, share * friction.limit,
        friction.exponent, friction.static_ratio, friction.stribeck_velocity,
        friction.rate_damping, friction.slip_damping, friction.step, friction.reference,
    )  # fmt: skip


@kernel(inline="always")
def laws_at(laws, share):
    """The laws of teeth with a share of their friction."""
    i = laws.interface
    point = point_at(i.friction, share)
    interface = Interface(i.faces, i.shapes, i.weights, i.places, i.counter, i.law, point)
    return Laws(interface, laws.tolerance, laws.floor, laws.most)

"""Figures 4.9 to 4.11 and 4.13 to 4.15: the shaken base, its forces, an increment as vectors.

In the thesis's symbols: the asperity reaches from its root M, on the base, to N', on the body; the
y of a deflection is that of the root less that of the body (46), (47).
"""

import dataclasses
import math

import numpy as np

from asperity.arrays import FloatArray
from asperity.results.dataset import described
from asperity.thesis.exhibits import Computed, figure
from asperity.thesis.sliding import drawings, drawings_setup

_TRANSFER, _EXPONENT = 0.71, 1.0
_HOW = "asperity.thesis.sliding.schemes.increment"


@dataclasses.dataclass(frozen=True)
class Increment:
    """Where body and root are in an increment, lengths over s_max.

    Attributes
    ----------
    body : ndarray, shape (2, 2)
        N' and N'_1.
    root : ndarray, shape (4, 2)
        M, M'1, M'2 and M_1.
    deflection : ndarray, shape (3,)
        s, s' and s_1.
    angles : ndarray, shape (2,)
        alpha and beta, rad.
    """

    body: FloatArray
    root: FloatArray
    deflection: FloatArray
    angles: FloatArray


def _along(size: float, reach: float, exponent: float) -> float:
    """The deflection of (44) where an end has moved so that it would be ``reach``."""
    change = reach - size
    return size + change * math.pow(1.0 - size * math.copysign(1.0, change), exponent)


def increment(
    root: FloatArray, body: FloatArray, moved: FloatArray, base_y: float,
    *, transfer: float = _TRANSFER, exponent: float = _EXPONENT,
) -> Increment:  # fmt: skip
    """Return the places of an increment by (44) to (59), (34) and (35).

    Parameters
    ----------
    root, body, moved : ndarray, shape (2,)
        M and N' before, and N'_1, over s_max: in ``moved`` stands the base's own motion along x, as
        (42) has it.
    base_y : float
        Increment of the base across, Delta y_b, over s_max.
    transfer, exponent : float
        eta_y, of which the root takes its part of ``base_y``, and Dahl's exponent.
    """
    s = float(np.hypot(*(body - root)))
    off = np.array([moved[0] - root[0], root[1] - moved[1]])
    reach = float(np.hypot(*off))
    middle = _along(s, reach, exponent)
    alpha = math.atan2(off[1], off[0])
    first = moved + middle * np.array([-math.cos(alpha), math.sin(alpha)])
    second = first + np.array([0.0, transfer * base_y])
    off = np.array([moved[0] - second[0], second[1] - moved[1]])
    last = _along(middle, float(np.hypot(*off)), exponent)
    beta = math.atan2(off[1], off[0])
    end = moved + last * np.array([-math.cos(beta), math.sin(beta)])
    return Increment(
        np.array([body, moved]),
        np.array([root, first, second, end]),
        np.array([s, middle, last]),
        np.array([alpha, beta]),
    )


@figure("4.11", drawings.increment, 0.0)
@figure("4.15", drawings.increment, 0.25)
def _increment(base_x: float) -> Computed:
    root, body = np.array([0.0, 0.42]), np.array([0.5, 0.0])
    own, base_y = np.array([0.55, -0.12]), 0.5
    moved = body + own - np.array([base_x, 0.0])
    found = increment(root, body, moved, base_y)
    dataset = described(
        axis=(("axis",), np.array(["x", "y"], dtype=object), "1", "axis"),
        body=(("place", "axis"), found.body, "1", "N', N'_1 over s_max"),
        own=(("axis",), own, "1", "the body's own motion over s_max"),
        root=(("stop", "axis"), found.root, "1", "M, M'1, M'2, M_1 over s_max"),
        deflection=(("phase",), found.deflection, "1", "s, s', s_1 over s_max"),
        angle=(("turn",), found.angles, "rad", "alpha, beta"),
        base=(("axis",), np.array([base_x, base_y]), "1", "increments of the base over s_max"),
    )
    return dataset, [_HOW]


@figure("4.14", drawings.base)
def _base() -> Computed:
    theta, share = math.radians(35.0), 0.8
    dataset = described(
        theta=((), theta, "rad", "direction of vibration"),
        share=((), share, "1", "displacement over its amplitude"),
    )
    return dataset, ["x_b = u cos(theta), y_b = u sin(theta)"]


@figure("4.9", drawings_setup.setup, 0.0)
@figure("4.13", drawings_setup.setup, 1.0)
def _setup(along: float) -> Computed:
    dataset = described(base=(("axis",), np.array([along, 1.0]), "1", "whether the base moves"))
    return dataset, ["a scheme: nothing in it is to scale"]


@figure("4.10", drawings_setup.forces)
def _forces() -> Computed:
    root, body = np.array([0.0, 0.42]), np.array([0.5, 0.0])
    found = increment(root, body, body + np.array([0.55, -0.12]), 0.5)
    beta, size = float(found.angles[1]), float(found.deflection[2])
    # On the body, towards the root; a body that is not speeded up is pulled by as much along x.
    force = size * np.array([-math.cos(beta), math.sin(beta)])
    dataset = described(
        force=(("axis",), force, "1", "friction on the body over mu F_N"),
        drive=((), -force[0], "1", "drive force over mu F_N"),
        beta=((), beta, "rad", "angle of the deflection"),
    )
    return dataset, ["(36), (37) with the deflection at the end of figure 4.11"]

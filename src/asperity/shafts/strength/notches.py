"""DIN 743-2: what shoulders, grooves, keyways and press fits do to a shaft's fatigue strength."""

import math
from typing import Annotated, Literal, NamedTuple

import numpy as np

from asperity.arrays import Real
from asperity.formulas import formula
from asperity.shafts import symbols as s

Load = Literal["tension", "bending", "torsion"]
Notch = Literal["shoulder", "groove"]


class _Shape(NamedTuple):
    a: float
    b: float
    c: float
    z: float


_SHAPES: dict[tuple[str, str], _Shape] = {
    ("shoulder", "tension"): _Shape(0.62, 3.5, 0.0, 1.0),
    ("shoulder", "bending"): _Shape(0.62, 5.8, 0.2, 3.0),
    ("shoulder", "torsion"): _Shape(3.4, 19.0, 1.0, 2.0),
    ("groove", "tension"): _Shape(0.22, 1.37, 0.0, 1.0),
    ("groove", "bending"): _Shape(0.2, 2.75, 0.0, 1.0),
    ("groove", "torsion"): _Shape(0.7, 10.3, 0.0, 1.0),
}
_MILD = 0.67
_SIZE_OF_TESTS = 40.0


@formula(
    symbol="alpha",
    equation="1 + 1/sqrt(A r/t + 2 B r/d (1 + 2 r/d)^2 + C (r/t)^z d/D), t = (D - d)/2",
    source=s.DIN_743,
    because="D must be above d",
)
def shape_factor(
    diameter: s.d, outer: s.D, radius: s.r, load: Load, notch: Notch = "shoulder"
) -> Real:
    """Stress concentration of a shoulder or of a round groove; A, B, C and z by load.

    Examples
    --------
    >>> round(shape_factor(25.0, 30.0, 1.0, "bending"), 5)
    2.11812
    """
    depth = 0.5 * (outer - diameter)
    k = _SHAPES[notch, load]
    x, y = radius / diameter, np.where(depth > 0.0, radius / depth, np.nan)
    shallow = k.a * y + 2.0 * k.b * x * (1.0 + 2.0 * x) ** 2
    return 1.0 + 1.0 / np.sqrt(shallow + k.c * y**k.z * diameter / outer)


@formula(
    symbol="G",
    unit="1/mm",
    equation="2.3 (1 + phi)/r for a shoulder, 2 (1 + phi)/r for a groove; torsion 1.15/r and 1/r; "
    "phi = 1/(4 sqrt(t/r) + 2) where d/D > 0.67",
    source=s.DIN_743,
)
def stress_gradient(
    diameter: s.d, outer: s.D, radius: s.r, load: Load, notch: Notch = "shoulder"
) -> Real:
    """Gradient of the stress below a notch, over the stress."""
    step = notch == "shoulder"
    if load == "torsion":
        return (1.15 if step else 1.0) / radius
    depth = np.maximum(0.5 * (outer - diameter), 0.0)
    mild = np.where(diameter / outer > _MILD, 1.0 / (4.0 * np.sqrt(depth / radius) + 2.0), 0.0)
    return (2.3 if step else 2.0) * (1.0 + mild) / radius


@formula(
    symbol="n",
    equation="1 + sqrt(G) 10^-(0.33 + sigma_S/712); of a hard layer 1 + sqrt(G) 10^-0.7",
    source=s.DIN_743,
)
def support_factor(
    gradient: s.gradient,
    yield_strength: s.sigma_S,
    *,
    hard: Annotated[bool, "Whether the surface is a hard layer"] = False,
) -> Real:
    """Support of what is stressed less; the yield strength is that of the size at hand.

    Examples
    --------
    >>> round(support_factor(2.885, 816.462), 4)
    1.0567
    """
    power = 0.7 if hard else 0.33 + yield_strength / 712.0
    return 1.0 + np.sqrt(gradient) * 10.0**-power


@formula(symbol="beta", equation="alpha/n", source=s.DIN_743)
def notch_factor(shape: s.alpha, support: s.n_sigma) -> Real:
    """What a notch takes of the fatigue strength.

    Examples
    --------
    >>> notch_factor(2.1, 1.05)
    2.0
    """
    return shape / support


@formula(
    symbol="beta",
    equation="3 (sigma_B/1000)^0.38 of a keyway, 2.7 (sigma_B/1000)^0.43 of a press fit; torsion "
    "0.56 beta + 0.1 and 0.65 beta + 0.1; times K_3(40)/K_3(d)",
    source=s.DIN_743,
)
def seat_factor(
    diameter: s.d,
    tensile_strength: s.sigma_B,
    load: Load,
    seat: Literal["keyway", "press fit"],
) -> Real:
    """Notch factor of a keyway or a press fit; the tensile strength is that of the size at hand.

    Tension is taken as bending.

    Examples
    --------
    >>> round(seat_factor(40.0, 1000.0, "bending", "keyway"), 5)
    3.0
    """
    keyway = seat == "keyway"
    tested = (
        3.0 * (tensile_strength / 1e3) ** 0.38 if keyway else 2.7 * (tensile_strength / 1e3) ** 0.43
    )
    if load == "torsion":
        tested = (0.56 if keyway else 0.65) * tested + 0.1
    return tested * _size(_SIZE_OF_TESTS, tested) / _size(diameter, tested)


def _size(diameter: Real, factor: Real) -> Real:
    """Return K_3, the geometric size factor of notch factors."""
    d = np.minimum(np.maximum(diameter, 7.5), 150.0)
    return 1.0 - 0.2 * np.log10(factor) * np.log10(d / 7.5) / math.log10(20.0)

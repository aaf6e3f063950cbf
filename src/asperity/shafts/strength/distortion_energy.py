"""Distortion energy with the lines of Goodman and Gerber, as textbooks have it."""

from typing import Annotated

import numpy as np

from asperity.arrays import Real
from asperity.formulas import Symbol, formula, not_negative, positive
from asperity.shafts import symbols as s

A = Annotated[Real, Symbol("A", "N m", not_negative)]
B = Annotated[Real, Symbol("B", "N m", not_negative)]
S_e = Annotated[Real, Symbol("S_e", "MPa", positive)]
S_ut = Annotated[Real, Symbol("S_ut", "MPa", positive)]
d = Annotated[Real, Symbol("d", "mm", positive)]
n = Annotated[Real, Symbol("n", "", positive)]
K_f = Annotated[Real, Symbol("K_f", "", positive)]
K_fs = Annotated[Real, Symbol("K_fs", "", positive)]
M_x = Annotated[Real, Symbol("M", "N m", not_negative)]
T_x = Annotated[Real, Symbol("T", "N m", not_negative)]


@formula(symbol="A", unit="N m", equation="sqrt(4 (K_f M)^2 + 3 (K_fs T)^2)", source=s.SHIGLEY)
def combined_moment(moment: M_x, torque: T_x, bending: K_f, torsion: K_fs) -> Real:
    """Twice the bending moment that alone would do as much by distortion energy.

    A of the amplitudes and B of the means.

    Examples
    --------
    >>> combined_moment(2.0, 0.0, 1.0, 1.0)
    4.0
    """
    return np.sqrt(4.0 * (bending * moment) ** 2 + 3.0 * (torsion * torque) ** 2)


@formula(
    symbol="n", equation="pi d^3/16000/(A/S_e + B/S_ut)", source=s.SHIGLEY,
    because="nothing loads the section",
)  # fmt: skip
def goodman_safety(
    diameter: d, alternating: A, mean: B, endurance_limit: S_e, tensile_strength: S_ut
) -> Real:
    """Factor of safety by DE-Goodman.

    Examples
    --------
    >>> a, b = combined_moment(70.0, 45.0, 2.2, 1.8), combined_moment(55.0, 35.0, 2.2, 1.8)
    >>> round(goodman_safety(27.27, a, b, 210.0, 700.0), 2)
    2.0
    """
    return np.pi * diameter**3 / 16e3 / (alternating / endurance_limit + mean / tensile_strength)


@formula(
    symbol="n",
    equation="pi d^3 S_e/(8000 A (1 + sqrt(1 + (2 B S_e/(A S_ut))^2)))",
    source=s.SHIGLEY,
    because="nothing alternates",
)
def gerber_safety(
    diameter: d, alternating: A, mean: B, endurance_limit: S_e, tensile_strength: S_ut
) -> Real:
    """Factor of safety by DE-Gerber.

    Examples
    --------
    >>> a, b = combined_moment(70.0, 45.0, 2.2, 1.8), combined_moment(55.0, 35.0, 2.2, 1.8)
    >>> round(gerber_safety(25.85, a, b, 210.0, 700.0), 2)
    2.0
    """
    rest = 2.0 * mean * endurance_limit / (alternating * tensile_strength)
    return (
        np.pi * diameter**3 * endurance_limit
        / (8e3 * alternating * (1.0 + np.sqrt(1.0 + rest**2)))
    )  # fmt: skip

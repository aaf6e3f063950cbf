"""DIN 743-1: sizes, surface and mean stress; safety against fatigue and against yield."""

import math
from typing import Annotated, Literal

import numpy as np

from asperity.arrays import Real
from asperity.formulas import Symbol, formula, not_negative, positive
from asperity.shafts import symbols as s

_TESTED = 16.0

_normal_borne = Annotated[Real, Symbol("sigma_AD", "MPa", positive)]
_shear_borne = Annotated[Real, Symbol("tau_AD", "MPa", positive)]
_bending = Annotated[Real, Symbol("sigma_ba", "MPa", not_negative)]
_torsion = Annotated[Real, Symbol("tau_ta", "MPa", not_negative)]
_normal = Annotated[Real, Symbol("sigma_max", "MPa", not_negative)]
_shear = Annotated[Real, Symbol("tau_max", "MPa", not_negative)]
_normal_yield = Annotated[Real, Symbol("sigma_F", "MPa", positive)]
_shear_yield = Annotated[Real, Symbol("tau_F", "MPa", positive)]

ASKED = 1.2
"""Least safety against fatigue and against yield (from memory)."""


@formula(
    symbol="K_1",
    equation="1 - 0.26 lg(d_eff/16) of sigma_B, 1 - 0.34 lg(d_eff/16) of sigma_S; 1 up to 16 mm",
    source=s.DIN_743,
)
def technological_size_factor(
    diameter: s.d_eff, of: Literal["tensile", "yield"] = "tensile"
) -> Real:
    """What a quenched and tempered steel loses by its size, of values at 16 mm.

    Examples
    --------
    >>> round(technological_size_factor(30.0), 6)
    0.92902
    >>> round(technological_size_factor(30.0, "yield"), 6)
    0.90718
    """
    slope = 0.26 if of == "tensile" else 0.34
    return 1.0 - slope * np.log10(np.maximum(diameter, _TESTED) / _TESTED)


@formula(
    symbol="K_2",
    equation="1 - 0.2 lg(d/7.5)/lg 20, 1 up to 7.5 mm, 0.8 above 150 mm; 1 for tension",
    source=s.DIN_743,
)
def geometric_size_factor(
    diameter: s.d, load: Literal["tension", "bending", "torsion"] = "bending"
) -> Real:
    """What bending and torsion lose by the size of the section.

    Examples
    --------
    >>> round(geometric_size_factor(25.0), 6)
    0.919621
    """
    if load == "tension":
        return np.ones_like(diameter)
    return 1.0 - 0.2 * np.log10(np.minimum(np.maximum(diameter, 7.5), 150.0) / 7.5) / math.log10(
        20.0
    )


@formula(
    symbol="K_F",
    equation="1 - 0.22 lg Rz (lg(sigma_B/20) - 1); torsion 0.575 K_F + 0.425",
    source=s.DIN_743,
)
def surface_factor(
    roughness: s.Rz,
    tensile_strength: s.sigma_B,
    load: Literal["tension", "bending", "torsion"] = "bending",
) -> Real:
    """What a rough surface takes of the fatigue strength; of 1 um and below nothing."""
    rough = np.log10(np.maximum(roughness, 1.0))
    normal = 1.0 - 0.22 * rough * (np.log10(tensile_strength / 20.0) - 1.0)
    return 0.575 * normal + 0.425 if load == "torsion" else normal


@formula(symbol="K_sigma", equation="(beta/K_2 + 1/K_F - 1)/K_V", source=s.DIN_743)
def total_factor(notch: s.beta, size: s.K_2, surface: s.K_F, hardened: s.K_V = 1.0) -> Real:
    """All that lowers the fatigue strength of a part.

    Examples
    --------
    >>> total_factor(2.0, 1.0, 1.0)
    2.0
    """
    return (notch / size + 1.0 / surface - 1.0) / hardened


@formula(symbol="sigma_WK", unit="MPa", equation="sigma_W K_1/K_sigma", source=s.DIN_743)
def part_fatigue_strength(smooth: s.sigma_W, size: s.K_1, factor: s.K_sigma) -> Real:
    """Fatigue strength of the part under an alternating stress without mean."""
    return smooth * size / factor


@formula(
    symbol="psi",
    equation="sigma_WK/(2 K_1 sigma_B - sigma_WK)",
    source=s.DIN_743,
    result=not_negative,
    because="the fatigue strength reaches twice the tensile strength",
)
def mean_stress_sensitivity(
    part_strength: s.sigma_WK, size: s.K_1, tensile_strength: s.sigma_B
) -> Real:
    """How much a mean stress takes of the amplitude that is borne."""
    return part_strength / (2.0 * size * tensile_strength - part_strength)


@formula(
    symbol="sigma_mv",
    unit="MPa",
    equation="sqrt((sigma_zdm + sigma_bm)^2 + 3 tau_m^2)",
    source=s.DIN_743,
)
def equivalent_mean_stress(tension: s.sigma_zdm, bending: s.sigma_bm, torsion: s.tau_m) -> Real:
    """Mean stress that counts; of torsion it is the square root of three smaller."""
    return np.sqrt((tension + bending) ** 2 + 3.0 * torsion**2)


@formula(
    symbol="sigma_AD",
    unit="MPa",
    equation="sigma_WK/(1 + psi sigma_mv/sigma_a)",
    source=s.DIN_743,
)
def amplitude_at_constant_ratio(
    part_strength: s.sigma_WK, sensitivity: s.psi, mean: s.sigma_mv, amplitude: s.sigma_a
) -> Real:
    """Amplitude that is borne in case 2: mean and amplitude grow together."""
    return part_strength / (1.0 + sensitivity * mean / amplitude)


@formula(
    symbol="S_D",
    equation="1/sqrt((sigma_ba/sigma_AD)^2 + (tau_ta/tau_AD)^2)",
    source=s.DIN_743,
    because="nothing alternates",
)
def fatigue_safety(
    bending: _bending,
    bending_strength: _normal_borne,
    torsion: _torsion,
    torsion_strength: _shear_borne,
) -> Real:
    """Safety against fatigue; what alternates is bending and torsion.

    Examples
    --------
    >>> fatigue_safety(100.0, 200.0, 0.0, 100.0)
    2.0
    """
    return 1.0 / np.sqrt((bending / bending_strength) ** 2 + (torsion / torsion_strength) ** 2)


@formula(symbol="sigma_F", unit="MPa", equation="K_1 K_2F gamma_F sigma_S", source=s.DIN_743_MEMORY)
def part_yield_strength(
    size: s.K_1, static_support: s.K_2F, notch: s.gamma_F, yield_strength: s.sigma_S
) -> Real:
    """Yield strength of the part; K_2F is 1.2 for bending and torsion of a solid shaft, else 1."""
    return size * static_support * notch * yield_strength


@formula(
    symbol="S_F",
    equation="1/sqrt((sigma_max/sigma_F)^2 + (tau_max/tau_F)^2)",
    source=s.DIN_743,
    because="nothing loads the section",
)
def yield_safety(
    normal: _normal, normal_yield: _normal_yield, shear: _shear, shear_yield: _shear_yield
) -> Real:
    """Safety against yield of a section under its greatest load.

    Examples
    --------
    >>> yield_safety(100.0, 300.0, 0.0, 100.0)
    3.0
    """
    return 1.0 / np.sqrt((normal / normal_yield) ** 2 + (shear / shear_yield) ** 2)

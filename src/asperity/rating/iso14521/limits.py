"""Where ISO/TR 14521 is valid, where its formulas bend or jump, and what safety it asks for."""

import math
from collections.abc import Callable, Iterator, Mapping
from typing import Any, get_args

import numpy as np

from asperity.gearset.materials import BaseOilName, Family
from asperity.rating.iso14521.friction import base_friction
from asperity.rating.iso14521.pitting import pitting_life_factor, pitting_ratio_factor
from asperity.rating.iso14521.strength import rim_factor
from asperity.rating.iso14521.tables import Lubrication, friction_constants, wear_constants
from asperity.rating.iso14521.thermal import heat_transfer_coefficient
from asperity.rating.iso14521.wear import pressure_factor, reference_wear_intensity, start_factor
from asperity.rating.jump import Jump
from asperity.sources import Range, Source

_STANDARD = "ISO/TR 14521:2010"
_ONE_SOURCE = Source(_STANDARD, "one source")
_FROM_MEMORY = Source(_STANDARD, "from memory")

MINIMUM_SAFETIES: Mapping[str, tuple[float, Source]] = {
    "safety_wear": (1.1, _ONE_SOURCE),
    "safety_pitting": (1.0, _ONE_SOURCE),
    "safety_deflection": (1.0, _ONE_SOURCE),
    "safety_root": (1.1, _ONE_SOURCE),
    "safety_temperature": (1.1, _FROM_MEMORY),
}
"""The least of each safety, by its key in a rating."""

VALIDITY: Mapping[str, Range] = {
    "centre_distance": Range("centre distance a (Y_S)", 65.0, 250.0, "mm", _ONE_SOURCE),
    "profile_shift": Range(
        "profile shift x_2 (h*, p_m*)", -1.0, 1.0, "", Source("usual practice", "from memory")
    ),
    "geometry_factor": Range(
        "geometry factor Y_G", 0.0, 2.0, "", Source("one commercial program", "one source")
    ),
    "sump_centre_distance": Range("centre distance a (theta_S)", 63.0, 400.0, "mm", _FROM_MEMORY),
    "sump_worm_speed": Range("worm speed n_1 (theta_S)", 60.0, 3000.0, "rpm", _FROM_MEMORY),
    "sump_ratio": Range("ratio u (theta_S)", 10.0, 40.0, "", _FROM_MEMORY),
}
"""Where the standard's formulas are valid; the symbol in brackets is what rests on it."""


def violations(
    *,
    centre_distance: float,
    profile_shift: float,
    worm_speed: float,
    ratio: float,
    geometry_factor: float | None = None,
    sump_by_formula: bool = True,
) -> tuple[str, ...]:
    """Return a sentence for each limit of validity that does not hold.

    Parameters
    ----------
    centre_distance : float
        mm.
    profile_shift : float
        Of the wheel.
    worm_speed : float
        rpm.
    ratio : float
        Wheel teeth over starts.
    geometry_factor : float, optional
        Left out where the friction is given and does not rest on it.
    sump_by_formula : bool
        Whether the sump's temperature comes from the standard and is not given.

    Examples
    --------
    >>> violations(centre_distance=60.17, profile_shift=0, worm_speed=1440, ratio=15)[0]
    'centre distance a (theta_S) is 60.17 mm; ISO/TR 14521:2010 is valid from 63 to 400 mm'
    """
    given: dict[str, float] = {"profile_shift": profile_shift}
    if geometry_factor is not None:
        given.update(centre_distance=centre_distance, geometry_factor=geometry_factor)
    if sump_by_formula:
        given.update(
            sump_centre_distance=centre_distance, sump_worm_speed=worm_speed, sump_ratio=ratio
        )
    sentences = (VALIDITY[name].violation(value) for name, value in given.items())
    return tuple(sentence for sentence in sentences if sentence)


def jumps() -> tuple[Jump, ...]:
    """Measure every branch point of the standard's own formulas.

    Returns
    -------
    tuple of Jump
        All but `rim_factor` bend and do not jump.

    Examples
    --------
    >>> for jump in jumps():
    ...     if abs(jump.relative) > 1e-12:
    ...         print(f"{jump.formula} at {jump.at:g} {jump.unit}: {100 * jump.relative:+.3f} %")
    rim_factor at 2 : -0.020 %
    """
    return tuple(
        Jump(name, at, unit, formula(_below(at)), formula(_above(at)))
        for name, formula, at, unit in _branch_points()
    )


def _below(at: float) -> float:
    return float(np.nextafter(at, -math.inf))


def _above(at: float) -> float:
    return float(np.nextafter(at, math.inf))


def _branch_points() -> Iterator[tuple[str, Callable[[float], Any], float, str]]:
    for family in get_args(Family):
        for lubrication in get_args(Lubrication):
            for oil in get_args(BaseOilName):
                words = {"family": family, "lubrication": lubrication, "base_oil": oil}
                law = friction_constants(family, lubrication, oil)
                cap = (law.gain / (law.cap - law.offset)) ** (1.0 / law.exponent) - law.shift
                if cap > 0.0:
                    yield "base_friction", _with(base_friction, words), cap, "m/s"
                wear = wear_constants(family, lubrication, oil)
                if math.isfinite(wear.cap):
                    cap = (wear.scale / wear.cap) ** (1.0 / wear.exponent)
                    yield (
                        "reference_wear_intensity",
                        _with(reference_wear_intensity, words),
                        cap,
                        "um",
                    )
    yield "pressure_factor", pressure_factor, 450.0, "MPa"
    yield "start_factor", start_factor, 200.0, "1/h"
    yield "pitting_life_factor", pitting_life_factor, 25000.0 / 1.6**6, "h"
    yield "pitting_ratio_factor", pitting_ratio_factor, 20.5, ""
    yield "heat_transfer_coefficient", heat_transfer_coefficient, 150.0, "rpm"
    yield "rim_factor", lambda rim: rim_factor(1.0, rim), 2.0, ""


def _with(formula: Callable[..., Any], words: Mapping[str, str]) -> Callable[[float], Any]:
    return lambda value: formula(value, **words)

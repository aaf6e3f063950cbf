"""ISO/TR 14521: how much the wheel's flanks wear."""

import numpy as np

from asperity.arrays import Real
from asperity.formulas import formula
from asperity.gearset.materials import BaseOilName, Family
from asperity.rating.iso14521 import symbols as s
from asperity.rating.iso14521.tables import Lubrication, wear_constants

_IRON = ("grey iron", "nodular iron")


@formula(symbol="W_S", equation="eta_0M^-0.35", source=s.ONE_SOURCE)
def lubricant_structure_factor(
    dynamic_viscosity: s.eta_0M, *, family: Family = "tin bronze", base_oil: BaseOilName = "mineral"
) -> Real:
    """Lubricant structure factor, by the oil's viscosity at the wheel's temperature.

    1 for mineral oil, and for polyalphaolefin on iron.

    Examples
    --------
    >>> round(lubricant_structure_factor(0.05, base_oil="polyglycol"), 3)
    2.853
    """
    if base_oil == "mineral" or (base_oil == "polyalphaolefin" and family in _IRON):
        return 1.0
    return dynamic_viscosity**-0.35


@formula(symbol="W_H", equation="min(1, (450/sigma_Hm)^4.5)", source=s.ONE_SOURCE)
def pressure_factor(contact_stress: s.sigma_Hm, *, family: Family = "tin bronze") -> Real:
    """Pressure factor of wear; bends at 450 MPa and does not jump.

    Shown for bronze; iron has (300/sigma_Hm)^1.4.

    Examples
    --------
    >>> pressure_factor(300.0), pressure_factor(300.0, family="grey iron")
    (1.0, 1.0)
    """
    if family in _IRON:
        return (300.0 / contact_stress) ** 1.4
    return np.minimum(1.0, (450.0 / contact_stress) ** 4.5)


@formula(symbol="K_W", unit="um", equation="h_minm W_S W_H", source=s.ONE_SOURCE)
def wear_parameter(
    film_thickness: s.h_minm, lubricant_structure_factor: s.W_S, pressure_factor: s.W_H
) -> Real:
    """Film thickness that counts for wear."""
    return film_thickness * lubricant_structure_factor * pressure_factor


@formula(symbol="J_0T", equation="min(A K_W^-n, J_max)", source=s.ONE_SOURCE)
def reference_wear_intensity(
    wear_parameter: s.K_W,
    *,
    family: Family = "tin bronze",
    lubrication: Lubrication = "bath",
    base_oil: BaseOilName = "mineral",
) -> Real:
    """Wear intensity of the standard's reference gearset: depth worn for each length slid.

    The constants stand in ``rating/data/iso14521.toml``; mineral oils have a cap, and so has
    polyalphaolefin on aluminium bronze. The way of lubrication makes a difference for tin bronze
    only.

    Examples
    --------
    >>> reference_wear_intensity(1.0)
    6.5e-11
    """
    law = wear_constants(family, lubrication, base_oil)
    return np.minimum(law.scale * wear_parameter**-law.exponent, law.cap)


@formula(symbol="W_NS", equation="min(1 + 0.015 N_S, 4)", source=s.ONE_SOURCE)
def start_factor(starts_per_hour: s.N_S) -> Real:
    """Start factor of wear.

    Examples
    --------
    >>> start_factor(100.0)
    2.5
    """
    return np.minimum(1.0 + 0.015 * starts_per_hour, 4.0)


@formula(symbol="J_W", equation="J_0T W_NS W_ML", source=s.ONE_SOURCE)
def wear_intensity(
    reference_wear_intensity: s.J_0T, start_factor: s.W_NS, wear_factor: s.W_ML
) -> Real:
    """Wear intensity; W_ML is that of the wheel's material with the base oil."""
    return reference_wear_intensity * start_factor * wear_factor


@formula(symbol="delta_Wn", unit="mm", equation="J_W s_Wm", source=s.ONE_SOURCE)
def flank_wear(wear_intensity: s.J_W, sliding_path: s.s_Wm) -> Real:
    """Depth worn off the wheel's flanks, in the normal section.

    Examples
    --------
    >>> flank_wear(1e-9, 2e8)
    0.2
    """
    return wear_intensity * sliding_path


@formula(symbol="delta_Wlim", unit="mm", equation="0.3 m_x1 cos(gamma_m1)", source=s.ONE_SOURCE)
def wear_limit(axial_module: s.m_x1, lead_angle: s.gamma_m1) -> Real:
    """Depth that may be worn off, where nothing else is asked for."""
    return 0.3 * axial_module * np.cos(lead_angle)

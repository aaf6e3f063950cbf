"""A section of a shaft that is judged: notch factors, and safeties by DIN 743 and others."""

import math
from typing import Any, Literal, NamedTuple

import numpy as np

from asperity.formulas.traced import number
from asperity.shafts.steel import ShaftSteel
from asperity.shafts.strength import din743, notches
from asperity.shafts.strength.distortion_energy import (
    combined_moment,
    gerber_safety,
    goodman_safety,
)

Torque = Literal["constant", "pulsating", "reversing"]
_SHEAR = math.sqrt(3.0)


class Detail(NamedTuple):
    """A section that is judged.

    Attributes
    ----------
    at : float
        Position, mm.
    name : str
        What weakens it.
    diameter : float
        That bears, mm.
    beta : tuple of float
        Notch factors in bending and torsion; None: of a shoulder or groove, from its shape.
    outer, radius : float
        Larger diameter and radius of a shoulder or groove, mm.
    kind : {'shoulder', 'groove', 'keyway', 'press fit', 'threads', 'plain'}
        Of the notch.
    roughness : float
        Rz, um.
    largest : float
        Diameter that was hardened, mm: that of the bar.
    """

    at: float
    name: str
    diameter: float
    kind: Literal["shoulder", "groove", "keyway", "press fit", "threads", "plain"]
    roughness: float
    largest: float
    outer: float = 0.0
    radius: float = 0.0
    beta: tuple[float, float] = (1.0, 1.0)


class Actions(NamedTuple):
    """What a section carries: bending moment and torque in N m, axial force in N."""

    bending: float
    torque: float
    axial: float


class Judged(NamedTuple):
    """Safeties of a section under a load.

    Attributes
    ----------
    fatigue_1, fatigue_2 : float
        By DIN 743, mean constant and ratio constant.
    yielding : float
        By DIN 743, of the greatest load.
    goodman, gerber : float
        Of bending and torsion by distortion energy, with the same notch factors.
    bending, axial, torsion : float
        Nominal stresses, MPa.
    mises : float
        Of them together, MPa.
    """

    fatigue_1: float
    fatigue_2: float
    yielding: float
    goodman: float
    gerber: float
    bending: float
    axial: float
    torsion: float
    mises: float


class Strength(NamedTuple):
    """What a section bears, of which load is no part.

    Attributes
    ----------
    k_1 : tuple of float
        Technological size factors of tensile and yield strength.
    beta : tuple of float
        Notch factors in bending and torsion.
    total : tuple of float
        K_sigma and K_tau.
    part : tuple of float
        sigma_bWK and tau_tWK, MPa.
    sensitivity : tuple of float
        psi of bending and torsion.
    gamma_f : float
        What a notch adds to the yield strength.
    endurance : float
        Bending fatigue strength of its size and surface without a notch, MPa.
    """

    k_1: tuple[float, float]
    beta: tuple[float, float]
    total: tuple[float, float]
    part: tuple[float, float]
    sensitivity: tuple[float, float]
    gamma_f: float
    endurance: float


def strength(detail: Detail, steel: ShaftSteel, hardening: float = 1.0) -> Strength:
    """Return what a section bears by DIN 743; lengths in mm, stresses in MPa."""
    tensile, yielding = 1e-6 * steel.tensile_strength, 1e-6 * steel.yield_strength
    k_1 = (1.0, 1.0)
    if steel.size == "16 mm":
        k_1 = (
            number(din743.technological_size_factor(detail.largest)),
            number(din743.technological_size_factor(detail.largest, "yield")),
        )
    beta, gamma_f = _notch(detail, k_1[0] * tensile, k_1[1] * yielding)
    totals, parts, psis = [], [], []
    loads: tuple[tuple[notches.Load, float, float], ...] = (
        ("bending", beta[0], steel.sigma_bw),
        ("torsion", beta[1], steel.tau_tw),
    )
    for load, factor, smooth in loads:
        size = number(din743.geometric_size_factor(detail.diameter, load))
        rough = number(din743.surface_factor(detail.roughness, k_1[0] * tensile, load))
        if detail.kind in ("keyway", "press fit"):
            rough = 1.0  # which is within the factors measured
        total = number(din743.total_factor(factor, size, rough, hardening))
        part = number(din743.part_fatigue_strength(smooth, k_1[0], total))
        totals.append(total)
        parts.append(part)
        psis.append(number(din743.mean_stress_sensitivity(part, k_1[0], tensile)))
    size = din743.geometric_size_factor(detail.diameter)
    rough = din743.surface_factor(detail.roughness, k_1[0] * tensile)
    smooth = din743.total_factor(1.0, size, rough, hardening)
    return Strength(
        k_1,
        beta,
        (totals[0], totals[1]),
        (parts[0], parts[1]),
        (psis[0], psis[1]),
        gamma_f,
        number(din743.part_fatigue_strength(steel.sigma_bw, k_1[0], smooth)),
    )


def _notch(detail: Detail, tensile: float, yielding: float) -> tuple[tuple[float, float], float]:
    """Return notch factors in bending and torsion, and gamma_F."""
    if detail.kind in ("shoulder", "groove"):
        kind: notches.Notch = "groove" if detail.kind == "groove" else "shoulder"
        found, shapes = [], []
        for load in ("bending", "torsion"):
            of = (detail.diameter, detail.outer, detail.radius)
            shape = number(notches.shape_factor(*of, load, kind))
            steep = number(notches.stress_gradient(*of, load, kind))
            support = number(notches.support_factor(steep, yielding))
            found.append(number(np.maximum(notches.notch_factor(shape, support), 1.0)))
            shapes.append(shape)
        return (found[0], found[1]), _gamma(shapes[0])
    if detail.kind in ("keyway", "press fit"):
        seat: Literal["keyway", "press fit"] = "keyway" if detail.kind == "keyway" else "press fit"
        return (
            number(notches.seat_factor(detail.diameter, tensile, "bending", seat)),
            number(notches.seat_factor(detail.diameter, tensile, "torsion", seat)),
        ), 1.0
    return detail.beta, 1.0


def _gamma(shape: float) -> float:
    """Return gamma_F of a round notch by its shape factor (DIN 743, from memory)."""
    for above, value in ((3.0, 1.15), (2.0, 1.10), (1.5, 1.05)):
        if shape >= above:
            return value
    return 1.0


def judged(
    detail: Detail,
    steel: ShaftSteel,
    borne: Strength,
    actions: Actions,
    *,
    torque: Torque = "constant",
    peak: float = 1.0,
) -> Judged:
    """Return the safeties of a section under what it carries.

    Bending turns with the shaft and alternates whole; the axial force is mean; the torque as
    ``torque`` says. A section that carries nothing has no safety: infinite.
    """
    d = detail.diameter
    bend = 32e3 * actions.bending / (math.pi * d**3)
    pull = 4.0 * actions.axial / (math.pi * d**2)
    twist = 16e3 * abs(actions.torque) / (math.pi * d**3)
    share = {"constant": 0.0, "pulsating": 0.5, "reversing": 1.0}[torque]
    twist_a = share * twist
    twist_m = twist - twist_a
    mises = number(np.sqrt((bend + abs(pull)) ** 2 + (_SHEAR * twist) ** 2))
    if not mises > 0.0:
        return Judged(math.inf, math.inf, math.inf, math.inf, math.inf, 0.0, 0.0, 0.0, 0.0)
    yields = _yield_safety(steel, borne, (bend, abs(pull), twist), peak)
    if not (bend > 0.0 or twist_a > 0.0):
        return Judged(math.inf, math.inf, yields, math.inf, math.inf, bend, pull, twist, mises)
    mean = number(din743.equivalent_mean_stress(abs(pull), 0.0, twist_m))
    safeties = []
    for case in (1, 2):
        normal = _borne_amplitude(borne.part[0], borne.sensitivity[0], mean, bend, case)
        shear = _borne_amplitude(borne.part[1], borne.sensitivity[1], mean / _SHEAR, twist_a, case)
        # Where the mean stress alone is too much, nothing may alternate.
        holds = normal > 0.0 and shear > 0.0
        safeties.append(
            number(din743.fatigue_safety(bend, normal, twist_a, shear)) if holds else 0.0
        )
    tensile = 1e-6 * steel.tensile_strength * borne.k_1[0]
    twisted = abs(actions.torque)
    a = combined_moment(actions.bending, share * twisted, borne.beta[0], borne.beta[1])
    b = combined_moment(0.0, (1.0 - share) * twisted, borne.beta[0], borne.beta[1])
    of = (d, a, b, borne.endurance, tensile)
    return Judged(
        safeties[0], safeties[1], yields,
        number(goodman_safety(*of)), number(gerber_safety(*of)),
        bend, pull, twist, mises,
    )  # fmt: skip


def _borne_amplitude(part: Any, sensitivity: Any, mean: Any, amplitude: Any, case: int) -> Any:
    if case == 1:
        return part - sensitivity * mean
    if not amplitude > 0.0:
        return part
    return number(din743.amplitude_at_constant_ratio(part, sensitivity, mean, amplitude))


def _yield_safety(
    steel: ShaftSteel, borne: Strength, stresses: tuple[float, float, float], peak: float
) -> Any:
    bend, pull, twist = (peak * each for each in stresses)
    strength_at_size = 1e-6 * steel.yield_strength
    k, gamma = borne.k_1[1], borne.gamma_f
    of_bending = din743.part_yield_strength(k, 1.2, gamma, strength_at_size)
    of_tension = din743.part_yield_strength(k, 1.0, gamma, strength_at_size)
    of_torsion = din743.part_yield_strength(k, 1.2, 1.0, strength_at_size) / _SHEAR
    used = number(bend / of_bending + pull / of_tension)
    return number(din743.yield_safety(used, 1.0, twist, of_torsion))

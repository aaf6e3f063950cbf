"""The efficiency chain of ISO/TR 14521 over one block of gearsets."""

import dataclasses
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from asperity.errors import InputError
from asperity.gearset import relations
from asperity.gearset.library import resolve
from asperity.gearset.materials import WheelMaterial
from asperity.rating.formula import Argument, Invalid, Masked, evaluate
from asperity.rating.iso14521 import efficiency, film, friction, losses
from asperity.rating.iso14521.tables import Edition, Flank, Lubrication, friction_constants

NO_WHEEL, NO_FILM, NOT_DRIVING = 101, 102, 103
"""Reason codes of a chain beside those of the numbers given."""

REASONS = {
    NO_WHEEL: "the worm's pitch diameter reaches the wheel's axis; raise the centre distance",
    NO_FILM: "h* is not above zero; lower the ratio or the module, or raise the centre distance",
    NOT_DRIVING: "lead angle and friction angle reach 90 deg, so the worm cannot drive",
}

# Stands in for a gearset that is not allowed, so that the formulas need not look out for it.
_SAFE = {
    "starts": 1.0,
    "wheel_teeth": 60.0,
    "diameter_factor": 8.0,
    "axial_module": 2.0,
    "pressure_angle": 0.35,
    "worm_speed": 1000.0,
    "worm_roughness": 1.0,
    "centre_distance": 68.0,
    "profile_shift": 0.0,
    "wheel_face_width": 12.0,
    "output_torque": 100.0,
    "loss_coefficient": 0.013,
    "seals": 2.0,
    "base_friction": 0.05,
    "friction": 0.05,
    "friction_factor": 1.0,
}


class Options(NamedTuple):
    """What holds for all gearsets of a chain."""

    lubrication: Lubrication
    edition: Edition
    flank: Flank
    masking: bool


def _refuse(
    arguments: Sequence[Argument], block: dict[str, Any], size: int, masking: bool
) -> npt.NDArray[np.int8]:
    """Return why gearsets of the block have no answer, and put safe ones in their place."""
    reason = np.zeros(size, dtype=np.int8)
    for code, argument in enumerate(arguments, 1):
        values = block[argument.name]
        outside = argument.outside(values)
        if not outside.any():
            continue
        if not masking:
            # As for a single number, the message comes from the formula's own machinery.
            evaluate(lambda value: value, dataclasses.replace(argument, value=values))
        reason = np.where((reason == 0) & outside, code, reason).astype(np.int8)
    with np.errstate(invalid="ignore"):
        d_m1, a = _diameter_and_distance(block)
    if np.any((2.0 * a <= d_m1) & (reason == 0)):
        if not masking:
            where = np.argmax(np.broadcast_to(2.0 * a <= d_m1, size))
            given, needed = (float(np.broadcast_to(x, size)[where]) for x in (a, 0.5 * d_m1))
            raise InputError(
                f"centre_distance is {given:.6g} mm; it must be above half the worm's pitch "
                f"diameter, {needed:.6g} mm"
            )
        reason = np.where((reason == 0) & (2.0 * a <= d_m1), NO_WHEEL, reason).astype(np.int8)
    bad = reason > 0
    if bad.any():
        for argument in arguments:
            block[argument.name] = np.where(bad, _SAFE[argument.name], block[argument.name])
    return reason


def _diameter_and_distance(block: Mapping[str, Any]) -> tuple[Any, Any]:
    # Not by gearset.relations, which take no nonsense: here it is yet to be sorted out.
    m, q = block["axial_module"], block["diameter_factor"]
    if "centre_distance" in block:
        return q * m, block["centre_distance"]
    return q * m, 0.5 * m * (q + block["wheel_teeth"] + 2.0 * block["profile_shift"])


def follow(
    arguments: Sequence[Argument], block: dict[str, Any], size: int, options: Options
) -> tuple[npt.NDArray[np.int8], dict[str, Any]]:
    """Return the reasons of a block of gearsets, and its answers by the names of a chain."""
    reason = _refuse(arguments, block, size, options.masking)
    z1, z2, n_1 = block["starts"], block["wheel_teeth"], block["worm_speed"]
    m, q = block["axial_module"], block["diameter_factor"]
    d_m1, a = _diameter_and_distance(block)
    lead = relations.lead_angle(z1, q)
    answers: dict[str, Any] = {
        "centre_distance": a,
        "profile_shift": relations.profile_shift(a, m, q, z2),
        "lead_angle": lead,
        "sliding_velocity": friction.sliding_velocity(d_m1, n_1, lead),
    }
    if "friction" in block:
        mu = block["friction"]
    else:
        answers |= _factors(block, answers, reason, options)
        mu = friction.mean_friction(
            answers["base_friction"],
            answers["size_factor"],
            answers["geometry_factor"],
            answers["material_factor"],
            answers["roughness_factor"],
        )
    mu = mu * block["friction_factor"]
    on_invalid: Invalid = "mask" if options.masking else "raise"
    eta = efficiency.worm_driving_efficiency(lead, mu, on_invalid=on_invalid)
    if isinstance(eta, Masked):
        reason[(reason == 0) & (eta.reason > 0)] = NOT_DRIVING
        eta = np.where(eta.reason > 0, 1.0, eta.values)
    answers |= {
        "mean_friction": mu,
        "efficiency": eta,
        "back_driving_efficiency": efficiency.wheel_driving_efficiency(lead, mu),
    }
    if "output_torque" in block:
        answers |= _powers(block, d_m1, a, eta)
    if reason.any():
        answers = {name: np.where(reason > 0, np.nan, v) for name, v in answers.items()}
    return reason, answers


def _factors(
    block: Mapping[str, Any],
    answers: Mapping[str, Any],
    reason: npt.NDArray[np.int8],
    options: Options,
) -> dict[str, Any]:
    constants = _constants(block["material"], block["base_oil"], options.lubrication)
    material_factor = constants.pop("material_factor")
    h = film.film_parameter(
        block["starts"],
        block["wheel_teeth"],
        block["diameter_factor"],
        block["axial_module"],
        block["pressure_angle"],
        answers["profile_shift"],
        wheel_face_width=block.get("wheel_face_width"),
        edition=options.edition,
        flank=options.flank,
        on_invalid="mask" if options.masking else "raise",
    )
    if isinstance(h, Masked):
        reason[(reason == 0) & (h.reason > 0)] = NO_FILM
        h = np.where(h.reason > 0, 0.07, h.values)
    mu = block.get("base_friction")
    if mu is None:
        mu = friction.capped_power(np.asarray(answers["sliding_velocity"]), **constants)
    return {
        "film_parameter": h,
        "base_friction": mu,
        "size_factor": friction.size_factor(answers["centre_distance"]),
        "geometry_factor": friction.geometry_factor(h),
        "material_factor": material_factor,
        "roughness_factor": friction.roughness_factor(block["worm_roughness"]),
    }


def _powers(block: Mapping[str, Any], d_m1: Any, a: Any, eta: Any) -> dict[str, Any]:
    torque, n_1 = block["output_torque"], block["worm_speed"]
    u = relations.gear_ratio(block["starts"], block["wheel_teeth"])
    d_m2 = relations.wheel_mean_diameter(a, d_m1)
    power = losses.output_power(torque, n_1, u)
    lost = {
        "loss_meshing": losses.meshing_loss(torque, n_1, u, eta),
        "loss_idle": losses.idle_loss(a, n_1),
        "loss_bearing": losses.bearing_loss(power, a, u, d_m2, block["loss_coefficient"]),
        "loss_seal": losses.seal_loss(d_m1, n_1, block["seals"]),
    }
    total = sum(lost.values())
    return {
        "output_power": power,
        **lost,
        "input_power": power + total,
        "total_efficiency": efficiency.total_efficiency(power, total),
    }


def _constants(
    materials: npt.NDArray[Any], oils: npt.NDArray[Any], lubrication: Lubrication
) -> dict[str, Any]:
    """Return the constants of the base friction and Y_W, as arrays where the words are."""
    names = ("offset", "gain", "shift", "exponent", "cap", "material_factor")
    shape = np.broadcast_shapes(materials.shape, oils.shape)
    materials, oils = np.broadcast_to(materials, shape), np.broadcast_to(oils, shape)
    if shape == ():
        return dict(zip(names, _row(materials.item(), oils.item(), lubrication), strict=True))
    columns = np.empty((len(names), *shape))
    left = np.ones(shape, dtype=bool)
    while left.any():
        first = int(np.argmax(left))
        here = (materials == materials[first]) & (oils == oils[first])
        columns[:, here] = np.array(_row(materials[first], oils[first], lubrication))[:, None]
        left &= ~here
    return dict(zip(names, columns, strict=True))


def _row(material: Any, base_oil: Any, lubrication: Lubrication) -> tuple[float, ...]:
    made_of = resolve("wheel", material, WheelMaterial)
    law = friction_constants(made_of.family, lubrication, base_oil)
    return law.offset, law.gain, law.shift, law.exponent, law.cap, made_of.material_factor

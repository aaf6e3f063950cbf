"""A gearset by ISO/TR 14521: the formulas in the order of the calculation.

Efficiency, forces, contact stress, pitting, deflection, tooth root and temperature go by the rated
torque, wear by the torque through the travel; both times the application factor, but for powers
and temperatures.

Of a duty cycle, wear, pitting and temperature go by its parts, each at its own torque, speed and
temperature, see `_over_the_parts`; deflection and root by the rated torque, which none of them
exceeds, with the friction at the speed of the part that has the greatest and the wear of all.
"""

import dataclasses
import math

import numpy as np

from asperity.arrays import Real, smaller
from asperity.formulas import current_mask, masking
from asperity.rating.inputs import Inputs, Values, times
from asperity.rating.iso14521 import (
    balance,
    contact,
    efficiency,
    film,
    forces,
    friction,
    hertz,
    losses,
    pitting,
    strength,
)
from asperity.rating.iso14521.housed import housing_of
from asperity.rating.iso14521.most_worn import chosen, of_alike, place_of_most
from asperity.rating.iso14521.wearing import sump_of, temperatures, wear_of
from asperity.units.standards import FROM_SI

ROOT_LIFE_FACTOR = 1.0
"""Y_NL, the default of MITCalc; that by wheel and grade has no document."""

_OF_WEAR = (
    "theta_S_degC", "theta_S_lim_degC", "alpha_L_W_m2K", "A_R_m2", "theta_M_degC", "nu_M_mm2_s",
    "rho_M_kg_m3", "eta_0M_Pas", "sigma_Hm_wear_MPa", "h_min_um", "W_S", "W_H", "K_W_um", "J_0T",
    "W_NS", "W_ML", "J_W", "s_star", "N_L", "s_Wm_mm", "delta_Wlim_mm",
)  # fmt: skip
"""What leads to the wear of a part of a duty cycle, by the keys of a rating."""

_ADDED = "N_L", "s_Wm_mm", "delta_Wn_mm"
"""What adds up over the parts."""


_OF_TEETH = (
    "sliding_velocity_m_s", "mu_0T", "Y_S", "h_star", "Y_G", "Y_W", "Y_R", "mu_zm", "eta_z1_2",
    "eta_z2_1",
)  # fmt: skip
"""What of a load goes by geometry and speed alone."""


def rated_efficiency(inputs: Inputs, teeth: Values | None = None) -> Values:
    """Return friction, efficiency and losses, by the keys of a rating.

    Parameters
    ----------
    inputs : Inputs
        The gearset and its load.
    teeth : Values, optional
        What was found of it at the same speed; then only powers and losses are.
    """
    v = _teeth(inputs) if teeth is None else {key: teeth[key] for key in _OF_TEETH}
    _powers(inputs, v)
    return v


def _teeth(inputs: Inputs) -> Values:
    wheel, operation = inputs.gearset.wheel_material, inputs.operation
    wheel.require_covered("ISO/TR 14521")
    v: Values = {}
    v["sliding_velocity_m_s"] = friction.sliding_velocity(
        inputs.worm_pitch_diameter, inputs.worm_speed, inputs.lead_angle
    )
    v["mu_0T"] = inputs.base_friction
    if inputs.base_friction is None:
        v["mu_0T"] = friction.base_friction(
            v["sliding_velocity_m_s"],
            family=wheel.family,
            lubrication=operation.lubrication,
            base_oil=operation.lubricant.base_oil,
        )
    v["Y_S"] = friction.size_factor(inputs.centre_distance)
    v["h_star"] = film_parameter_of(inputs)
    v["Y_G"] = friction.geometry_factor(v["h_star"])
    v["Y_W"] = wheel.material_factor
    v["Y_R"] = friction.roughness_factor(inputs.worm_roughness)
    mean = inputs.friction
    if mean is None:
        mean = friction.mean_friction(v["mu_0T"], v["Y_S"], v["Y_G"], v["Y_W"], v["Y_R"])
    v["mu_zm"] = times(mean, inputs.friction_factor)
    v["eta_z1_2"] = efficiency.worm_driving_efficiency(inputs.lead_angle, v["mu_zm"])
    v["eta_z2_1"] = efficiency.wheel_driving_efficiency(inputs.lead_angle, v["mu_zm"])
    return v


def film_parameter_of(inputs: Inputs) -> Real:
    """Return h*."""
    return film.film_parameter(
        inputs.starts,
        inputs.wheel_teeth,
        inputs.diameter_factor,
        inputs.axial_module,
        inputs.pressure_angle,
        inputs.profile_shift,
        wheel_face_width=inputs.effective_face_width,
        edition=inputs.options.iso14521_edition,
        flank=inputs.gearset.flank,
    )


def _powers(inputs: Inputs, v: Values) -> None:
    mesh = inputs.output_torque, inputs.worm_speed, inputs.gear_ratio
    v["output_power_W"] = losses.output_power(*mesh)
    v["loss_meshing_W"] = losses.meshing_loss(*mesh, v["eta_z1_2"])
    housing = inputs.operation.housing
    v["loss_idle_W"] = losses.idle_loss(inputs.centre_distance, inputs.worm_speed)
    if housing is not None and housing.idle_loss is not None:
        v["loss_idle_W"] = balance.measured_idle_loss(
            housing.idle_loss, inputs.measured_at, inputs.worm_speed
        )
    v["loss_bearing_W"] = losses.bearing_loss(
        v["output_power_W"],
        inputs.centre_distance,
        inputs.gear_ratio,
        inputs.wheel_mean_diameter,
        inputs.operation.bearings.loss_coefficient,
    )
    v["loss_seal_W"] = losses.seal_loss(
        inputs.worm_pitch_diameter, inputs.worm_speed, inputs.operation.seals
    )
    if housing is not None and housing.seal_loss is not None:
        v["loss_seal_W"] = balance.measured_seal_loss(
            housing.seal_loss, inputs.measured_at, inputs.worm_speed
        )
    others = v["loss_idle_W"] + v["loss_bearing_W"] + v["loss_seal_W"]
    v["loss_total_W"] = v["loss_meshing_W"] + others
    v["input_power_W"] = v["output_power_W"] + v["loss_total_W"]
    v["input_torque_Nm"] = v["input_power_W"] / (math.pi / 30.0 * inputs.worm_speed)
    v["eta_ges"] = efficiency.total_efficiency(v["output_power_W"], v["loss_total_W"])
    back = losses.back_driving_meshing_loss(*mesh, v["eta_z2_1"])
    v["loss_meshing_back_W"] = back
    v["eta_ges2_1"] = efficiency.back_driving_total_efficiency(v["output_power_W"], back + others)


def rated_capacity(inputs: Inputs, v: Values) -> Values:
    """Return stresses, temperatures and safeties; ``v`` is what `rated_efficiency` returned."""
    v = dict(v)
    rated = inputs.operation.application_factor * inputs.output_torque
    v["p_m_star"] = contact.contact_parameter(
        inputs.starts,
        inputs.wheel_teeth,
        inputs.diameter_factor,
        inputs.axial_module,
        inputs.centre_distance,
        inputs.pressure_angle,
        inputs.profile_shift,
        wheel_face_width=inputs.effective_face_width,
        edition=inputs.options.iso14521_edition,
        flank=inputs.gearset.flank,
    )
    worm, wheel = inputs.gearset.worm_material, inputs.gearset.wheel_material
    elastic = (
        worm.youngs_modulus * FROM_SI["MPa"],
        worm.poisson_ratio,
        wheel.youngs_modulus * FROM_SI["MPa"],
        wheel.poisson_ratio,
    )
    v["E_red_MPa"] = contact.reduced_modulus(*elastic)
    v["sigma_Hm_MPa"] = contact.contact_stress(
        v["p_m_star"], rated, v["E_red_MPa"], inputs.centre_distance
    )
    v["sigma_line_MPa"] = hertz.worm_contact_stress(
        rated,
        inputs.wheel_reference_diameter,
        inputs.axial_module,
        inputs.diameter_factor,
        inputs.lead_angle,
        inputs.pressure_angle,
        hertz.contact_modulus(*elastic),
    )
    _forces(inputs, v, rated)
    parts, friction_of_bending = parts_of(inputs, v), v["mu_zm"]
    if parts:
        _over_the_parts(inputs, parts, v)
        friction_of_bending = inputs.most_of_hardest([own["mu_zm"] for own in parts])
    else:
        temperatures(inputs, v)
        wear_of(inputs, v)
    _pitting(inputs, v)
    _deflection(inputs, v, friction_of_bending)
    _root(inputs, v)
    hottest = v.get("theta_S_max_degC", v["theta_S_degC"])
    if inputs.operation.housing is not None:
        hottest = housing_of(inputs, v)
    v["safety_temperature"] = strength.safety(v["theta_S_lim_degC"], hottest)
    return v


def parts_of(inputs: Inputs, v: Values) -> tuple[Values, ...]:
    """Return losses, temperatures and wear of each part of a duty cycle; none without one.

    Parameters
    ----------
    inputs : Inputs
        The gearset and its duty cycle.
    v : Values
        ``p_m_star`` and ``E_red_MPa``, which are those of all parts.
    """
    outer, count = current_mask(), len(inputs.duty)
    if outer is None or count < 2:
        return _parts_of(inputs, inputs.parted(), v)
    if inputs.together:
        with masking((count,)) as own:
            found = _parts_of(inputs, inputs.parted(), v)
        for sentence in own.legend.values():
            outer.refuse(True, sentence)
        return found
    if outer.reason.ndim != 1:
        return _parts_of(inputs, inputs.parted(), v)
    # Formulas take about as long for a few rows of variants as for one.
    with masking(outer.stacked(count)) as own:
        (rows,) = _parts_of(inputs, (inputs.at_once(),), v)
    outer.refuse_as(own)
    return tuple({key: _row(value, place) for key, value in rows.items()} for place in range(count))


def _row(value: Real, place: int) -> Real:
    if np.ndim(value) < 2:
        return value
    row = value[place]
    return row if row.size > 1 else row[0]


def _parts_of(inputs: Inputs, parted: tuple[Inputs, ...], v: Values) -> tuple[Values, ...]:
    spectrum = inputs.operation.spectrum
    if spectrum is not None and spectrum.oil == "mean" and len(inputs.duty) > 1:
        loads = inputs.parted()
        hours = inputs.total(part.life for part in loads)
        mean = inputs.total(part.life * sump_of(part) for part in loads) / hours
        parted = tuple(dataclasses.replace(part, sump=mean) for part in parted)
    found: list[Values] = []
    # A film and a friction that were found at the same speed are those of the part too.
    known = [(inputs.worm_speed, v)] if "mu_zm" in v else []
    for part in parted:
        same = (teeth for speed, teeth in known if _equal(speed, part.worm_speed))
        own = rated_efficiency(part, next(same, None))
        known.append((part.worm_speed, own))
        if np.any(part.load_drives):
            _let_down(part, own)
        own |= {key: v[key] for key in ("p_m_star", "E_red_MPa")}
        own["part_hours"] = part.life
        temperatures(part, own)
        wear_of(part, own)
        found.append(own)
    return tuple(found)


def _equal(one: Real, other: Real) -> bool:
    """Whether two speeds are the same number, or the very same array or cell."""
    return one is other or (isinstance(one, float) and isinstance(other, float) and one == other)


def _let_down(part: Inputs, own: Values) -> None:
    """Put the losses of a load that drives in the place of those of the worm."""
    forward = own["loss_meshing_W"]
    back = own["loss_meshing_back_W"]
    if np.ndim(part.load_drives):
        back = np.where(part.load_drives, back, forward)
    own["loss_meshing_W"] = back
    own["loss_total_W"] = own["loss_total_W"] - forward + back


def _over_the_parts(inputs: Inputs, parts: tuple[Values, ...], v: Values) -> None:
    """Add up the wear of a duty cycle and find its hottest part.

    Depths worn off add up, and paths and turns, each by torque, speed and temperature of its part;
    what leads to them is told of the load that wears most, in however many parts it is given. Each
    part lasts long enough for the sump to settle.
    """
    if inputs.together:
        depths = np.broadcast_to(parts[0]["delta_Wn_mm"], (len(inputs.duty),))
        place = int(np.argmax(of_alike(inputs, [np.nan_to_num(depths)])[0]))
        for key in _OF_WEAR:
            v[key] = float(np.broadcast_to(parts[0][key], (len(inputs.duty),))[place])
    else:
        for place, own in enumerate(parts, 1):
            v |= {f"part_{place}.{key}": value for key, value in own.items()}
        most = place_of_most(of_alike(inputs, [own["delta_Wn_mm"] for own in parts]))
        there = [most == place for place in range(len(parts))] if np.ndim(most) else []
        for key in _OF_WEAR:
            v[key] = chosen(most, there, [own[key] for own in parts])
    for key in _ADDED:
        v[key] = inputs.total(own[key] for own in parts)
    v["safety_wear"] = strength.safety(v["delta_Wlim_mm"], v["delta_Wn_mm"])
    v["theta_S_max_degC"] = inputs.greatest(own["theta_S_degC"] for own in parts)
    hours = inputs.total(own["part_hours"] for own in parts)
    heat = (own["part_hours"] * own["loss_total_W"] for own in parts)
    v["loss_mean_W"] = inputs.total(heat) / hours
    v["loss_max_W"] = inputs.greatest(own["loss_total_W"] for own in parts)


def _forces(inputs: Inputs, v: Values, torque: Real) -> None:
    v["F_tm2_N"] = forces.wheel_tangential_force(torque, inputs.wheel_mean_diameter)
    mesh = inputs.lead_angle, v["mu_zm"]
    v["F_tm1_N"] = forces.worm_tangential_force(v["F_tm2_N"], *mesh)
    v["F_rm_N"] = forces.separating_force(v["F_tm1_N"], inputs.pressure_angle, *mesh)


def _pitting(inputs: Inputs, v: Values) -> None:
    edition = inputs.options.iso14521_edition
    v["Z_v"] = pitting.pitting_velocity_factor(v["sliding_velocity_m_s"])
    _pitting_life(inputs, v)
    v["Z_S"] = pitting.pitting_size_factor(inputs.centre_distance)
    v["Z_u"] = pitting.pitting_ratio_factor(inputs.gear_ratio, edition=edition)
    v["Z_oil"] = inputs.operation.lubricant.base.pitting_factor
    strong = inputs.gearset.wheel_material.pitting_strength * inputs.options.pitting_factor
    v["sigma_HlimT_MPa"] = strong * FROM_SI["MPa"]
    v["sigma_HG_MPa"] = pitting.pitting_limit(
        v["sigma_HlimT_MPa"],
        v["Z_h"],
        v["Z_v"],
        v["Z_S"],
        v["Z_u"],
        v["Z_oil"],
    )
    v["safety_pitting"] = strength.safety(v["sigma_HG_MPa"], v["sigma_Hm_MPa"])


def _pitting_life(inputs: Inputs, v: Values) -> None:
    """Find the life factor; of a duty cycle by the damage of its parts, which is our own rule."""
    duty = inputs.loads
    if not duty:
        v["Z_h"] = pitting.pitting_life_factor(inputs.life)
        return
    # Stress goes with the root of the torque, what is borne with the velocity factor alone.
    reliefs = [
        np.sqrt(inputs.output_torque / part.torque)
        * (
            pitting.pitting_velocity_factor(
                friction.sliding_velocity(inputs.worm_pitch_diameter, part.speed, inputs.lead_angle)
            )
            / v["Z_v"]
        )
        for part in duty
    ]
    damage = (part.hours / relief**6 for part, relief in zip(duty, reliefs, strict=True))
    v["L_He_h"] = inputs.total(damage)
    v["relief"] = inputs.least(reliefs)
    v["Z_h"] = pitting.pitting_life_factor_of_parts(v["L_He_h"], v["relief"])


def _deflection(inputs: Inputs, v: Values, mean_friction: Real) -> None:
    v["delta_m_mm"] = strength.worm_deflection(
        v["F_tm2_N"],
        inputs.lead_angle,
        mean_friction,
        inputs.pressure_angle,
        inputs.worm_root_diameter,
        0.5 * inputs.bearing_span,
        0.5 * inputs.bearing_span,
        inputs.gearset.worm_material.youngs_modulus * FROM_SI["MPa"],
    )
    v["delta_lim_mm"] = strength.deflection_limit(inputs.axial_module)
    v["safety_deflection"] = strength.safety(v["delta_lim_mm"], v["delta_m_mm"])


def _root(inputs: Inputs, v: Values) -> None:
    v["s_ft2_mm"] = strength.root_thickness(
        inputs.axial_module,
        inputs.wheel_mean_diameter,
        inputs.wheel_root_diameter,
        inputs.pressure_angle,
        inputs.lead_angle,
        smaller(v["delta_Wn_mm"], v["delta_Wlim_mm"]),
    )
    v["Y_F"] = strength.form_factor(inputs.axial_module, v["s_ft2_mm"])
    v["Y_K"] = strength.rim_factor(inputs.axial_module, inputs.rim_thickness)
    v["tau_F_MPa"] = strength.root_shear_stress(
        v["F_tm2_N"],
        inputs.effective_face_width,
        inputs.axial_module,
        v["Y_F"],
        inputs.lead_angle,
        v["Y_K"],
    )
    v["tau_FlimT_MPa"] = inputs.gearset.wheel_material.shear_strength * FROM_SI["MPa"]
    v["Y_NL"] = ROOT_LIFE_FACTOR
    v["tau_FG_MPa"] = strength.root_shear_limit(v["tau_FlimT_MPa"], v["Y_NL"])
    v["safety_root"] = strength.safety(v["tau_FG_MPa"], v["tau_F_MPa"])

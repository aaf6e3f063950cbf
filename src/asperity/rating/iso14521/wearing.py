"""What one load does by ISO/TR 14521: temperatures, lubricant film and wear."""

from asperity.arrays import Real
from asperity.gearset import oil
from asperity.rating.inputs import Inputs, Values
from asperity.rating.iso14521 import contact, film, strength, thermal, wear

_MM2 = 1e6


def sump_of(inputs: Inputs) -> Real:
    """Return the temperature of the oil sump, degC: as it is given, or by the standard."""
    if inputs.sump is not None:
        return inputs.sump
    settled = inputs.oil_temperature
    if settled is not None:
        return settled
    lubricant = inputs.operation.lubricant
    return thermal.sump_temperature(
        inputs.output_torque,
        inputs.worm_speed,
        inputs.gear_ratio,
        inputs.centre_distance,
        lubricant.viscosity_40 * _MM2,
        inputs.ambient_temperature,
        base_oil=lubricant.base_oil,
        fan=inputs.operation.fan,
    )


def temperatures(inputs: Inputs, v: Values) -> None:
    """Find the temperatures of sump and teeth, and the oil between them."""
    operation, lubricant = inputs.operation, inputs.operation.lubricant
    v["theta_S_degC"] = sump_of(inputs)
    v["theta_S_lim_degC"] = inputs.sump_limit
    v["alpha_L_W_m2K"] = thermal.heat_transfer_coefficient(
        inputs.worm_speed, immersed=operation.immersed
    )
    v["A_R_m2"] = thermal.cooling_area(inputs.rim_width, inputs.wheel_mean_diameter)
    v["theta_M_degC"] = thermal.bulk_temperature(
        v["theta_S_degC"],
        v["loss_meshing_W"],
        v["alpha_L_W_m2K"],
        v["A_R_m2"],
    )
    v["nu_M_mm2_s"] = oil.kinematic_viscosity(
        v["theta_M_degC"],
        lubricant.viscosity_40 * _MM2,
        lubricant.viscosity_100 * _MM2,
    )
    v["rho_M_kg_m3"] = oil.density(
        v["theta_M_degC"], inputs.density_15, lubricant.base.density_coefficient
    )
    v["eta_0M_Pas"] = v["nu_M_mm2_s"] * v["rho_M_kg_m3"] / _MM2


def wear_of(inputs: Inputs, v: Values) -> None:
    """Find the film, the wear of the wheel's flanks and the safety against it."""
    wheel, lubricant = inputs.gearset.wheel_material, inputs.operation.lubricant
    torque = inputs.operation.application_factor * inputs.through_travel_torque
    v["sigma_Hm_wear_MPa"] = contact.contact_stress(
        v["p_m_star"], torque, v["E_red_MPa"], inputs.centre_distance
    )
    v["h_min_um"] = film.film_thickness(
        v["h_star"],
        lubricant.base.pressure_viscosity,
        v["eta_0M_Pas"],
        inputs.worm_speed,
        inputs.centre_distance,
        v["E_red_MPa"],
        torque,
    )
    family, base_oil = wheel.family, lubricant.base_oil
    v["W_S"] = wear.lubricant_structure_factor(v["eta_0M_Pas"], family=family, base_oil=base_oil)
    v["W_H"] = wear.pressure_factor(v["sigma_Hm_wear_MPa"], family=family)
    v["K_W_um"] = wear.wear_parameter(v["h_min_um"], v["W_S"], v["W_H"])
    v["J_0T"] = wear.reference_wear_intensity(
        v["K_W_um"],
        lubrication=inputs.operation.lubrication,
        family=family,
        base_oil=base_oil,
    )
    v["W_NS"] = wear.start_factor(inputs.starts_per_hour)
    v["W_ML"] = wheel.wear_factor.get(lubricant.base_oil, 1.0) * inputs.options.wear_factor
    v["J_W"] = wear.wear_intensity(v["J_0T"], v["W_NS"], v["W_ML"])
    v["s_star"] = contact.path_parameter(
        inputs.gear_ratio, inputs.lead_angle, flank=inputs.gearset.flank
    )
    v["N_L"] = contact.load_cycles(inputs.life, inputs.worm_speed, inputs.gear_ratio)
    v["s_Wm_mm"] = contact.sliding_path(
        v["s_star"],
        v["sigma_Hm_wear_MPa"],
        inputs.centre_distance,
        v["E_red_MPa"],
        v["N_L"],
    )
    v["delta_Wn_mm"] = wear.flank_wear(v["J_W"], v["s_Wm_mm"])
    v["delta_Wlim_mm"] = wear.wear_limit(inputs.axial_module, inputs.lead_angle)
    v["safety_wear"] = strength.safety(v["delta_Wlim_mm"], v["delta_Wn_mm"])

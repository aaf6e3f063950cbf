"""A rating by ISO/TR 14521: its numbers with their equations, sources, limits and notes."""

import math
from collections.abc import Iterator

from asperity.formulas import masking
from asperity.gearset import oil
from asperity.gearset.library import GIVEN
from asperity.rating.demands import failures
from asperity.rating.entries import entries
from asperity.rating.housing import Housing
from asperity.rating.inputs import Inputs, Values
from asperity.rating.iso14521 import balance
from asperity.rating.iso14521.calculation import rated_capacity, rated_efficiency
from asperity.rating.iso14521.housed import uncounted
from asperity.rating.iso14521.limits import implausible, violations
from asperity.rating.iso14521.tables import EDITIONS, friction_constants, wear_constants
from asperity.rating.result import Rating
from asperity.sources import Source


def rate(inputs: Inputs) -> Rating:
    """Rate one gearset by ISO/TR 14521.

    A stress or safety whose formula does not reach so far is left out, and a note says why.

    Raises
    ------
    FilmParameterError
        :math:`h^*` is not above zero.
    InputError
        The standard cannot be applied.
    """
    values, unanswered = rated(inputs)
    return Rating(
        EDITIONS[inputs.options.iso14521_edition],
        entries(inputs, "iso14521", values, _sources(inputs), _equations(inputs)),
        _violations(inputs, values),
        (*unanswered, *_notes(inputs, values)),
        unanswered,
    )


def rated(inputs: Inputs) -> tuple[Values, tuple[str, ...]]:
    """Return all numbers by the keys of a rating, and why some have no answer."""
    values = rated_efficiency(inputs)
    with masking() as unanswered:
        values = rated_capacity(inputs, values)
    return values, tuple(unanswered.legend.values())


_HOTTEST_GIVEN = 100.0


def _violations(inputs: Inputs, values: Values) -> tuple[str, ...]:
    found: dict[str, None] = {}
    # It goes with the speed.
    slides = float(values["sliding_velocity_m_s"]) / float(inputs.worm_speed)
    for speed in inputs.speeds:
        sentences = violations(
            centre_distance=inputs.centre_distance,
            profile_shift=inputs.profile_shift,
            worm_speed=speed,
            ratio=inputs.gear_ratio,
            geometry_factor=values["Y_G"] if inputs.friction is None else None,
            sump_by_formula=inputs.oil_temperature is None,
            sliding_velocity=slides * float(speed),
        )
        found |= dict.fromkeys(sentences)
    own = tuple(found)
    own = (*own, *implausible(values))
    hot = values["theta_M_degC"]
    if math.isnan(values["nu_M_mm2_s"]):
        beyond = None if math.isnan(hot) else oil.TEMPERATURE.violation(hot)
        return own if beyond is None else (*own, beyond)
    return (*own, *inputs.operation.lubricant.violations(hot + 273.15))


def _notes(inputs: Inputs, values: Values) -> tuple[str, ...]:
    notes = [*failures("iso14521", values)]
    if inputs.operation.lubrication == "spray" and inputs.oil_temperature is None:
        notes.append(
            "the oil temperature is that of a splash-lubricated gearbox, though the lubrication is "
            "by spray: give operation.oil_temperature"
        )
    if inputs.gearset.wheel_material.avoids(inputs.operation.lubricant.base_oil):
        notes.append(
            "polyglycol with aluminium bronze is a pair that practice avoids, for its wear: the "
            "standard's curves are not of such pairs, and safety_wear says nothing of it"
        )
    worn = wear_constants(
        inputs.gearset.wheel_material.family,
        inputs.operation.lubrication,
        inputs.operation.lubricant.base_oil,
    )
    if values["J_0T"] >= worn.cap:
        notes.append(
            f"the wear intensity stands at its cap of {worn.cap:g}: safety_wear rests on that"
        )
    if values["theta_M_degC"] > _HOTTEST_GIVEN:
        notes.append(
            f"the wheel's bulk temperature is {values['theta_M_degC']:.0f} degC: the oil's "
            "viscosity is extrapolated beyond the 100 degC it is given at"
        )
    notes += _of_heat(inputs, values)
    spectrum = inputs.operation.spectrum
    if spectrum is not None and spectrum.oil != "each" and spectrum.oil_temperature is None:
        notes.append(
            "the oil has the mean temperature of all loads, as the cycles of S3 are alike: give "
            "spectrum.oil_temperature = 'each' where a load comes in long blocks"
        )
    if inputs.duty:
        notes.append(
            f"the duty cycle: wear adds up over its parts, {_SUMPS[_oil(inputs)]}, "
            "and film and wear factors are those of the part that wears most; pitting "
            "goes by its parts' damage, with the exponent of Z_h (our own rule); deflection and "
            "root go by the rated torque, the friction there by the speed of the part with the "
            "greatest torque"
        )
        if inputs.operation.through_travel_torque is not None:
            notes.append(
                "operation.through_travel_torque does not count beside operation.duty_cycle, whose "
                "parts tell what is carried"
            )
        if inputs.operation.spectrum is not None and inputs.operation.model_fields_set & _LIVES:
            notes.append(
                "operation.life and operation.wheel_revolutions do not count beside [spectrum], "
                "whose steps are the whole life"
            )
    elif inputs.oil_temperature is None and inputs.through_travel_torque < inputs.output_torque:
        notes.append(
            "the oil is as hot as under the rated torque all the time; wear goes by the "
            "through-travel torque at that temperature: give operation.oil_temperature if it is "
            "cooler"
        )
    return tuple(notes)


_MOST_BEYOND = 30.0  # W/(m2 K)


def _of_heat(inputs: Inputs, values: Values) -> Iterator[str]:
    """Say where the sump's temperature by the standard and the heat balance contradict."""
    if told := uncounted(inputs):
        yield f"heat: {told}"
    housing = inputs.operation.housing
    if housing is None:
        return
    if values.get("k_S_W_m2K", 0.0) > _MOST_BEYOND:
        yield (
            f"heat: the sump's formula of ISO/TR 14521, which knows no losses, would have the "
            f"housing give off {values['k_S_W_m2K']:.0f} W/(m2 K); more than {_MOST_BEYOND:g} "
            "takes blown air: wear and film go by that formula, temperature by the balance"
        )


_SUMPS = {
    "each": "each with the sump at rest at its own temperature",
    "mean": "all with the oil at the mean temperature of its parts, weighted by their hours",
}
_LIVES = {"life", "wheel_revolutions"}


def _oil(inputs: Inputs) -> str:
    spectrum = inputs.operation.spectrum
    return "each" if spectrum is None else spectrum.oil


def _equations(inputs: Inputs) -> dict[str, str]:
    """Return the equations that depend on the case, by key."""
    options, operation = inputs.options, inputs.operation
    wheel, base_oil = inputs.gearset.wheel_material, operation.lubricant.base_oil
    concave, old = inputs.gearset.flank == "ZC", options.iso14521_edition == "1998"
    law = friction_constants(wheel.family, operation.lubrication, base_oil)
    worn = wear_constants(wheel.family, operation.lubrication, base_oil)
    iron = wheel.family in ("grey iron", "nodular iron")
    thin = base_oil == "mineral" or (base_oil == "polyalphaolefin" and iron)
    intensity = f"{worn.scale:g} K_W^-{worn.exponent:g}"
    by_case = {
        "mu_0T": (
            "input"
            if options.base_friction is not None
            else f"min({law.offset:g} + {law.gain:g}/(v_gm + {law.shift:g})^{law.exponent:g}, "
            f"{law.cap:g})"
        ),
        "h_star": (
            "0.018 + q_1/(7.86 (q_1 + z_2)) + 1/z_2 + x_2/110 - u/36300 + b_2H/(370.4 m_x1) - "
            "sqrt(2 q_1 - 1)/213.9"
            if old
            else f"{'-0.511 + 3.7904e-6' if concave else '-0.393 + 2.9157e-6'} "
            "P(z_2, alpha_n, x_2, q_1, z_1/q_1, m_x1)"
        ),
        "p_m_star": (
            "1.03 (0.4 + x_2/u + 0.01 z_2 - 0.083 b_2H/m_x1 + sqrt(2 q_1 - 1)/6.9 + "
            "(q_1 + 50 (u + 1)/u)/(15.9 + 37.5 q_1))"
            if old
            else f"polynomial of {'C' if concave else 'A, I, N, K'} flanks in "
            "a/d_m1, x_2, q_1, z_2, alpha_n, z_1/q_1"
        ),
        "theta_S_degC": (
            "input"
            if operation.oil_temperature is not None
            else "theta_0 + (c_1 T_R/(a/63)^3 + c_0) c_2 with c_0, c_1, c_2 of n_1, u, a, nu_40, "
            f"{'with' if operation.fan else 'without'} a fan"
        ),
        "W_S": "1" if thin else "eta_0M^-0.35",
        "W_H": "(300/sigma_Hm2)^1.4" if iron else "min(1, (450/sigma_Hm2)^4.5)",
        "J_0T": f"min({intensity}, {worn.cap:g})" if math.isfinite(worn.cap) else intensity,
        "s_star": (
            "0.94 + 0.25 u + 6.7/tan(gamma_m1)" if concave else "0.78 + 0.21 u + 5.6/tan(gamma_m1)"
        ),
    }
    if old:
        by_case["Z_u"] = "1"
    if inputs.duty:
        by_case |= {
            "N_L": "sum of 60 L_h n_1/u over the duty cycle",
            "s_Wm_mm": "sum of s* sigma_Hm a/E_red N_L over the duty cycle",
            "delta_Wn_mm": "sum of J_W s_Wm over the duty cycle",
            "Z_h": "min((25000/L_He)^(1/6), 1.6 k_r)",
            "safety_temperature": "theta_Slim/theta_Smax",
        }
    if operation.housing is not None:
        by_case |= _of_housing(operation.housing, inputs)
    if options.friction is not None:
        by_case["mu_zm"] = f"k_mu {options.friction:g}"
    return by_case


def _of_housing(housing: Housing, inputs: Inputs) -> dict[str, str]:
    """Return the equations of a housing's heat, by key."""
    how = inputs.how.kind
    timed = housing.capacity is not None and how != "S1"
    equations = {"safety_temperature": "theta_Slim/theta_h"}
    if timed:
        equations["theta_h_degC"] = "theta_0 + dtheta_t"
        formula = balance.rise_in_cycles if how == "S3" else balance.rise_after
        equations["rise_top_K"] = formula.equation
    equations["A_h_m2"] = balance.AREAS[housing.area_rule].equation
    if housing.area is not None:
        equations["A_h_m2"] = "input"
    if not inputs.duty:
        equations["loss_heating_W"] = "P_V"
    elif _oil(inputs) == "mean":
        equations["loss_heating_W"] = "P_Vm"
    if housing.idle_loss is not None:
        equations["loss_idle_W"] = balance.measured_idle_loss.equation
    if housing.seal_loss is not None:
        equations["loss_seal_W"] = balance.measured_seal_loss.equation
    return equations


def _sources(inputs: Inputs) -> dict[str, Source]:
    """Return where the values of tables come from, by key."""
    wheel, operation = inputs.gearset.wheel_material, inputs.operation
    law = wheel.family, operation.lubrication, operation.lubricant.base_oil
    base = operation.lubricant.base
    in_place = {
        "mu_0T": inputs.base_friction,
        "mu_zm": inputs.friction,
        "theta_S_degC": inputs.oil_temperature,
    }
    changed = {
        "W_ML": inputs.options.wear_factor, "sigma_HlimT_MPa": inputs.options.pitting_factor,
    }  # fmt: skip
    in_place |= {key: None if factor == 1.0 else factor for key, factor in changed.items()}
    housing, by_rule = operation.housing, {}
    if housing is not None:
        own = {"A_h_m2": "area", "loss_idle_W": "idle_loss", "loss_seal_W": "seal_loss"}
        in_place |= {key: getattr(housing, name) for key, name in own.items()}
        by_rule = {"A_h_m2": balance.AREAS[housing.area_rule].source}
    return {
        "mu_0T": friction_constants(*law).source,
        "Y_W": wheel.source("material_factor"),
        "theta_S_lim_degC": base.source("sump_limit"),
        "J_0T": wear_constants(*law).source,
        "W_ML": wheel.source("wear_factor"),
        "Z_oil": base.source("pitting_factor"),
        "sigma_HlimT_MPa": wheel.source("pitting_strength"),
        "tau_FlimT_MPa": wheel.source("shear_strength"),
        **by_rule,
        **{key: GIVEN for key, value in in_place.items() if value is not None},
    }

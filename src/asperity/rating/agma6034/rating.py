"""A gearset by AGMA 6034: the formulas in the order of the calculation.

Loads go by the rated torque times the application factor, powers and temperatures by the rated
torque itself.
"""

import math

import numpy as np

from asperity.arrays import Real
from asperity.errors import InputError
from asperity.gearset import oil
from asperity.gearset.library import GIVEN
from asperity.rating.agma6034 import capacity, forces, limits, mesh, thermal
from asperity.rating.agma6034.symbols import LEAD_ANGLES
from asperity.rating.demands import failures
from asperity.rating.entries import entries
from asperity.rating.inputs import Inputs, Values, times
from asperity.rating.iso14521 import losses, strength
from asperity.rating.result import Rating
from asperity.sources import Range, Source

_AGREE = 1e-3  # of the losses, that those by powers and by e_W may be apart untold
_MOMENTARY = 30.0  # s in all: what lasts no longer is a peak (our own rule)


def rate(inputs: Inputs) -> Rating:
    """Rate one gearset by AGMA 6034.

    Raises
    ------
    InputError
        The standard cannot be applied.
    """
    values = rated(inputs)
    equations = {} if inputs.friction is None else {"mu": f"k_mu {inputs.friction:g}"}
    if inputs.duty:
        equations["safety_torque"] = "min(T_Gall/(K_A T_i)) over the duty cycle"
    return Rating(
        "ANSI/AGMA 6034-B92",
        entries(inputs, "agma6034", values, _sources(inputs), equations),
        _violations(inputs, values),
        _notes(inputs, values),
    )


def rated(inputs: Inputs, *, loads: bool = True) -> Values:
    """Return friction, efficiency, loads and heat by the keys of a rating.

    Of a duty cycle the safety is the least and the sump's temperature the highest of its parts;
    everything else is that under the rated torque. Without ``loads`` it is friction, efficiency and
    the torque alone.
    """
    inputs.gearset.wheel_material.require_covered("AGMA 6034")
    v = _rated(inputs, loads)
    # A part under the rated load has what is known of that.
    parts = [
        dict(v) if _is_alike(part, inputs) else _rated(part, loads) for part in inputs.parted()
    ]
    if parts:
        for place, own in enumerate(() if inputs.together else parts, 1):
            v |= {f"part_{place}.{key}": value for key, value in own.items()}
        v["safety_torque"] = _least(inputs, parts)
        if loads:
            v["t_s_degC"] = inputs.greatest(own["t_s_degC"] for own in parts)
    return v


def _is_alike(part: Inputs, inputs: Inputs) -> bool:
    """Whether speed and torque are the same numbers; arrays and cells are others."""
    pairs = (part.worm_speed, inputs.worm_speed), (part.output_torque, inputs.output_torque)
    return all(type(one) is type(other) is float and one == other for one, other in pairs)


def _least(inputs: Inputs, parts: list[Values]) -> Real:
    """Return the least safety of parts, of a spectrum of those above the peaks' time if any is."""
    safeties = [own["safety_torque"] for own in parts]
    if inputs.operation.spectrum is None:
        return inputs.least(safeties)
    lasts = [part.hours * 3600.0 > _MOMENTARY for part in inputs.loads]
    if inputs.together or any(isinstance(long, np.ndarray) for long in lasts):
        lasting = [np.where(a, b, np.inf) for a, b in zip(lasts, safeties, strict=True)]
        some, every = inputs.least(lasting), inputs.least(safeties)
        return np.where(np.isinf(some), every, some)
    kept = [safety for long, safety in zip(lasts, safeties, strict=True) if long]
    return inputs.least(kept or safeties)


def _rated(inputs: Inputs, loads: bool) -> Values:
    casting = inputs.gearset.wheel_material.agma6034
    if casting is None:
        raise InputError(
            f"gearset.wheel_material is {inputs.gearset.wheel_material.name!r}, which is no bronze "
            "that AGMA 6034 covers; take another, or a table with the key 'agma6034'"
        )
    v: Values = {}
    v["sliding_velocity_m_s"] = mesh.sliding_velocity(
        inputs.worm_pitch_diameter, inputs.lead_angle, inputs.worm_speed
    )
    mean = inputs.friction
    if mean is None:
        mean = mesh.friction(v["sliding_velocity_m_s"])
    v["mu"] = times(mean, inputs.friction_factor)
    teeth = v["mu"], inputs.lead_angle, inputs.pressure_angle
    v["eta"] = mesh.worm_driving_efficiency(*teeth)
    v["eta_back"] = mesh.wheel_driving_efficiency(*teeth)
    v["C_s"] = capacity.materials_factor(
        inputs.centre_distance, inputs.wheel_mean_diameter, casting
    )
    v["C_m"] = capacity.ratio_correction_factor(inputs.gear_ratio)
    v["C_v"] = capacity.velocity_factor(v["sliding_velocity_m_s"])
    v["F_e_mm"] = capacity.effective_face_width(inputs.wheel_face_width, inputs.worm_pitch_diameter)
    v["W_t_all_N"] = capacity.allowable_tangential_load(
        v["C_s"],
        inputs.wheel_mean_diameter,
        v["F_e_mm"],
        v["C_m"],
        v["C_v"],
    )
    v["allowable_torque_Nm"] = capacity.wheel_torque(v["W_t_all_N"], inputs.wheel_mean_diameter)
    factor = inputs.operation.service_factor
    torque = (
        inputs.operation.application_factor if factor is None else factor
    ) * inputs.output_torque
    v["safety_torque"] = strength.safety(v["allowable_torque_Nm"], torque)
    if loads:
        _forces(inputs, v, torque)
        _heat(inputs, v)
    return v


def _forces(inputs: Inputs, v: Values, torque: Real) -> None:
    teeth = v["mu"], inputs.lead_angle, inputs.pressure_angle
    v["W_G_N"] = 2000.0 * torque / inputs.wheel_mean_diameter
    v["W_W_N"] = forces.worm_tangential_load(v["W_G_N"], *teeth)
    v["bending_stress_MPa"] = forces.bending_stress(
        v["W_G_N"],
        inputs.axial_pitch,
        inputs.lead_angle,
        v["F_e_mm"],
        forces.lewis_form_factor(inputs.pressure_angle),
    )


def _heat(inputs: Inputs, v: Values) -> None:
    v["output_power_W"] = losses.output_power(
        inputs.output_torque, inputs.worm_speed, inputs.gear_ratio
    )
    load = 2000.0 * inputs.output_torque / inputs.wheel_mean_diameter
    teeth = v["mu"], inputs.lead_angle, inputs.pressure_angle
    v["W_f_N"] = forces.friction_force(load, *teeth)
    v["loss_meshing_W"] = thermal.friction_power(v["sliding_velocity_m_s"], v["W_f_N"])
    v["input_power_W"] = v["output_power_W"] + v["loss_meshing_W"]
    v["input_torque_Nm"] = v["input_power_W"] / (math.pi / 30.0 * inputs.worm_speed)
    v["h_CR_W_m2K"] = thermal.heat_transfer_coefficient(inputs.worm_speed, fan=inputs.operation.fan)
    v["A_min_m2"] = thermal.minimum_housing_area(inputs.centre_distance)
    v["t_s_degC"] = thermal.sump_temperature(
        inputs.ambient_temperature,
        v["input_power_W"],
        v["eta"],
        v["h_CR_W_m2K"],
        v["A_min_m2"],
    )


def _sources(inputs: Inputs) -> dict[str, Source]:
    casting = {"C_s": inputs.gearset.wheel_material.source("agma6034")}
    return casting if inputs.friction is None else {**casting, "mu": GIVEN}


def _violations(inputs: Inputs, values: Values) -> tuple[str, ...]:
    fastest = max(inputs.speeds)
    at = {
        "sliding_velocity": values["sliding_velocity_m_s"] * (fastest / inputs.worm_speed),
        "worm_speed": fastest,
        "gear_ratio": inputs.gear_ratio,
        "pressure_angle": math.degrees(inputs.pressure_angle),
    }
    found = [limits.VALIDITY[name].violation(value) for name, value in at.items()]
    steepest = math.degrees(mesh.maximum_lead_angle(inputs.pressure_angle))
    lead = Range("lead angle", 0.0, steepest, "deg", LEAD_ANGLES)
    found.append(lead.violation(math.degrees(inputs.lead_angle)))
    hottest, oils = oil.TEMPERATURE.upper, oil.TEMPERATURE.source
    sump = Range("temperature of the sump t_s", oil.TEMPERATURE.lower, hottest, "degC", oils)
    found.append(sump.violation(values["t_s_degC"]))
    return tuple(sentence for sentence in found if sentence)


def _losses_and_efficiency(inputs: Inputs) -> str:
    apart = inputs.wheel_reference_diameter / inputs.wheel_mean_diameter - 1.0
    if abs(apart) <= _AGREE:
        return "the friction force W_f is taken as Shigley has it, so that losses and e_W agree"
    way = "less" if apart < 0.0 else "more"
    return (
        "the friction force W_f is taken as Shigley has it; the load is that at the wheel's mean "
        "diameter, the sliding velocity that on the worm's: with this profile shift losses are "
        f"{100.0 * abs(apart):.2g} % {way} than by e_W"
    )


def _notes(inputs: Inputs, values: Values) -> tuple[str, ...]:
    notes = [_losses_and_efficiency(inputs)]
    if inputs.duty:
        notes.append(
            "the duty cycle: the standard has no rule for one; its safety and its sump are those "
            "of the part that is nearest to its limit"
        )
    if not inputs.gearset.worm_material.hardened:
        notes.append(
            f"the worm of {inputs.gearset.worm_material.name} is not known to be hardened to 58 "
            "HRC or more, which the standard takes for granted"
        )
    return (*failures("agma6034", values), *notes)

"""A gearset by BS 721: the formulas in the order of the calculation.

Wear is judged by the torque through the travel and strength by the rated torque, both times the
application factor, for the whole running time; of a valve strength for a tenth of it (thesis
3.3.1), of a duty cycle for equivalent times at the greatest torque of its parts and at the rated
one, both at the speed of the part with the greatest torque (the fastest of such).
"""

from collections.abc import Callable, Iterator, Sequence
from typing import Any

import numpy as np

from asperity.arrays import Real, smaller
from asperity.errors import InputError
from asperity.formulas import current_mask, masking
from asperity.gearset.library import GIVEN
from asperity.rating.bs721 import life, torque
from asperity.rating.bs721.limits import VALIDITY
from asperity.rating.bs721.symbols import FROM_MEMORY
from asperity.rating.bs721.tables import TableRangeError, Tables
from asperity.rating.demands import failures
from asperity.rating.entries import entries
from asperity.rating.inputs import Inputs, Values
from asperity.rating.iso14521 import efficiency
from asperity.rating.iso14521.friction import sliding_velocity
from asperity.rating.iso14521.strength import safety
from asperity.rating.result import Rating
from asperity.sources import Source, weakest

_FEW = 16  # speeds that are looked up one by one
_TOLD = 16  # parts that are told of one by one
_OF_DUTY = (
    "the duty cycle: hours are referred to n_m, the worm's speed in the part with the greatest "
    "torque, at which the speed factors are looked up too"
)


def rate(inputs: Inputs, tables: Tables) -> Rating:
    """Rate one gearset by BS 721.

    Raises
    ------
    InputError
        The standard cannot be applied.
    """
    values, notes = rated(inputs, tables)
    return Rating(
        "BS 721-2:1983",
        entries(inputs, "bs721", values, _sources(inputs, tables), _equations(inputs, values)),
        _violations(inputs, values),
        (*notes, *_notes(inputs, values, tables)),
        (*notes, *_parts_unrated(inputs, tables)),
    )


def rated(inputs: Inputs, tables: Tables) -> tuple[Values, tuple[str, ...]]:
    """Return friction and permissible torques by the keys of a rating, and notes."""
    inputs.gearset.wheel_material.require_covered("BS 721")
    wheel, worm = _rows(inputs)
    v: Values = {}
    v["sliding_velocity_m_s"] = sliding_velocity(
        inputs.worm_pitch_diameter, inputs.worm_speed, inputs.lead_angle
    )
    mean = inputs.friction
    if mean is None:
        mean = torque.friction(v["sliding_velocity_m_s"], tables=tables)
    v["mu"] = mean * inputs.friction_factor
    angle = v["mu"]
    if by_normal_section(inputs):
        angle = angle / np.cos(inputs.pressure_angle)
    v["eta"] = efficiency.worm_driving_efficiency(inputs.lead_angle, angle)
    v["eta_back"] = efficiency.wheel_driving_efficiency(inputs.lead_angle, angle)
    geometry = inputs.axial_module, inputs.diameter_factor, inputs.lead_angle
    m, q, lead = geometry
    d_2, n_1 = inputs.wheel_reference_diameter, inputs.hardest_speed
    n_2 = n_1 / inputs.gear_ratio
    at = sliding_velocity(inputs.worm_pitch_diameter, n_1, inputs.lead_angle)
    v["X_c"] = torque.wear_speed_factor(at, n_2, tables=tables)
    v["Z"] = torque.zone_factor(inputs.starts, q, inputs.wheel_face_width, m, tables=tables)
    v["S_c_MPa"] = tables.surface_stress_factor(wheel, worm)
    v["X_b"] = torque.strength_speed_factor(n_2, tables=tables)
    _as_far_as_parts_reach(inputs, tables, v)
    v["S_b_MPa"] = tables.bending_stress_factor("wheel", wheel)
    v["l_r_mm"] = torque.root_arc(inputs.wheel_face_width, inputs.worm_tip_diameter, *geometry)

    def wear(speed_factor: Real, stress_factor: float) -> Real:
        return torque.wear_torque(speed_factor, stress_factor, v["Z"], d_2, m)

    def strength(speed_factor: Real, stress_factor: float) -> Real:
        return torque.strength_torque(speed_factor, stress_factor, m, v["l_r_mm"], d_2, lead)

    def worm_wear() -> Real:
        speed = torque.wear_speed_factor(at, n_1, member="worm", tables=tables)
        return wear(speed, tables.worm_surface_stress_factor(worm, wheel))

    def worm_strength() -> Real:
        speed = torque.strength_speed_factor(n_1, member="worm", tables=tables)
        return strength(speed, tables.bending_stress_factor("worm", worm))

    v["M_c_wheel_Nm"] = wear(v["X_c"], v["S_c_MPa"])
    lower_wear, wear_note = _with_worm(v, "M_c", worm_wear)
    v["M_b_wheel_Nm"] = strength(v["X_b"], v["S_b_MPa"])
    lower_strength, strength_note = _with_worm(v, "M_b", worm_strength)
    _torques(inputs, v, lower_wear, lower_strength)
    return v, tuple(note for note in (wear_note, strength_note) if note)


def _as_far_as_parts_reach(inputs: Inputs, tables: Tables, v: Values) -> None:
    """Leave the speed factors of the wheel without a value where a part is beyond its tables.

    Of one gearset that raises TableRangeError, as it does of a load that is all the same.
    """
    own_speeds = [part.speed for part in inputs.duty]
    speeds = inputs.speeds if inputs.together else own_speeds
    for speed in _unreached(inputs, tables, speeds, "wheel"):
        at = sliding_velocity(inputs.worm_pitch_diameter, speed, inputs.lead_angle)
        wheel = speed / inputs.gear_ratio
        own = {
            "X_c": torque.wear_speed_factor(at, wheel, tables=tables),
            "X_b": torque.strength_speed_factor(wheel, tables=tables),
        }
        if current_mask() is not None:
            v |= {key: np.where(np.isnan(one), one, v[key]) for key, one in own.items()}


def _unreached(
    inputs: Inputs, tables: Tables, speeds: Sequence[Real], member: torque.Member
) -> Sequence[Real]:
    """Return the speeds of the worm at which a table of the wheel, or the worm, may not reach.

    Of many, which are looked up at once; few are returned all.
    """
    if len(speeds) <= _FEW or inputs.is_varied or any(np.ndim(speed) for speed in speeds):
        return speeds
    worm = np.asarray(speeds, dtype=np.float64)
    turning = worm / inputs.gear_ratio if member == "wheel" else worm
    with masking(worm.shape) as mask:
        at = sliding_velocity(inputs.worm_pitch_diameter, worm, inputs.lead_angle)
        torque.wear_speed_factor(at, turning, member=member, tables=tables)
        torque.strength_speed_factor(turning, member=member, tables=tables)
    return [speed for speed, reason in zip(speeds, mask.reason, strict=True) if reason]


def _parts_unrated(inputs: Inputs, tables: Tables) -> Iterator[str]:
    """Say which parts of a duty cycle run at speeds that no table reaches: some, and how many."""
    first = {part.speed: place for place, part in reversed([*enumerate(inputs.duty, 1)])}
    parts = (
        first.items() if inputs.together else [(p.speed, n) for n, p in enumerate(inputs.duty, 1)]
    )
    members: tuple[torque.Member, ...] = ("wheel", "worm")
    for member in members:
        unreached = set(_unreached(inputs, tables, [speed for speed, _ in parts], member))
        told = more = 0
        for worm_speed, place in parts:
            if worm_speed not in unreached:
                continue
            if told == _TOLD and len(unreached) < len(parts):
                more += 1
                continue
            speed = worm_speed / inputs.gear_ratio if member == "wheel" else worm_speed
            try:
                torque.strength_speed_factor(speed, member=member, tables=tables)
                torque.wear_speed_factor(
                    sliding_velocity(inputs.worm_pitch_diameter, worm_speed, inputs.lead_angle),
                    speed, member=member, tables=tables,
                )  # fmt: skip
            except TableRangeError as error:
                if told == _TOLD:
                    more += 1
                    continue
                told += 1
                yield f"the {member} is not rated: part {place} of the duty cycle: {error}"
        if more:
            yield (
                f"the {member} is not rated: {more} more parts of the duty cycle, at speeds that "
                "its tables do not reach"
            )


def by_normal_section(inputs: Inputs) -> bool:
    """Whether the efficiencies take mu/cos(alpha_n) for the tangent of the friction angle."""
    return inputs.options.bs721_friction_angle == "mu_over_cos"


def _with_worm(v: Values, symbol: str, worm: Callable[[], Real]) -> tuple[Real, str]:
    """Return the lower torque of wheel and worm, and why the worm is not rated."""
    wheel = v[f"{symbol}_wheel_Nm"]
    mask = current_mask()
    if mask is not None:
        # A worm that no table reaches does not limit; a wheel without an answer stays without.
        with masking(mask.copy()):
            return np.where(np.isnan(wheel), wheel, np.fmin(wheel, worm())), ""
    try:
        v[f"{symbol}_worm_Nm"] = worm()
    except TableRangeError as error:
        return wheel, f"the worm is not rated: {error}"
    return smaller(wheel, v[f"{symbol}_worm_Nm"]), ""


def _equations(inputs: Inputs, values: Values) -> dict[str, str]:
    wear = "min(M_c1, M_c2)" if "M_c_worm_Nm" in values else "M_c2"
    bending = "min(M_b1, M_b2)" if "M_b_worm_Nm" in values else "M_b2"
    by_case = {
        "M_26k_Nm": f"min({wear}, {bending})",
        "M_w_Nm": f"{wear} k_w",
        "M_s_Nm": f"{bending} k_s",
        "U_w_h": "L_h",
        "U_s_h": "L_h/10" if inputs.operation.service == "valve" else "L_h",
    }
    if inputs.duty:
        for key, exponent, torque in (("U_w_h", 3, "T_2"), ("U_s_h", 7, "T_R")):
            by_case[key] = f"sum of U_i n_i/n_m (T_i/{torque})^{exponent} over the duty cycle"
    if by_normal_section(inputs):
        by_case["eta"] = "tan(gamma_m1)/tan(gamma_m1 + atan(mu/cos(alpha_n)))"
        by_case["eta_back"] = "tan(gamma_m1 - atan(mu/cos(alpha_n)))/tan(gamma_m1)"
    if inputs.friction is not None:
        by_case["mu"] = f"k_mu {inputs.friction:g}"
    return by_case


def _sources(inputs: Inputs, tables: Tables) -> dict[str, Source]:
    row = inputs.gearset.wheel_material.source("bs721")
    sources = {
        "X_c": weakest(tables.sliding_speed_factor.source, tables.rotation_speed_factor.source),
        "Z": tables.zone_factor.source,
        "S_c_MPa": weakest(tables.surface_stress_factor.source, row),
        "X_b": tables.strength_speed_factor.source,
        "S_b_MPa": weakest(tables.bending_stress_factor.source, row),
        "M_c_worm_Nm": tables.worm_surface_stress_factor.source,
    }
    sources["mu"] = tables.friction.source if inputs.friction is None else GIVEN
    if inputs.duty:
        sources |= {"U_w_h": FROM_MEMORY, "U_s_h": FROM_MEMORY}
    return sources


def _violations(inputs: Inputs, values: Values) -> tuple[str, ...]:
    fastest = max(inputs.speeds)
    at = {
        "axial_module": inputs.axial_module,
        "wheel_diameter": inputs.wheel_reference_diameter,
        "sliding_velocity": values["sliding_velocity_m_s"] * (fastest / inputs.worm_speed),
        "wheel_speed": fastest / inputs.gear_ratio,
    }
    found = (span.violation(at[name]) for name, span in VALIDITY.items())
    return tuple(sentence for sentence in found if sentence)


def _notes(inputs: Inputs, values: Values, tables: Tables) -> list[str]:
    notes = [_OF_DUTY] if inputs.duty else []
    notes += [
        f"{part}: {note}"
        for part in ("wheel", "worm")
        if (note := getattr(inputs.gearset, f"{part}_material").source("bs721").note)
    ]
    bronze = inputs.gearset.wheel_material.family == "tin bronze"
    if inputs.friction is None and not (bronze and inputs.gearset.worm_material.hardened):
        notes.append("the friction is that of phosphor bronze on a case-hardened worm")
    if doubt := tables.surface_stress_factor.doubts.get(", ".join(_rows(inputs))):
        notes.append(f"S_c of the wheel is {values['S_c_MPa']:g} MPa; it is {doubt}")
    if inputs.gearset.flank != "ZI":
        notes.append(f"the flank is {inputs.gearset.flank}; the standard is for ZI")
    return [*failures("bs721", values), *notes]


def _rows(inputs: Inputs) -> tuple[str, str]:
    """Return what the tables of stress factors call the materials."""
    rows = []
    for part in ("wheel", "worm"):
        material: Any = getattr(inputs.gearset, f"{part}_material")
        if material.bs721 is None:
            raise InputError(
                f"gearset.{part}_material is {material.name!r}, for which BS 721 has no stress "
                "factors; take another, or a table with the key 'bs721'"
            )
        rows.append(material.bs721)
    return rows[0], rows[1]


def _torques(inputs: Inputs, v: Values, wear: Real, strength: Real) -> None:
    v["M_26k_Nm"] = smaller(wear, strength)
    v["U_w_h"], v["U_s_h"] = inputs.wear_hours, inputs.strength_hours
    v["wear_life_factor"] = life.wear_life_factor(v["U_w_h"])
    v["strength_life_factor"] = life.strength_life_factor(v["U_s_h"])
    v["M_w_Nm"] = wear * v["wear_life_factor"]
    v["M_s_Nm"] = strength * v["strength_life_factor"]
    v["M_permissible_Nm"] = smaller(v["M_w_Nm"], v["M_s_Nm"])
    factor = inputs.operation.application_factor
    v["safety_wear"] = safety(v["M_w_Nm"], factor * inputs.through_travel_torque)
    v["safety_strength"] = safety(v["M_s_Nm"], factor * inputs.output_torque)

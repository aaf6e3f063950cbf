"""Claims 1.1, 2.6, 3.9 to 3.14 and 7.9: what the thesis says of gearsets besides their numbers."""

import math

import numpy as np

from asperity.rating.agma6034.forces import lewis_form_factor
from asperity.rating.bs721.torque import friction
from asperity.roots import root_between
from asperity.thesis.exhibits import claim
from asperity.thesis.products import ARITHMETIC, FITTED, NOT_TESTABLE, Finding
from asperity.thesis.rating.claims import FROM_MEMORY
from asperity.thesis.rating.rated import (
    GEARSET_2,
    GEARSET_3,
    GEARSETS,
    OPTIMISED,
    OTHERS_ARE,
    RatedGear,
    number,
)

_LOW, _HIGH = 0.05, 0.10


@claim("1.1")
def _saving() -> Finding:
    output, ratio = 150.0, 15.0
    before, after = (output / (ratio * efficiency) for efficiency in (0.5, 0.8))
    saved = after / before - 1.0
    return Finding.judged(
        {
            "20 N m to 12.5 N m": math.isclose(before, 20.0) and math.isclose(after, 12.5),
            "37 % less power": math.floor(-100.0 * saved) == 37,
        },
        f"{before:g} N m to {after:g} N m, {saved:.1%}",
        "Arithmetic: T_1 = T_2/(U eta). The thesis drops the half percent.",
        {"torque_before_Nm": before, "torque_after_Nm": after, "saving": -saved},
        ["output_torque / (gear_ratio * efficiency)"],
        verdict=ARITHMETIC,
    )


@claim("2.6")
def _bronze_on_steel() -> Finding:
    keys = {
        "BS 721": ("bs721", "mu"),
        "AGMA 6034": ("agma6034", "mu"),
        "mu_0T of ISO/TR 14521": ("iso14521", "mu_0T"),
        "mu_zm of ISO/TR 14521": ("iso14521", "mu_zm"),
    }
    found = {
        name: [gear.number(standard, key) for gear in GEARSETS.values()]
        for name, (standard, key) in keys.items()
    }
    velocities = [gear.number("iso14521", "sliding_velocity_m_s") for gear in GEARSETS.values()]
    second, third = found["mu_0T of ISO/TR 14521"]
    speeds = np.geomspace(0.01, 2.0, 400)
    inside = speeds[(friction(speeds) <= _HIGH) & (friction(speeds) >= _LOW)]
    slow, fast = float(inside[0]), float(inside[-1])
    return Finding.judged(
        {
            f"by {name}": all(_LOW <= mu <= _HIGH for mu in both)
            for name, both in found.items()
            if not name.startswith("mu_0T")
        },
        "; ".join(f"{name} {' and '.join(f'{mu:.3f}' for mu in both)}"
                  for name, both in found.items()),
        "“The most common sliding speeds” are not named, so there is nothing to hold it to. By BS "
        f"721, which is cited, friction lies in the range from {slow:.2f} to {fast:.2f} m/s; at "
        "the velocities of gearsets 2 and 3, "
        f"{' and '.join(f'{velocity:.2f}' for velocity in velocities)} m/s, it is lower. ISO/TR "
        f"14521 has its base friction in the range there, {second:.3f} and {third:.3f}, and raises "
        "it for size, geometry, material and roughness. The table of BS 721 is from memory.",
        {
            f"{gear}_{name.partition(' of ')[0]}": mu
            for name, both in found.items()
            for gear, mu in zip(GEARSETS, both, strict=True)
        }
        | {"BS_721_from_m_s": slow, "BS_721_to_m_s": fast},
        GEARSETS.values(),
        verdict=NOT_TESTABLE,
    )  # fmt: skip


@claim("3.9")
def _orders() -> Finding:
    parts: dict[str, bool] = {}
    numbers: dict[str, float] = {}
    shown = []
    spare: dict[str, float] = {}
    for name, gear in GEARSETS.items():
        keys = ("M_26k_Nm", "M_w_Nm", "M_s_Nm", "output_torque_Nm", "through_travel_torque_Nm")
        long, wear, strength, rated, peak = gear.numbers("bs721", *keys)
        mesh, gearbox = gear.numbers("iso14521", "eta_z1_2", "eta_ges")
        parts |= {
            f"{name}: eta_ges < eta_z": gearbox < mesh,
            f"{name}: M_w, M_s > M_26k": min(wear, strength) > long,
            f"{name}: M_w > T_2": wear > peak,
            f"{name}: M_s > T_R": strength > rated,
        }
        shown.append(
            f"{name}: {gearbox:.1%} < {mesh:.1%}; M_w {wear:.0f} > {peak:.0f}, M_s {strength:.0f} "
            f"> {rated:.0f}, both > {long:.0f} N m"
        )
        spare[name] = strength / rated - 1.0
        numbers |= {
            f"{name}_{key}": value
            for key, value in (("eta_ges", gearbox), ("eta_z", mesh), ("M_26k_Nm", long),
                               ("M_w_Nm", wear), ("M_s_Nm", strength), ("T_2_Nm", peak),
                               ("T_R_Nm", rated))
        }  # fmt: skip
    narrow = min(spare, key=lambda name: spare[name])
    return Finding.judged(
        parts,
        "; ".join(shown),
        "T_2 is the torque of through travel, a third of T_R as 3.2.1 has it. The narrowest is M_s "
        f"above T_R, by {spare[narrow]:.0%} of {narrow}. Of gearsets 2 and 3, which are "
        "reconstructed; the others are lost.",
        numbers,
        GEARSETS.values(),
        assumed=f"Face widths of the wheels, which are lost, by the usual formula. {FROM_MEMORY}",
    )  # fmt: skip


@claim("3.10")
def _besides_the_optimum() -> Finding:
    change = {name: gear.changes for name, gear in GEARSETS.items()}
    second, third = change.values()
    others = [change["sigma_a"] for change in GEARSET_3.changes_elsewhere]
    optimum = GEARSET_3.optimum
    angles = [
        math.radians(number(rated, "iso14521", "pressure_angle_deg"))
        for rated in (optimum.before, optimum.after)
    ]
    start = math.degrees(angles[0])
    before, after = (float(lewis_form_factor(angle)) for angle in angles)
    form = before / after
    bare = (1.0 + third["sigma_a"]) / form - 1.0
    return Finding.judged(
        {
            "M_w rises a little": all(0.0 < own["M_w"] < 0.1 for own in change.values()),
            "M_s stays": all(abs(own["M_s"]) < 1e-6 for own in change.values()),
            "eta_AGMA does not rise in all": min(own["eta_AGMA"] for own in change.values()) <= 0.0,
            "q_1 rises for gearset 3 only": second["q_1"] <= 0.0 < third["q_1"],
            "“q_1 and σ_a increase for gearset 3 only”: σ_a": second["sigma_a"]
            <= 0.0
            < third["sigma_a"],
        },
        "; ".join(
            f"{name}: " + ", ".join(f"{key} {share:+.1%}" for key, share in own.items())
            for name, own in change.items()
        ),
        f"The bending stress of gearset 3 changes by {third['sigma_a']:+.0%} with our bounds, and "
        f"by {max(others):+.0%} at most with {len(others)} others. A pressure angle that rises to "
        "its bound makes the teeth's feet thicker: AGMA's form factor alone takes "
        f"{1.0 - form:.0%} off, and without it sigma_a would change by {bare:+.0%}. Gearsets 2 and "
        "3 only.",
        {
            f"{name}_{key}_change": share
            for name, own in change.items()
            for key, share in own.items()
        }
        | {"gearset_3_sigma_a_change_at_most": max(others)},
        OPTIMISED,
        assumed=f"The pressure angle to begin with, {start:.0f} deg, and the bounds; {OTHERS_ARE}.",
    )


@claim("3.11")
def _efficiency_at_the_optimum() -> Finding:
    efficiency = number(GEARSET_2.optimum.after, "iso14521", "eta_z1_2")
    return Finding.judged(
        {"45 % are the 38 % of 3.2.1 and 7 % more": math.isclose(38.0 + 7.0, 45.0)},
        f"{efficiency:.1%} by our optimum",
        "The thesis adds its gain to its efficiency. What our optimum comes to is claim 3.6 again, "
        "and hangs on the same bounds.",
        {"eta_z": efficiency},
        [GEARSET_2.command("optimise")],
        verdict=ARITHMETIC,
    )


@claim("3.12")
def _velocity_over_size() -> Finding:
    sizes = [gear.number("iso14521", "centre_distance_mm") for gear in GEARSETS.values()]
    second, third = (gear.number("iso14521", "sliding_velocity_m_s") for gear in GEARSETS.values())
    return Finding.judged(
        {
            "it rises from gearset 2 to 3, as size does": second < third and sizes[0] < sizes[1],
            "both within 1.05 to 2.40 m/s": second > 1.05 and third < 2.40,
        },
        f"{second:.3f} m/s at a = {sizes[0]:.1f} mm, {third:.3f} m/s at {sizes[1]:.1f} mm",
        "The velocity of gearset 3 is stated in 7.2.4 and was taken from there; that of gearset 2 "
        "was found from its friction. The ends of the range, gearsets 1 and 4, are lost.",
        {"gearset_2_v_g_m_s": second, "gearset_3_v_g_m_s": third},
        GEARSETS.values(),
        verdict=FITTED,
    )


@claim("3.13")
def _order_over_size() -> Finding:
    def excess(scale: float) -> float:
        gear = _grown(scale)
        return gear.number("agma6034", "allowable_torque_Nm") / gear.number("bs721", "M_26k_Nm") - 1

    scales = (1.0, 1.25, 1.5, 2.0, 3.0, 4.0)
    values = [excess(scale) for scale in scales]
    turned = next((n for n, value in enumerate(values) if value < 0.0), None)
    numbers = {f"excess_at_scale_{scale:g}": v for scale, v in zip(scales, values, strict=True)}
    if turned:
        scale = root_between(excess, scales[turned - 1], scales[turned], within=1e-3)
        velocity = _grown(scale).number("iso14521", "sliding_velocity_m_s")
        size = _grown(scale).number("iso14521", "centre_distance_mm")
        numbers |= {"turns_at_v_g_m_s": velocity, "turns_at_centre_distance_mm": size}
        ours = f"turns at a = {size:.0f} mm and v_g = {velocity:.2f} m/s"
    else:
        velocity, ours = math.inf, f"does not turn up to {scales[-1]:g} times the size"
    return Finding.judged(
        {
            "T_G,all > M_26k for gearsets 2 and 3": values[0] > 0.0
            and GEARSET_2.number("agma6034", "allowable_torque_Nm")
            > GEARSET_2.number("bs721", "M_26k_Nm"),
            "the order turns for a larger gearset": turned is not None,
            "it does so within gearset 4's 2.40 m/s": velocity <= 2.40,
        },
        ours,
        "Gearset 4 is lost, and the thesis says that its gearsets differ in ratio and speed as "
        "well as in size. In its place stands gearset 3, grown with all its lengths at its speed: "
        "that the order turns at all for a larger gearset is what this can show.",
        numbers,
        map(_grown, scales),
        verdict=NOT_TESTABLE,
    )


@claim("3.14")
def _self_locking() -> Finding:
    gears = {q: _thick(q) for q in (6, 12)}
    angles, back = (
        {q: gear.number("iso14521", key) for q, gear in gears.items()}
        for key in ("lead_angle_deg", "eta_z2_1")
    )
    return Finding.judged(
        {"“it is recommended that q_1 be as low as possible”": back[6] < back[12]},
        ", ".join(f"q_1 {q}: {angles[q]:.2f} deg, eta_z2_1 {back[q]:+.2f}" for q in gears),
        "tan gamma = z_1/q_1: a low diameter factor makes the lead steep, and the wheel drives the "
        "worm the more easily. Self-locking wants q_1 as high as may be, though this gearset locks "
        "itself at both. Gearset 2, its centre distance moved so that the profile shift stays.",
        {f"lead_angle_q_{q}_deg": angle for q, angle in angles.items()}
        | {f"eta_z2_1_q_{q}": efficiency for q, efficiency in back.items()},
        gears.values(),
    )


@claim("7.9")
def _contact_pressure() -> Finding:
    gears = [RatedGear("gearset-3", _peak(torque)) for torque in (23, 366)]
    low, high = (gear.number("iso14521", "sigma_line_MPa") for gear in gears)
    mean = gears[1].number("iso14521", "sigma_Hm_MPa")
    return Finding.judged(
        {
            "194.3 N/mm2 at 23 N m, within 1 %": abs(low / 194.3 - 1.0) < 0.01,
            "778 N/mm2 at 366 N m, within 1 %": abs(high / 778.0 - 1.0) < 0.01,
        },
        f"{low:.0f} and {high:.0f} N/mm2",
        "The pressure goes with the root of the torque, so that the second follows from the first "
        "and does not count anew. Not used to reconstruct gearset 3.",
        {"sigma_line_23_Nm_MPa": low, "sigma_line_366_Nm_MPa": high},
        gears,
        assumed="A Hertz line contact, as (70) is of the discs whose pressure the gearset is to "
        "have, though the thesis does not say so of the gearset; sigma_Hm of "
        f"ISO/TR 14521 would be {mean:.0f} N/mm2 for the second.",
    )


def _peak(torque: float) -> tuple[str, str]:
    return (
        f"operation.output_torque={torque:g} N m",
        f"operation.through_travel_torque={torque / 3.0:.6g} N m",
    )


def _thick(diameter_factor: float) -> RatedGear:
    keys = ("axial_module_mm", "centre_distance_mm", "diameter_factor")
    module, distance, before = GEARSET_2.numbers("iso14521", *keys)
    distance += 0.5 * module * (diameter_factor - before)
    settings = (
        f"gearset.diameter_factor={diameter_factor:g}",
        f"gearset.centre_distance={distance:.6f} mm",
    )
    return RatedGear(GEARSET_2.case, settings)


def _grown(scale: float) -> RatedGear:
    keys = ("centre_distance_mm", "axial_module_mm")
    distance, module = (scale * one for one in GEARSET_3.numbers("iso14521", *keys))
    settings = (
        f"gearset.centre_distance={distance:.6f} mm",
        f"gearset.axial_module={module:.8f} mm",
    )
    return RatedGear(GEARSET_3.case, settings)

"""A gearset as a REXS model: stage, worm and wheel, shafts, bearings, oil, loads and tools.

The worm's shaft lies along x, its driven end at negative x; the wheel's shaft along z, a centre
distance above it in y. What no attribute of the format holds, such as the roughness of the worm,
has a name of its own that begins with ``custom_asperity_``, as the format allows. No result of a
rating is written: the format's names are of DIN 3996:2019, and that edition is not calculated.
"""

import math
from typing import Any

from asperity.flanks.export.rexs.components import (
    LUBRICATION,
    NUMBER,
    OWN,
    Given,
    celsius,
    component,
    materials,
    mm,
    oil,
    tools,
)
from asperity.flanks.export.rexs.document import Component, Document, Relation
from asperity.flanks.export.rexs.shafts import (
    ALONG_X,
    ALONG_Z,
    section_names,
    shaft_components,
    wheel_shaft,
    worm_shaft,
)
from asperity.flanks.parameters import Mount
from asperity.flanks.worm.setting import Pair
from asperity.rating import Operation

_HOURS = 1.0 / 3600.0


def document(given: Given) -> Document:
    """Return a case as a REXS model; raises InputError where it makes no gearset."""
    pair = Pair.of(given.gearset, given.hob, given.mount, None, given.disc)
    components = [
        *_machine(given), *_gears(given, pair), *_shafts(given), *materials(given),
        *tools(given, pair),
    ]  # fmt: skip
    if given.operation is not None:
        components.append(oil(given.operation))
    made = {one.number for one in components}
    relations = tuple(one for one in _relations(given) if made >= set(one.roles.values()))
    ordered = tuple(sorted(components, key=lambda one: one.number))
    return Document(ordered, relations, tuple(_load_cases(given)))


def _machine(given: Given) -> list[Component]:
    gearset, run = given.gearset, given.operation
    g, mount = gearset.geometry, given.mount or Mount()
    own: dict[str, Any] = {}
    life: float | None = None
    if run is not None:
        life = _life(run, g.gear_ratio, given.steps)
        own = {
            f"{OWN}seals": (run.seals, "none"), f"{OWN}fan": (run.fan, "none"),
            f"{OWN}immersed": (run.immersed, "none"), f"{OWN}service": (run.service, "none"),
            f"{OWN}starts_per_hour": (run.starts_per_hour, "none"),
            f"{OWN}through_travel_torque": (run.through_travel_torque, "N m"),
            f"{OWN}bearings": (run.bearings.name or None, "none"),
            "reference_temperature": celsius(run.ambient_temperature),
        }  # fmt: skip
    stage: dict[str, Any] = {
        "center_distance": (g.centre_distance, "mm"),
        "gear_ratio": (g.gear_ratio, "none"),
        "center_distance_offset": mm(mount.centre_distance_error),
        "width_offset": mm(mount.axial_offset),
        "intersection_angle_offset": (math.degrees(mount.shaft_angle_error), "deg"),
        "inclination_angle_offset": (0.0, "deg"),
        "temperature_lubricant": celsius(given.sump),
    }
    if run is not None:
        stage |= {
            "application_factor_din_3996_2019": (run.application_factor, "none"),
            "lubrication_type_din_3996_2019": (LUBRICATION[run.lubrication], "none"),
        }
    return [
        component(
            "unit", "gear_unit", gearset.name, operating_time=(life, "h"),
            model_name=(gearset.name or None, "none"), number_of_gears=(1, "none"),
            gear_shift_index=(1, "none"), reference_component_for_position=(1, "none"),
            support_vector=((0.0, 0.0, 0.0), "mm"), **ALONG_X, **own,
        ),
        component("casing", "gear_casing", temperature_lubricant=celsius(given.sump)),
        component("stage", "worm_stage", **stage),
        component("worm_data", "worm_stage_gear_data", is_driving_gear=(True, "none")),
        component("wheel_data", "worm_stage_gear_data", is_driving_gear=(False, "none")),
    ]  # fmt: skip


def _life(run: Operation, ratio: float, steps: tuple[tuple[float, ...], ...]) -> float | None:
    """Operating time, h; None where none is asked for."""
    if steps:
        return math.fsum(hours for hours, *_ in steps)
    if run.life is not None:
        return float(f"{run.life * _HOURS:.15g}")
    if run.wheel_revolutions is not None:
        return run.wheel_revolutions * 2.0 * math.pi * ratio / run.worm_speed * _HOURS
    return None


def _gears(given: Given, pair: Pair) -> list[Component]:
    gearset = given.gearset
    g, sign = gearset.geometry, gearset.hand_sign
    speed = None if given.operation is None else _rpm(given.operation.worm_speed)
    span, place = worm_shaft(given).mesh, wheel_shaft(given).mesh
    angle = sign * math.degrees(g.lead_angle)
    # The format's u, v, w of the worm's shaft are x, y and z, v turned round with w.
    own, others = {}, {}
    if given.forces is not None:
        x, y, z = given.forces.worm
        own = _forces((-x, -y, z))
        x, y, z = given.forces.wheel
        others = _forces((z, -x, -y))
    common = {
        "flank_form": (gearset.flank.lower(), "none"),
        "pressure_angle_worm_gear": (math.degrees(g.pressure_angle), "deg"),
        "normal_module": (g.normal_module, "mm"),
        "reference_component_for_position": (1, "none"),
    }
    worm = component(
        "worm", "worm_gear", "worm", **common,
        number_of_teeth=(g.starts, "none"), axial_module=(g.axial_module, "mm"),
        axial_pitch=(g.axial_pitch, "mm"), lead=(g.lead, "mm"),
        lead_angle_worm_gear=(angle, "deg"), length_worm_gear=(g.worm_face_width, "mm"),
        reference_diameter_worm_gear=(g.worm_pitch_diameter, "mm"),
        tip_diameter_worm_gear=(g.worm_tip_diameter, "mm"),
        root_diameter_worm_gear=(g.worm_root_diameter, "mm"),
        rotational_speed=(speed, "1 / min"), u_coordinate_on_shaft=(span, "mm"),
        support_vector=((span, 0.0, 0.0), "mm"), **ALONG_X, **own,
        **{f"{OWN}roughness": (float(f"{1e6 * gearset.worm_roughness:.15g}"), "mum"),
           f"{OWN}tooth_proportions": (gearset.tooth_proportions, "none")},
    )  # fmt: skip
    wheel = component(
        "wheel", "worm_wheel", "wheel", **common,
        number_of_teeth=(g.wheel_teeth, "none"), transverse_module=(g.axial_module, "mm"),
        addendum_modification_coefficient_worm_wheel=(g.profile_shift, "none"),
        reference_diameter_worm_gear=(g.wheel_reference_diameter, "mm"),
        tip_diameter_worm_gear=(g.wheel_throat_diameter, "mm"),
        root_diameter_worm_gear=(g.wheel_root_diameter, "mm"),
        outer_diameter_worm_wheel=(g.wheel_outside_diameter, "mm"),
        throat_radius_worm_wheel=(g.wheel_throat_radius, "mm"),
        face_width_worm_wheel=(g.wheel_face_width, "mm"),
        effective_face_width_worm_wheel=(g.effective_face_width, "mm"),
        rim_width_worm_wheel=(g.rim_width, "mm"),
        helix_angle_reference_diameter=(angle, "deg"),
        rotational_speed=(None if speed is None else speed / g.gear_ratio, "1 / min"),
        u_coordinate_on_shaft=(place, "mm"),
        support_vector=((span, g.centre_distance, 0.0), "mm"), **ALONG_Z, **others,
        **{f"{OWN}rim_thickness": (g.rim_thickness, "mm")},
    )  # fmt: skip
    sides = [
        Component(NUMBER[f"{part}_{side}"], "worm_gear_flank", "", {})
        for part in ("worm", "wheel")
        for side in ("left", "right")
    ]
    return [worm, wheel, *sides]


def _forces(values: tuple[float, float, float]) -> dict[str, Any]:
    names = zip("uvw", values, strict=True)
    return {f"force_acting_on_shaft_{axis}": (value + 0.0, "N") for axis, value in names}


def _rpm(speed: float) -> float:
    return float(f"{speed * 30.0 / math.pi:.14g}")


def _shafts(given: Given) -> list[Component]:
    g, run = given.gearset.geometry, given.operation
    worm, wheel = worm_shaft(given), wheel_shaft(given)
    torque = None if run is None else run.output_torque
    speed = {} if run is None else {
        "defines_speed": (True, "none"), "rotational_speed": (_rpm(run.worm_speed), "1 / min"),
    }  # fmt: skip
    above = worm.mesh, g.centre_distance, -wheel.mesh
    return [
        *shaft_components("worm", worm, (0.0, 0.0, 0.0), ALONG_X, **speed),
        *shaft_components("wheel", wheel, above, ALONG_Z),
        component("worm_load", "external_load", transmits_torque=(True, "none"),
                   u_coordinate_on_shaft=(0.0, "mm")),
        component("wheel_load", "external_load", transmits_torque=(True, "none"),
                   u_coordinate_on_shaft=(0.0, "mm"), torque_around_u_axis=(torque, "N m"),
                   defines_torque=(True if torque is not None else None, "none")),
    ]  # fmt: skip


def _relations(given: Given) -> tuple[Relation, ...]:
    def one(type_: str, order: int | None = None, **roles: str) -> Relation:
        return Relation(type_, {role: NUMBER[what] for role, what in roles.items()}, order)

    made = [
        one("stage", stage="stage", gear_1="worm", gear_2="wheel"),
        one("stage_gear_data", stage="stage", gear="worm", stage_gear_data="worm_data"),
        one("stage_gear_data", stage="stage", gear="wheel", stage_gear_data="wheel_data"),
        *(one("assembly", assembly="unit", part=part)
          for part in ("casing", "stage", "worm_shaft", "wheel_shaft")),
        one("reference", origin="casing", referenced="oil"),
        one("reference", origin="stage", referenced="oil"),
    ]  # fmt: skip
    shafts = worm_shaft(given), wheel_shaft(given)
    for part, tool, laid in zip(("worm", "wheel"), ("disc", "hob"), shafts, strict=True):
        shaft = f"{part}_shaft"
        made += [
            one("assembly", assembly=shaft, part=part),
            one("assembly", assembly=shaft, part=f"{part}_load"),
            *(one("assembly", assembly=shaft, part=name) for name in section_names(part, laid)),
            one("reference", origin=part, referenced=f"{part}_material"),
            one("flank", gear=part, left=f"{part}_left", right=f"{part}_right"),
        ]
        for end in "ab":
            bearing = f"{part}_bearing_{end}"
            made += [
                one("side", outer_part="casing", inner_part=shaft, assembly=bearing),
                one("reference", origin=bearing, referenced="oil"),
            ]
        made += [
            one("manufacturing_step", 1, workpiece=f"{part}_{side}", tool=tool,
                manufacturing_settings=f"{part}_settings")
            for side in ("left", "right")
        ]  # fmt: skip
    return tuple(made)


def _load_cases(given: Given) -> list[tuple[Component, ...]]:
    """What the steps of a duty cycle or spectrum are, each by its share of the operating time."""
    whole = math.fsum(hours for hours, *_ in given.steps)
    return [
        (
            component("unit", "gear_unit", operating_time_fraction=(100.0 * hours / whole, "%")),
            component("worm_shaft", "shaft", rotational_speed=(speed, "1 / min")),
            component("wheel_load", "external_load", torque_around_u_axis=(torque, "N m")),
        )
        for hours, torque, speed in given.steps
    ]

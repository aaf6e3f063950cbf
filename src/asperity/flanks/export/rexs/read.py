"""The tables of a case from a REXS model with one worm stage, and what had to be assumed."""

import math
from pathlib import Path
from typing import Any, NamedTuple

from asperity.errors import InputError, plain
from asperity.flanks.export.rexs.carried import carried_in
from asperity.flanks.export.rexs.components import OWN
from asperity.flanks.export.rexs.document import Component, Document, read_document
from asperity.flanks.export.rexs.operation import count, is_known, mm, needed, operation_of, written
from asperity.gearset.library import find
from asperity.gearset.materials import WheelMaterial, worm_material
from asperity.gearset.proportions import RULES

Tables = dict[str, dict[str, Any]]

WORM, WHEEL = "case-hardened steel", "CuSn12Ni2-C-GZ"
"""Materials that are assumed where a file names none that is known."""

_TOLERATED = 2e-3
_SAME = 1e-6


class StageRead(NamedTuple):
    """What a file holds.

    Attributes
    ----------
    tables : dict
        Tables of a case, by name and key, as a file of it has them.
    remarks : tuple of str
        What was assumed, changed or left out.
    """

    tables: Tables
    remarks: tuple[str, ...]


def read_rexs(path: Path) -> StageRead:
    """Read a worm stage from a REXS file.

    Raises
    ------
    InputError
        It is no REXS file, has no worm stage or several, or lacks what defines a gearset.
    StorageError
        The file cannot be read.
    """
    document = read_document(path)
    try:
        return found_in(document)
    except InputError as error:
        raise InputError(f"{plain(str(path))}: {error}") from None


def found_in(document: Document) -> StageRead:
    """Return the tables of a model; raises InputError."""
    stages = list(document.of_type("worm_stage"))
    if len(stages) != 1:
        have = ", ".join(sorted({one.type for one in document.components})) or "none"
        raise InputError(
            f"it has {len(stages)} worm stages, and one is read; its components are {have}"
        )
    (stage,) = stages
    worm = _gear(document, stage, "gear_1", "worm_gear")
    wheel = _gear(document, stage, "gear_2", "worm_wheel")
    remarks: list[str] = []
    gearset = _gearset(document, stage, worm, wheel, remarks)
    tables: Tables = {"gearset": gearset}
    tables |= _making(document, stage, worm, wheel, gearset)
    operation = operation_of(document, stage, worm, wheel, remarks)
    carried = carried_in(document, remarks)
    if operation:
        if "spectrum" in carried:
            operation.pop("duty_cycle", None)
        if "worm_shaft" in carried:
            operation.pop("bearing_span", None)
        tables["operation"] = operation
    tables |= carried
    return StageRead(tables, tuple(remarks))


def _gear(document: Document, stage: Component, role: str, type_: str) -> Component:
    found = document.related("stage", "stage", stage.number, role)
    others = document.of_type(type_)
    made = next((one for one in found if one.type == type_), None) or next(others, None)
    if made is None:
        raise InputError(f"worm_stage {stage.number} has no {type_}")
    return made


def _gearset(
    document: Document, stage: Component, worm: Component, wheel: Component, remarks: list[str]
) -> dict[str, Any]:
    starts, teeth = (count(one) for one in (worm, wheel))
    made: dict[str, Any] = {}
    if name := _name(document):
        made["name"] = name
    made |= {"starts": starts, "wheel_teeth": teeth}
    made["centre_distance"] = mm(needed(stage, "center_distance"))
    module = worm.value("axial_module")
    size = needed(worm, "reference_diameter_worm_gear")
    if module is None:
        module = needed(worm, "axial_pitch") / math.pi
    made["axial_module"] = mm(module)
    factor = float(f"{size / module:.14g}")
    made["diameter_factor"] = factor
    angle = worm.value("pressure_angle_worm_gear")
    if angle is not None:
        made["pressure_angle"] = written(angle, "deg", 180.0 / math.pi)
    flank = worm.text("flank_form") or wheel.text("flank_form")
    if flank:
        made["flank"] = flank.upper()
    lead = worm.value("lead_angle_worm_gear")
    made["hand"] = "left" if lead is not None and lead < 0.0 else "right"
    expected = math.atan(starts / factor)
    if lead is not None and abs(abs(lead) - expected) > _TOLERATED:
        remarks.append(
            f"its lead angle is {math.degrees(abs(lead)):.4g} deg; starts, module and diameter "
            f"give {math.degrees(expected):.4g} deg, which is taken"
        )
    rough = worm.value(f"{OWN}roughness")
    if rough is not None:
        made["worm_roughness"] = written(rough, "um", 1e6)
    made |= _made_of(document, worm, wheel, remarks)
    for key, part, names in (
        ("worm_face_width", worm, ("length_worm_gear",)),
        ("wheel_face_width", wheel, ("face_width_worm_wheel", "rim_width_worm_wheel",
                                     "effective_face_width_worm_wheel")),
        ("rim_thickness", wheel, (f"{OWN}rim_thickness",)),
    ):  # fmt: skip
        value = next((v for v in map(part.value, names) if v), None)
        if value:
            made[key] = mm(value)
    made["tooth_proportions"] = _proportions(worm, module, expected, remarks)
    return made


def _name(document: Document) -> str:
    unit = next(document.of_type("gear_unit"), None)
    return "" if unit is None else plain(unit.text("model_name"))


def _proportions(worm: Component, module: float, lead_angle: float, remarks: list[str]) -> str:
    """Return the rule of tooth heights that the worm's diameters follow, or the nearest."""
    own = worm.text(f"{OWN}tooth_proportions")
    if own in RULES:
        return own
    tip, root = (worm.value(f"{end}_diameter_worm_gear") for end in ("tip", "root"))
    size = needed(worm, "reference_diameter_worm_gear")
    if tip is None or root is None:
        return "bs721"
    m = 1e3 * module
    addendum, dedendum = 5e2 * (tip - size), 5e2 * (size - root)

    def off(rule: str) -> float:
        heights = RULES[rule](m, lead_angle)
        return float(abs(heights.worm_addendum - addendum) + abs(heights.worm_dedendum - dedendum))

    best = min(RULES, key=off)
    if off(best) > _SAME * m:
        remarks.append(
            f"its worm has an addendum of {addendum:.4g} and a dedendum of {dedendum:.4g} mm; the "
            f"nearest rule of tooth heights is {best}, which differs by {off(best):.3g} mm in all"
        )
    return best


def _made_of(
    document: Document, worm: Component, wheel: Component, remarks: list[str]
) -> dict[str, str]:
    made = {}
    for key, gear, known, assumed in (
        ("worm_material", worm, worm_material, WORM),
        ("wheel_material", wheel, lambda name: find(WheelMaterial, name), WHEEL),
    ):
        own = next(document.related("reference", "origin", gear.number, "referenced"), None)
        name = "" if own is None else plain(own.text("material_designation") or own.name)
        made[key] = name if name and is_known(known, name) else assumed
        if made[key] != name:
            said = f"{name!r}, which is no {key.replace('_', ' ')} of a name" if name else "none"
            remarks.append(f"the file gives gearset.{key} as {said}: {assumed} is assumed")
    return made


def _making(
    document: Document, stage: Component, worm: Component, wheel: Component, gearset: dict[str, Any]
) -> Tables:
    tables: Tables = {}
    mount = {
        key: mm(value)
        for key, name in (("centre_distance_error", "center_distance_offset"),
                          ("axial_offset", "width_offset"))
        if (value := stage.value(name))
    }  # fmt: skip
    if turned := stage.value("intersection_angle_offset"):
        mount["shaft_angle_error"] = written(turned, "deg", 180.0 / math.pi)
    if mount:
        tables["mount"] = mount
    tool, settings = _step(document, wheel)
    hob: dict[str, Any] = {}
    if tool is not None:
        own = tool.value(f"{OWN}oversize")
        off = None if settings is None else settings.value("center_distance_correction")
        if own is not None and own != 1.0:
            hob["oversize"] = own
        elif own is None and off:
            size = needed(worm, "reference_diameter_worm_gear")
            hob["oversize"] = float(f"{1.0 + 2.0 * off / size:.12g}")
        rule = tool.text(f"{OWN}rule")
        if hob and rule:
            hob["rule"] = rule
        if radius := tool.text(f"{OWN}tip_radius"):
            hob["tip_radius"] = radius
    if settings is not None and (tilt := settings.value("lyra_angle")):
        hob["tilt"] = written(tilt, "deg", 180.0 / math.pi)
    if hob:
        tables["hob"] = hob
    disc, _ = _step(document, worm)
    if disc is not None and gearset.get("flank") in ("ZK", "ZC"):
        ground = {
            key: mm(value)
            for key, name in (("diameter", "grinding_disk_diameter"),
                              ("profile_radius", "profile_radius_zc_disc"))
            if (value := disc.value(name))
        }  # fmt: skip
        if gearset["flank"] != "ZC":
            ground.pop("profile_radius", None)
        if ground:
            tables["disc"] = ground
    return tables


def _step(document: Document, gear: Component) -> tuple[Component | None, Component | None]:
    """Return the tool and the settings of a gear's last step."""
    for flank in document.related("flank", "gear", gear.number, "left"):
        number = flank.number
        of = [
            next(document.related("manufacturing_step", "workpiece", number, role), None)
            for role in ("tool", "manufacturing_settings")
        ]
        return of[0], of[1]
    return None, None

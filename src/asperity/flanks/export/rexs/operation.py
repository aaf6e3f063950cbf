"""How a gearset is run, from a REXS model: speed, torque, life, oil, bearings, load cases."""

import math
from collections.abc import Callable
from typing import Any

from asperity.errors import InputError, plain
from asperity.flanks.export.rexs.components import LUBRICATION, OILS, OWN
from asperity.flanks.export.rexs.document import Component, Document
from asperity.gearset.library import find
from asperity.gearset.lubricants import Lubricant

_SAME = 1e-6
_OWN_OPERATION = ("seals", "fan", "immersed", "service", "starts_per_hour", "bearings")


def written(value: float, unit: str, factor: float = 1.0) -> str:
    """Return a value as a case file has it."""
    return f"{float(f'{value * factor:.13g}')!r} {unit}"


def mm(value: float) -> str:
    """Return a length in metres as a case file has it."""
    return written(value, "mm", 1e3)


def count(gear: Component) -> int:
    """Return the number of teeth of a gear; raises InputError."""
    value = needed(gear, "number_of_teeth")
    if value != int(value) or value < 1:
        raise InputError(f"{gear.type} {gear.number} has number_of_teeth = {value:g}")
    return int(value)


def is_known(look: Callable[[str], object], name: str) -> bool:
    """Whether something of a name is found."""
    try:
        look(name)
    except InputError:
        return False
    return True


def needed(component: Component, key: str) -> float:
    """Return an attribute that must be there, in SI; raises InputError."""
    value = component.value(key)
    if value is None:
        raise InputError(f"{component.type} {component.number} has no {key}, which is needed")
    return value


def operation_of(
    document: Document, stage: Component, worm: Component, wheel: Component, remarks: list[str]
) -> dict[str, Any]:
    """Return what ``[operation]`` has of a file; what is to be said is added to the remarks."""
    shafts = _shaft(document, worm), _shaft(document, wheel)
    unit = next(document.of_type("gear_unit"), None)
    made: dict[str, Any] = {}
    speed = _speed(worm, wheel, shafts)
    torque = _torque(document, shafts[1])
    if speed:
        made["worm_speed"] = written(speed, "rpm", 30.0 / math.pi)
    if torque:
        made["output_torque"] = written(torque, "N m")
    if document.load_cases and unit is not None and shafts[1] is not None:
        made |= _cycle(document, unit, shafts, made, remarks)
    elif unit is not None and (life := unit.value("operating_time")):
        made["life"] = written(life, "h", 1.0 / 3600.0)
    made |= _oil(document, stage, remarks)
    lubrication = {name: key for key, name in LUBRICATION.items()}
    way = lubrication.get(stage.text("lubrication_type_din_3996_2019"))
    if way:
        made["lubrication"] = way
    sump = stage.value("temperature_lubricant")
    if sump:
        made["oil_temperature"] = written(sump - 273.15, "degC")
    if span := _span(document, shafts[0]):
        made["bearing_span"] = mm(span)
    if (factor := stage.value("application_factor_din_3996_2019")) and factor != 1.0:
        made["application_factor"] = factor
    if unit is not None:
        made |= _own(unit)
    missing = [key for key in ("worm_speed", "output_torque", "lubricant") if key not in made]
    if missing:
        remarks.append(f"the file does not say operation.{' and operation.'.join(missing)}")
    return made


def _own(unit: Component) -> dict[str, Any]:
    """Return what asperity wrote of an operation under names of its own."""
    made: dict[str, Any] = {}
    for key in _OWN_OPERATION:
        text = unit.text(f"{OWN}{key}")
        if text in ("true", "false"):
            made[key] = text == "true"
        elif text:
            made[key] = int(text) if key == "seals" and text.isdecimal() else text
    if "starts_per_hour" in made:
        made["starts_per_hour"] = unit.value(f"{OWN}starts_per_hour")
    if travel := unit.value(f"{OWN}through_travel_torque"):
        made["through_travel_torque"] = written(travel, "N m")
    if (ambient := unit.value("reference_temperature")) is not None:
        made["ambient_temperature"] = written(ambient - 273.15, "degC")
    return made


def _speed(
    worm: Component, wheel: Component, shafts: tuple[Component | None, Component | None]
) -> float | None:
    ratio = count(wheel) / count(worm)
    for part, times in ((worm, 1.0), (shafts[0], 1.0), (wheel, ratio), (shafts[1], ratio)):
        speed = None if part is None else part.value("rotational_speed")
        if speed:
            return abs(speed) * times
    return None


def _torque(document: Document, shaft: Component | None) -> float | None:
    """Return the greatest external torque on a shaft, N m."""
    if shaft is None:
        return None
    loads = document.related("assembly", "assembly", shaft.number, "part")
    found = [one.value("torque_around_u_axis") for one in loads if one.type == "external_load"]
    return max((abs(value) for value in found if value), default=None)


def _cycle(
    document: Document,
    unit: Component,
    shafts: tuple[Component | None, Component | None],
    known: dict[str, Any],
    remarks: list[str],
) -> dict[str, Any]:
    """Return a duty cycle of the load cases, each with its share of the operating time."""
    whole = unit.value("operating_time") or 25000.0 * 3600.0
    loads = {
        one.number
        for one in document.related("assembly", "assembly", shafts[1].number, "part")
        if one.type == "external_load"
    } if shafts[1] is not None else set()  # fmt: skip
    driven = 0 if shafts[0] is None else shafts[0].number
    steps = []
    for case in document.load_cases:
        step: dict[str, Any] = {}
        for one in case:
            if one.number == unit.number and (share := one.value("operating_time_fraction")):
                step["duration"] = written(share * whole, "h", 1.0 / 3600.0)
            elif one.number in loads and (torque := one.value("torque_around_u_axis")):
                step["output_torque"] = written(abs(torque), "N m")
            elif one.number == driven and (speed := one.value("rotational_speed")):
                step["worm_speed"] = written(abs(speed), "rpm", 30.0 / math.pi)
        steps.append(step)
    if not all({"duration", "output_torque"} <= set(step) for step in steps):
        remarks.append(
            "its load cases lack a share of the operating time or the torque of the wheel, and "
            "are left out"
        )
        return {}
    most = max(float(step["output_torque"].split()[0]) for step in steps)
    rated = float(str(known.get("output_torque", "0")).split()[0])
    return {"duty_cycle": steps, "output_torque": f"{max(most, rated)!r} N m"}


def _oil(document: Document, stage: Component, remarks: list[str]) -> dict[str, Any]:
    own = document.related("reference", "origin", stage.number, "referenced")
    oil = next((one for one in own if one.type == "lubricant"), None)
    oil = oil or next(document.of_type("lubricant"), None)
    if oil is None:
        return {}
    thin, thick = (oil.value(f"viscosity_at_{t}_degree_celsius") for t in (100, 40))
    for name in (oil.name, oil.text("name")):
        if is_known(lambda text: find(Lubricant, text), name):
            known = find(Lubricant, name)
            if thick is None or math.isclose(known.viscosity_40, thick, rel_tol=_SAME):
                return {"lubricant": name}
    kinds = {name: key for key, name in OILS.items()}
    kinds |= {"water_soluble_polyglycol": "polyglycol"}
    base = kinds.get(oil.text("lubricant_type_iso_6336_2006"))
    if base is None or thick is None or thin is None:
        remarks.append(
            f"its oil {plain(oil.name)!r} lacks viscosities or a base oil that is known, and is "
            "left out"
        )
        return {}
    made: dict[str, Any] = {
        "base_oil": base,
        "viscosity_40": written(thick, "mm^2/s", 1e6),
        "viscosity_100": written(thin, "mm^2/s", 1e6),
    }
    if density := oil.value("density_at_15_degree_celsius"):
        made["density_15"] = written(density, "kg/m^3")
    return {"lubricant": made}


def _span(document: Document, shaft: Component | None) -> float | None:
    """Return the distance of the outermost bearings of a shaft, m."""
    if shaft is None:
        return None
    bearings = document.related("side", "inner_part", shaft.number, "assembly")
    places = [one.value("u_coordinate_on_shaft_inner_side") for one in bearings]
    known = [place for place in places if place is not None]
    return max(known) - min(known) if len(known) > 1 else None


def _shaft(document: Document, gear: Component) -> Component | None:
    shafts = document.related("assembly", "part", gear.number, "assembly")
    return next((one for one in shafts if one.type == "shaft"), None)

"""What data files hold for keys of a case, each by its name with the figures it is chosen by."""

import re
from typing import Any

from asperity.gearset.library import Sourced, every
from asperity.units import quantity_of

_AT = re.compile(r"_(\d+)$")  # of a viscosity, its temperature


def data_file_names() -> dict[str, list[dict[str, str]]]:
    """Return by ``table.key`` what may stand there: names, and key figures in words."""
    from asperity.gearset.bearings import Bearings
    from asperity.gearset.lubricants import Lubricant
    from asperity.gearset.materials import WheelMaterial, WormMaterial
    from asperity.shafts.bearing import RollingBearing
    from asperity.shafts.steel import ShaftSteel

    figures: dict[str, Any] = {
        "gearset.wheel_material": (WheelMaterial, "family", "pitting_strength", "shear_strength"),
        "gearset.worm_material": (WormMaterial, "youngs_modulus", "bs721"),
        "operation.bearings": (Bearings, "loss_coefficient"),
        "operation.lubricant": (Lubricant, "base_oil", "viscosity_40", "viscosity_100"),
        "worm_shaft.bearing": (RollingBearing, "kind", "bore", "dynamic_rating", "static_rating"),
        "worm_shaft.material": (ShaftSteel, "tensile_strength", "yield_strength"),
    }
    found = {path: _lines(*of) for path, of in figures.items()}
    return found | {path.replace("worm_shaft", "wheel_shaft"): of for path, of in found.items()}


def _lines(model: type[Sourced], *keys: str) -> list[dict[str, str]]:
    return [
        {"name": thing.name, "says": ", ".join(filter(None, (_says(thing, key) for key in keys)))}
        for thing in every(model)
    ]


def _says(thing: Sourced, key: str) -> str:
    """Return a figure with its name, or a word that says what it is by itself; "" for none."""
    value, quantity = getattr(thing, key), quantity_of(type(thing), key)
    if value is None or value == "":
        return ""
    if isinstance(value, float) and quantity is not None:
        words = _AT.sub(r" at \1 degC", key).replace("_", " ")
        return f"{words} {quantity.text(value)}"
    return str(value)

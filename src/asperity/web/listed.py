"""What data files hold for keys of a case, each by its name with the figures it is chosen by."""

import re

from asperity.gearset.library import Sourced, every
from asperity.units import quantity_of

_AT = re.compile(r"_(\d+)$")  # of a viscosity, its temperature


def listed() -> dict[str, list[dict[str, str]]]:
    """Return by ``table.key`` what may stand there: names, and key figures in words."""
    from asperity.gearset.lubricants import Lubricant
    from asperity.gearset.materials import WheelMaterial, WormMaterial
    from asperity.shafts.bearing import RollingBearing
    from asperity.shafts.steel import ShaftSteel

    bearings = _lines(RollingBearing, "kind", "bore", "dynamic_rating", "static_rating")
    steels = _lines(ShaftSteel, "tensile_strength", "yield_strength")
    return {
        "gearset.wheel_material": _lines(
            WheelMaterial, "family", "pitting_strength", "shear_strength"
        ),
        "gearset.worm_material": _lines(WormMaterial, "youngs_modulus", "bs721"),
        "operation.lubricant": _lines(Lubricant, "base_oil", "viscosity_40", "viscosity_100"),
        "worm_shaft.material": steels,
        "worm_shaft.bearing": bearings,
        "wheel_shaft.material": steels,
        "wheel_shaft.bearing": bearings,
    }


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

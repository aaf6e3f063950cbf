"""Forms made from the tables of a case: the same keys, texts and bounds as ``asperity schema``."""

from collections.abc import Mapping
from typing import Any

from asperity.casefile.schema import Key, keys_of, table_schema
from asperity.casefile.table import Table, same_thing
from asperity.units import bounds_of, quantity_of, split_unit, to_si

_DECADES = 30.0


def forms(tables: Mapping[str, type[Table]]) -> dict[str, Any]:
    """Return every table with its keys, as JSON has it."""
    return {
        name: {
            "meaning": table_schema(model)["description"],
            "keys": [_field(model, key) for key in keys_of(model)],
        }
        for name, model in tables.items()
    }


def _field(model: type[Table], key: Key) -> dict[str, Any]:
    quantity = quantity_of(model, key.name)
    example = key.example.strip('"')
    unit = (split_unit(example) or ("", ""))[1] if quantity and quantity.unit else ""
    limits = {} if quantity is None else bounds_of(quantity)
    least = limits.get("ge", limits.get("gt"))
    most = limits.get("le", limits.get("lt"))
    schema = key.schema
    if quantity is None:
        least, most = schema.get("minimum", least), schema.get("maximum", most)
    others = sorted(same_thing(model, key.name) - {key.name})
    return {
        "key": key.name,
        "meaning": key.meaning,
        "unit": unit,
        "kind": _kind(schema, quantity is not None and bool(quantity.unit)),
        "choices": [str(choice) for choice in schema.get("enum", [])],
        "minimum": _in_unit(least, unit, quantity),
        "maximum": _in_unit(most, unit, quantity),
        "open": "gt" in limits,
        "default": "" if key.default == "required" else key.default,
        "required": key.default == "required",
        "example": example,
        "follows": others,
        "log": _spans_decades(least, most, quantity),
    }


def _kind(schema: Mapping[str, Any], united: bool) -> str:
    if united:
        return "quantity"
    if "enum" in schema:
        return "choice"
    kind = schema.get("type") or ("number" if "anyOf" in schema and _number(schema) else "")
    return {"integer": "integer", "number": "number", "boolean": "flag"}.get(kind, "text")


def _number(schema: Mapping[str, Any]) -> bool:
    return any(part.get("type") == "number" for part in schema["anyOf"])


def _in_unit(value: float | None, unit: str, quantity: Any) -> float | None:
    if value is None or quantity is None or not unit:
        return value
    zero, one = to_si(f"0 {unit}", quantity.unit), to_si(f"1 {unit}", quantity.unit)
    return float(f"{(value - zero) / (one - zero):.12g}")


def _spans_decades(least: float | None, most: float | None, quantity: Any) -> bool:
    """Whether a slider of it goes by ratios: what is positive and has no natural end."""
    if quantity is None or quantity.unit in ("rad", "K"):
        return False
    if least is None or least < 0.0:
        return False
    return most is None or (least > 0.0 and most / least > _DECADES) or most > 1e3

"""Tables as the text of a case file, and their values in words."""

import datetime
import json
import re
from collections.abc import Mapping
from typing import Any

from asperity.casefile.table import Table
from asperity.units import Quantity, quantity_of

_MOST_PARTS = 6
_BARE = re.compile(r"[A-Za-z0-9_-]+")


def toml(value: Any) -> str:
    """Return a value as TOML has it."""
    if isinstance(value, Mapping):
        entries = (f"{_key(key)} = {toml(entry)}" for key, entry in value.items())
        return "{ " + ", ".join(entries) + " }"
    if isinstance(value, list | tuple):
        return f"[{', '.join(map(toml, value))}]"
    if isinstance(value, datetime.date | datetime.time):
        return value.isoformat()
    # What JSON writes of a text, a number and a truth is TOML too.
    return json.dumps(value, ensure_ascii=False)


def _key(name: str) -> str:
    return name if _BARE.fullmatch(name) else json.dumps(name, ensure_ascii=False)


def written(raw: Mapping[str, Mapping[str, Any]], title: str = "") -> str:
    """Return tables as the text of a case file, as they are."""
    lines = [f"# {title}"] if title else []
    for name, given in raw.items():
        entries = (f"{_key(key)} = {toml(value)}" for key, value in given.items())
        lines += ["", f"[{_key(name)}]", *entries]
    return "\n".join(lines).lstrip() + "\n"


def worded(value: Any, quantity: Quantity | None = None) -> str:
    """Return a value of a validated table in words and units, of a long list its first parts.

    Parameters
    ----------
    value : object
        In SI.
    quantity : Quantity, optional
        What it is, or each number of a list.
    """
    if isinstance(value, Table):
        return str(getattr(value, "name", "")) or ", ".join(_parts(value))
    if isinstance(value, list | tuple):
        parts = [worded(part, quantity) for part in value[:_MOST_PARTS]]
        more = len(value) - len(parts)
        return "; ".join(parts) + (f"; and {more} more" if more else "") if parts else "none"
    if isinstance(value, Mapping):
        return ", ".join(f"{key} = {worded(part, quantity)}" for key, part in value.items())
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, float):
        return quantity.text(value) if quantity and quantity.unit else f"{value:.12g}"
    return str(getattr(value, "name", "") or value)


def _parts(table: Table) -> list[str]:
    """Return what was given of a table; a number stands alone that no other has the unit of."""
    quantities = {key: quantity_of(type(table), key) for key in type(table).model_fields}
    units = [quantity.unit for quantity in quantities.values() if quantity]
    said = []
    for key, quantity in quantities.items():
        value = getattr(table, key)
        if key not in table.model_fields_set or value is None:
            continue
        text = worded(value, quantity)
        alone = quantity is not None and quantity.unit and units.count(quantity.unit) == 1
        said.append(text if alone else f"{key.replace('_', ' ')} {text}")
    return said

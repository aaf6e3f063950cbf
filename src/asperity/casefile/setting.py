"""Settings: ``table.key=value``, as ``--set`` takes them, applied to what is to be validated."""

import json
import re
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from asperity.casefile.table import Table, names_file, same_thing, trouble_with
from asperity.errors import InputError, nearest, shown
from asperity.files import store
from asperity.units import Quantity, quantity_of, split_unit

Raw = dict[str, Any]
"""Tables as they stand in a case file, by name."""

PATH = re.compile(r"([A-Za-z_][\w-]*)\.([A-Za-z_][\w-]*)")
"""A ``table.key``."""
_INNER_KEY = re.compile(rf"({PATH.pattern})\.([\w.-]+)")


def known_table(name: str, known: Mapping[str, type[Table]]) -> type[Table]:
    """Return the class of a table by its name; raises InputError where there is none."""
    if name not in known:
        raise InputError(f"[{name}] is not a table of a case file{nearest(name, known)}")
    return known[name]


def listed(settings: Iterable[str]) -> Iterable[str]:
    """Return settings as they are; raises InputError for a single text, whose parts are letters."""
    if isinstance(settings, str):
        raise InputError(f"settings is {shown(settings)}; it must be a list: [{shown(settings)}]")
    return settings


def apply(raw: Raw, setting: str, known: Mapping[str, type[Table]]) -> str:
    """Apply a ``table.key=value`` to what is to be validated; returns the key."""
    path, equals, text = setting.partition("=")
    parts = PATH.fullmatch(path.strip())
    if not equals or not parts:
        if equals and (inner := _INNER_KEY.fullmatch(path.strip())):
            value = json.dumps(_toml_value(text.strip()), ensure_ascii=False, default=str)
            raise InputError(
                f"--set {setting}: {inner[1]} is set as a whole, as "
                f"{inner[1]}={{ {inner[4]} = {value} }}"
            )
        raise InputError(f"--set {setting}: it must be table.key=value, as in friction.mu=0.1")
    name, key = parts.groups()
    try:
        model = known_table(name, known)
    except InputError as error:
        raise InputError(f"--set {setting}: {error}") from None
    entries = raw.setdefault(name, {})
    value = _with_unit(model, key, _toml_value(text.strip()), setting)
    if isinstance(value, str) and names_file(model, key):
        value = str(Path(value).absolute())
    for other in same_thing(model, key):
        entries.pop(other, None)
    entries[key] = value
    return f"{name}.{key}"


def _toml_value(text: str) -> Any:
    try:
        parsed = store.parse_toml(f"value = {text}")
    except ValueError:
        return text
    return text if len(parsed) > 1 or trouble_with(parsed) else parsed["value"]


def _with_unit(model: type[Table], key: str, value: Any, setting: str) -> Any:
    quantity = quantity_of(model, key)
    is_number = isinstance(value, int | float) and not isinstance(value, bool)
    written = setting.partition("=")[2].strip()
    number = written if split_unit(written) == (written, "") else repr(value)
    parts = (number, "") if is_number else split_unit(value) if isinstance(value, str) else None
    if not (quantity and quantity.unit and parts and not parts[1]):
        return value
    unit = bare_unit(quantity)
    if not unit:
        path = f"{model.table}.{key}"
        raise InputError(
            f"--set {setting}: {path} is {parts[0]} without a unit; {quantity.expected()}"
        )
    return f"{parts[0]} {unit}"


def bare_unit(quantity: Quantity) -> str:
    """Return the unit of a number without one on the command line: deg for an angle, else none."""
    return "deg" if quantity.unit == "rad" else ""

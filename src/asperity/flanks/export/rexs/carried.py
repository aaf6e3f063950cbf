"""What of a case the format has no place for: whole tables, carried in an attribute of our own.

They stand beside what the format does hold of shafts and loads. Where another program has changed
that, what is carried is no longer true and is left out, and a remark says so.
"""

import hashlib
import json
from collections.abc import Mapping
from typing import Any

from asperity.casefile import Case
from asperity.flanks.export.rexs.components import OWN
from asperity.flanks.export.rexs.document import Component, Document, written_as

TABLES = (
    "housing", "spectrum", "requirements", "worm_shaft", "wheel_shaft", "bearings", "tolerances",
    "blank", "measuring", "modification", "rating",
)  # fmt: skip
"""Tables that are carried as the case has them."""

HELD = ("gearset", "operation", "hob", "disc", "mount")
"""Tables that the format holds, but for single keys."""

_NAME, _MARK = f"{OWN}tables", f"{OWN}tables_of"
_FILES = {"rating": ("bs721_tables",)}
_RESTING = "spectrum", "worm_shaft", "wheel_shaft", "bearings"
_PARTS = "shaft", "shaft_section", "concept_bearing"


def carried_of(case: Case) -> dict[str, dict[str, Any]]:
    """Return the tables of a case that are carried; names of files are left out."""
    return {
        name: {
            key: value
            for key, value in case.raw[name].items()
            if key not in _FILES.get(name, ())
        }
        for name in TABLES
        if name in case.raw
    }  # fmt: skip


def left_out(case: Case) -> list[str]:
    """Return the tables of a case that a file does not hold."""
    known = (*TABLES, *HELD, "project")
    files = [f"{name}.{key}" for name, keys in _FILES.items() for key in keys
             if key in case.raw.get(name, {})]  # fmt: skip
    return [*(f"[{name}]" for name in case.raw if name not in known), *files]


def with_carried(document: Document, tables: Mapping[str, Mapping[str, Any]]) -> Document:
    """Return a model whose gear unit carries tables."""
    if not tables:
        return document
    own = {
        _NAME: (json.dumps(tables, sort_keys=True), "none"),
        _MARK: (_mark(document), "none"),
    }
    components = tuple(
        one._replace(attributes={**one.attributes, **own}) if one.type == "gear_unit" else one
        for one in document.components
    )
    return document._replace(components=components)


def carried_in(document: Document, remarks: list[str]) -> dict[str, dict[str, Any]]:
    """Return the tables that a model carries; what is not to be taken is said in the remarks."""
    unit = next(document.of_type("gear_unit"), None)
    text = "" if unit is None else unit.text(_NAME)
    if unit is None or not text:
        return {}
    try:
        found = json.loads(text)
    except (ValueError, RecursionError):
        found = None
    if not isinstance(found, dict) or not all(isinstance(one, dict) for one in found.values()):
        remarks.append("the tables that it carries in an attribute of our own cannot be read")
        return {}
    made = {name: own for name, own in found.items() if name in TABLES}
    for name, keys in _FILES.items():
        for key in keys:
            made.get(name, {}).pop(key, None)
    if unit.text(_MARK) != _mark(document):
        dropped = [name for name in _RESTING if made.pop(name, None) is not None]
        if dropped:
            listed = ", ".join(f"[{name}]" for name in dropped)
            remarks.append(
                f"its shafts or loads were changed since asperity wrote it: what it carries of "
                f"{listed} is left out"
            )
    return made


def _mark(document: Document) -> str:
    """Return what changes where shafts, bearings or loads do."""
    parts = [one for one in document.components if one.type in _PARTS]
    told = [*map(_told, parts), *(_told(one) for case in document.load_cases for one in case)]
    return hashlib.sha256("\n".join(told).encode()).hexdigest()


def _told(component: Component) -> str:
    every = {
        key: value if isinstance(value, tuple) else (value,)
        for key, (value, _) in sorted(component.attributes.items())
    }
    said = (f"{key}={','.join(map(written_as, values))}" for key, values in every.items())
    return f"{component.type} {component.number}: {'; '.join(said)}"

"""What a case file may say, from its tables: a JSON Schema, and the keys as a reader wants them.

Editors complete and underline by the schema; the tables of the documentation are made from the same
keys. A quantity with a unit is text whose keyword ``quantity`` says the SI unit and the bounds, for
a reader of schemas that knows it; how several keys go together is not part of a schema, except
that forms of the same thing exclude each other.
"""

import dataclasses
import re
import types
import typing
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Annotated, Any, Literal, NamedTuple, get_args, get_origin

from pydantic import BeforeValidator
from pydantic.fields import FieldInfo
from pydantic_core import PydanticUndefined

from asperity.casefile.table import Table
from asperity.errors import choices
from asperity.units import Quantity, bounds_of, quantity_of

DIALECT = "https://json-schema.org/draft/2020-12/schema"

NUMBER = r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d{1,4})?"
_PARAMETER = re.compile(r"^([A-Za-z_]\w*(?:, [A-Za-z_]\w*)*) : ")
_MATHS = re.compile(r":math:`([^`]*)`")
_WORD = re.compile(r"'(\w+)' or ")
_ROLE = re.compile(r":\w+:`~?([^`]*)`")
_LIMITS = {"ge": "minimum", "gt": "exclusiveMinimum", "le": "maximum", "lt": "exclusiveMaximum",
           "min_length": "minItems"}  # fmt: skip


class Key(NamedTuple):
    """A key of a table as a reader wants it.

    Attributes
    ----------
    name : str
        In its table.
    meaning : str
        In a line.
    allowed : str
        Words or kind of values.
    example, default : str
        As a file has them; the default is empty where there is none, "required" where the key must
        be given.
    schema : dict
        Its JSON Schema.
    """

    name: str
    meaning: str
    allowed: str
    example: str
    default: str
    schema: dict[str, Any]


def schema(tables: Mapping[str, type[Table]]) -> dict[str, Any]:
    """Return the JSON Schema of case files of these tables."""
    return {
        "$schema": DIALECT,
        "title": "asperity case file",
        "type": "object",
        "additionalProperties": False,
        "properties": {name: table_schema(model) for name, model in tables.items()},
    }


def table_schema(model: type[Table]) -> dict[str, Any]:
    """Return the JSON Schema of a table."""
    keys = keys_of(model)
    made: dict[str, Any] = {
        "type": "object",
        "description": _first_line(model.__doc__ or ""),
        "additionalProperties": False,
        "properties": {key.name: key.schema for key in keys},
    }
    required = [key.name for key in keys if key.default == "required"]
    if required:
        made["required"] = required
    together: list[dict[str, Any]] = [
        {"not": {"required": [one, other]}}
        for group in (*model.alternatives, *model.required_alternatives)
        for place, one in enumerate(group)
        for other in group[place + 1 :]
    ]
    together += [
        {"anyOf": [{"required": [key]} for key in group]} for group in model.required_alternatives
    ]
    return made | ({"allOf": together} if together else {})


def keys_of(model: type[Table]) -> tuple[Key, ...]:
    """Return the keys of a table in their order."""
    meanings = _meanings(model)
    keys = []
    for name in model.own_keys():
        field = model.model_fields[name]
        quantity = quantity_of(model, name)
        made = _schema(field.annotation, field.metadata)
        meaning = meanings.get(name, "")
        default = _default(field, quantity)
        example = _example(made, quantity)
        allowed = _allowed(made, quantity)
        made = {"description": meaning} | made
        if default not in ("", "required"):
            made["default"] = default if quantity and quantity.unit else field.default
        keys.append(Key(name, meaning, allowed, example, default, made))
    return tuple(keys)


def _schema(annotation: Any, metadata: Iterable[Any] = ()) -> dict[str, Any]:
    """Return the schema of an annotation; an empty one where anything may stand."""
    origin, arguments = get_origin(annotation), get_args(annotation)
    if origin is Annotated:
        return _schema(arguments[0], (*arguments[1:], *metadata))
    made: dict[str, Any] = {}
    for extra in metadata:
        if isinstance(extra, Quantity):
            return _of_quantity(extra)
        if isinstance(extra, BeforeValidator):
            written = extra.json_schema_input_type
            if written is not PydanticUndefined:
                return _schema(written)
            return {"type": "object"} if _holds_table(annotation) else {}
        if isinstance(extra, FieldInfo):
            return _schema(annotation, extra.metadata)
        for name, keyword in _LIMITS.items():
            if getattr(extra, name, None) is not None:
                made[keyword] = getattr(extra, name)
    if origin in (typing.Union, types.UnionType):
        parts = [_schema(part) for part in arguments if part is not type(None)]
        return parts[0] if len(parts) == 1 else {"anyOf": parts}
    return _plain(annotation, origin, arguments) | made


def _holds_table(annotation: Any) -> bool:
    parts = get_args(annotation) or (annotation,)
    return any(isinstance(part, type) and issubclass(part, Table) for part in parts)


def _plain(annotation: Any, origin: Any, arguments: tuple[Any, ...]) -> dict[str, Any]:
    if origin is Literal:
        return {"enum": list(arguments)}
    if origin is tuple:
        if arguments[-1] is Ellipsis:
            return {"type": "array", "items": _schema(arguments[0])}
        fixed = {"prefixItems": [_schema(part) for part in arguments], "items": False}
        return {"type": "array", "minItems": len(arguments)} | fixed
    if origin is not None and issubclass(origin, Mapping):
        names, values = arguments
        allowed = {"propertyNames": _schema(names)} if get_origin(names) is Literal else {}
        return {"type": "object", **allowed, "additionalProperties": _schema(values)}
    if isinstance(annotation, type) and issubclass(annotation, Table):
        table = table_schema(annotation)
        # What data files hold by name may be named.
        named = hasattr(annotation, "section")
        return {"anyOf": [{"type": "string"}, table]} if named else table
    kinds = {int: "integer", float: "number", bool: "boolean", str: "string", Path: "string"}
    return {"type": kinds[annotation]} if annotation in kinds else {}


def _of_quantity(quantity: Quantity) -> dict[str, Any]:
    limits = bounds_of(quantity)
    if word := _WORD.match(quantity.what):
        plain = dataclasses.replace(quantity, what=quantity.what[word.end() :])
        return {"anyOf": [{"const": word[1]}, _of_quantity(plain)]}
    if quantity.unit:
        return {
            "type": "string",
            "pattern": rf"^\s*{NUMBER}\s*[^\s\d.].*$",
            "examples": [quantity.example],
            "quantity": {"what": quantity.what, "unit": quantity.unit} | limits,
        }
    bounds = {_LIMITS[name]: limit for name, limit in limits.items()}
    written = {"type": "string", "pattern": rf"^\s*{NUMBER}\s*%?\s*$"}
    return {
        "anyOf": [{"type": "number"} | bounds, written | {"quantity": {"unit": ""} | limits}],
        "examples": [float(quantity.example)],
    }


def _allowed(made: Mapping[str, Any], quantity: Quantity | None) -> str:
    if quantity is not None:
        return quantity.what
    if "enum" in made:
        return choices(map(str, made["enum"]))
    kind = str(made.get("type", ""))
    words = {"integer": "a whole number", "boolean": "true or false", "array": "a list"}
    return words.get(kind, "text" if kind == "string" else "a name or a table")


def _example(made: Mapping[str, Any], quantity: Quantity | None) -> str:
    if quantity is not None:
        return f'"{quantity.example}"' if quantity.unit else quantity.example
    return f'"{made["enum"][0]}"' if "enum" in made else ""


def _default(field: FieldInfo, quantity: Quantity | None) -> str:
    if field.is_required():
        return "required"
    value = field.default
    if value is None or value is PydanticUndefined or value == "":
        return ""
    if quantity is not None and quantity.unit and isinstance(value, float):
        return quantity.text(value)
    return str(value).lower() if isinstance(value, bool) else str(value)


def _meanings(model: type[Table]) -> dict[str, str]:
    """Return what the docstrings of a table and its bases say of each parameter, in a line."""
    found: dict[str, str] = {}
    for base in reversed(model.__mro__):
        if base is Table or not issubclass(base, Table):
            continue
        names: list[str] = []
        lines: list[str] = []
        inside = False
        for line in [*_dedented(base.__doc__ or ""), "end : "]:
            starts = _PARAMETER.match(line)
            if (starts or (line and not line.startswith(" "))) and names:
                found |= dict.fromkeys(names, _one_line(lines))
                names, lines = [], []
            if line in ("Parameters", "Attributes"):
                inside = True
            elif starts and inside:
                names = starts[1].split(", ")
            elif names:
                lines.append(line.strip())
    return found


def _dedented(text: str) -> list[str]:
    first, _, rest = text.partition("\n")
    lines = rest.split("\n")
    margin = min((len(line) - len(line.lstrip()) for line in lines if line.strip()), default=0)
    return [first.strip(), *(line[margin:] for line in lines)]


def _one_line(lines: Iterable[str]) -> str:
    text = " ".join(filter(None, lines))
    text = _MATHS.sub(lambda found: _plain_maths(found[1]), text)
    return _ROLE.sub(r"\1", text).replace("``", "").replace("`", "").strip()


def _plain_maths(text: str) -> str:
    text = re.sub(r"\\sqrt\{([^{}]*)\}", r"sqrt(\1)", text)
    for command, sign in (("ge", ">="), ("le", "<="), ("sim", "~"), (",", " ")):
        text = re.sub(rf"\\{command}(?![A-Za-z])", sign, text)
    return re.sub(r"[\\{}]", "", text)


def _first_line(text: str) -> str:
    return _one_line([text.strip().partition("\n")[0]])

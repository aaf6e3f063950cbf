"""What ``asperity materials`` and ``asperity lubricants`` do: what data files hold, by name."""

from collections.abc import Sequence
from typing import Any

from asperity.cli import show
from asperity.gearset.library import Sourced, every
from asperity.results.table import Column, Table
from asperity.units import quantity_of, split_unit

_HIDDEN = "name", "sources", "assumption", "own"
_SHORT = {"polyalphaolefin": "PAO", "polyglycol": "PG"}


def print_library(models: Sequence[type[Sourced]], *, as_json: bool) -> None:
    """Print everything of some kinds that data files hold, with its source and trust."""
    things = [(model, thing) for model in models for thing in every(model)]
    if as_json:
        show.print_json({"listed": [_json(model, thing) for model, thing in things]})
        return
    sources: dict[str, int] = {}
    tables = []
    for model in models:
        keys = [key for key in model.model_fields if key not in _HIDDEN]
        shown = [thing for of, thing in things if of is model]
        rows = [(t.name, *(_short(t, key) for key in keys), _numbers(t, sources)) for t in shown]
        headings = [_heading(model, key) for key in keys]
        columns = (
            Column("name"),
            *(Column(heading, folds=True) for heading in headings),
            Column("from"),
        )
        tables.append(Table(columns, tuple(rows), title=(model.__doc__ or "").partition("\n")[0]))
    remarks = (
        *(f"{number}: {source}" for source, number in sources.items()),
        "the name, in quotes, is what a case file takes; a table with these keys works as well",
        "files of your own: asperity --materials FILE COMMAND, or named in ASPERITY_MATERIALS",
    )
    show.print_tables([*tables, Table((), (), remarks=remarks)])


def _unit(model: type[Sourced], key: str) -> str:
    quantity = quantity_of(model, key)
    return (split_unit(quantity.example) or ("", ""))[1] if quantity and quantity.unit else ""


def _heading(model: type[Sourced], key: str) -> str:
    unit = _unit(model, key)
    return f"{key.replace('_', ' ')}{f' ({unit})' if unit else ''}"


def _short(thing: Sourced, key: str) -> str:
    """Return a value without its unit, which stands above it."""
    value = getattr(thing, key)
    if isinstance(value, dict) and value:
        return " ".join(f"{_SHORT.get(name, name)} {number:g}" for name, number in value.items())
    if isinstance(value, tuple):
        return f"{len(value)} values" if isinstance(value[0], float) else f"{len(value)} rows"
    return _text(thing, key).removesuffix(_unit(type(thing), key)).strip()


def _text(thing: Sourced, key: str) -> str:
    value = getattr(thing, key)
    if value is None or value == {}:
        return "-"
    quantity = quantity_of(type(thing), key)
    if isinstance(value, float):
        return quantity.text(value) if quantity and quantity.unit else f"{value:g}"
    if isinstance(value, dict):
        return ", ".join(f"{name} {number:g}" for name, number in value.items())
    return str(value).lower() if isinstance(value, bool) else str(value)


def _numbers(thing: Sourced, known: dict[str, int]) -> str:
    """Return the numbers of a thing's sources, and number those that are new."""
    found = dict.fromkeys(f"{s.name} ({s.confidence})" for s in thing.sources.values())
    return ",".join(str(known.setdefault(source, len(known) + 1)) for source in found)


def _json(model: type[Sourced], thing: Sourced) -> dict[str, Any]:
    sources = {
        key: {"name": source.name, "confidence": source.confidence, "note": source.note}
        for key, source in thing.sources.items()
    }
    return {
        "kind": model.section,
        "name": thing.name,
        **{
            key: _text(thing, key)
            for key in model.model_fields
            if key not in ("name", "sources", "own")
        },
        "sources": sources,
    }

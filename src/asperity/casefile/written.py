"""Tables as the text of a case file."""

import datetime
import json
import re
from collections.abc import Mapping
from typing import Any

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

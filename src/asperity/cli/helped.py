"""Help as it is written: rich, which prints it, would take words in brackets for its own signs."""

import re
from collections.abc import Iterator
from typing import Any

# What rich takes for markup, with the backslashes before it.
_MARKUP = re.compile(r"(\\*)(\[[a-zA-Z#/@][^\[]*?\])")


def as_written(command: Any) -> None:
    """Have a command, with all below it, print its help as it is written."""
    for one in _with_all_below(command):
        for name in ("help", "short_help", "epilog"):
            if text := getattr(one, name, None):
                setattr(one, name, _escaped(text))
        for parameter in one.params:
            if text := getattr(parameter, "help", None):
                parameter.help = _escaped(text)


def _with_all_below(command: Any) -> Iterator[Any]:
    yield command
    for one in getattr(command, "commands", {}).values():
        yield from _with_all_below(one)


def _escaped(text: str) -> str:
    return _MARKUP.sub(r"\1\1\\\2", text)

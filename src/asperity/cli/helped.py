"""Help as it is written: rich, which prints it, would take words in brackets for its own signs."""

import importlib
import re
import sys
import types
from collections.abc import Callable, Iterator
from typing import Any

# What rich takes for markup, with the backslashes before it.
_MARKUP = re.compile(r"(\\*)(\[[a-zA-Z#/@][^\[]*?\])")
# What typer's help imports and does not use: to load it takes longer than to print the help.
_UNUSED = {"rich.markdown": "Markdown", "rich.traceback": "Traceback"}
_PRINTER = "typer.rich_utils"


def as_written(command: Any) -> None:
    """Have a command, with all below it, print its help as it is written."""
    for one in with_all_below(command):
        one.format_help = _lightly(one.format_help)
        for name in ("help", "short_help", "epilog"):
            if text := getattr(one, name, None):
                setattr(one, name, _escaped(text))
        for parameter in one.params:
            if text := getattr(parameter, "help", None):
                parameter.help = _escaped(text)


def with_all_below(command: Any) -> Iterator[Any]:
    """Yield a command and all commands below it."""
    yield command
    for one in getattr(command, "commands", {}).values():
        yield from with_all_below(one)


def _escaped(text: str) -> str:
    return _MARKUP.sub(r"\1\1\\\2", text)


def _lightly(format_help: Callable[..., None]) -> Callable[..., None]:
    """Return what prints help, and loads first no more than it needs."""

    def formatted(*arguments: Any) -> None:
        if _PRINTER not in sys.modules:
            _load_printer()
        format_help(*arguments)

    return formatted


def _load_printer() -> None:
    """Import what prints help, with empty classes in the place of those it does not use."""
    stand_ins = {name: types.ModuleType(name) for name in _UNUSED if name not in sys.modules}
    for name, module in stand_ins.items():
        setattr(module, _UNUSED[name], type(_UNUSED[name], (), {}))
    sys.modules.update(stand_ins)
    try:
        importlib.import_module(_PRINTER)
    except (AttributeError, ImportError, TypeError):
        # Another version of it needs more of them, and loads all when it prints.
        sys.modules.pop(_PRINTER, None)
    finally:
        for name in stand_ins:
            del sys.modules[name]

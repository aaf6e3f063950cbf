"""The command line as it is asked: of all commands the one that is named, or all of them for help.

To make what typer makes of thirty commands takes as long as many of them take to answer.
"""

import copy
from collections.abc import Sequence
from typing import Any

import typer

from asperity.cli.helped import with_all_below
from asperity.cli.registry_commands import register
from asperity.commands import COMMANDS, GROUPS


def built(app: typer.Typer, arguments: Sequence[str] | None = None) -> Any:
    """Return what runs a command line.

    Parameters
    ----------
    app : typer.Typer
        Its callback, and the commands that are not of the registry.
    arguments : sequence of str, optional
        What is typed; left out: everything is made.
    """
    asked = _asked(arguments or ())
    own = {_name(info): info for info in app.registered_commands}
    tree = copy.copy(app)
    tree.registered_commands, tree.registered_groups = [], []
    if asked in own:
        tree.registered_commands = [own[asked]]
    elif asked in GROUPS or any(command.name == asked for command in COMMANDS):
        register(tree, asked)
    else:
        register(tree)
        tree.registered_commands += own.values()
    command = typer.main.get_command(tree)
    for one in with_all_below(command):
        for parameter in one.params:
            parameter._runtime_param = _AsGiven()
    return command


def _name(info: Any) -> str:
    return str(info.name or info.callback.__name__.replace("_", "-"))


def _asked(arguments: Sequence[str]) -> str:
    """Return the first word, which names a command; nothing where an option is not known here."""
    words = iter(arguments)
    for word in words:
        if word == "--materials":
            next(words, None)
        elif not word.startswith("--materials="):
            return word
    return ""


class _AsGiven:
    """Takes text as it is; what converts it is made, and pydantic loaded, for anything else."""

    def coerce(self, value: Any, param: Any, ctx: Any) -> Any:
        several = param.multiple or param.nargs == -1
        if value is None:
            return () if several else None
        texts = value if several else [value]
        kind = list[str] if several else str
        if param.type_descriptor.annotation == kind and all(map(_is_text, texts)):
            return list(texts) if several else value
        param._runtime_param = None
        return param.get_runtime_param().coerce(value, param=param, ctx=ctx)


def _is_text(value: object) -> bool:
    """Whether a value is text with nothing in it that was no text on the command line."""
    if not isinstance(value, str):
        return False
    try:
        value.encode()
    except UnicodeEncodeError:
        return False
    return True

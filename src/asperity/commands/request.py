"""What a program asks of a command: an object as JSON has it, read as a command line is."""

import hashlib
import os
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any, NamedTuple

from asperity.casefile import Case
from asperity.commands.command import Command
from asperity.commands.listed import COMMANDS
from asperity.errors import InputError, nearest, shown
from asperity.files.store import stamp
from asperity.runs.key import code_key, key

Body = Mapping[str, Any]


class CommandRequest(NamedTuple):
    """Something that a command is to do.

    Attributes
    ----------
    command : Command
        Which.
    name : str
        Of its case; empty where it takes none.
    settings : tuple of str
        As ``--set`` takes them.
    given : dict
        What was given beside a case, arguments among it.
    """

    command: Command
    name: str
    settings: tuple[str, ...]
    given: dict[str, Any]

    @classmethod
    def of(cls, body: Body) -> "CommandRequest":
        """Read ``command``, ``case``, ``settings``, ``arguments`` and ``options``.

        Raises
        ------
        InputError
            There is no such command, or it takes something else.
        """
        name = body.get("command")
        command = next((command for command in COMMANDS if command.name == name), None)
        if command is None:
            known = nearest(str(name), [command.name for command in COMMANDS])
            raise InputError(f"{shown(name)} is not a command{known}")
        case = body.get("case") if command.case else ""
        if not isinstance(case, str):
            raise InputError(f"case is {shown(case)}; it must be a text")
        given = command.given(mapping(body, "arguments"), mapping(body, "options"))
        return cls(command, case, settings(body), given)

    @property
    def options(self) -> dict[str, Any]:
        """What the command takes, with what it does if nothing is said."""
        return self.command.defaults | self.given

    @property
    def line(self) -> str:
        """What does the same on a terminal."""
        return self.command.line(self.name, self.settings, self.given)

    def texts(self) -> Iterator[str]:
        """Yield every text that is given beside a case: any of them may name a file."""
        for value in self.given.values():
            several = value if isinstance(value, list) else [value]
            yield from (one for one in several if isinstance(one, str))

    def case(self, name: str) -> Case:
        """Return the case, which is read by a name; a reader may find it without."""
        return self.command.case_of(name, self.settings, **self.options)

    def key(self, case: Case | None) -> str:
        """Return the name of the answer: a key of all that it follows from.

        Parameters
        ----------
        case : Case or None
            As it was read; None where the command takes none by name.
        """
        from asperity.gearset.library import own_files

        parts = {
            "command": self.command.name,
            "case": self.name,
            "given": self.given,
            "settings": sorted(self.settings),
            "files": dict(_contents((*self.texts(), *own_files()))),
            "project": case.raw.get("project") if case else None,
        }
        code = code_key(*self.command.modules)
        return key(code, case.canonical() if case else "", repr(sorted(parts.items())))


def settings(body: Body) -> tuple[str, ...]:
    """Return what changes a case, as ``--set`` takes it."""
    given = mapping(body, "settings")
    for path, value in given.items():
        if not isinstance(value, str):
            raise InputError(f"the setting {shown(path)} is {shown(value)}; it must be a text")
    return tuple(f"{path}={value}" for path, value in given.items())


def mapping(body: Body, name: str) -> Body:
    """Return what is given by name; refuses what is not an object."""
    given = body.get(name, {})
    if not isinstance(given, Mapping):
        raise InputError(f"{name} is {shown(given)}; it must be an object")
    return given


def _contents(texts: Iterable[str]) -> Iterator[tuple[str, str]]:
    """Yield the files that are named, each with a hash of what it holds."""
    for text in texts:
        if os.path.isfile(text):  # also of a name too long for one
            with open(text, "rb") as file:
                yield text, hashlib.file_digest(file, "sha256").hexdigest()
        elif os.path.isdir(text):
            for each in sorted(Path(text).iterdir()):
                if each.is_file() and not each.name.startswith("."):
                    yield str(each), str(stamp(each))

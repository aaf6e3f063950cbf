"""Shipped cases with settings that know their command."""

import dataclasses
import shlex
from collections.abc import Mapping
from typing import ClassVar, Self

from asperity.casefile import Case, Table, read_case


@dataclasses.dataclass(frozen=True)
class Shipped:
    """A shipped case with settings."""

    verb: ClassVar[str]
    """What is mostly done with it."""

    known: ClassVar[Mapping[str, type[Table]]] = {}
    """Tables that its file may have."""

    case: str
    settings: tuple[str, ...] = ()

    @property
    def name(self) -> str:
        """Case and settings."""
        return " ".join((self.case, *self.settings))

    def read(self) -> Case:
        """The case."""
        return read_case(self.case, self.known, self.settings)

    def plus(self, *settings: str) -> Self:
        """The same with more settings."""
        return dataclasses.replace(self, settings=(*self.settings, *settings))

    def command(self, verb: str = "", **options: tuple[str, ...]) -> str:
        """What is done with it on the command line."""
        options["set"] = self.settings
        given = (f"--{name} {shlex.quote(one)}" for name, all_ in options.items() for one in all_)
        return " ".join(["asperity", verb or self.verb, self.case, *given])

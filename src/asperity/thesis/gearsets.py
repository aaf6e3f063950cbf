"""Shipped gearsets with settings that know their command."""

import dataclasses
import shlex

from asperity.casefile import Case, read_case
from asperity.flanks.tables import TABLES as FLANKS_TABLES
from asperity.rating.tables import TABLES as RATING_TABLES

_TABLES = {**RATING_TABLES, **FLANKS_TABLES}


@dataclasses.dataclass(frozen=True)
class Gear:
    """A shipped case of a gearset with settings."""

    case: str
    settings: tuple[str, ...] = ()

    def read(self) -> Case:
        """The case."""
        return read_case(self.case, _TABLES, self.settings)

    def command(self, verb: str = "rate") -> str:
        """The same on the command line."""
        settings = [f"--set {shlex.quote(setting)}" for setting in self.settings]
        return " ".join(["asperity", verb, self.case, *settings])

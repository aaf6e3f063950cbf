"""What a case file lacks, and which commands take it."""

from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple

from asperity.casefile.case import Case, naming_source
from asperity.casefile.check import Mistake, check_case, missing
from asperity.commands import COMMANDS, Command, case_tables
from asperity.errors import AsperityError, InputError
from asperity.start.duty import sized
from asperity.start.gear import MACRO, begun

DUTY = "requirements"
"""The table of a case that says what a gearset has to do, where it has none yet."""


class Checked(NamedTuple):
    """What is known of a case file.

    Attributes
    ----------
    case : Case
        With the tables that have no mistake.
    mistakes : tuple of Mistake
        In the order of its lines.
    takers : tuple of str
        Commands that take it.
    refused : dict of str to str
        Commands whose tables it has and that refuse it, and why.
    besides : tuple of str
        Commands that need something beside it, such as an axis.
    """

    case: Case
    mistakes: tuple[Mistake, ...]
    takers: tuple[str, ...]
    refused: dict[str, str]
    besides: tuple[str, ...] = ()

    @property
    def failure(self) -> InputError | None:
        """How many mistakes there are; None without any."""
        count = len(self.mistakes)
        if not count:
            return None
        return InputError(f"{self.case.source} has {count} mistake{'s' if count > 1 else ''}")

    def to_json(self) -> dict[str, Any]:
        """Return everything by key."""
        return {
            "file": self.case.source,
            "mistakes": [mistake._asdict() for mistake in self.mistakes],
            "commands": list(self.takers),
            "refused": {} if self.mistakes else self.refused,
        }

    def lines(self) -> Iterator[str]:
        """Yield what a person reads."""
        source = self.case.source
        for m in self.mistakes:
            yield f"{source}:{m.line or ''}: {m.text}".replace(":: ", ": ")
        if not self.mistakes:
            taken = f"; asperity {', '.join(self.takers)} can take it" if self.takers else ""
            if taken and "sweep" in self.besides:
                taken += ", and sweep over its keys"
            yield f"{source}: no mistakes{taken}"


def check(name: str, settings: Sequence[str]) -> Checked:
    """Look at a case file and at what every command says of it."""
    case, mistakes = check_case(name, case_tables(), settings)
    left_out = [m for m in mistakes if _filled(case, m)]
    mistakes = tuple(m for m in mistakes if m not in left_out)
    takers: list[str] = []
    refusals: dict[str, str] = {}
    able = [] if mistakes or left_out else _able(case)
    asked = [command for command in able if _takes_no_more(command)]
    for command in asked:
        try:
            with naming_source(case):
                command.prepared(case, **command.defaults)
        except AsperityError as error:
            refusals[command.name] = str(error)
        else:
            takers.append(command.name)
    # The command that needs most of the case is the one it is written for.
    if asked and asked[0].name in refusals:
        text = refusals[asked[0].name].removeprefix(f"{case.source}: ")
        mistakes, takers = (Mistake(None, "", text),), []
    elif not mistakes and not able and DUTY in case:
        try:
            with naming_source(case):
                sized(case)
        except AsperityError as error:
            mistakes = (Mistake(None, "", str(error).removeprefix(f"{case.source}: ")),)
        else:
            takers = ["size"]
    elif not mistakes and not able:
        mistakes = tuple(_lacking(case))
    besides = [
        c.name
        for c in COMMANDS
        if not _takes_no_more(c)
        and c.needs
        and (not missing(case, c.needs) or any(table in case for table in c.either))
    ]
    return Checked(case, mistakes, tuple(takers), refusals, tuple(besides))


def _filled(case: Case, mistake: Mistake) -> bool:
    """Whether a mistake is what a duty leaves out and ``size`` fills in."""
    table, _, key = mistake.key.partition(".")
    filled = table == "gearset" and mistake.text == f"{mistake.key} is missing"
    return filled and DUTY in case.raw and key in (*MACRO, *begun()[table])


def _takes_no_more(command: Command) -> bool:
    """Whether a command takes nothing that must be given beside a case."""
    must = any(option.default is None or option.one_of for option in command.options)
    return not command.arguments and not must


def _able(case: Case) -> list[Command]:
    """Return the commands whose tables a case has, what needs most first."""
    able = [c for c in COMMANDS if c.needs and not missing(case, c.needs)]
    return sorted(able, key=lambda command: -len(command.needs))


def _lacking(case: Case) -> Iterator[Mistake]:
    """Yield the tables that the command lacks which has most of what it needs."""
    begun = [c for c in COMMANDS if 0 < len(missing(case, c.needs)) < len(c.needs)]
    if not begun:
        return
    nearest = min(begun, key=lambda c: len(missing(case, c.needs)) / len(c.needs))
    lacks = missing(case, nearest.needs)
    verb, which = ("are", "them") if len(lacks) > 1 else ("is", "it")
    tables = ", ".join(f"[{name}]" for name in lacks)
    text = f"the table{'s' if len(lacks) > 1 else ''} {tables} {verb} missing; asperity "
    yield Mistake(None, lacks[0], f"{text}{nearest.name} needs {which}")

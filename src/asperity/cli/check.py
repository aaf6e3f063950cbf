"""What ``asperity check`` and ``asperity schema`` do."""

from collections.abc import Iterator, Sequence

from asperity.casefile.case import Case, told
from asperity.casefile.check import Mistake, check_case, missing
from asperity.casefile.schema import schema
from asperity.cli import show
from asperity.commands import COMMANDS, Command, case_tables
from asperity.errors import AsperityError, InputError


def check(name: str, settings: Sequence[str], *, as_json: bool) -> None:
    """Print all mistakes of a case file, or which commands take it; raises for mistakes."""
    case, mistakes = check_case(name, case_tables(), settings)
    takers: list[str] = []
    refusals: dict[str, str] = {}
    able = [] if mistakes else _able(case)
    asked = [command for command in able if _takes_no_more(command)]
    for command in asked:
        try:
            with told(case):
                command.prepared(case, **{o.name: o.default for o in command.options})
        except AsperityError as error:
            refusals[command.name] = str(error)
        else:
            takers.append(command.name)
    # The command that needs most of the case is the one it is written for.
    if asked and asked[0].name in refusals:
        text = refusals[asked[0].name].removeprefix(f"{case.source}: ")
        mistakes, takers = (Mistake(None, "", text),), []
    elif not mistakes and not able:
        mistakes = tuple(_lacking(case))
    if as_json:
        show.print_json(
            {
                "file": case.source,
                "mistakes": [mistake._asdict() for mistake in mistakes],
                "commands": takers,
                "refused": {} if mistakes else refusals,
            }
        )
    else:
        lines = [f"{case.source}:{m.line or ''}: {m.text}".replace(":: ", ": ") for m in mistakes]
        if not mistakes:
            taken = f"; asperity {', '.join(takers)} can take it" if takers else ""
            lines.append(f"{case.source}: no mistakes{taken}")
        show.print_text("\n".join(lines))
    if mistakes:
        count = len(mistakes)
        raise InputError(f"{case.source} has {count} mistake{'s' if count > 1 else ''}")


def print_schema() -> None:
    """Print the JSON Schema of case files."""
    show.print_json(schema(case_tables()))


def _takes_no_more(command: Command) -> bool:
    """Whether a command takes nothing that must be given beside a case."""
    return not command.arguments and all(option.default is not None for option in command.options)


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

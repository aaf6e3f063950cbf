"""What ``asperity check`` and ``asperity schema`` do."""

from collections.abc import Iterator, Sequence

from asperity.casefile.case import Case, told
from asperity.casefile.check import Mistake, check_case, missing
from asperity.casefile.schema import schema
from asperity.cli import show
from asperity.commands import COMMANDS, Command, case_tables
from asperity.errors import AsperityError, InputError, choices


def check(name: str, settings: Sequence[str], *, as_json: bool) -> None:
    """Print all mistakes of a case file, or which commands take it; raises for mistakes."""
    case, mistakes = check_case(name, case_tables(), settings)
    takers: list[str] = []
    refusals: dict[str, str] = {}
    if not mistakes:
        for command in _asked(case):
            try:
                with told(case):
                    command.prepared(case, **{o.name: o.default for o in command.options})
            except AsperityError as error:
                refusals[command.name] = str(error)
            else:
                takers.append(command.name)
        if not takers:
            mistakes = tuple(_of_commands(case, refusals))
            refusals = {}
    if as_json:
        show.print_json(
            {
                "file": case.source,
                "mistakes": [mistake._asdict() for mistake in mistakes],
                "commands": takers,
                "refused": refusals,
            }
        )
    else:
        lines = [f"{case.source}:{m.line or ''}: {m.text}".replace(":: ", ": ") for m in mistakes]
        if takers:
            lines.append(f"{case.source}: no mistakes; asperity {', '.join(takers)} can take it")
            lines += [f"asperity {name} cannot: {why}" for name, why in refusals.items()]
        show.print_text("\n".join(lines))
    if mistakes:
        count = len(mistakes)
        raise InputError(f"{case.source} has {count} mistake{'s' if count > 1 else ''}")


def print_schema() -> None:
    """Print the JSON Schema of case files."""
    show.print_json(schema(case_tables()))


def _asked(case: Case) -> Iterator[Command]:
    """Yield the commands whose tables a case has, of those that take nothing else."""
    for command in COMMANDS:
        asks = any(option.default is None for option in command.options)
        if command.needs and not asks and not missing(case, command.needs):
            yield command


def _of_commands(case: Case, refusals: dict[str, str]) -> Iterator[Mistake]:
    """Yield why no command takes a case: what they say, or the tables that it lacks."""
    texts = dict.fromkeys(refusals.values())
    for text in texts:
        yield Mistake(None, "", text.removeprefix(f"{case.source}: "))
    if texts:
        return
    nearest = min(
        (command for command in COMMANDS if command.needs),
        key=lambda c: (len(missing(case, c.needs)) / len(c.needs), -len(c.needs)),
    )
    lacks = missing(case, nearest.needs)
    tables = choices(lacks).replace("'", "")
    yield Mistake(
        None,
        lacks[0],
        f"the table{'s' if len(lacks) > 1 else ''} [{tables.replace(', ', '], [')}] "
        f"{'are' if len(lacks) > 1 else 'is'} missing; asperity {nearest.name} needs "
        f"{'them' if len(lacks) > 1 else 'it'}",
    )

"""What a command line is made of: the arguments that many take, and the commands of the registry.

Everything heavy is imported inside the commands, so that the help is there at once.
"""

import inspect
from pathlib import Path
from typing import Annotated, Any

import typer

from asperity.cli.outcome import reported
from asperity.commands import COMMANDS, GROUPS, Argument, Command, Option

CASE_HELP = "A case file, or the name of a case that ships."
CaseArgument = Annotated[str, typer.Argument(metavar="CASE", help=CASE_HELP)]
SetOption = Annotated[
    list[str] | None,
    typer.Option("--set", metavar="TABLE.KEY=VALUE", help="Change the case; as often as needed."),
]
JsonOption = Annotated[
    bool, typer.Option("--json", help="Print one JSON object to standard output, nothing else.")
]
FullOption = Annotated[
    bool, typer.Option("--full", help="Print every number, not one screen with the verdict.")
]


def folder_of(path: str) -> Path:
    """Return the folder that was given; refuses none."""
    # Python takes "" for the working directory; it is a variable of the shell that was not set.
    if not path:
        raise typer.BadParameter("it is empty; give a folder, or . for the working directory")
    return Path(path)


OutOption = Annotated[
    Path | None,
    typer.Option("--out", metavar="DIR", parser=folder_of, help="Folder to write files to."),
]
UnitsOption = Annotated[
    str,
    typer.Option(
        "--units",
        metavar="SYSTEM",
        help="Show it in si or us units; files keep their own.",
    ),
]
LanguageOption = Annotated[
    str,
    typer.Option(
        "--language", metavar="LANGUAGE", help="Show it in en, de, or by a file of sentences."
    ),
]
FormatOption = Annotated[
    str, typer.Option("--format", metavar="FORMAT", help="Of pictures: png, svg or pdf.")
]


def _out(command: Command) -> Any:
    if command.out == "DIR":
        return OutOption
    said = typer.Option("--out", metavar=command.out, parser=folder_of, help="File to write.")
    return Annotated[Path | None, said]


def _command(command: Command, into: typer.Typer) -> None:
    """Give an application or a group a command of the registry."""

    @reported
    def run(
        settings: list[str] | None, as_json: bool, out: Path | None, case: str = "", **options: Any
    ) -> None:
        from asperity.cli.on_terminal import execute_on_terminal

        execute_on_terminal(command, case, settings or (), as_json=as_json, out=out, **options)

    own = {option.name for option in command.options}
    case = Annotated[str, typer.Argument(metavar=command.case, help=CASE_HELP)]
    parameters = {
        **{
            argument.name: (_placed(argument), inspect.Parameter.empty)
            for argument in command.arguments
        },
        **({"case": (case, inspect.Parameter.empty)} if command.case else {}),
        **{option.name: _typed(option) for option in command.options},
        **({"full": (FullOption, False)} if command.brief else {}),
        **({"pictures": (FormatOption, "png")} if command.draws else {}),
        "settings": (SetOption, None),
        **({} if "units" in own else {"units": (UnitsOption, "")}),
        "language": (LanguageOption, ""),
        "as_json": (JsonOption, False),
        "out": (_out(command), None),
    }
    keyword = inspect.Parameter.KEYWORD_ONLY
    run.__signature__ = inspect.Signature(  # type: ignore[attr-defined]
        [
            inspect.Parameter(name, keyword, annotation=kind, default=default)
            for name, (kind, default) in parameters.items()
        ]
    )
    run.__doc__ = f"{command.summary}\n\n{command.files}"
    # Typer looks at the function behind a decorator.
    del run.__wrapped__  # type: ignore[attr-defined]
    into.command(name=command.name.rpartition(" ")[2])(run)


def _placed(argument: Argument) -> Any:
    kind: Any = list[str] if argument.many else str
    return Annotated[kind, typer.Argument(metavar=argument.metavar, help=argument.help)]


def _not_empty(context: typer.Context, option: typer.CallbackParam, value: Any) -> Any:
    """Refuse an empty text that was given, which is a variable of the shell that was not set."""
    source = context.get_parameter_source(str(option.name))
    if value == "" and source is not None and source.name == "COMMANDLINE":
        raise typer.BadParameter(f"it is empty; give {option.metavar}, or leave it out")
    return value


def _typed(option: Option) -> tuple[Any, Any]:
    kind: Any = list[str] if option.many else str if option.metavar else bool
    said = typer.Option(
        f"--{option.name}", metavar=option.metavar or None, help=option.help,
        callback=_not_empty if kind is str and option.default is not None else None,
    )  # fmt: skip
    default: Any = inspect.Parameter.empty if option.default is None else option.default
    if option.many and default == "":
        kind, default = list[str] | None, None
    return Annotated[kind, said], default


def register(app: typer.Typer, only: str = "") -> None:
    """Give an application the commands of the registry, or only one command or group of them."""
    groups = {n: typer.Typer(help=about) for n, about in GROUPS.items() if only in ("", n)}
    for name, group in groups.items():
        app.add_typer(group, name=name, no_args_is_help=True)
    for command in COMMANDS:
        group_name = command.name.rpartition(" ")[0]
        if only in ("", command.name, group_name or command.name):
            _command(command, groups.get(group_name, app))

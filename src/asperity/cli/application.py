"""What a user types, and what it sets going.

Everything heavy is imported inside the commands, so that the help is there at once.
"""

import os
import sys
from pathlib import Path
from typing import Annotated, Any

import typer

from asperity import exit_codes
from asperity.cli import begin, outcome
from asperity.cli.command_line import built
from asperity.cli.helped import as_written
from asperity.cli.outcome import USAGE_ERROR, reported, tell, usage
from asperity.cli.registry_commands import (
    CaseArgument,
    JsonOption,
    LanguageOption,
    OutOption,
    SetOption,
    UnitsOption,
    folder_of,
)
from asperity.cli.rig_look import looking
from asperity.kernels.native import makers

app = typer.Typer(
    add_completion=False,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
    help="What imposed vibration does to friction between sliding surfaces.",
)


@app.callback(invoke_without_command=True)
@reported
def asperity(
    context: typer.Context,
    version: Annotated[bool, typer.Option("--version", help="Show the version.")] = False,
    files: Annotated[
        list[str] | None,
        typer.Option(
            "--materials",
            metavar="FILE",
            help="Materials, oils, bearings and motors of your own; again for another file.",
        ),
    ] = None,
) -> None:
    """What imposed vibration does to friction between sliding surfaces."""
    from asperity.cli.show import print_text

    if files:
        from asperity.gearset.library import add_files

        add_files(files)
    if version:
        from asperity import __version__

        print_text(f"asperity {__version__}")
        raise typer.Exit
    # With its rich help typer prints by itself and returns nothing.
    if context.invoked_subcommand is None and (text := context.get_help()):
        print_text(text)


@app.command()
@reported
def export(
    case: CaseArgument,
    program: Annotated[
        str,
        typer.Option(
            "--to",
            metavar="PROGRAM",
            help="abaqus or calculix; c, csv or mat for a body's mean friction; dahl for its law.",
        ),
    ],
    settings: SetOption = None,
    over: Annotated[
        str,
        typer.Option("--over", metavar="TABLE.KEY=VALUES", help="Mean friction over this as well."),
    ] = "",
    subroutine: Annotated[
        str,
        typer.Option(
            "--subroutine",
            metavar="NAME",
            help="appendix-e: user.f as in Appendix E of the thesis, which is not sound.",
        ),
    ] = "",
    as_json: JsonOption = False,
    out: Annotated[
        Path | None,
        typer.Option(
            "--out",
            metavar="DIR",
            parser=folder_of,
            help="Folder to write to; out/PROGRAM if left out.",
        ),
    ] = None,
) -> None:
    """Take a case to another program: an input deck, or a body's mean friction as a table.

    An elastic block or a gearset's loaded teeth become block.inp or teeth.inp; for Abaqus also
    gear.inp, a gearset shaken along its worm, and user.f, the friction law as subroutine FRIC.
    The mean friction of a sliding body over a cycle of its vibration, against its mean velocity,
    becomes law.c and law.h, law.csv or law.mat; with --over map.c and so on. With dahl its law,
    step by step, is asperity_dahl.c, .h and .m.
    """
    from asperity.cli.export import export as run

    run(case, program, settings or (), over, subroutine, as_json=as_json, out=out)


@app.command()
@reported
def thesis(
    only: Annotated[
        list[str] | None,
        typer.Option(
            "--only",
            metavar="NUMBER",
            help="Only what has this number, 4.17, name, 'figure 4.17', or chapter, 4.",
        ),
    ] = None,
    out: Annotated[
        Path, typer.Option("--out", metavar="DIR", parser=folder_of, help="Folder to write to.")
    ] = Path("out/thesis"),
    full: Annotated[
        bool,
        typer.Option("--full", help="Figures of elastic blocks on fine meshes; about an hour."),
    ] = False,
    as_json: JsonOption = False,
) -> None:
    """Reproduce the thesis's claims, figures and tables into one page, index.html.

    The page is there at once and fills. What is done is kept: after Ctrl-C, or a change in the
    package, the same command makes what is missing and no more.
    """
    from asperity.cli import show
    from asperity.errors import ConvergenceError
    from asperity.thesis import run

    result = run(out, only or (), show.note, full=full)
    if as_json:
        show.print_json(result.to_json())
    else:
        show.print_text(str(result.index))
    if result.failed:
        name, why = next(iter(result.failed.items()))
        count = f"{len(result.failed)} of what was to be made failed"
        raise ConvergenceError(f"{count}, the first of them {name}: {why}")


@app.command()
@reported
def cases(
    name: Annotated[
        str, typer.Argument(metavar="NAME", help="Print this one, to begin a file of your own.")
    ] = "",
    as_json: JsonOption = False,
) -> None:
    """List the cases that ship, or print one; their names work wherever a file does."""
    from asperity.cli.cases import print_case, print_cases

    if name:
        print_case(name, as_json=as_json)
    else:
        print_cases(as_json=as_json)


app.command()(begin.new)
app.command()(begin.size)


@app.command()
@reported
def compare(
    cases: Annotated[
        list[str], typer.Argument(metavar="CASE CASE...", help="Case files, or names of cases.")
    ],
    settings: SetOption = None,
    units: UnitsOption = "",
    language: LanguageOption = "",
    as_json: JsonOption = False,
    out: OutOption = None,
) -> None:
    """Put gearsets or bodies side by side: what differs in what is asked and in what comes of it.

    A --set changes all of them. With --out also compare.json and compare.nc.
    """
    from asperity.cli.compare import compare as run

    run(cases, settings or (), (units, language), as_json=as_json, out=out)


@app.command()
@reported
def page(
    case: Annotated[
        str, typer.Argument(metavar="CASE", help="One to open; another can be chosen there.")
    ] = "",
    port: Annotated[
        int,
        typer.Option(
            "--port",
            metavar="N",
            show_default=False,
            help="Where to listen; 8321, or any that is free, if left out.",
        ),
    ] = 0,
    folder: Annotated[
        Path | None,
        typer.Option(
            "--folder",
            metavar="DIR",
            parser=folder_of,
            help="Of cases, uploads and jobs; that of CASE, or this one, if left out.",
        ),
    ] = None,
    no_browser: Annotated[
        bool, typer.Option("--no-browser", help="Print the address and open nothing.")
    ] = False,
    units: UnitsOption = "",
) -> None:
    """Open the page: see it, turn it, shake it. It is on this machine alone, until Ctrl-C."""
    from asperity.cli.show import print_text
    from asperity.commands.shown import check_shown
    from asperity.web.serve import serve

    check_shown(units, "")
    serve(case, port, folder, print_text, browser=not no_browser, units=units)


@app.command()
@reported
def check(
    case: CaseArgument,
    settings: SetOption = None,
    language: LanguageOption = "",
    as_json: JsonOption = False,
) -> None:
    """Find all mistakes of a case file, each with its line and what is allowed."""
    from asperity.cli.check import check as run

    run(case, settings or (), language, as_json=as_json)


@app.command()
@reported
def schema(as_json: JsonOption = False) -> None:
    """Print the JSON Schema of case files, by which editors complete and underline.

    It is one JSON object in any case.
    """
    from asperity.cli.check import print_schema

    print_schema()


@app.command()
@reported
def materials(as_json: JsonOption = False) -> None:
    """List the materials of worms and wheels, with source and trust."""
    from asperity.cli.lists import print_library
    from asperity.gearset.library import every
    from asperity.gearset.materials import Steel, WheelMaterial, WormMaterial
    from asperity.gearset.plastics import Plastic

    own = (Plastic,) if every(Plastic) else ()
    print_library((WheelMaterial, *own, WormMaterial, Steel), as_json=as_json)


@app.command()
@reported
def lubricants(as_json: JsonOption = False) -> None:
    """List the lubricants and their base oils, with source and trust."""
    from asperity.cli.lists import print_library
    from asperity.gearset.lubricants import BaseOil, Lubricant

    print_library((Lubricant, BaseOil), as_json=as_json)


@app.command()
@reported
def bearings(as_json: JsonOption = False) -> None:
    """List rolling bearings and steels of shafts that data files hold, with source and trust.

    Bearings are your own: asperity new bearing begins a file.
    """
    from asperity.cli.lists import print_library
    from asperity.shafts.bearing import RollingBearing
    from asperity.shafts.steel import ShaftSteel

    print_library((RollingBearing, ShaftSteel), as_json=as_json)


@app.command()
@reported
def hobs(as_json: JsonOption = False) -> None:
    """List the hobs that data files hold, which requirements.hobs = "own" takes, with source.

    A file has tables such as [hob."4 x 40"] with axial_module and worm_pitch_diameter.
    """
    from asperity.cli.lists import print_library
    from asperity.gearset.hob_shelf import ShelfHob

    print_library((ShelfHob,), as_json=as_json)


@app.command()
@reported
def instruments(
    name: Annotated[
        str, typer.Argument(metavar="NAME", help="Print this one, to begin a table of your own.")
    ] = "",
    as_json: JsonOption = False,
) -> None:
    """List the supplies and generators that a rig knows by name, or print what is said to one."""
    from asperity.cli.instruments import print_instrument, print_instruments

    if name:
        print_instrument(name, as_json=as_json)
    else:
        print_instruments(as_json=as_json)


@app.command()
@reported
def cache(
    kinds: Annotated[
        list[str] | None,
        typer.Argument(metavar="KIND", help="Of these only; all if left out."),
    ] = None,
    clear: Annotated[bool, typer.Option("--clear", help="Remove it; it is made anew.")] = False,
    as_json: JsonOption = False,
) -> None:
    """Show what is kept in the user's cache folder and how much of it, or remove it.

    What runs meanwhile goes on and makes anew what it asks for.
    """
    from asperity.cli.cache import cache as run

    run(kinds or (), clear=clear, as_json=as_json)


def run(arguments: list[str] | None = None) -> int:
    """Run the command line; returns its exit code."""
    outcome.hold_streams()
    # What makes the tables of case files looks through all installed packages for its plugins.
    os.environ.setdefault("PYDANTIC_DISABLE_PLUGINS", "1")
    arguments = looking(sys.argv[1:] if arguments is None else arguments)
    if arguments:
        makers.begin_for(arguments)
    command: Any = built(app, arguments)
    as_written(command)
    # Left without a value, the option for help would load all of pydantic to convert none.
    no_help: dict[str, Any] = {"help": False}
    for name, one in command.commands.items():
        within = {each: {"help": False} for each in getattr(one, "commands", {})}
        no_help[name] = {"help": False, **within}
    try:
        code: int | None = command.main(
            arguments, prog_name="asperity", standalone_mode=False, default_map=no_help
        )
    except USAGE_ERROR as error:
        tell(usage(error))
        code = exit_codes.BAD_INPUT
    except OSError as error:
        # Of what is left, the help that cannot be printed.
        tell(outcome.unwritten(error))
        code = exit_codes.BAD_INPUT
    try:
        sys.stdout.flush()
    except OSError:
        # What refused it has been told; Python would complain at its own last flush.
        outcome.silence_standard_output()
    return code or 0

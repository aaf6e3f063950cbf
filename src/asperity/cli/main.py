"""The command ``asperity``: what a user types, and what it sets going.

Everything heavy is imported inside the commands, so that the help is there at once.
"""

import sys
from pathlib import Path
from typing import Annotated, NoReturn

import typer

from asperity.cli.outcome import USAGE_ERROR, reported, silence_standard_output, usage

app = typer.Typer(
    add_completion=False,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
    help="What imposed vibration does to friction between sliding surfaces.",
)

CaseArgument = Annotated[
    str, typer.Argument(metavar="CASE", help="A case file, or the name of a case that ships.")
]
SetOption = Annotated[
    list[str] | None,
    typer.Option("--set", metavar="TABLE.KEY=VALUE", help="Change the case; as often as needed."),
]
JsonOption = Annotated[
    bool, typer.Option("--json", help="Print one JSON object to standard output, nothing else.")
]


def _folder(given: str) -> Path:
    # Python takes "" for the working directory; it is a variable of the shell that was not set.
    if not given:
        raise typer.BadParameter("it is empty; give a folder, or . for the working directory")
    return Path(given)


OutOption = Annotated[
    Path | None,
    typer.Option("--out", metavar="DIR", parser=_folder, help="Folder to write files to."),
]


@app.callback(invoke_without_command=True)
@reported
def asperity(
    context: typer.Context,
    version: Annotated[bool, typer.Option("--version", help="Show the version.")] = False,
) -> None:
    """What imposed vibration does to friction between sliding surfaces."""
    from asperity.cli.show import print_text

    if version:
        from asperity import __version__

        print_text(f"asperity {__version__}")
        raise typer.Exit
    # With its rich help typer prints by itself and returns nothing.
    if context.invoked_subcommand is None and (text := context.get_help()):
        print_text(text)


@app.command()
@reported
def slide(
    case: CaseArgument,
    settings: SetOption = None,
    as_json: JsonOption = False,
    out: OutOption = None,
) -> None:
    """Pull a body over a vibrating base: drive force, friction, power.

    With --out also slide.nc, slide.png and slide.json.
    """
    from asperity.casefile import read_case
    from asperity.cli import show
    from asperity.cli.tables import TABLES
    from asperity.errors import ConvergenceError
    from asperity.slider.march import Timetable
    from asperity.slider.methods import solve
    from asperity.slider.model import Model
    from asperity.store import output_folder

    model = Model.from_case(read_case(case, TABLES, settings or ()))
    # A case that is refused leaves no folder behind, and a folder that is refused costs no time.
    if model.solve.method == "march":
        Timetable(model)
    else:
        _ = model.substeps
    folder = output_folder(out) if out is not None else None
    try:
        result = solve(model, history=folder is not None)
    except ConvergenceError as error:
        if as_json:
            show.print_json({"error": str(error), "reached": error.reached})
        raise
    answer = result.to_json()
    # Shown before it is written: what was solved is not lost to a disk that is full.
    if as_json:
        show.print_json(answer)
    else:
        show.print_slide(case, answer)
    if folder is not None:
        from asperity.store import write_dataset

        write_dataset(result.to_dataset(), folder / "slide.nc")
        show.write_picture(result.plot(), folder / "slide.png")
        show.write_json(answer, folder / "slide.json")
        show.note(f"written to {folder}: slide.nc, slide.png, slide.json")


@app.command()
@reported
def block(
    case: CaseArgument,
    settings: SetOption = None,
    as_json: JsonOption = False,
    out: OutOption = None,
) -> None:
    """Pull an elastic block over a vibrating base: the same by finite elements.

    With --out also block.nc, block.png, block_pressure.png, block.json and block.pvd, an
    animation for ParaView.
    """
    from asperity.cli.block import block as run

    run(case, settings or (), as_json=as_json, out=out)


@app.command()
@reported
def sweep(
    case: CaseArgument,
    over: Annotated[
        list[str],
        typer.Option(
            "--over",
            metavar="TABLE.KEY=VALUES",
            help="An axis: 1,2,3 or start:stop:step, with units; again for another axis.",
        ),
    ],
    settings: SetOption = None,
    as_json: JsonOption = False,
    out: OutOption = None,
    cluster: Annotated[
        str | None,
        typer.Option(
            "--cluster",
            metavar="ADDRESS",
            help="A Dask scheduler to send the work to, instead of this machine's cores.",
        ),
    ] = None,
) -> None:
    """Solve a case over a grid of values; what is done is kept, and found by the next run.

    With --out also sweep.nc, sweep.json and, for one or two axes, sweep.png.
    """
    from asperity.cli import show
    from asperity.cli.tables import TABLES
    from asperity.errors import ConvergenceError
    from asperity.store import output_folder
    from asperity.sweep import read_grid, run

    first, axes = read_grid(case, TABLES, settings or [], over)
    folder = output_folder(out) if out is not None else None
    with show.progress_bar() as progress:
        result = run(first, axes, cluster=cluster, progress=progress, notify=show.note)
    if folder is not None:
        from asperity.sweep.plots import MOST_AXES

        result.write(folder / "sweep.nc")
        drawn = len(axes) <= MOST_AXES
        if drawn:
            show.write_picture(result.plot(), folder / "sweep.png")
        show.write_json(result.to_json(), folder / "sweep.json")
        names = "sweep.nc, sweep.png, sweep.json" if drawn else "sweep.nc, sweep.json"
        show.note(f"written to {folder}: {names}")
    if as_json:
        show.print_json(result.to_json())
    else:
        show.print_sweep(result)
    if result.failed:
        point, why = next(iter(result.failures.items()))
        raise ConvergenceError(
            f"{result.failed} of {result.points} points did not converge, the first at {point}: "
            f"{why}"
        )


@app.command()
@reported
def rate(
    case: CaseArgument,
    standard: Annotated[
        str,
        typer.Option("--standard", metavar="NAME", help="iso14521, bs721, agma6034 or all."),
    ] = "all",
    settings: SetOption = None,
    as_json: JsonOption = False,
    out: OutOption = None,
) -> None:
    """Rate a worm gearset: friction, efficiency, losses, load capacity, self-locking.

    With --out also rate.json, rate.html and rate.csv.
    """
    from asperity.cli.rate import rate as run

    run(case, standard, settings or (), as_json=as_json, out=out)


@app.command()
@reported
def sensitivity(
    case: CaseArgument,
    settings: SetOption = None,
    as_json: JsonOption = False,
    out: OutOption = None,
) -> None:
    """Raise each input of a worm gearset alone, to 40 %, and follow its efficiency.

    With --out also sensitivity.nc, sensitivity.png and sensitivity.json.
    """
    from asperity.cli.studies import run_sensitivity

    run_sensitivity(case, settings or (), as_json=as_json, out=out)


@app.command()
@reported
def methods(
    case: CaseArgument,
    settings: SetOption = None,
    as_json: JsonOption = False,
    out: OutOption = None,
) -> None:
    """Compare oils, additives, coatings and vibration by a worm gearset's efficiency.

    The vibration is that of the case's [vibration], with the law of [friction].
    With --out also methods.nc, methods.png and methods.json.
    """
    from asperity.cli.studies import run_methods

    run_methods(case, settings or (), as_json=as_json, out=out)


@app.command()
@reported
def optimise(
    case: CaseArgument,
    settings: SetOption = None,
    as_json: JsonOption = False,
    out: OutOption = None,
) -> None:
    """Find a worm gearset's most efficient design that keeps its load capacity.

    Pressure angle, diameter factor, module and roughness are free. Also what a higher permissible
    torque costs. With --out also optimise.nc, optimise.png and optimise.json.
    """
    from asperity.cli.studies import run_optimise

    run_optimise(case, settings or (), as_json=as_json, out=out)


@app.command()
@reported
def flank(
    case: CaseArgument,
    density: Annotated[
        str,
        typer.Option(
            "--density",
            metavar="SIZE",
            help="Of the mesh: coarse, intermediate, fine, or an element size as '0.5 mm'.",
        ),
    ] = "intermediate",
    step: Annotated[
        bool, typer.Option("--step", help="Also write tooth and worm as STEP, with --out.")
    ] = False,
    settings: SetOption = None,
    as_json: JsonOption = False,
    out: OutOption = None,
) -> None:
    """Cut a worm wheel exactly: its contact, transmission error, backlash and mesh.

    With --out also flank.json, flank.nc, pictures, and tooth and worm as mesh and surface.
    """
    from asperity.cli.flank import flank as run

    run(case, settings or (), density=density, step=step, as_json=as_json, out=out)


@app.command()
@reported
def export(
    case: CaseArgument,
    program: Annotated[str, typer.Option("--to", metavar="PROGRAM", help="abaqus or calculix.")],
    settings: SetOption = None,
    as_json: JsonOption = False,
    out: Annotated[
        Path | None,
        typer.Option(
            "--out",
            metavar="DIR",
            parser=_folder,
            help="Folder to write to; out/PROGRAM if left out.",
        ),
    ] = None,
) -> None:
    """Write an elastic block on its base as an input deck: block.inp.

    For Abaqus also user.f, the friction law as user subroutine FRIC.
    """
    from asperity.cli.export import export as run

    run(case, program, settings or (), as_json=as_json, out=out)


@app.command()
@reported
def thesis(
    only: Annotated[
        list[str] | None,
        typer.Option("--only", metavar="NUMBER", help="Only this figure or table, as 4.17."),
    ] = None,
    out: Annotated[
        Path, typer.Option("--out", metavar="DIR", parser=_folder, help="Folder to write to.")
    ] = Path("out/thesis"),
    full: Annotated[
        bool,
        typer.Option("--full", help="Figures of elastic blocks on fine meshes; about an hour."),
    ] = False,
    as_json: JsonOption = False,
) -> None:
    """Reproduce the thesis's claims, figures and tables into one page, index.html."""
    from asperity.cli import show
    from asperity.thesis import run

    result = run(out, only or (), show.note, full=full)
    if as_json:
        show.print_json(result.to_json())
    else:
        show.print_text(str(result.index))


@app.command()
@reported
def cases(as_json: JsonOption = False) -> None:
    """List the cases that ship; their names work wherever a file does."""
    from asperity.casefile import describe, shipped_cases
    from asperity.cli import show

    shipped = [
        {"name": name, "description": describe(path)} for name, path in shipped_cases().items()
    ]
    if as_json:
        show.print_json({"cases": shipped})
    else:
        show.print_cases(shipped)


def main(arguments: list[str] | None = None) -> NoReturn:
    """Run the command line and leave with its exit code."""
    try:
        code: int | None = typer.main.get_command(app).main(
            arguments, prog_name="asperity", standalone_mode=False
        )
    except USAGE_ERROR as error:
        print(usage(error), file=sys.stderr)
        code = 2
    except OSError as error:
        # Of what is left, the help that cannot be printed.
        print(error, file=sys.stderr)
        silence_standard_output()
        code = 2
    sys.exit(code or 0)

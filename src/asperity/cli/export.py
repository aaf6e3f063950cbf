"""What ``asperity export`` does."""

from collections.abc import Mapping, Sequence
from pathlib import Path

from asperity.casefile import Case, naming_source, read_case
from asperity.cli import show
from asperity.commands import case_tables
from asperity.errors import InputError, choices, one_of
from asperity.files.store import output_folder, write_atomically, write_text

_MOST_NODES = 2_000_000
_ABAQUS = "abaqus"
_DECKS = (_ABAQUS, "calculix")
SUBROUTINES = ("appendix-e",)
_LAWS = ("c", "csv", "mat")
_DAHL = "dahl"
PROGRAMS = (*_DECKS, *_LAWS, _DAHL)

Files = Mapping[str, str] | Mapping[str, bytes]


def export(
    case: str,
    program: str,
    settings: Sequence[str],
    over: str = "",
    subroutine: str = "",
    *,
    as_json: bool,
    out: Path | None,
) -> None:
    """Write a case as input of another program, or its friction, and say where."""
    if program not in PROGRAMS:
        raise InputError(f"--to {program}: {one_of(PROGRAMS, program)}")
    if subroutine and subroutine not in SUBROUTINES:
        raise InputError(f"--subroutine {subroutine}: {one_of(SUBROUTINES, subroutine)}")
    if subroutine and program != _ABAQUS:
        raise InputError(f"--subroutine is for --to {_ABAQUS}; leave it out with --to {program}")
    if program in _LAWS:
        files = _law(case, program, settings, over)
    elif over:
        raise InputError(f"--over is for {choices(_LAWS)}; leave it out with --to {program}")
    elif program == _DAHL:
        files = _dahl(read_case(case, case_tables(), settings))
    else:
        read = read_case(case, case_tables(), settings)
        geared = "drive" in read and "block" not in read
        if subroutine and not geared:
            raise InputError(
                f"--subroutine {subroutine} is of a gearset's deck; {case} has none: leave it out"
            )
        files = _teeth(read, program, subroutine) if geared else _block(read, program)
    folder = output_folder(out if out is not None else Path("out") / program)
    written = [str(_written(folder / name, content)) for name, content in files.items()]
    if as_json:
        show.print_json({"to": program, "files": written})
    else:
        show.print_text("\n".join(written))


def _block(case: Case, program: str) -> Files:
    from asperity.block.deck import WRITERS, BlockSetup
    from asperity.block.solution.check import check_ranges

    setup = BlockSetup.from_case(case)
    check_ranges(setup.problem)
    nodes = setup.problem.nodes
    if nodes > _MOST_NODES:
        raise InputError(
            f"block.elements is {list(setup.block.elements)} with '{setup.block.element}', {nodes} "
            f"nodes; a deck is written with at most {_MOST_NODES}: take fewer elements"
        )
    return WRITERS[program](setup)


def _teeth(case: Case, program: str, subroutine: str) -> Files:
    from asperity.drive.deck import WRITERS, TeethSetup, abaqus_files
    from asperity.runs import Run

    setup = TeethSetup.from_case(case, Run(notify=show.note))
    return abaqus_files(setup, subroutine) if subroutine else WRITERS[program](setup)


def _law(name: str, program: str, settings: Sequence[str], over: str) -> Files:
    from asperity.runs import Run
    from asperity.slider.friction_map import tabulate
    from asperity.slider.law_files import WRITERS
    from asperity.slider.slide import prepare
    from asperity.sweep.axes import read_grid
    from asperity.sweep.axis import Axis
    from asperity.units import unit_of

    axes: list[Axis] = []
    if over:
        case, axes = read_grid(name, case_tables(), settings, [over])
    else:
        case = read_case(name, case_tables(), settings)
    key, unit, values = "", "", [0.0]
    for axis in axes:
        key, unit = axis.path, unit_of(case.known[axis.table], axis.key) or ""
        values = sorted(value for value in axis.values if not isinstance(value, str))
        if len(values) < 2:
            raise InputError(f"--over {over}: a map is over two numbers or more")
    with naming_source(case), show.progress_bar("laws") as progress:
        wanted: list[dict[str, object]] = [{key: value} if key else {} for value in values]
        models = [
            prepare(case.replace_values({"solve.method": "homogenised", **one})) for one in wanted
        ]
        run = Run(progress=progress, notify=show.note)
        laws = tabulate(models, values, key, unit, run)
    about = _about(case, key)
    for note in dict.fromkeys(note for law in laws.laws for note in law.notes):
        show.note(note)
    return WRITERS[program](laws, about)


def _dahl(case: Case) -> Files:
    from asperity.slider.dahl_files import dahl_files
    from asperity.slider.model import Model

    with naming_source(case):
        return dahl_files(Model.from_case(case), _about(case, ""))


def _about(case: Case, but: str) -> list[str]:
    from asperity import __version__

    return [f"asperity {__version__}, {case.source}", *_said(case, but)]


def _said(case: Case, but: str) -> list[str]:
    """What a case says of a body, as it is written there."""
    said = [
        (f"{name}.{key}", value)
        for name in ("slider", "friction", "vibration", "normal")
        for key, value in case.raw.get(name, {}).items()
    ]
    return [f"{path} = {value}" for path, value in said if path != but]


def _written(path: Path, content: str | bytes) -> Path:
    if isinstance(content, str):
        return write_text(path, content)
    return write_atomically(path, lambda target: target.write_bytes(content))

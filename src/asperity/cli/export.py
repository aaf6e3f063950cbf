"""What ``asperity export`` does."""

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

from asperity.casefile import Case, read_case
from asperity.cli import show
from asperity.commands import case_tables
from asperity.errors import InputError, choices, suggestion
from asperity.store import output_folder, write_text

_MOST_NODES = 2_000_000
PROGRAMS = ("abaqus", "calculix")

Files = Mapping[str, str]


def export(
    case: str, program: str, settings: Sequence[str], *, as_json: bool, out: Path | None
) -> None:
    """Write a block's or a gearset's case as input of another program, and say where."""
    if program not in PROGRAMS:
        raise InputError(
            f"--to {program}: it must be one of {choices(PROGRAMS)}{suggestion(program, PROGRAMS)}"
        )
    read = read_case(case, case_tables(), settings)
    geared = "drive" in read and "block" not in read
    write: Callable[[Case, str], Files] = _teeth if geared else _block
    files = write(read, program)
    folder = output_folder(out if out is not None else Path("out") / program)
    written = [str(write_text(folder / name, text)) for name, text in files.items()]
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


def _teeth(case: Case, program: str) -> Files:
    from asperity.drive.deck import WRITERS, TeethSetup
    from asperity.runs import Run

    return WRITERS[program](TeethSetup.from_case(case, Run(notify=show.note)))

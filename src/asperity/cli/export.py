"""What ``asperity export`` does."""

from collections.abc import Sequence
from pathlib import Path

from asperity.block.deck import WRITERS, BlockSetup
from asperity.block.solution.check import check_ranges
from asperity.casefile import read_case
from asperity.cli import show
from asperity.commands import case_tables
from asperity.errors import InputError, choices, suggestion
from asperity.store import output_folder, write_text

_MOST_NODES = 2_000_000


def export(
    case: str, program: str, settings: Sequence[str], *, as_json: bool, out: Path | None
) -> None:
    """Write a block's case as input of another program, and say where."""
    if program not in WRITERS:
        raise InputError(
            f"--to {program}: it must be one of {choices(WRITERS)}{suggestion(program, WRITERS)}"
        )
    setup = BlockSetup.from_case(read_case(case, case_tables(), settings))
    check_ranges(setup.problem)
    nodes = setup.problem.nodes
    if nodes > _MOST_NODES:
        raise InputError(
            f"block.elements is {list(setup.block.elements)} with '{setup.block.element}', {nodes} "
            f"nodes; a deck is written with at most {_MOST_NODES}: take fewer elements"
        )
    files = WRITERS[program](setup)
    folder = output_folder(out if out is not None else Path("out") / program)
    written = [str(write_text(folder / name, text)) for name, text in files.items()]
    if as_json:
        show.print_json({"to": program, "files": written})
    else:
        show.print_text("\n".join(written))

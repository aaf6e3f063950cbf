"""What ``asperity flank`` does."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from asperity.casefile import read_case
from asperity.cli import show
from asperity.commands import case_tables
from asperity.errors import ConvergenceError, InputError
from asperity.flanks.export.brep import require_cad
from asperity.flanks.mesh.density import read_density
from asperity.flanks.study import prepare_case, study
from asperity.results.files import write_json
from asperity.store import output_folder

if TYPE_CHECKING:
    from asperity.flanks.result import FlankStudy


def flank(
    case: str,
    settings: Sequence[str],
    *,
    density: str,
    step: bool,
    as_json: bool,
    out: Path | None,
) -> None:
    """Study the flanks of a worm gearset, print what was found and write it to files."""
    if step and out is None:
        raise InputError("--step: there is no folder for the files; name one with --out DIR")
    if step:
        require_cad()
    try:
        size = read_density(density)
    except InputError as error:
        raise InputError(f"--{error}") from None
    # What can be refused is refused before the folder is made, and the folder before the work.
    prepared = prepare_case(read_case(case, case_tables(), settings), size)
    folder = output_folder(out) if out is not None else None
    try:
        found = study(prepared)
    except ConvergenceError as error:
        if as_json:
            show.print_json({"error": str(error), "reached": error.reached})
        raise
    if as_json:
        show.print_json(found.to_json())
    else:
        _print(case, found)
    if folder is not None:
        from asperity.flanks.export.files import write_study

        write_json(found.to_json(), folder / "flank.json")
        written = write_study(found, folder, step=step)
        for line in written.notes:
            show.note(line)
        show.note(f"written to {folder}: {', '.join(('flank.json', *written.names))}")


def _print(case: str, found: "FlankStudy") -> None:
    from rich.console import Console

    console = Console(highlight=False, markup=False)
    with console.capture() as capture:
        console.print(found.to_rich())
    show.print_text(f"{case}: {found.name or 'worm gearset'}\n")
    show.print_text("\n".join(line.rstrip() for line in capture.get().splitlines()))

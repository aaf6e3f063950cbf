"""What ``asperity rate`` does."""

from collections.abc import Sequence
from pathlib import Path

from asperity.casefile import read_case
from asperity.cli import show
from asperity.commands import case_tables
from asperity.errors import InputError, choices, suggestion
from asperity.rating import STANDARDS, Rated, rate_case
from asperity.results.files import write_json
from asperity.store import output_folder, write_text

ALL = "all"


def rate(
    case: str, standard: str, settings: Sequence[str], *, as_json: bool, out: Path | None
) -> None:
    """Rate a worm gearset, print the result and write it to files."""
    allowed = (*STANDARDS, ALL)
    if standard not in allowed:
        raise InputError(
            f"--standard {standard}: it must be one of {choices(allowed)}"
            f"{suggestion(standard, allowed)}"
        )
    folder = output_folder(out) if out is not None else None
    wanted = STANDARDS if standard == ALL else (standard,)
    rated = rate_case(read_case(case, case_tables(), settings), wanted)
    if folder is not None:
        write_json(rated.to_json(), folder / "rate.json")
        write_text(folder / "rate.html", rated.to_html())
        write_text(folder / "rate.csv", rated.to_frame().to_csv(lineterminator="\n"))
        show.note(f"written to {folder}: rate.json, rate.html, rate.csv")
    if as_json:
        show.print_json(rated.to_json())
    else:
        _print(case, rated)


def _print(case: str, rated: Rated) -> None:
    from rich.console import Console

    console = Console(highlight=False, markup=False)
    with console.capture() as capture:
        console.print(rated.to_rich())
    lines = (line.rstrip() for line in capture.get().splitlines())
    show.print_text(f"{case}: {rated.gearset.name or 'worm gearset'}\n")
    show.print_text("\n".join(lines))

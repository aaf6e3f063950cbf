"""Everything at once: figures, tables and ledger computed or found, and the page written."""

import dataclasses
import json
import os
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from asperity import __version__
from asperity.store import output_folder, write_text
from asperity.thesis import contents
from asperity.thesis.ledger import Entry, settle
from asperity.thesis.page.report import render
from asperity.thesis.reproduce.files import (
    FigureFiles,
    TableFiles,
    found_figure,
    found_table,
    make_figure,
    make_table,
    stamp,
)

_LEDGER = "claims.json"


@dataclasses.dataclass(frozen=True)
class ThesisResult:
    """What a run made or found.

    Attributes
    ----------
    index : pathlib.Path
        The page.
    claims : tuple of Entry
        The ledger; empty if only some figures were asked for and none was there.
    figures : tuple of FigureFiles
        The figures asked for.
    tables : tuple of TableFiles
        The tables asked for.
    seconds : float
        Time it took, s.
    """

    index: Path
    claims: tuple[Entry, ...]
    figures: tuple[FigureFiles, ...]
    tables: tuple[TableFiles, ...]
    seconds: float

    def to_json(self) -> dict[str, Any]:
        """As plain values."""
        return {
            "index": str(self.index),
            "claims": [entry.to_json() for entry in self.claims],
            "figures": [
                {
                    "number": figure.number,
                    "title": figure.title,
                    "picture": str(figure.picture),
                    "dataset": str(figure.dataset),
                    "how": list(figure.how),
                    "reused": figure.reused,
                }
                for figure in self.figures
            ],
            "tables": [
                {
                    "number": table.number,
                    "title": table.title,
                    "path": str(table.path),
                    **table.grid.to_json(),
                    "reused": table.reused,
                }
                for table in self.tables
            ],
            "seconds": self.seconds,
        }


def run(
    out: str | os.PathLike[str],
    only: Sequence[str] = (),
    progress: Callable[[str], None] | None = None,
    *,
    full: bool = False,
) -> ThesisResult:
    """Reproduce the thesis's figures, tables and claims into a folder.

    Each is written as soon as it is made; what an earlier run left there and is still true is used
    again.

    Parameters
    ----------
    out : path
        Folder for ``index.html``, the ledger, each figure's PNG and netCDF, and each table's CSV.
    only : sequence of str
        Numbers of figures and tables to make, such as ``"4.17"``, and nothing else; all and the
        ledger if empty. A figure and a table may have the same number.
    progress : callable, optional
        Takes a line about each thing done.
    full : bool
        Make figures in full that take long: elastic blocks on the mesh of the shipped cases, in
        25 directions.

    Raises
    ------
    InputError
        There is neither figure nor table of such a number.
    StorageError
        The folder cannot be written to.
    """
    began = time.perf_counter()
    say = progress or (lambda line: None)
    wanted_figures, wanted_tables = contents.select(only)
    folder = output_folder(out)
    figures = {
        figure.number: make_figure(folder, figure, say, full=full) for figure in wanted_figures
    }
    tables = {table.number: make_table(folder, table, say) for table in wanted_tables}
    claims = _ledger(folder, say, compute=not only)
    all_figures = [
        figures.get(number) or found_figure(folder, figure)
        for number, figure in contents.FIGURES.items()
    ]
    all_tables = [
        tables.get(number) or found_table(folder, table)
        for number, table in contents.TABLES.items()
    ]
    page = render(
        claims,
        [figure for figure in all_figures if figure is not None],
        [table for table in all_tables if table is not None],
        __version__,
    )
    index = write_text(folder / "index.html", page)
    seconds = time.perf_counter() - began
    return ThesisResult(index, claims, tuple(figures.values()), tuple(tables.values()), seconds)


def _ledger(folder: Path, say: Callable[[str], None], *, compute: bool) -> tuple[Entry, ...]:
    """The ledger an earlier run left as far as it is still true, completed if asked for."""
    path = folder / _LEDGER
    true = stamp("ledger", contents.CASES)
    entries: dict[str, Entry] = {}
    try:
        plain = json.loads(path.read_text("utf-8"))
        if plain["stamp"] == true:
            entries = {claim["id"]: Entry.from_json(claim) for claim in plain["claims"]}
    except (OSError, ValueError, KeyError, TypeError):
        entries = {}
    for claim in contents.CLAIMS if compute else ():
        if claim.id in entries:
            say(f"claim {claim.id}: there already")
            continue
        began = time.perf_counter()
        entries[claim.id] = settle(claim)
        done = {"stamp": true, "claims": [entry.to_json() for entry in entries.values()]}
        write_text(path, json.dumps(done, indent=1, allow_nan=False))
        say(f"claim {claim.id}: {entries[claim.id].finding.verdict}, "
            f"{time.perf_counter() - began:.1f} s")  # fmt: skip
    return tuple(entries[claim.id] for claim in contents.CLAIMS if claim.id in entries)

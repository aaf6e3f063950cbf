"""Everything at once: figures and ledger computed or found, and the page written."""

import dataclasses
import hashlib
import json
import os
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from asperity import __version__
from asperity.casefile import read_case
from asperity.compiled import source_hash
from asperity.errors import StorageError
from asperity.slider import TABLES
from asperity.store import output_folder, read_dataset, write_atomically, write_dataset, write_text
from asperity.thesis.claims import CASES, CLAIMS
from asperity.thesis.figures import FIGURES, FigureOf, select
from asperity.thesis.ledger import Entry, settle
from asperity.thesis.report import render

_DOTS_PER_INCH = 150
_LEDGER = "claims.json"


@dataclasses.dataclass(frozen=True)
class FigureFiles:
    """A figure on disk.

    Attributes
    ----------
    number, title, caption : str
        As in `asperity.thesis.figures.FIGURES`.
    picture, dataset : pathlib.Path
        PNG and netCDF.
    how : tuple of str
        Commands and functions that give its numbers.
    reused : bool
        Whether it was there from an earlier run.
    """

    number: str
    title: str
    caption: str
    picture: Path
    dataset: Path
    how: tuple[str, ...]
    reused: bool


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
    seconds : float
        Time it took, s.
    """

    index: Path
    claims: tuple[Entry, ...]
    figures: tuple[FigureFiles, ...]
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
            "seconds": self.seconds,
        }


def run(
    out: str | os.PathLike[str],
    only: Sequence[str] = (),
    progress: Callable[[str], None] | None = None,
) -> ThesisResult:
    """Reproduce the thesis's figures and claims into a folder.

    Each figure is written as soon as it is made; what an earlier run left there and is still true
    is used again.

    Parameters
    ----------
    out : path
        Folder for ``index.html``, the ledger and each figure's PNG and netCDF.
    only : sequence of str
        Numbers of figures to make, such as ``"4.17"``, and nothing else; all and the ledger if
        empty.
    progress : callable, optional
        Takes a line about each thing done.

    Raises
    ------
    InputError
        There is no figure of such a number.
    StorageError
        The folder cannot be written to.
    """
    began = time.perf_counter()
    say = progress or (lambda line: None)
    wanted = select(only)
    folder = output_folder(out)
    figures = tuple(_figure(folder, figure, say) for figure in wanted)
    claims = _ledger(folder, say, compute=not only)
    numbers = {figure.number for figure in figures}
    found = [_found(folder, figure) for figure in FIGURES.values() if figure.number not in numbers]
    shown = [*figures, *(figure for figure in found if figure is not None)]
    order = list(FIGURES)
    page = render(claims, sorted(shown, key=lambda figure: order.index(figure.number)), __version__)
    index = write_text(folder / "index.html", page)
    return ThesisResult(index, claims, figures, time.perf_counter() - began)


def _stamp(name: str, cases: Sequence[str]) -> str:
    """Hash of all that decides what comes out: the sources and the cases' values."""
    digest = hashlib.sha256(f"{source_hash()}\0{name}".encode())
    for case in cases:
        digest.update(b"\0" + read_case(case, TABLES).canonical().encode())
    return digest.hexdigest()


def _files(folder: Path, figure: FigureOf) -> tuple[Path, Path]:
    name = f"figure-{figure.number}"
    return folder / f"{name}.png", folder / f"{name}.nc"


def _found(folder: Path, figure: FigureOf) -> FigureFiles | None:
    """A figure an earlier run left, if it is whole and still true."""
    picture, dataset = _files(folder, figure)
    try:
        attributes = read_dataset(dataset).attrs
        digest = hashlib.sha256(picture.read_bytes()).hexdigest()
    except (StorageError, OSError):
        return None
    if attributes.get("stamp") != _stamp(figure.number, figure.cases):
        return None
    if attributes.get("picture_sha256") != digest:
        return None
    how = tuple(json.loads(attributes["how"]))
    return FigureFiles(figure.number, figure.title, figure.caption, picture, dataset, how, True)


def _figure(folder: Path, figure: FigureOf, say: Callable[[str], None]) -> FigureFiles:
    found = _found(folder, figure)
    if found is not None:
        say(f"figure {figure.number}: there already")
        return found
    began = time.perf_counter()
    picture, path = _files(folder, figure)
    drawn = figure.make()
    metadata = {"Software": f"asperity {__version__}", "Title": figure.title}
    write_atomically(
        picture,
        lambda target: drawn.figure.savefig(target, dpi=_DOTS_PER_INCH, metadata=metadata),
    )
    # The dataset comes last and vouches for the picture: an interrupted figure is made again.
    dataset = drawn.dataset.assign_attrs(
        title=figure.title,
        caption=figure.caption,
        how=json.dumps(list(drawn.how)),
        asperity=__version__,
        stamp=_stamp(figure.number, figure.cases),
        picture_sha256=hashlib.sha256(picture.read_bytes()).hexdigest(),
    )
    write_dataset(dataset, path)
    say(f"figure {figure.number}: made in {time.perf_counter() - began:.1f} s")
    return FigureFiles(
        figure.number, figure.title, figure.caption, picture, path, tuple(drawn.how), False
    )


def _ledger(folder: Path, say: Callable[[str], None], *, compute: bool) -> tuple[Entry, ...]:
    """The ledger an earlier run left as far as it is still true, completed if asked for."""
    path = folder / _LEDGER
    stamp = _stamp("ledger", CASES)
    entries: dict[str, Entry] = {}
    try:
        plain = json.loads(path.read_text("utf-8"))
        if plain["stamp"] == stamp:
            entries = {claim["id"]: Entry.from_json(claim) for claim in plain["claims"]}
    except (OSError, ValueError, KeyError, TypeError):
        entries = {}
    for claim in CLAIMS if compute else ():
        if claim.id in entries:
            say(f"claim {claim.id}: there already")
            continue
        began = time.perf_counter()
        entries[claim.id] = settle(claim)
        done = {"stamp": stamp, "claims": [entry.to_json() for entry in entries.values()]}
        write_text(path, json.dumps(done, indent=1, allow_nan=False))
        say(f"claim {claim.id}: {entries[claim.id].finding.verdict}, "
            f"{time.perf_counter() - began:.1f} s")  # fmt: skip
    return tuple(entries[claim.id] for claim in CLAIMS if claim.id in entries)

"""Figures and tables on disk: made, or found where an earlier run left them and still true."""

import dataclasses
import functools
import hashlib
import json
import time
from collections.abc import Callable, Sequence
from pathlib import Path

import asperity
from asperity import __version__
from asperity.casefile import read_case
from asperity.closure import package_hash
from asperity.errors import StorageError
from asperity.store import read_dataset, write_atomically, write_dataset, write_text
from asperity.thesis.exhibits import FigureOf, Grid, TableOf
from asperity.thesis.rating.gearsets import CASE_TABLES

Say = Callable[[str], None]

_PACKAGE = Path(asperity.__file__).parent
_DOTS_PER_INCH = 150


@dataclasses.dataclass(frozen=True)
class FigureFiles:
    """A figure on disk.

    Attributes
    ----------
    number, title, caption : str
        As in `asperity.thesis.contents.FIGURES`.
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
class TableFiles:
    """A table on disk.

    Attributes
    ----------
    number, title, caption : str
        As in `asperity.thesis.contents.TABLES`.
    path : pathlib.Path
        CSV.
    grid : Grid
        What is in it.
    reused : bool
        Whether it was there from an earlier run.
    """

    number: str
    title: str
    caption: str
    path: Path
    grid: Grid
    reused: bool


def stamp(name: str, cases: Sequence[str]) -> str:
    """Hash of all that decides what comes out: the sources, their data and the cases' values."""
    digest = hashlib.sha256(f"{package_hash()}\0{_data_hash()}\0{name}".encode())
    for case in cases:
        digest.update(b"\0" + read_case(case, CASE_TABLES).canonical().encode())
    return digest.hexdigest()


@functools.cache
def _data_hash() -> str:
    digest = hashlib.sha256()
    for path in sorted(_PACKAGE.rglob("data/*.toml")):
        digest.update(path.name.encode() + b"\0" + path.read_bytes())
    return digest.hexdigest()


def found_figure(folder: Path, figure: FigureOf, *, full: bool = False) -> FigureFiles | None:
    """Return a figure an earlier run left, if it is whole and still true.

    One that was made in full serves as well where that is not asked for.
    """
    picture, path = _figure_paths(folder, figure)
    try:
        attributes = read_dataset(path).attrs
        digest = _sha256(picture)
    except (StorageError, OSError):
        return None
    grades = {full, True} if figure.full else {False}
    if attributes.get("stamp") not in {_figure_stamp(figure, full=grade) for grade in grades}:
        return None
    if attributes.get("picture_sha256") != digest:
        return None
    how = tuple(json.loads(attributes["how"]))
    return FigureFiles(figure.number, figure.title, figure.caption, picture, path, how, True)


def make_figure(folder: Path, figure: FigureOf, say: Say, *, full: bool = False) -> FigureFiles:
    """Return a figure, drawn if it is not there; in full where there is more of it."""
    full = full and figure.full is not None
    found = found_figure(folder, figure, full=full)
    if found is not None:
        say(f"figure {figure.number}: there already")
        return found
    began = time.perf_counter()
    picture, path = _figure_paths(folder, figure)
    drawn = figure.full() if full and figure.full else figure.make()
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
        stamp=_figure_stamp(figure, full=full),
        picture_sha256=_sha256(picture),
    )
    write_dataset(dataset, path)
    say(f"figure {figure.number}: made in {time.perf_counter() - began:.1f} s")
    return FigureFiles(
        figure.number, figure.title, figure.caption, picture, path, tuple(drawn.how), False
    )


def found_table(folder: Path, table: TableOf) -> TableFiles | None:
    """Return a table an earlier run left, if it is whole and still true."""
    path, beside = _table_paths(folder, table)
    try:
        plain = json.loads(beside.read_text("utf-8"))
        if plain["stamp"] != stamp(f"table {table.number}", table.cases):
            return None
        if plain["csv_sha256"] != _sha256(path):
            return None
        grid = Grid.from_json(plain)
    except (OSError, ValueError, KeyError, TypeError):
        return None
    return TableFiles(table.number, table.title, table.caption, path, grid, True)


def make_table(folder: Path, table: TableOf, say: Say) -> TableFiles:
    """Return a table, calculated if it is not there."""
    found = found_table(folder, table)
    if found is not None:
        say(f"table {table.number}: there already")
        return found
    began = time.perf_counter()
    path, beside = _table_paths(folder, table)
    grid = table.make()
    write_text(path, grid.to_csv())
    # Last, as the dataset of a figure: it vouches for the CSV.
    plain = {
        "title": table.title,
        "caption": table.caption,
        **grid.to_json(),
        "asperity": __version__,
        "stamp": stamp(f"table {table.number}", table.cases),
        "csv_sha256": _sha256(path),
    }
    write_text(beside, json.dumps(plain, indent=1, allow_nan=False))
    say(f"table {table.number}: made in {time.perf_counter() - began:.1f} s")
    return TableFiles(table.number, table.title, table.caption, path, grid, False)


def _figure_stamp(figure: FigureOf, *, full: bool) -> str:
    return stamp(f"figure {figure.number}" + full * " in full", figure.cases)


def _sha256(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()


def _figure_paths(folder: Path, figure: FigureOf) -> tuple[Path, Path]:
    name = f"figure-{figure.number}"
    return folder / f"{name}.png", folder / f"{name}.nc"


def _table_paths(folder: Path, table: TableOf) -> tuple[Path, Path]:
    name = f"table-{table.number}"
    return folder / f"{name}.csv", folder / f"{name}.json"

"""Figures, tables and findings on disk: made, or found where an earlier run left them, still true.

What a run made stands in ``made.json``: under which key, of which files with which content. It is
written after them and vouches for them, so that an exhibit whose making was cut short, whose files
were harmed or whose sources have changed is made again.
"""

import dataclasses
import hashlib
import json
import time
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from asperity import __version__
from asperity.shipped import shipped_cases
from asperity.store import write_atomically, write_dataset, write_text
from asperity.thesis.exhibits import Exhibit, FigureOf, Grid, TableOf
from asperity.thesis.ledger import Claim, Entry

_MADE = "made.json"
_LEDGER = "claims.json"
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


Shown = FigureFiles | TableFiles | Entry


@dataclasses.dataclass(frozen=True)
class Made:
    """What making an exhibit gave.

    Attributes
    ----------
    name : str
        Its kind and number.
    key : str
        What it follows from.
    plain : dict
        What is not in its files, as plain values.
    files : mapping of str to str
        Its files and hashes of what is in them.
    seconds : float
        Time it took, s.
    """

    name: str
    key: str
    plain: dict[str, Any]
    files: Mapping[str, str] = dataclasses.field(default_factory=dict)
    seconds: float = 0.0


def key_of(exhibit: Exhibit, *, full: bool = False) -> str:
    """Return what an exhibit follows from: the sources of what makes it, and its cases."""
    from asperity.runs.key import code_key, key

    shipped = shipped_cases()
    cases = [shipped[case].read_bytes() for case in exhibit.cases]
    in_full = full and isinstance(exhibit, FigureOf) and exhibit.has_full
    return key(code_key(exhibit.module), exhibit.name + " in full" * in_full, *cases)


def make(exhibit: Exhibit, folder: Path, key: str, *, full: bool = False) -> Made:
    """Make an exhibit and write its files; they are found again under the key."""
    began = time.perf_counter()
    paths: Sequence[Path] = ()
    if isinstance(exhibit, FigureOf):
        plain, paths = _draw(exhibit, folder, full)
    elif isinstance(exhibit, TableOf):
        plain, paths = _calculate(exhibit, folder)
    elif isinstance(exhibit, Claim):
        plain = Entry.of(exhibit, exhibit.make()).to_json()
    else:
        raise TypeError(f"{exhibit.name} is neither a figure nor a table nor a claim")
    files = {path.name: _sha256(path) for path in paths}
    return Made(exhibit.name, key, plain, files, time.perf_counter() - began)


def _draw(figure: FigureOf, folder: Path, full: bool) -> tuple[dict[str, Any], list[Path]]:
    drawn = figure.make(full=full)
    picture, path = _paths(folder, figure, ".png", ".nc")
    metadata = {"Software": f"asperity {__version__}", "Title": figure.title}
    write_atomically(
        picture,
        lambda target: drawn.figure.savefig(target, dpi=_DOTS_PER_INCH, metadata=metadata),
    )
    labels = {"title": figure.title, "caption": figure.caption, "asperity": __version__}
    write_dataset(drawn.dataset.assign_attrs(**labels, how=json.dumps(list(drawn.how))), path)
    return {"how": list(drawn.how)}, [picture, path]


def _calculate(table: TableOf, folder: Path) -> tuple[dict[str, Any], list[Path]]:
    grid = table.make()
    path, beside = _paths(folder, table, ".csv", ".json")
    write_text(path, grid.to_csv())
    labels = {"title": table.title, "caption": table.caption, "asperity": __version__}
    write_text(beside, json.dumps({**labels, **grid.to_json()}, indent=1, allow_nan=False))
    return {}, [path, beside]


class Collection:
    """What is in a run's folder.

    Parameters
    ----------
    folder : pathlib.Path
        The folder.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self._made = {made.name: made for made in _read(folder)}

    def add(self, made: Made) -> None:
        """Take note of what was made, on disk too."""
        self._made[made.name] = made
        kept = [dataclasses.asdict(made) for made in self._made.values()]
        if made.name.startswith(Claim.kind):
            claims = [one["plain"] for one in kept if one["name"].startswith(Claim.kind)]
            write_text(self.folder / _LEDGER, _text({"claims": claims}))
        write_text(self.folder / _MADE, _text(kept))

    def find(self, exhibit: Exhibit, *, full: bool = False) -> Shown | None:
        """Return an exhibit an earlier run left, if it is whole and still true.

        A figure that was made in full serves as well where that is not asked for.
        """
        made = self._made.get(exhibit.name)
        if made is None or made.key not in {key_of(exhibit, full=grade) for grade in (full, True)}:
            return None
        return self.show(exhibit, made, reused=True)

    def show(self, exhibit: Exhibit, made: Made, *, reused: bool) -> Shown | None:
        """Return an exhibit as it stands on disk, None if its files are not what was written."""
        try:
            if any(_sha256(self.folder / name) != was for name, was in made.files.items()):
                return None
            if isinstance(exhibit, FigureOf):
                labels = exhibit.number, exhibit.title, exhibit.caption
                picture, path = _paths(self.folder, exhibit, ".png", ".nc")
                how = tuple(made.plain["how"])
                return FigureFiles(*labels, picture, path, how, reused)
            if isinstance(exhibit, TableOf):
                path, beside = _paths(self.folder, exhibit, ".csv", ".json")
                grid = Grid.from_json(json.loads(beside.read_text("utf-8")))
                labels = exhibit.number, exhibit.title, exhibit.caption
                return TableFiles(*labels, path, grid, reused)
            return Entry.from_json(made.plain)
        except (OSError, ValueError, KeyError, TypeError):
            return None


def _read(folder: Path) -> list[Made]:
    try:
        return [Made(**plain) for plain in json.loads((folder / _MADE).read_text("utf-8"))]
    except (OSError, ValueError, TypeError):
        return []


def _text(plain: object) -> str:
    return json.dumps(plain, indent=1, allow_nan=False)


def _sha256(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()


def _paths(folder: Path, exhibit: Exhibit, *suffixes: str) -> list[Path]:
    return [folder / f"{exhibit.name.replace(' ', '-')}{suffix}" for suffix in suffixes]

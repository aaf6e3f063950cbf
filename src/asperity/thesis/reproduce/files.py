"""Exhibits on disk: made, or found where an earlier run left them, still true.

What a run made stands in ``made.json``: under which key, of which files with which content. It is
written after them and vouches for them, so that an exhibit whose making was cut short, whose files
were harmed or whose sources have changed is made again.
"""

import dataclasses
import hashlib
import json
import re
import time
from collections.abc import Mapping
from pathlib import Path

from asperity.files.shipped import shipped_cases
from asperity.files.store import write_text
from asperity.thesis.exhibits import CLAIM, Exhibit
from asperity.thesis.products import Plain
from asperity.thesis.said import exhibit_entry

_MADE = "made.json"
_LEDGER = "claims.json"


@dataclasses.dataclass(frozen=True)
class MadeExhibit:
    """What making an exhibit gave."""

    name: str  # kind and number
    key: str  # what it follows from
    plain: Plain  # what is shown of it: words, numbers, and how they were come by
    files: Mapping[str, str] = dataclasses.field(default_factory=dict)  # hashes of their content
    seconds: float = 0.0


@dataclasses.dataclass(frozen=True)
class Shown:
    """An exhibit as it stands in a run's folder.

    Its words and numbers are plain JSON values; its files are known by their suffix: a figure's
    ``.png`` and ``.nc``, a table's ``.csv``.
    """

    exhibit: Exhibit
    plain: Plain
    files: Mapping[str, Path]
    reused: bool  # from an earlier run

    @property
    def number(self) -> str:
        """In the thesis."""
        return self.exhibit.number


def key_of(exhibit: Exhibit, *, full: bool = False) -> str:
    """Return what an exhibit follows from: the sources of what makes it, and its cases."""
    from asperity.runs.key import code_key, key

    shipped = shipped_cases()
    cases = [shipped[case].read_bytes() for case in exhibit.cases]
    in_full = full and exhibit.has_full
    name = exhibit.name + " in full" * in_full
    return key(code_key(exhibit.module), name, repr(exhibit_entry(exhibit.name)), *cases)


def make(exhibit: Exhibit, folder: Path, key: str, *, full: bool = False) -> MadeExhibit:
    """Make an exhibit and write its files; they are found again under the key."""
    began = time.perf_counter()
    words = exhibit.maker.words
    found, paths = exhibit.make(full=full).write(folder / exhibit.name.replace(" ", "-"), words)
    files = {path.name: _sha256(path) for path in paths}
    # As it will be read again.
    plain = json.loads(_text({**words, **found}))
    return MadeExhibit(exhibit.name, key, plain, files, time.perf_counter() - began)


class Collection:
    """What is in a run's folder."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self._made = {made.name: made for made in _read(folder)}

    def add(self, exhibit: MadeExhibit) -> None:
        """Take note of what was made, on disk too."""
        self._made[exhibit.name] = exhibit
        # They come as the processes have done with them.
        kept = [vars(self._made[name]) for name in sorted(self._made, key=_by_number)]
        if exhibit.name.startswith(CLAIM):
            claims = [one["plain"] for one in kept if one["name"].startswith(CLAIM)]
            write_text(self.folder / _LEDGER, _text({"claims": claims}))
        write_text(self.folder / _MADE, _text(kept))

    def find(self, exhibit: Exhibit, *, full: bool = False) -> Shown | None:
        """Return an exhibit an earlier run left, if it is whole and still true.

        A figure that was made in full serves as well where that is not asked for.
        """
        made = self._made.get(exhibit.name)
        grades = dict.fromkeys((full, True))
        if made is None or all(made.key != key_of(exhibit, full=grade) for grade in grades):
            return None
        return self.show(exhibit, made, reused=True)

    def show(self, exhibit: Exhibit, record: MadeExhibit, *, reused: bool) -> Shown | None:
        """Return an exhibit as it stands on disk, None if its files are not what was written."""
        paths = {Path(name).suffix: self.folder / name for name in record.files}
        try:
            if any(_sha256(self.folder / name) != was for name, was in record.files.items()):
                return None
        except OSError:
            return None
        return Shown(exhibit, record.plain, paths, reused)


def _by_number(name: str) -> list[str | int]:
    """Return what sorts names as the thesis numbers them: 4.9 before 4.10."""
    return [int(part) if part.isdigit() else part for part in re.split(r"(\d+)", name)]


def _read(folder: Path) -> list[MadeExhibit]:
    try:
        return [MadeExhibit(**plain) for plain in json.loads((folder / _MADE).read_text("utf-8"))]
    except (OSError, ValueError, TypeError):
        return []


def _text(plain: object) -> str:
    return json.dumps(plain, indent=1, allow_nan=False)


def _sha256(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()

"""The cases that can be opened, each with what kind it is and what it says of itself."""

import functools
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import NamedTuple

from asperity.errors import InputError, StorageError
from asperity.files import store
from asperity.files.shipped import SPEAKING, describe, shipped_case, shipped_cases

# What makes a case one of a kind, what asks for most first.
_KINDS = (("rig", "rig"), ("drive", "drive"), ("block", "block"), ("gearset", "gear"))


class OpenableCase(NamedTuple):
    """A case that can be opened.

    Attributes
    ----------
    name, alias : str
        What it is opened by; the alias is empty where there is none.
    kind : str
        As ``asperity new`` names kinds.
    title : str
        The comment in its first line.
    shipped : bool
        Whether it comes with the package.
    """

    name: str
    alias: str
    kind: str
    title: str
    shipped: bool


def openable_cases(files: Iterable[Path] = ()) -> Iterator[OpenableCase]:
    """Yield cases of one's own that can be read, and those that ship."""
    for path in files:
        if found := _looked_at(path):
            yield OpenableCase(path.name, "", *found, shipped=False)
    says = {name: alias for alias, name in SPEAKING.items()}
    for name, path in shipped_cases().items():
        if found := _looked_at(path):
            yield OpenableCase(name, says.get(name, ""), *found, shipped=True)


def kind_of(tables: Mapping[str, object]) -> str:
    """Return what kind of case has these tables."""
    return next((kind for table, kind in _KINDS if table in tables), "slide")


def opened(case: str, folder: Path | None) -> tuple[Path, str, str]:
    """Return the folder that a case is opened in, its name there, and its kind."""
    if not case:
        return store.output_folder(folder or Path()), "", "home"
    path = shipped_case(case)
    if path is not None and not Path(case).is_file():
        return store.output_folder(folder or Path()), case, kind_of(store.read_toml(path))
    path = Path(case)
    if folder is not None and path.resolve().parent != folder.resolve():
        raise InputError(f"{case} is not in {folder}; leave --folder out, or copy it there")
    return path.parent, path.name, kind_of(store.read_toml(path))


def _looked_at(path: Path) -> tuple[str, str] | None:
    """Return kind and title of a case, None for what is none."""
    try:
        return _read(path, store.stamp(path))
    except (InputError, StorageError, OSError):
        return None


@functools.lru_cache(maxsize=256)
def _read(path: Path, _stamp: tuple[int, ...]) -> tuple[str, str]:
    return kind_of(store.read_toml(path)), describe(path)

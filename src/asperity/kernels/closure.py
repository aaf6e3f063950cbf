"""What an answer follows from: a module's source and those of all modules it imports, as a hash.

Caches of kernels, condensed bodies, sweeps and exhibits name their entries by it, so that a change
reaches everything that follows from it and nothing else.
"""

import functools
import hashlib
import os
import re
from collections.abc import Iterable, Iterator
from pathlib import Path

_PACKAGE = Path(__file__).parents[1]

# Parsing whole files would cost every start of the program as much as it saves.
_IMPORT = re.compile(
    r"^(?P<indent>[ \t]*)(?:from[ \t]+(?P<module>[\w.]+)[ \t]+import[ \t]+"
    r"(?P<names>\([^)]*\)|[^\n#]+)|import[ \t]+(?P<modules>[\w., \t]+))",
    re.MULTILINE,
)
_FOR_TYPES_ONLY = re.compile(r"^if TYPE_CHECKING:\n(?:[ \t]+.*\n|\n)+", re.MULTILINE)


class Sources:
    """The package's sources as they are when they are first looked at: each found and read once.

    What asks for the keys of many modules asks for the same files as often as there are modules.
    """

    def __init__(self) -> None:
        self._files: dict[str, str | None] = {}
        self._imports: dict[tuple[str, bool], tuple[str, ...]] = {}
        self._tables: dict[str, list[str]] = {}
        self._contents: dict[str, bytes] = {}

    def file(self, name: str, roots: dict[str, str]) -> str | None:
        """Return the file of a module, or of the one that a name is taken from."""
        if name.partition(".")[0] != "asperity":
            return _file(name, roots)
        if name not in self._files:
            self._files[name] = _file(name, roots)
        return self._files[name]

    def imports(self, path: str, lazy: bool) -> tuple[str, ...]:
        """Return the full names that a source imports."""
        if (path, lazy) not in self._imports:
            self._imports[path, lazy] = _imports(path, lazy)
        return self._imports[path, lazy]

    def tables(self, folder: str) -> list[str]:
        """Return the files in the folder ``data`` of a folder."""
        if folder not in self._tables:
            inside = Path(folder, "data").rglob("*")
            self._tables[folder] = [str(path) for path in inside if path.is_file()]
        return self._tables[folder]

    def content(self, path: str) -> bytes:
        """Return what a file holds."""
        if path not in self._contents:
            self._contents[path] = Path(path).read_bytes()
        return self._contents[path]


def closure(
    module: str,
    *,
    lazy: bool = False,
    file: Path | None = None,
    sources: Sources | None = None,
) -> tuple[Path, ...]:
    """Return the files behind a module: its source and those of what it imports, in turn.

    Only modules of this package and of the module's own are followed; what is imported for types
    alone is not.

    Parameters
    ----------
    module : str
        Full name of a module or package.
    lazy : bool
        Follow imports inside functions as well, which a compiled function cannot have, and add
        the tables in the folders ``data`` that stand beside a source.
    file : path, optional
        The module's file, needed where the module is not one of this package.
    sources : Sources, optional
        Where files are looked for; left out, as they are now.
    """
    return tuple(map(Path, _closure(module, lazy, file, sources or Sources())))


def _closure(module: str, lazy: bool, file: Path | None, sources: Sources) -> list[str]:
    roots = {"asperity": os.fspath(_PACKAGE)}
    top, *inner = module.split(".")
    at = sources.file(module, roots) if file is None else os.fspath(file)
    if at is None:
        raise LookupError(f"{module} is not a module of asperity")
    if file is not None and top not in roots and inner:
        depth = len(inner) - (file.name != "__init__.py")
        roots[top] = os.fspath(file.parents[depth])
    # Texts: a run of the thesis asks tens of thousands of times; paths take twice as long.
    known: set[str] = set()
    names: set[str] = set()
    waiting = [at]
    while waiting:
        path = waiting.pop()
        if path not in known:
            known.add(path)
            new = [name for name in sources.imports(path, lazy) if name not in names]
            names.update(new)
            waiting += [place for name in new if (place := sources.file(name, roots)) is not None]
    if lazy:
        for folder in {os.path.dirname(path) for path in known}:
            known.update(sources.tables(folder))
    return sorted(known, key=_as_path)


def source_key(*modules: str, lazy: bool = True, sources: Sources | None = None) -> str:
    """Return a hash of the sources behind modules of this package, the same on every machine.

    Parameters
    ----------
    *modules : str
        Full names of modules or packages.
    lazy : bool
        Follow imports inside functions as well.
    sources : Sources, optional
        Where files are looked for; left out, as they are now.
    """
    sources = sources or Sources()
    files = {path for module in modules for path in _closure(module, lazy, None, sources)}
    return _digest_of(files, _PACKAGE.parent, sources)


def digest_of(files: Iterable[Path], root: Path = _PACKAGE.parent) -> str:
    """Return a hash of files' names, as seen from a folder, and contents."""
    return _digest_of(map(os.fspath, files), root, Sources())


def _digest_of(files: Iterable[str], root: Path, sources: Sources) -> str:
    digest = hashlib.sha256()
    inside = f"{os.fspath(root).rstrip(os.sep)}{os.sep}"
    for path in sorted(files, key=_as_path):
        name = path.removeprefix(inside) if path.startswith(inside) else os.path.basename(path)
        content = sources.content(path)
        digest.update(f"{name.replace(os.sep, '/')}\0{len(content)}\0".encode())
        digest.update(content)
    return digest.hexdigest()[:16]


def _as_path(path: str) -> list[str]:
    """Return what sorts texts as paths are sorted, at a tenth of the time."""
    return path.split(os.sep)


def _imports(path: str, lazy: bool) -> tuple[str, ...]:
    status = os.stat(path)
    return _imports_of(path, status.st_mtime_ns, status.st_size, lazy)


@functools.cache
def _imports_of(path: str, _changed: int, _size: int, lazy: bool) -> tuple[str, ...]:
    text = _FOR_TYPES_ONLY.sub("", Path(path).read_text(encoding="utf-8"))
    return tuple(dict.fromkeys(_named(text, lazy)))


def _named(text: str, lazy: bool) -> Iterator[str]:
    for found in _IMPORT.finditer(text):
        if found["indent"] and not lazy:
            continue
        if found["modules"]:
            for entry in found["modules"].split(","):
                yield entry.split()[0]
            continue
        for entry in re.sub(r"#.*", "", found["names"].strip("()")).split(","):
            # A name may be a module of its own or stand in the one it is taken from.
            if entry.strip():
                yield f"{found['module']}.{entry.split()[0]}"


def _file(name: str, roots: dict[str, str]) -> str | None:
    top, *inner = name.split(".")
    if top not in roots:
        return None
    parts = [roots[top], *inner]
    while parts:
        place = os.sep.join(parts)
        for candidate in (f"{place}.py", f"{place}{os.sep}__init__.py"):
            if os.path.isfile(candidate):
                return candidate
        parts.pop()
    return None

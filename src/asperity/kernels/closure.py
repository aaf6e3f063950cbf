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


def closure(module: str, *, lazy: bool = False, file: Path | None = None) -> tuple[Path, ...]:
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
    """
    roots = {"asperity": os.fspath(_PACKAGE)}
    top, *inner = module.split(".")
    at = _file(module, roots) if file is None else os.fspath(file)
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
            new = [name for name in _imports(path, lazy) if name not in names]
            names.update(new)
            waiting += [place for name in new if (place := _file(name, roots)) is not None]
    found = {Path(path) for path in known}
    if lazy:
        folders = {path.parent / "data" for path in found}
        found |= {path for folder in folders for path in folder.rglob("*") if path.is_file()}
    return tuple(sorted(found))


def source_key(*modules: str, lazy: bool = True) -> str:
    """Return a hash of the sources behind modules of this package, the same on every machine.

    Parameters
    ----------
    *modules : str
        Full names of modules or packages.
    lazy : bool
        Follow imports inside functions as well.
    """
    files = {path for module in modules for path in closure(module, lazy=lazy)}
    return digest_of(files)


def digest_of(files: Iterable[Path], root: Path = _PACKAGE.parent) -> str:
    """Return a hash of files' names, as seen from a folder, and contents."""
    digest = hashlib.sha256()
    inside = f"{root.as_posix().rstrip('/')}/"
    for path in sorted(files):
        text = path.as_posix()
        name = text.removeprefix(inside) if text.startswith(inside) else path.name
        content = path.read_bytes()
        digest.update(f"{name}\0{len(content)}\0".encode() + content)
    return digest.hexdigest()[:16]


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

"""What the machine code of an entry follows from, and the name it is kept under for that."""

import contextlib
import functools
import hashlib
import importlib.metadata
import json
from collections.abc import Iterable
from pathlib import Path

from asperity.kernels.closure import closure, digest_of, source_key
from asperity.kernels.native.entries import Entry
from asperity.kernels.native.target import platform_name

_ROOT = Path(__file__).parents[3]


@functools.cache
def versions() -> dict[str, str]:
    """Return the versions of what makes machine code."""
    return {name: importlib.metadata.version(name) for name in ("numba", "llvmlite", "numpy")}


@functools.cache
def sources(module: str) -> tuple[str, ...]:
    """Return the files that a module's kernels follow from, from the folder of the package on."""
    return tuple(path.relative_to(_ROOT).as_posix() for path in _files(module))


@functools.cache
def _files(module: str) -> tuple[Path, ...]:
    return closure(module)


@functools.cache
def closure_digest(module: str) -> str:
    """Return the digest of the sources that a module's kernels follow from."""
    return digest_of(_files(module))


def stands(module: str) -> bool:
    """Return whether the sources of a module's kernels are still those of `closure_digest`."""
    return digest_of(_files(module)) == closure_digest(module)


def digests(names: Iterable[str]) -> dict[str, str]:
    """Return the digest of each file, by its name from the folder of the package on."""
    return {name: hashlib.sha256((_ROOT / name).read_bytes()).hexdigest() for name in names}


@functools.cache
def _maker() -> str:
    """What all machine code follows from beside the kernels."""
    own = source_key("asperity.kernels.building.lean", "asperity.kernels.native.gather", lazy=False)
    made_with = versions()
    # NumPy is not in the machine code, nor does it make any.
    parts = (own, made_with["numba"], made_with["llvmlite"], platform_name())
    return "\0".join(parts)


def key(entry: Entry) -> str:
    """Return the name that an entry is kept under: 32 hexadecimal digits."""
    told = json.dumps([entry.arguments, entry.target])
    parts = (_maker(), closure_digest(entry.module), entry.name, told)
    return hashlib.sha256("\0".join(parts).encode()).hexdigest()[:32]


def keyed(entries: Iterable[Entry]) -> dict[str, Entry]:
    """Return entries by their keys, but for those whose sources cannot be read."""
    found = {}
    for entry in entries:
        with contextlib.suppress(OSError):
            found[key(entry)] = entry
    return found

"""Condensed bodies on disk, under the hash of everything they follow from."""

import contextlib
import dataclasses
import functools
import hashlib
import json
import time
import zipfile
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from asperity import folders, store
from asperity.closure import source_key
from asperity.contact.elastic.condensed import CondensedBody
from asperity.errors import StorageError

_KEPT_DAYS = 30
_PLAIN = "plain"


@functools.cache
def _version() -> str:
    return source_key("asperity.contact.elastic")


def key(*parts: NDArray[np.generic] | str) -> str:
    """Return a name made from the content of arrays and texts, and from this room's sources."""
    digest = hashlib.sha256(_version().encode())
    for part in parts:
        content = part.encode() if isinstance(part, str) else np.ascontiguousarray(part).tobytes()
        shape = "" if isinstance(part, str) else f"{part.dtype.str}{part.shape}"
        digest.update(f"{shape}\0{len(content)}\0".encode() + content)
    return digest.hexdigest()[:32]


def folder() -> Path | None:
    """Return the folder condensed bodies are kept in, None where none can be written to."""
    return folders.cache_folder("condensed")


def save(place: Path, name: str, body: CondensedBody) -> None:
    """Keep a body; trouble with the disk costs the copy and nothing else."""
    fields = {field.name: getattr(body, field.name) for field in dataclasses.fields(body)}
    plain = {label: fields.pop(label) for label, value in [*fields.items()] if _is_plain(value)}
    arrays: dict[str, Any] = {**fields, _PLAIN: json.dumps(plain)}
    with contextlib.suppress(StorageError, OSError):
        # Not compressed: it would cost more time than reading.
        store.write_atomically(place / f"{name}.npz", lambda path: np.savez(path, **arrays))
        _remove_old(place)


def _is_plain(value: object) -> bool:
    return not isinstance(value, np.ndarray)


def load(place: Path, name: str) -> CondensedBody | None:
    """Return a body kept before, None if there is none or it is damaged."""
    path = place / f"{name}.npz"
    try:
        # Opened here, since NumPy leaves a file open that it cannot read.
        with path.open("rb") as opened, np.load(opened, allow_pickle=False) as file:
            fields = {label: file[label] for label in file.files}
        plain = json.loads(str(fields.pop(_PLAIN)))
        plain |= {"load_names": tuple(plain["load_names"]), "from_cache": True}
        path.touch()
        return CondensedBody(**fields, **plain)
    except (OSError, EOFError, ValueError, KeyError, TypeError, zipfile.BadZipFile):
        return None


def _remove_old(place: Path) -> None:
    oldest = time.time() - _KEPT_DAYS * 86400
    for path in place.glob("*.npz"):
        if path.stat().st_mtime < oldest:
            path.unlink(missing_ok=True)

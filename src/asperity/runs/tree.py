"""Trees of arrays: what a run keeps on disk, and dataclasses as such trees.

A tree is a mapping of names to arrays, numbers, texts, truths, None, lists and trees.
"""

import dataclasses
import errno
import json
import os
import types
import typing
from collections.abc import Mapping
from pathlib import Path
from typing import Any, TypeVar

import numpy as np

from asperity.errors import StorageError
from asperity.files.store import write_atomically

Tree = dict[str, Any]
T = TypeVar("T")

_PLAN = "plan"
_ARRAY = "array"


class DamagedError(StorageError):
    """A file of a tree is not what was written."""


def write_tree(path: str | os.PathLike[str], tree: Mapping[str, Any]) -> Path:
    """Write a tree, whole or not at all.

    Raises
    ------
    StorageError
        The file cannot be written.
    """
    arrays: list[np.ndarray] = []
    plan = json.dumps(_planned(tree, arrays))
    named = {f"{_ARRAY}{number}": array for number, array in enumerate(arrays)}
    # Not compressed: it would cost more time than reading. The archive has its checksums.
    return write_atomically(path, lambda target: _save(target, {_PLAN: plan, **named}))


def _save(target: Path, arrays: Mapping[str, Any]) -> None:
    with target.open("wb") as file:  # given a name, NumPy adds its own suffix
        np.savez(file, **arrays)


def read_tree(path: str | os.PathLike[str]) -> Tree:
    """Read a tree back.

    Raises
    ------
    OSError
        There is no such file, or it cannot be opened.
    DamagedError
        It is not what was written.
    """
    # Opened here, since NumPy leaves a file open that it cannot read; and a file that cannot be
    # opened is not a damaged one.
    with Path(path).open("rb") as opened:
        whole = False
        try:
            with np.load(opened, allow_pickle=False) as file:
                # An array's header may ask for less than there is, whose checksum is not seen then.
                if file.zip.testzip() is not None:
                    raise ValueError("a checksum is wrong")
                whole = True
                arrays = {name: file[name] for name in file.files}
            tree: Tree = _restored(json.loads(str(arrays.pop(_PLAN))), arrays)
        except Exception as error:
            if whole and isinstance(error, MemoryError):
                raise
            if isinstance(error, OSError) and error.errno == errno.EIO:
                raise
            # What a damaged file raises depends on the byte.
            raise DamagedError(f"{path} is damaged, or nothing of ours") from None
    return tree


def _planned(value: Any, arrays: list[np.ndarray]) -> Any:
    if isinstance(value, np.ndarray):
        arrays.append(value)
        return {_ARRAY: len(arrays) - 1}
    if isinstance(value, np.generic):
        return value.item()
    if isinstance(value, Mapping):
        return {"tree": {name: _planned(entry, arrays) for name, entry in value.items()}}
    if isinstance(value, list | tuple):
        return [_planned(entry, arrays) for entry in value]
    if value is None or isinstance(value, str | int | float):
        return value
    raise TypeError(f"{type(value).__name__} is not part of a tree")


def _restored(plan: Any, arrays: Mapping[str, np.ndarray]) -> Any:
    if isinstance(plan, list):
        return [_restored(entry, arrays) for entry in plan]
    if isinstance(plan, dict):
        if _ARRAY in plan:
            return arrays[f"{_ARRAY}{plan[_ARRAY]}"]
        return {name: _restored(entry, arrays) for name, entry in plan["tree"].items()}
    return plan


def to_tree(value: Any) -> Any:
    """Return a dataclass, and those within it, as a tree."""
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        fields = dataclasses.fields(value)
        return {field.name: to_tree(getattr(value, field.name)) for field in fields}
    if isinstance(value, Mapping):
        return {name: to_tree(entry) for name, entry in value.items()}
    if isinstance(value, list | tuple):
        return [to_tree(entry) for entry in value]
    return value


def from_tree(of: type[T], tree: Any) -> T:
    """Return the dataclass that a tree was made from, by the annotations of its fields."""
    restored: T = _typed(of, tree)
    return restored


def _typed(of: Any, tree: Any) -> Any:
    origin, inner = typing.get_origin(of), typing.get_args(of)
    if origin in (typing.Union, types.UnionType):
        if tree is None:
            return None
        return _typed(next(kind for kind in inner if kind is not types.NoneType), tree)
    if dataclasses.is_dataclass(of):
        hints = typing.get_type_hints(of)
        fields = {field.name for field in dataclasses.fields(of)}
        made: Any = of
        return made(**{name: _typed(hints[name], tree[name]) for name in fields})
    if hasattr(of, "_fields"):
        hints = typing.get_type_hints(of)
        return of(
            *(_typed(hints[name], entry) for name, entry in zip(of._fields, tree, strict=True))
        )
    if origin is tuple:
        kinds = [inner[0]] * len(tree) if inner[-1] is Ellipsis else inner
        return tuple(_typed(kind, entry) for kind, entry in zip(kinds, tree, strict=True))
    if origin is list:
        return [_typed(inner[0], entry) for entry in tree]
    if origin is dict:
        return {name: _typed(inner[1], entry) for name, entry in tree.items()}
    return tree

"""What the arguments of one signature must be, as rows of words that machine code goes through."""

import ctypes
import importlib
from typing import Any

from asperity.kernels.native import layout
from asperity.kernels.native.dtypes import described

Spec = list[Any]

_KINDS = {"0": layout.NONE, "d": layout.FLOAT, "q": layout.INT, "b": layout.BOOL}
_CONTIGUOUS = {"C": layout.C, "F": layout.F, "A": 0}
_PLAIN = "fiu"


class UnknownTypeError(ValueError):
    """A table names a type of argument that is not called from here."""


class Plan:
    """The rows for one signature, and the memory they name.

    Parameters
    ----------
    specs : list
        What each argument must be.
    back : int
        Number of words that come back, which stand before the arguments' in a room.

    Attributes
    ----------
    words : int
        Number of words of the arguments.
    room : int
        Number of words that a call needs in all.
    """

    def __init__(self, specs: list[Spec], back: int) -> None:
        self._rows: list[list[int]] = []
        self._paths: list[tuple[int, ...]] = []
        self._known: dict[int, tuple[Any, list[Any], Any]] = {}
        self._tuples = 1
        self.words = 0
        given = [spec for spec in specs if spec[0] != "O"]
        if specs[: len(given)] != given:
            raise UnknownTypeError("an argument left out before one that is given")
        for index, spec in enumerate(given):
            self._add(spec, 0, (index,))
        types = layout.types()
        start, scratch = 1 + back, 1 + back + self.words
        self.room = scratch + self._tuples
        self._types = types
        head = [ctypes.addressof(types), len(self._rows), 8 * start, 8 * scratch, len(given)]
        words = [*head, *(word for row in self._rows for word in row)]
        self._memory = (ctypes.c_int64 * len(words))(*words)
        self.address = ctypes.addressof(self._memory)

    def _add(self, spec: Spec, within: int, path: tuple[int, ...]) -> None:
        kind = spec[0]
        row = [_KINDS.get(kind, 0), 8 * within, 8 * path[-1], 0, 0, 0, 0, 0]
        self._rows.append(row)
        self._paths.append(path)
        if kind in _KINDS:
            self.words += 1
        elif kind == "A":
            _, dtype, ndim, order, is_writable, is_aligned = spec
            # Numba says so of all records that are packed; their numbers stand where they stand.
            if not is_aligned and isinstance(dtype, str):
                raise UnknownTypeError("arrays out of line")
            mask = layout.C | layout.F | layout.ALIGNED | layout.WRITEABLE
            flags = _CONTIGUOUS[order] | layout.ALIGNED | (layout.WRITEABLE if is_writable else 0)
            if order == "C":
                # One axis has both orders, which Numba calls this one.
                mask &= ~layout.F
            row[0] = layout.ARRAY
            row[4:] = ndim, mask, flags, self._knows(dtype)
            self.words += 5 + 2 * ndim
        elif kind == "R":
            row[0] = layout.RECORD
            row[7] = self._knows(spec[1])
            self.words += 1
        elif kind in ("T", "N"):
            tuple_type = tuple if kind == "T" else named(spec)
            own, self._tuples = self._tuples, self._tuples + 1
            row[0] = layout.TUPLE
            row[3:6] = 8 * own, id(tuple_type), len(spec[-1])
            for index, inner in enumerate(spec[-1]):
                self._add(inner, own, (*path, index))
        else:
            raise UnknownTypeError(f"an argument {kind!r}")

    def _knows(self, dtype: Any) -> int:
        """Return the address of the words that tell a data type."""
        from asperity.kernels.native.dtypes import read

        mark, own = 0, read(dtype)
        if isinstance(dtype, str) and own.kind in _PLAIN and own.isnative:
            (mark,) = layout.read(own, layout.DTYPE_KIND)
        words = (ctypes.c_int64 * (2 + layout.KNOWN))(mark, own.itemsize)
        self._known[len(self._rows) - 1] = words, [], dtype
        return ctypes.addressof(words)

    def learn(self, row: int, arguments: tuple[Any, ...]) -> bool:
        """Look at a data type not met before; return whether it is the one of the signature.

        Parameters
        ----------
        row : int
            Number of its row, from one.
        arguments : tuple
            What the kernel is called with.
        """
        words, kept, expected = self._known[row - 1]
        thing: Any = arguments
        for index in self._paths[row - 1]:
            thing = thing[index]
        if described(thing.dtype) != expected:
            return False
        # Kept alive, so that no other gets its address.
        if len(kept) == layout.KNOWN:
            kept.pop(0)
        kept.append(thing.dtype)
        words[2 : 2 + len(kept)] = [id(each) for each in kept]
        return True


def named(spec: Spec) -> type:
    """Return the class of a named tuple."""
    _, module, name, members = spec
    found: Any = importlib.import_module(module)
    for part in name.split("."):
        found = getattr(found, part)
    if not (isinstance(found, type) and issubclass(found, tuple)):
        raise UnknownTypeError(f"{module}.{name} is no named tuple")
    if len(getattr(found, "_fields", ())) != len(members):
        raise UnknownTypeError(f"{module}.{name} has other fields")
    return found

"""What a kernel's machine code gives back, made into Python's values."""

import struct
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from asperity.kernels.native.plan import Spec, UnknownTypeError, named

# Words of a returned value and the arguments of the call -> a Python value.
Maker = Callable[[tuple[Any, ...], tuple[Any, ...]], Any]
Release = Callable[[int], object]

_FORMATS = {"d": "d", "q": "q", "b": "?7x", "0": "q"}


def words_of(spec: Spec) -> int:
    """Return the number of words of a returned value."""
    return struct.calcsize(_format(spec)) // 8


def reader(spec: Spec, release: Release) -> Callable[[Any, tuple[Any, ...]], Any]:
    """Return the function that makes a Python value of a room, given the arguments of the call.

    Parameters
    ----------
    spec : list
        What comes back.
    release : callable
        Gives an array's memory back, by the address of its count of references.
    """
    unpack = struct.Struct("<8x" + _format(spec)).unpack_from
    if spec[0] == "0":
        return lambda room, arguments: None
    if spec[0] in "dqb":
        return lambda room, arguments: unpack(room)[0]
    if spec[0] == "T" and all(member[0] in "dqb" for member in spec[-1]):
        return lambda room, arguments: unpack(room)
    make, _ = _maker(spec, 0, release)
    return lambda room, arguments: make(unpack(room), arguments)


def _format(spec: Spec) -> str:
    kind = spec[0]
    if kind == "A":
        return f"{5 + 2 * spec[2]}q"
    if kind in ("T", "N"):
        return "".join(_format(member) for member in spec[-1])
    if kind not in _FORMATS:
        raise UnknownTypeError(f"a returned {kind!r}")
    return _FORMATS[kind]


def _maker(spec: Spec, start: int, release: Release) -> tuple[Maker, int]:
    """Return what makes a value of the words from a place on, and the place behind them."""
    kind = spec[0]
    if kind == "A":
        return _array_maker(spec, start, release), start + 5 + 2 * spec[2]
    if kind in ("T", "N"):
        makers = []
        for member in spec[-1]:
            maker, start = _maker(member, start, release)
            makers.append(maker)
        together: Callable[..., Any] = tuple
        if kind == "N":
            together = named(spec)._make  # type: ignore[attr-defined]

        def make(words: tuple[Any, ...], arguments: tuple[Any, ...]) -> Any:
            return together([each(words, arguments) for each in makers])

        return make, start
    if kind == "0":
        return (lambda words, arguments: None), start + 1
    return (lambda words, arguments: words[start]), start + 1


def _array_maker(spec: Spec, start: int, release: Release) -> Maker:
    _, dtype, ndim, _, is_writable, _ = spec
    if not isinstance(dtype, str):
        raise UnknownTypeError("a returned array of records")
    shape_at, strides_at = start + 5, start + 5 + ndim

    def make(words: tuple[Any, ...], arguments: tuple[Any, ...]) -> Any:
        meminfo, data = words[start], words[start + 4]
        shape, strides = words[shape_at:strides_at], words[strides_at : strides_at + ndim]
        interface = {
            "version": 3,
            "typestr": dtype,
            "shape": shape,
            "strides": strides,
            "data": (data, not is_writable),
        }
        if meminfo:
            return np.asarray(_Allocated(interface, meminfo, release))
        for each in _arrays(arguments):
            if _holds(each, data, shape, strides):
                if each.__array_interface__["data"][0] == data and _is(each, dtype, shape, strides):
                    return each
                return np.asarray(_View(interface, each))
        return np.asarray(_View(interface, None)).copy(order="K")

    return make


class _View:
    """Memory of an argument that came back, which must live as long as who looks at it."""

    def __init__(self, interface: dict[str, Any], owner: Any) -> None:
        self.__array_interface__ = interface
        self.owner = owner


class _Allocated:
    """Memory that a kernel allocated, which goes with the last array over it."""

    def __init__(self, interface: dict[str, Any], meminfo: int, release: Release) -> None:
        self.__array_interface__ = interface
        self._meminfo = meminfo
        self._release = release

    def __del__(self) -> None:
        self._release(self._meminfo)


def _arrays(arguments: tuple[Any, ...]) -> Iterator[Any]:
    for each in arguments:
        if isinstance(each, tuple):
            yield from _arrays(each)
        elif isinstance(each, np.ndarray | np.void):
            yield each


def _holds(thing: Any, data: int, shape: tuple[int, ...], strides: tuple[int, ...]) -> bool:
    if isinstance(thing, np.void):
        low = thing.__array_interface__["data"][0]
        return bool(low <= data < low + thing.nbytes)
    low, high = np.lib.array_utils.byte_bounds(thing)
    return bool(low <= data < high or data == low == high)


def _is(thing: Any, dtype: str, shape: tuple[int, ...], strides: tuple[int, ...]) -> bool:
    same = isinstance(thing, np.ndarray) and thing.dtype == np.dtype(dtype)
    return same and (thing.shape, thing.strides) == (shape, strides)

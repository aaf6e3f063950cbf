"""Calls of kernels as a command makes them, and others like them."""

import contextlib
import copy
from collections import defaultdict

import numpy as np

from asperity.kernels.compiled import _Lazy
from asperity.kernels.native import kept, load
from asperity.kernels.native.target import FEATURES
from asperity.kernels.native.types import UnlistedTypeError, types_of

# How far a number is moved, of itself.
SHARE = 1e-3

LINE = 64  # bytes


@contextlib.contextmanager
def recorded(most=20, of=lambda kernel, arguments: id(kernel)):
    """Give lists of (kernel, arguments as they were before the call), some of what they are of.

    That is each kernel; what calls are of otherwise, or None of those that are left out, is given.
    """
    calls, before = defaultdict(list), _Lazy.__call__

    def call(self, *arguments):
        which = of(self, arguments)
        if which is not None and len(calls[which]) < most:
            calls[which].append((self, copied(arguments)))
        return before(self, *arguments)

    _Lazy.__call__ = call
    try:
        yield calls
    finally:
        _Lazy.__call__ = before


@contextlib.contextmanager
def left_to_numba():
    """Give a list of kernels with the types of calls that Numba answers, though a library could."""
    found, before = [], _Lazy.__call__
    is_on = load._is_wanted() and load.is_for_here(kept._MADE_HERE, FEATURES)

    def call(self, *arguments):
        answer = self._native(arguments)
        if answer is not NotImplemented:
            return answer
        try:
            called = f"{self.__module__}.{self.__qualname__}", types_of(arguments)
        except UnlistedTypeError as unlisted:
            called = f"{self.__module__}.{self.__qualname__}", str(unlisted)
        if called not in found:
            found.append(called)
        return self._dispatcher(*arguments)

    if is_on:
        _Lazy.__call__ = call
    try:
        yield found
    finally:
        _Lazy.__call__ = before


def copied(value):
    """Return a value with arrays and records of its own, of the same types.

    Arrays begin where theirs do in a line of the processor's cache, by which vector instructions
    are faster or slower.
    """
    return _each(value, lambda numbers: numbers)


def moved(value, rng):
    """Return a value whose floats are a little others: what it is called with stays sensible."""
    return _each(value, lambda numbers: numbers * (1.0 + SHARE * rng.uniform(-1.0, 1.0)))


def _each(value, change):
    if isinstance(value, tuple):
        members = [_each(member, change) for member in value]
        return type(value)._make(members) if hasattr(value, "_make") else tuple(members)
    if isinstance(value, np.ndarray):
        other = _placed(value)
        _change(other, change)
        other.flags.writeable = value.flags.writeable
        return other
    if isinstance(value, np.void):
        other = np.array([value], value.dtype)
        _change(other, change)
        return other[0]
    return type(value)(change(value)) if isinstance(value, float) else copy.copy(value)


def _placed(numbers):
    compact = numbers.copy(order="K")
    room = np.empty(compact.nbytes + LINE, np.uint8)
    first = (address(numbers) - address(room)) % LINE
    other = np.ndarray(compact.shape, compact.dtype, room, first, compact.strides)
    other[...] = compact
    return other


def address(numbers):
    """Return where the first of an array's numbers stands."""
    return numbers.__array_interface__["data"][0]


def _change(numbers, change):
    if numbers.dtype.names:
        for name in numbers.dtype.names:
            _change(numbers[name], change)
    elif numbers.dtype.kind == "f":
        # What is to be filled may hold anything.
        with np.errstate(all="ignore"):
            numbers[...] = change(numbers)


def words(value):
    """Return a value's bits, so that two are the same where their words are."""
    if isinstance(value, tuple):
        return type(value).__name__, *map(words, value)
    if isinstance(value, np.ndarray):
        return str(value.dtype), value.shape, value.strides, _bits(value)
    if isinstance(value, np.void):
        return str(value.dtype), _bits(np.array([value], value.dtype))
    if isinstance(value, float):
        return type(value).__name__, np.float64(value).tobytes()
    return type(value).__name__, value


def _bits(numbers):
    """Return the bits of numbers; what lies between the fields of a record is nobody's."""
    names = numbers.dtype.names
    return tuple(_bits(numbers[name]) for name in names) if names else numbers.tobytes()

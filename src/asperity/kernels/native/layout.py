"""Where CPython and NumPy hold a value, and whether they do so here.

The places have been the same for many versions, but for two of CPython's that are found by looking.
A Python that holds anything elsewhere (one without the interpreter's lock, say) gets no library.
"""

import ctypes
import functools
import platform
import struct
import sys
from typing import Any

import numpy as np

# Bytes from an object's address.
TYPE = 8
SIZE = 16
SCALAR = 16
DIGITS = 24
ARRAY_DATA, ARRAY_NDIM, ARRAY_SHAPE, ARRAY_STRIDES = 16, 24, 32, 40
ARRAY_DTYPE, ARRAY_FLAGS = 56, 64
RECORD_DATA, RECORD_DTYPE = 24, 32
DTYPE_KIND = 24

# Bits of an array's flags.
C, F, ALIGNED, WRITEABLE = 0x1, 0x2, 0x100, 0x400

# A plan: address of `types`, number of rows, bytes of the room before the first word of the
# arguments and before the tuples' addresses, number of arguments; then rows of eight words: kind,
# bytes to the tuple the object stands in and within it, bytes to the own place of a tuple, and four
# that depend on the kind.
TYPES, ROWS, ROW = 0, 1, 8
NONE, FLOAT, INT, BOOL, ARRAY, RECORD, TUPLE = range(7)

# `types`: what objects are compared with.
ITEMS, SIGN_IN_TAG, INT_TYPE, INT64_TYPE, ARRAY_TYPE, VOID_TYPE, NONE_AT = range(7)
FLOAT_TYPES, TRUES, FALSES = (7, 8), (9, 10), (11, 12)

# Data types known by their address, behind a plain number's mark and the size of an item.
KNOWN = 4


@functools.cache
def types() -> Any:
    """Return addresses and places that all plans share, or None where they are not as expected."""
    items = tuple.__basicsize__
    found = platform.python_implementation() == "CPython" and sys.byteorder == "little"
    if not (found and _sizes() and _scalars() and _array() and _record() and _tuple(items)):
        return None
    in_tag = _sign_in_tag()
    if in_tag is None:
        return None
    objects = (int, np.int64, np.ndarray, np.void, None, float, np.float64)
    truths = (True, np.True_, False, np.False_)
    addresses = [id(each) for each in (*objects, *truths)]
    return (ctypes.c_int64 * 13)(items, in_tag, *addresses)


def _sizes() -> bool:
    sizes = {object: 16, float: 24, int: 24, np.float64: 24, np.int64: 24, np.void: 64}
    least = np.ndarray.__basicsize__ >= 80 and np.dtype.__basicsize__ >= 32
    return least and int.__itemsize__ == 4 and all(t.__basicsize__ == n for t, n in sizes.items())


def read(thing: object, offset: int, form: str = "q") -> tuple[Any, ...]:
    """Return what stands so many bytes behind an object's address."""
    return struct.unpack(form, ctypes.string_at(id(thing) + offset, struct.calcsize(form)))


def _scalars() -> bool:
    reals = all(read(kind(-1.5), SCALAR, "d") == (-1.5,) for kind in (float, np.float64))
    truths = np.bool_(1) is np.True_ and np.bool_(0) is np.False_
    return reals and truths and read(np.int64(-7), SCALAR) == (-7,) and read(7, TYPE) == (id(int),)


def _array() -> bool:
    array = np.asfortranarray(np.arange(6.0).reshape(2, 3))[:, ::2]
    data = array.__array_interface__["data"][0]
    head = *read(array, ARRAY_DATA), *read(array, ARRAY_NDIM, "i"), *read(array, ARRAY_DTYPE)
    if head != (data, 2, id(array.dtype)):
        return False
    shape, strides = (
        struct.unpack("2q", ctypes.string_at(read(array, where)[0], 16))
        for where in (ARRAY_SHAPE, ARRAY_STRIDES)
    )
    kind, number = read(array.dtype, DTYPE_KIND, "c3xi")
    return (shape, strides, kind, number) == (array.shape, array.strides, b"f", 12) and _flags()


def _flags() -> bool:
    array = np.zeros((2, 2))
    fixed = np.zeros((2, 2))
    fixed.flags.writeable = False
    odd = np.zeros(17, np.int8)[1:].view(np.float64)
    expected = (
        (array, C | ALIGNED | WRITEABLE),
        (array.T, F | ALIGNED | WRITEABLE),
        (array[0], C | F | ALIGNED | WRITEABLE),
        (array[:, 0], ALIGNED | WRITEABLE),
        (fixed, C | ALIGNED),
        (odd, C | F | WRITEABLE),
    )
    mask = C | F | ALIGNED | WRITEABLE
    return all(read(each, ARRAY_FLAGS, "i")[0] & mask == flags for each, flags in expected)


def _record() -> bool:
    record = np.zeros(2, [("x", "f8"), ("n", "i8")])[1]
    data = record.__array_interface__["data"][0]
    return (*read(record, RECORD_DATA), *read(record, RECORD_DTYPE)) == (data, id(record.dtype))


def _tuple(items: int) -> bool:
    pair = (object(), object())
    return read(pair, SIZE) == (2,) and read(pair, items, "qq") == (id(pair[0]), id(pair[1]))


def _sign_in_tag() -> bool | None:
    numbers = {0: (), 5: (5,), -5: (5,), 2**30: (0, 1), -(2**63): (0, 0, 8)}
    if any(read(number, DIGITS, f"{len(digits)}i") != digits for number, digits in numbers.items()):
        return None
    heads = [read(number, SIZE)[0] for number in numbers]
    if heads == [0, 1, -1, 2, -3]:
        return False
    # The lowest bit of three tells of small numbers that live for ever in later versions.
    bare = [head & ~4 for head in heads]
    return True if bare == [1, 8, 10, 16, 26] else None

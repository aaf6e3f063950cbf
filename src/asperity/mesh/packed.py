"""Arrays in one small file that a program draws from as they are, behind a header that says what.

It begins with the length of a JSON header (4 bytes, little endian), padded to whole words; its
``arrays`` name those behind it with dtype, shape and offset from its end.
"""

import json
import struct
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from asperity.arrays import FloatArray
from asperity.results.quantity import plain

Arrays = dict[str, NDArray[Any]]

_WORD = 4


def floats(values: FloatArray) -> NDArray[Any]:
    """Return numbers as a graphics card takes them."""
    return np.ascontiguousarray(values, dtype="<f4")


def indices(triangles: NDArray[Any]) -> NDArray[Any]:
    """Return numbers of points in as few bytes as hold them."""
    small = int(triangles.max()) < 2**16
    return np.ascontiguousarray(triangles, dtype="<u2" if small else "<u4")


def size_of(arrays: Arrays) -> int:
    """Return how many bytes arrays take at most, without their header."""
    return sum(values.nbytes + _WORD for values in arrays.values())


def packed(header: Mapping[str, Any], arrays: Arrays) -> bytes:
    """Return a header and arrays as the content of a file."""
    told, parts, offset = {}, [], 0
    for name, values in arrays.items():
        content = values.tobytes()
        content += bytes(-len(content) % _WORD)
        told[name] = {"dtype": values.dtype.str[1:], "shape": values.shape, "offset": offset}
        parts.append(content)
        offset += len(content)
    text = json.dumps(plain({**header, "arrays": told}), separators=(",", ":")).encode()
    text += b" " * (-len(text) % _WORD)
    return b"".join([struct.pack("<I", len(text)), text, *parts])

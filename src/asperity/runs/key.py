"""The key of an answer: what was asked, the sources it follows from, and the machine's part."""

import functools
import hashlib

import numpy as np
from numpy.typing import NDArray

from asperity.kernels.closure import Sources, source_key

# Each source is read once a process: one that is edited under a process counts from its next start.
_LOADED = Sources()


@functools.cache
def code_key(*modules: str) -> str:
    """Return a hash of what modules compute with: their sources, their data, Numba, NumPy.

    The processor is part of it, since which instructions it has moves the last bits of a result.

    Parameters
    ----------
    *modules : str
        Full names of modules; all they import belongs to them, also inside functions.
    """
    from asperity.kernels.fingerprint import machine

    code = source_key(*modules, sources=_LOADED)
    return hashlib.sha256("\0".join((code, *machine())).encode()).hexdigest()


def key(code: str, *parts: str | bytes | NDArray[np.generic]) -> str:
    """Return the name under which an answer is kept: 32 hexadecimal digits.

    Parameters
    ----------
    code : str
        From :func:`code_key`.
    *parts : str, bytes or ndarray
        What was asked, such as :meth:`asperity.casefile.Case.canonical`.
    """
    digest = hashlib.sha256(code.encode())
    for part in parts:
        if isinstance(part, str | bytes):
            kind, content = "", part.encode() if isinstance(part, str) else part
        else:
            kind, content = f"{part.dtype.str}{part.shape}", np.ascontiguousarray(part).tobytes()
        digest.update(f"{kind}\0{len(content)}\0".encode() + content)
    return digest.hexdigest()[:32]

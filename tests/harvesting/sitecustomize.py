"""Python runs this first where its folder is on the path: calls of kernels are written down.

So those of a command's own processes are seen as well. Each process writes a file of lines into the
folder that ``HARVEST`` names: a kernel's name and what it was called with; at its end null, and
which compilers it has loaded.
"""

import atexit
import contextlib
import json
import os
import sys

from asperity.kernels import compiled
from asperity.kernels.native.types import UnlistedTypeError, types_of

_plain = compiled._Lazy.__call__
_seen = set()


def _noted(self, *arguments):
    try:
        types = types_of(arguments)
    except UnlistedTypeError:
        types = None
    text = _text(self, types)
    if text not in _seen:
        _seen.add(text)
        _write(text)
    return _plain(self, *arguments)


def _text(kernel, types):
    return json.dumps([f"{kernel.__module__}.{kernel.__qualname__}", types])


def _is_called(self, *arguments):
    # As where nothing is kept: what has been called before is there by then.
    with contextlib.suppress(UnlistedTypeError):
        return _text(self, types_of(arguments)) in _seen
    return True


def _write(text):
    with open(os.path.join(os.environ["HARVEST"], f"{os.getpid()}.jsonl"), "a") as file:
        file.write(text + "\n")


def _ends():
    # A process that others share may end after the command that began it.
    with contextlib.suppress(FileNotFoundError):
        _write(json.dumps([None, sorted({"numba", "llvmlite"}.intersection(sys.modules))]))


# What makes kernels needs compilers and calls none.
if "HARVEST" in os.environ and "asperity.kernels.building.worker" not in sys.orig_argv:
    compiled._Lazy.__call__ = _noted
    compiled._Lazy.is_made = _is_called
    atexit.register(_ends)

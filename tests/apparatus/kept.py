"""Answers of plain ways that are kept, so that ordinary tests need not compile those.

Each is kept under what it follows from: the numbers given, to nine digits, and the source of the
plain way. What is not kept is calculated. Where a source or an ordinary test has changed, delete
``kept.json`` and run, in one process and with ``KEEP=1``, ``pytest`` of the files of tests that
call them: ``tests/literature/test_drive_plain.py``, ``tests/property/test_slider_ways.py``,
``tests/property/test_slider_plays.py``, ``tests/property/test_slider_limit.py`` and
``tests/unit/test_slider_astray.py``.
"""

import functools
import hashlib
import json
import os
from pathlib import Path

import numpy as np

FILE = Path(__file__).with_name("kept.json")


@functools.cache
def _known():
    return json.loads(FILE.read_text("utf-8")) if FILE.exists() else {}


@functools.cache
def source(module):
    """What tells one state of a plain way's module from another."""
    return hashlib.sha256(Path(module).read_bytes()).hexdigest()[:8]


def _written(given):
    if isinstance(given, tuple | list | np.ndarray):
        return [_written(each) for each in given]
    return f"{given:.9g}"


def answer(module, calculate, *given):
    """Return ``calculate(*given)``, floats, or what is kept of it.

    Parameters
    ----------
    module : str
        Its file, whose source the answer follows from.
    calculate : callable
        Of numbers, arrays of them and tuples; what it returns is a list of floats.
    *given
        Those.
    """
    text = json.dumps([calculate.__name__, _written(given)])
    key = f"{source(module)}-{hashlib.sha256(text.encode()).hexdigest()[:16]}"
    known = _known()
    if key not in known:
        known[key] = [float(each) for each in calculate(*given)]
        if os.environ.get("KEEP"):
            lines = (f'"{name}": {json.dumps(known[name])}' for name in sorted(known))
            FILE.write_text("{\n" + ",\n".join(lines) + "\n}\n", "utf-8")
    return known[key]

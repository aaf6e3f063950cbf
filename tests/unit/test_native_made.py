"""Entries of the list: types told as Numba tells them, keys that follow sources, machine code."""

import importlib
import inspect
import os
import subprocess
import sys
from collections import namedtuple

import numba
import numpy as np
import pytest

from asperity.kernels.building.specs import UnknownTypeError, numba_type, spec
from asperity.kernels.native.entries import likely, listed
from asperity.kernels.native.types import UnlistedTypeError, types_of

Pair = namedtuple("Pair", "x y")

RECORD = np.zeros((), [("x", "f8"), ("n", "i8")])[()]
FIXED = np.zeros(3)
FIXED.flags.writeable = False

VALUES = [
    1.0, 1, True, None, np.float64(1), np.int64(1), np.bool_(1), RECORD, np.zeros((2, 3)), FIXED,
    np.zeros((2, 3), order="F"), np.zeros((4, 4))[:, ::2], np.zeros(2, np.bool_), (1.0, 2.0),
    (1.0, 2), Pair(1.0, 2.0), Pair(np.zeros(2), (1, 2.0)), np.zeros(5, [("x", "f8", 3)]),
]  # fmt: skip


@pytest.mark.parametrize("value", VALUES, ids=lambda value: type(value).__name__)
def test_a_value_is_what_numba_takes_it_for(value):
    (told,) = types_of([value])
    assert numba_type(told) == numba.typeof(value)
    assert spec(numba.typeof(value)) == told


def test_what_no_machine_code_is_called_with_has_no_type():
    with pytest.raises(UnlistedTypeError):
        types_of(["word"])
    with pytest.raises(UnknownTypeError):
        spec(numba.typeof("word"))


def test_each_entry_is_called_with_as_many_values_as_its_kernel_takes():
    def takes(entry):
        kernel = getattr(importlib.import_module(entry.module), entry.name.rpartition(".")[2], None)
        return kernel and len(inspect.signature(kernel._function).parameters)

    # Where it fails, `python tests/harvest.py --again` with words of the lines that call them.
    told = {(entry.name, takes(entry), len(entry.arguments)) for entry in listed().entries}
    assert not {one for one in told if one[1] != one[2]}


def test_what_commands_call_together_is_likely_wanted_together():
    line = "slide table-4.1-L1"
    first, *others = listed().lines[line]
    asked = {first}
    for number in others:
        asked.add(number)
        assert asked.isdisjoint(entry.number for entry in likely(asked))
    assert not {entry.number for entry in likely(listed().lines[line][:2])} - set(others)


PROGRAM = """
import tempfile
from pathlib import Path
from asperity.kernels.building import lean, link, making
from asperity.kernels.native.entries import listed
from asperity.kernels.native import load
(entry,) = listed().named("asperity.slider.pressed.friction_limit")
making.began()
made = lean.make(making.kernel(entry), entry.arguments, link.symbol(entry))
with tempfile.TemporaryDirectory() as folder:
    link.write(Path(folder), [(entry, made)], link.support())
    native = load.from_folder(Path(folder)).entry(entry.name)
    print(native((0.5, 2.0)) == making.kernel(entry)._function(0.5, 2.0), native((1, 2.0)))
"""


@pytest.mark.slow
def test_an_entry_is_compiled_linked_and_called():
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM],
        env=os.environ | {"ASPERITY_NATIVE": "0"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.stdout, done.stderr) == ("True NotImplemented\n", "")

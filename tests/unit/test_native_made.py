"""Entries of the list: types told as Numba tells them, keys that follow sources, machine code."""

import importlib
import inspect
import math
import os
import subprocess
import sys
from collections import namedtuple

import numba
import numpy as np
import pytest
from numba.core import ir
from numba.core.compiler import run_frontend

from asperity.kernels.building import quicker
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
    # Once it is known that it marches.
    assert not {entry.number for entry in likely(listed().lines[line][:3])} - set(others)


def test_the_command_and_its_case_say_what_is_likely_wanted():
    # Drives of other models call alike kernels first, and the dearest of all later.
    line = listed().lines["drive drive-thesis"]
    told = likely(line[:1], ["drive", "drive-thesis"])
    assert [entry.number for entry in told] == list(line[1:])
    assert likely(line[:1], ["no such", "case"]) == likely(line[:1])


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


def _stepped(x, table, n):
    total, both = 0.0, (x, 2.0)
    for k in range(n):
        if table[k] > both[0] and k != 3:
            total += math.sin(table[k]) * both[1]
        elif k % 2:
            total = -total
    return total, [x, total]


def test_variables_of_instructions_are_those_that_numba_finds():
    blocks = run_frontend(_stepped).blocks.values()
    parts = [one for block in blocks for one in block.body]
    parts += [one.value for one in parts if isinstance(one, ir.Assign)]
    assert {type(one) for one in parts} >= {ir.Assign, ir.Branch, ir.Expr, ir.Return}
    found = 0
    for one in parts:
        if isinstance(one, ir.Inst):
            held = one._kws if isinstance(one, ir.Expr) else one.__dict__
            theirs = one.list_vars()
            assert quicker._variables(held.values()) == theirs
            assert quicker._variables([one, None, "word", (one,)]) == [*theirs, *theirs]
            found += len(theirs)
    assert found > 50


COMPILED = """
import hashlib
from asperity.kernels.building import lean, link, making, quicker
from asperity.kernels.native.entries import listed
if not {quicker}:
    quicker.begin = lambda: None
making.began()
for name in ("asperity.vibration.waveform.fill_increments", "asperity.slider.kernels.prime"):
    (entry, *_) = listed().named(name)
    made = lean.make(making.kernel(entry), entry.arguments, link.symbol(entry))
    print(hashlib.sha256(made.code).hexdigest())
"""


@pytest.mark.slow
def test_what_is_compiled_in_fewer_steps_is_the_same_to_the_byte():
    environment = os.environ | {"ASPERITY_NATIVE": "0"}
    told = [
        subprocess.run(
            [sys.executable, "-c", COMPILED.format(quicker=quicker)],
            env=environment,
            check=True,
            capture_output=True,
            text=True,
        ).stdout.split()
        for quicker in (False, True)
    ]
    assert len(told[0]) == 2
    assert told[0] == told[1]


MAKER = """
import io, sys
sys.argv, sys.stdin = ["worker", ".", "1"], io.StringIO("")
from asperity.kernels.building import worker
worker.main()
import numba
print(int(numba.config.OPT))
"""


@pytest.mark.slow
def test_settings_of_numba_where_one_works_are_not_those_of_what_is_kept(tmp_path):
    (tmp_path / ".numba_config.yaml").write_text("opt: '0'\n", "utf-8")
    done = subprocess.run(
        [sys.executable, "-W", "ignore", "-c", MAKER],
        cwd=tmp_path,
        check=True,
        capture_output=True,
        text=True,
    )
    assert done.stdout == "3\n"


def told_by(program):
    """What a process prints in which nothing is made yet."""
    without = os.environ | {"ASPERITY_NATIVE": "0"}
    line = [sys.executable, "-c", program]
    return subprocess.run(line, env=without, check=True, capture_output=True, text=True).stdout


LOOPS = """
from asperity.kernels.building import lean, link, making
from asperity.kernels.native.entries import listed
optimise = lean._optimise
def told(*module, **options):
    optimise(*module, **options)
    print(str(module[0]).count("\\nvector.body"))
lean._optimise = told
making.began()
(entry,) = listed().named("asperity.slider.batch_pressed_kernels.march_pressed_batch")
lean.make(making.kernel(entry), entry.arguments, link.symbol(entry), entry.target)
"""


@pytest.mark.slow
def test_all_loops_over_pressed_lanes_are_of_vector_instructions():
    told = told_by(LOOPS)
    # Three before the window, five in it while some wait and five when none does; two that make the
    # increments in the plane, and one of those up, the others of which are unrolled whole. With
    # max and min as functions of their own there were twelve.
    assert int(told) >= 3 + 5 + 5 + 2 + 1


COUNTED = """
import numba, numpy
from asperity.kernels.building import lean
from asperity.kernels.compiled import kernel
from typing import NamedTuple
class Pair(NamedTuple):
    first: numpy.ndarray
    second: numpy.ndarray
def end(rows, n):
    pair = Pair(rows[0], numpy.empty(n))
    last = pair.second
    for k in range(n):
        part = numpy.empty(k + 1)
        part[k] = pair.first[k]
        last = part if k % 2 else pair.second
        last[0] = part[k]
    if n > 3:
        return last
    return pair.first
lean.begin()
end.__module__ = "__main__"
own = kernel(end)
made = lean.make(own, [["A", "<f8", 2, "C", True, True], ["q"]], "entry")
from asperity.kernels.building import link, runtime
import ctypes, os, tempfile
with tempfile.TemporaryDirectory() as folder:
    path = os.path.join(folder, "a.so")
    open(path, "wb").write(link.linked(folder, [made.code, link.support()]))
    library = ctypes.CDLL(path)
    rows = numpy.arange(16.0).reshape(2, 8)
    release = library.asperity_release
    release.argtypes = [ctypes.c_void_p]
    for n in (3, 4, 5, 6):
        words = [0] + [0] * made.words[0] + [0, 0, 16, 8, rows.ctypes.data, 2, 8, 64, 8, n]
        room = (ctypes.c_int64 * len(words))(*words)
        status = library.entry(room)
        held, value = room[1], ctypes.c_double.from_address(room[5]).value
        print(n, status, ctypes.c_int64.from_address(held).value if held else None, value)
        if held:
            release(held)
"""


@pytest.mark.slow
def test_what_is_made_in_a_loop_or_once_is_counted_and_what_is_lent_is_not():
    told = [line.split() for line in told_by(COUNTED).splitlines()]
    # What comes back is held once by who called: the array made once, or the last of the loop.
    assert told == [
        ["3", "0", "None", "0.0"],
        ["4", "0", "1", "3.0"],
        ["5", "0", "1", "4.0"],
        ["6", "0", "1", "5.0"],
    ]


BORROWED = """
from asperity.kernels.building import borrowing, making
from asperity.kernels.native.entries import listed
found, decided = {}, borrowing.only_borrows
def noted(state):
    found[state.func_id.func_name] = decided(state)
    return found[state.func_id.func_name]
borrowing.only_borrows = noted
from asperity.kernels.building import lean
making.began()
(entry, *_) = listed().named("asperity.slider.kernels.march_stretches")
lean.make(making.kernel(entry), entry.arguments, "entry")
print(found["march_block"], found["fill_increments"], found["march_stretches"])
"""


@pytest.mark.slow
def test_what_makes_no_arrays_is_compiled_without_counts_of_them_and_what_makes_some_with():
    told = told_by(BORROWED).split()
    assert told == ["True", "True", "False"]

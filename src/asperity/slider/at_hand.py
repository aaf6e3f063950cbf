"""What is done at the states of bodies in the plane, before the kernel for it is compiled.

On an empty cache a first march would wait for `at_state`, which takes longest to be compiled of all
that it calls, and half of that a periodic state. Till it is there Python goes through it, in a few
cycles, which are compiled sooner: all numbers are the same. That takes a millisecond or two; who
asks for many states waits for the kernel after a while.
"""

import functools
import itertools
from typing import Any

import numpy as np

from asperity.arrays import FloatArray
from asperity.kernels.compiled import as_python
from asperity.slider import shooting
from asperity.slider.cycle_map import Cycle
from asperity.slider.on_twice import at_state
from asperity.slider.scaled import STATE, SUMS

_MOST = 100
"""Times that Python does it in a process: 0.1 to 0.2 s, where the kernel takes seconds."""

_TIMES = itertools.count(1)
# What was there once stays so, and to ask takes as long as a cycle.
_IS_MADE: list[bool] = []


def done_at(
    cycle: Cycle, sums: np.ndarray, jacobian: FloatArray, most: int, task: int
) -> tuple[float, float]:
    """Do what `at_state` does where a cycle's body is, by it or by Python.

    Parameters
    ----------
    cycle : Cycle
        Where the body is.
    sums : ndarray of a record
        Overwritten.
    jacobian, most, task
        As there.
    """
    body = cycle.body
    state, here = body.kept["state"], (cycle.springs, body.p, cycle.q)
    waves, others = (cycle.increments, cycle.rises), (jacobian, most, task)
    arguments = state, *here, *waves, sums, *others
    if cycle.q is not None or _is_made(arguments):
        left, ratio = at_state(*arguments)
    else:
        # As machine code does; a body that is lost is told by the numbers it has.
        with np.errstate(all="ignore"):
            named = _with_attributes(sums)
            left, ratio = _by_python()(_with_attributes(state), *here, *waves, named, *others)
    return float(left), float(ratio)


def _is_made(arguments: tuple[Any, ...]) -> bool:
    """Return whether the kernel is there, or worth waiting for."""
    kernel: Any = at_state
    if not _IS_MADE and (kernel.is_made(*arguments) or next(_TIMES) > _MOST):
        _IS_MADE.append(True)
    return bool(_IS_MADE)


@functools.cache
def _by_python() -> Any:
    """Return `at_state` as Python, but for the cycles."""

    def cycle(state: Any, springs: Any, p: Any, q: Any, *waves_and_sums: Any) -> None:
        increments, rises, sums, _nodes, _whole = waves_and_sums
        shooting.run_cycle(_held(state, STATE), springs, p, q, increments, rises, _held(sums, SUMS))

    return as_python(at_state, {shooting._cycle: cycle})


def _with_attributes(records: np.ndarray) -> np.ndarray:
    return records.view(np.dtype((np.record, records.dtype)))


def _held(record: Any, kind: np.dtype[np.void]) -> np.void:
    """Return a record of an array of one as a kernel is given it."""
    held: np.void = record.base.view(kind)[0]
    return held

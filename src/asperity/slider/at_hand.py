"""What is done at a state where no more is compiled yet than cycles of a body in the plane.

A first march on an empty cache would wait for `at_state`, which takes longest to be compiled of all
that it calls. Till that is there, Python goes through it: in a few cycles, which are compiled, so
that all numbers are the same. It takes 2 ms.
"""

import functools
from typing import Any

import numpy as np

from asperity.arrays import FloatArray
from asperity.kernels.compiled import as_python
from asperity.slider import shooting
from asperity.slider.cycle_map import Cycle
from asperity.slider.on_twice import at_state
from asperity.slider.scaled import STATE, SUMS

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
    if cycle.q is not None or _is_at_hand(state, here, waves, sums, others):
        left, ratio = at_state(state, *here, *waves, sums, *others)
    else:
        # As machine code does; a body that is lost is told by the numbers it has.
        with np.errstate(all="ignore"):
            named = _with_attributes(sums)
            left, ratio = _by_python()(_with_attributes(state), *here, *waves, named, *others)
    return float(left), float(ratio)


def _is_at_hand(
    state: np.ndarray,
    here: tuple[Any, ...],
    waves: tuple[FloatArray, FloatArray],
    sums: np.ndarray,
    others: tuple[Any, ...],
) -> bool:
    """Return whether `at_state` is there, or what Python would need is not there either."""
    if not _IS_MADE:
        whole: Any = at_state
        cycles: Any = shooting.run_cycle
        if not whole.is_made(state, *here, *waves, sums, *others):
            return not cycles.is_made(state[0], *here, *waves, sums[0])
        _IS_MADE.append(True)
    return True


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

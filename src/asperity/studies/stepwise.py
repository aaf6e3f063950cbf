"""Sequential quadratic programming (Kraft's SLSQP), by SciPy's machine code.

To import :mod:`scipy.optimize` takes as long as all climbs of a command together. Of it the one
compiled module that is needed is loaded by itself, where it is of a release whose call is known
here; else, SciPy's own function is imported.
"""

import functools
import importlib.machinery
import importlib.util
from collections.abc import Callable, Generator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from queue import SimpleQueue
from typing import Any

import numpy as np

from asperity.arrays import FloatArray

_RELEASES = ("1.17.",)
_MODULE = "scipy.optimize._slsqplib"

Climb = Generator[FloatArray, tuple[FloatArray, FloatArray], FloatArray]
"""Asks for points; is sent values and slopes at each; returns the last of them."""


def lowest(start: FloatArray, accuracy: float, iterations: int) -> Climb:
    """Go down within the unit cube, asking for one point after the other.

    Parameters
    ----------
    start : ndarray, shape (n,)
        Where to begin.
    accuracy : float
        Of what is to be low.
    iterations : int
        After which it ends anyway.

    Yields
    ------
    ndarray, shape (n,)
        A point. To be sent are a row of values there, (1 + m,), and their slopes, (1 + m, n):
        first what is to be low, behind it what may not be below zero.

    Returns
    -------
    ndarray, shape (n,)
        The end.

    Notes
    -----
    Kraft, A software package for sequential quadratic programming, DFVLR-FB 88-28, 1988.
    """
    step = _machine_code()
    if step is None:
        return (yield from _by_scipy(start, accuracy, iterations))
    point: FloatArray = np.clip(np.array(start, dtype=float), 0.0, 1.0)
    values, slopes = yield point.copy()
    n, m = len(point), len(values) - 1
    state: dict[str, Any] = dict.fromkeys(
        ("alpha", "f0", "gs", "h1", "h2", "h3", "h4", "t", "t0"), 0.0
    )
    state |= dict.fromkeys(("exact", "inconsistent", "reset", "iter", "line", "meq", "mode"), 0)
    state |= {"acc": accuracy, "tol": 10.0 * accuracy, "itermax": iterations, "m": m, "n": n}
    room = n * (n + 1) // 2 + 3 * m * n + 9 * m + 8 * n * n + 35 * n + 28
    room += 0 if m else 2 * n * (n + 1)
    buffer, places = np.zeros(room), np.zeros(m + 2 * n + 2, dtype=np.int32)
    multipliers = np.zeros(m + 2 * n + 2)
    low, high = np.zeros(n), np.ones(n)
    normals, held = np.zeros((max(m, 1), n), order="F"), np.zeros(max(m, 1))
    height, downhill = float(values[0]), slopes[0].copy()
    normals[:m], held[:m] = slopes[1:], values[1:]
    while True:
        step(state, height, downhill, normals, held, point, multipliers, low, high, buffer, places)
        if abs(state["mode"]) != 1:
            return point
        values, slopes = yield point.copy()
        if state["mode"] == 1:
            height, held[:m] = float(values[0]), values[1:]
        else:
            downhill, normals[:m] = slopes[0].copy(), slopes[1:]


class _NoMoreError(Exception):
    """Nobody answers any more."""


def _by_scipy(start: FloatArray, accuracy: float, iterations: int) -> Climb:
    """Do the same by SciPy's function, which asks by calling: in a thread that can be held."""
    asked: SimpleQueue[FloatArray | None] = SimpleQueue()
    told: SimpleQueue[tuple[FloatArray, FloatArray] | None] = SimpleQueue()

    def slope(point: FloatArray) -> tuple[FloatArray, FloatArray]:
        asked.put(point.copy())
        answer = told.get()
        if answer is None:
            raise _NoMoreError
        return answer

    def climb() -> FloatArray:
        from scipy.optimize import minimize

        try:
            found: FloatArray = minimize(
                lambda point: slope(point)[0][0],
                start,
                jac=lambda point: slope(point)[1][0],
                method="SLSQP",
                bounds=[(0.0, 1.0)] * len(start),
                constraints={
                    "type": "ineq",
                    "fun": lambda point: slope(point)[0][1:],
                    "jac": lambda point: slope(point)[1][1:],
                },
                options={"ftol": accuracy, "maxiter": iterations},
            ).x
            return found
        finally:
            asked.put(None)

    with ThreadPoolExecutor(1) as pool:
        end = pool.submit(climb)
        try:
            while (point := asked.get()) is not None:
                told.put((yield point))
        finally:
            told.put(None)
        found: FloatArray = end.result()
        return found


@functools.cache
def _machine_code() -> Callable[..., None] | None:
    """Return SciPy's compiled step; None where there is none whose call is known."""
    import scipy

    if not scipy.__version__.startswith(_RELEASES):
        return None
    name = _MODULE.rpartition(".")[2] + importlib.machinery.EXTENSION_SUFFIXES[0]
    spec = importlib.util.spec_from_file_location(
        _MODULE, Path(scipy.__file__).parent / "optimize" / name
    )
    if spec is None or spec.loader is None:
        return None
    try:
        module = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
        step: Callable[..., None] = module.slsqp
    except (ImportError, AttributeError):
        return None
    return step

"""Kernels as plain Python, so that a broken one need not be compiled: a plugin of pytest.

Numba compiles anew, for minutes, whatever calls a kernel that was edited; most tests of kernels are
small enough to be run without. With ``NUMBA_DISABLE_JIT=1`` and ``ASPERITY_NATIVE=0`` they are;
here records of NumPy get the attributes that Numba gives them, and a test that takes more than
``--spare`` seconds of a processor is skipped.
"""

import functools
import signal
from contextlib import contextmanager

import numpy as np
import pytest

from asperity.kernels.compiled import _Lazy


class _Record(np.record):
    """A record whose fields come before what NumPy's records have of the same name (`base`)."""

    def __getattribute__(self, name):
        of = np.void.__getattribute__
        if not name.startswith("__") and name in (of(self, "dtype").names or ()):
            value = self[name]
            return _with_attributes(value) if isinstance(value, np.void) else value
        return super().__getattribute__(name)


def pytest_addoption(parser):
    parser.addoption("--spare", type=float, default=0.0, help="s, of one test; 0 for any")


def pytest_configure():
    _Lazy.__call__ = _called
    for name, make in makers().items():
        setattr(np, name, make)


def makers():
    """What makes arrays, by NumPy's names: in a kernel such that fields are read by their names."""
    return {name: _making(getattr(np, name)) for name in ("empty", "zeros")}


def _making(made):
    @functools.wraps(made)
    def make(*arguments, **options):
        array = made(*arguments, **options)
        return _with_attributes(array) if _inside else array

    return make


# How many kernels are being run: what they call is told from what calls them.
_inside = 0


# Most arguments are such.
_PLAIN = frozenset([float, int, bool, np.float64, np.int64, np.bool_, _Record])


def _called(self, *arguments):
    global _inside
    _inside += 1
    try:
        return self._function(*_each_with_attributes(arguments))
    finally:
        _inside -= 1


def plainly(kernel):
    """Return a kernel as plain Python."""
    return functools.partial(_called, kernel)


def _each_with_attributes(values):
    return [one if type(one) in _PLAIN else _with_attributes(one) for one in values]


def _with_attributes(value):
    """The same memory, of which fields can be read and set by their names."""
    kind = type(value)
    if kind is np.ndarray:
        named = value.dtype.names and value.dtype.type is np.void
        return value.view(np.dtype((_Record, value.dtype))) if named else value
    if kind is np.void:
        base = value.base
        if base is None or base.dtype != value.dtype:
            return _with_attributes(np.array([value]))[0]
        away = value.__array_interface__["data"][0] - base.__array_interface__["data"][0]
        return _with_attributes(base.reshape(-1))[away // value.dtype.itemsize]
    if isinstance(value, tuple):
        new = _each_with_attributes(value)
        if any(one is not other for one, other in zip(new, value, strict=True)):
            return tuple(new) if kind is tuple else kind(*new)
    return value


@contextmanager
def _limited(item):
    def late(number, frame):
        pytest.skip("takes too long without compiling")

    before = signal.signal(signal.SIGVTALRM, late)
    signal.setitimer(signal.ITIMER_VIRTUAL, item.config.option.spare)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_VIRTUAL, 0.0)
        signal.signal(signal.SIGVTALRM, before)


@pytest.hookimpl(wrapper=True)
def pytest_runtest_setup(item):
    with _limited(item):
        return (yield)


@pytest.hookimpl(wrapper=True)
def pytest_runtest_call(item):
    with _limited(item):
        return (yield)

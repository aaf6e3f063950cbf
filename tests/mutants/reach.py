"""Which functions of the package each test calls, and how long it takes: a plugin of pytest.

``python tests/mutants/near.py`` runs the tests with it. What a fixture, or a cached function of the
tests, has called counts for each test that uses it, not only for the one that came first. Kernels
that are called by other kernels are seen by nobody; they are found by the names they stand under.
"""

import json
import os
import sys
import threading
import time
import types
from contextlib import contextmanager
from pathlib import Path

import pytest

import asperity
from asperity.kernels.compiled import _Lazy

PACKAGE = str(Path(asperity.__file__).parent) + os.sep
_CALL = _Lazy.__call__.__code__

_seen = set()  # what has been called since the last look
_of_fixture = {}


def _watch(frame, event, argument):
    code = frame.f_code
    if code is _CALL:
        _kernel(frame.f_locals["self"])
    else:
        _seen.add(code)


def _kernel(lazy):
    function = lazy._function
    if function.__code__ in _seen:
        return
    _seen.add(function.__code__)
    about = {**function.__globals__, **_closed_over(function)}
    for value in map(about.get, function.__code__.co_names + function.__code__.co_freevars):
        if isinstance(value, _Lazy):
            _kernel(value)
        elif isinstance(value, types.ModuleType):
            for name in function.__code__.co_names:
                if isinstance(other := vars(value).get(name), _Lazy):
                    _kernel(other)


def _closed_over(function):
    cells = function.__closure__ or ()
    return {n: c.cell_contents for n, c in zip(function.__code__.co_freevars, cells, strict=True)}


@contextmanager
def _looking():
    """Yield a set that holds, in the end, what was called meanwhile."""
    global _seen
    before, _seen = _seen, set()
    here = _seen
    sys.settrace(_watch)
    threading.settrace(_watch)
    try:
        yield here
    finally:
        sys.settrace(None)
        threading.settrace(None)
        before |= here
        _seen = before
        if before is not _outermost:
            sys.settrace(_watch)
            threading.settrace(_watch)


_outermost = _seen


class _Cached:
    """A cached function of the tests that tells, each time it is asked, what it once called."""

    def __init__(self, cached):
        self._cached = cached
        self._called = set()

    def __call__(self, *arguments, **options):
        with _looking() as called:
            answer = self._cached(*arguments, **options)
        self._called |= called
        _seen.update(self._called)
        return answer

    def __getattr__(self, name):
        return getattr(self._cached, name)


def pytest_collection_modifyitems(items):
    wrapped = {}
    for module in {item.module for item in items}:
        for name, value in vars(module).copy().items():
            if hasattr(value, "cache_info") and not isinstance(value, _Cached):
                setattr(module, name, wrapped.setdefault(value, _Cached(value)))


@pytest.hookimpl(wrapper=True)
def pytest_fixture_setup(fixturedef):
    with _looking() as called:
        value = yield
    _of_fixture[fixturedef] = called
    return value


@pytest.hookimpl(wrapper=True)
def pytest_runtest_protocol(item):
    start = time.process_time(), time.perf_counter()
    with _looking() as called:
        answer = yield
    spent = max(time.process_time() - start[0], 0.0)
    for definitions in item._fixtureinfo.name2fixturedefs.values():
        for definition in definitions:
            called |= _of_fixture.get(definition, set())
    names = sorted(
        f"{code.co_filename.removeprefix(PACKAGE)}:{code.co_qualname}"
        for code in called
        if code.co_filename.startswith(PACKAGE)
    )
    with open(os.environ["REACHED"], "a", encoding="utf-8") as file:
        file.write(json.dumps({"test": item.nodeid, "seconds": spent, "called": names}) + "\n")
    return answer

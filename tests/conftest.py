"""Settings shared by all tests."""

import os
import shutil

import hypothesis
import pytest
import warm

if "PYTEST_XDIST_WORKER" in os.environ:
    # The workers have the cores among themselves; threads of linear algebra on top of them wait
    # for each other. Read by the libraries when they are first imported, here or by a program
    # that a test starts.
    for _library in ("OMP", "OPENBLAS", "MKL"):
        os.environ.setdefault(f"{_library}_NUM_THREADS", "1")

# Without a deadline, because the first example may load a unit registry or compile a kernel; the
# same examples every time, so that a failure is about the change at hand.
hypothesis.settings.register_profile("asperity", deadline=None, derandomize=True, database=None)
hypothesis.settings.load_profile("asperity")

# Programs of others that some tests compare with: name of the program, files of tests.
_NEEDS = {
    "gfortran": ["literature/test_fric_subroutine.py"],
    "ccx": ["literature/test_calculix.py"],
}
_absent = [program for program in _NEEDS if shutil.which(program) is None]
collect_ignore = [name for program in _absent for name in _NEEDS[program]]


def pytest_report_header() -> list[str]:
    return [f"{program} is not installed: left out {_NEEDS[program]}" for program in _absent]


def pytest_sessionstart(session: pytest.Session) -> None:
    # Before the workers start, each of which would compile the same kernels at the same time.
    workers = getattr(session.config.option, "numprocesses", None)
    if workers and not session.config.option.collectonly:
        warm.compile_kernels(workers)

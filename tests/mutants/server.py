"""A process that has loaded what all tests load but the package, and tests in copies of itself.

A line of its input asks for a run: arguments of pytest, a file for what it prints, seconds of a
processor, seconds in all and bytes. A line of its output answers with the exit code, or null where
time was up. To load libraries takes longer than most tests do.
"""

import contextlib
import importlib
import json
import os
import resource
import signal
import sys
import time

_LOADED = (
    "numpy", "scipy.integrate", "scipy.interpolate", "scipy.linalg",
    "scipy.optimize", "scipy.sparse", "scipy.spatial.transform", "scipy.stats", "numba", "xarray",
    "h5netcdf", "pint", "pydantic", "rich", "typer", "skfem",
)  # fmt: skip
_LOOK = 0.05  # s


def _run(asked):
    for limit, most in ((resource.RLIMIT_CPU, asked["cpu"]), (resource.RLIMIT_AS, asked["bytes"])):
        resource.setrlimit(limit, (most, most))
    # Started in the background, programs are told to ignore Ctrl+C, and tests of it fail.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    output = os.open(asked["output"], os.O_WRONLY | os.O_CREAT | os.O_TRUNC)
    for stream, file in ((0, os.open(os.devnull, os.O_RDONLY)), (1, output), (2, output)):
        os.dup2(file, stream)
    code = int(pytest.main(asked["arguments"]))
    sys.stdout.flush()
    os._exit(code)


def _ended(child, seconds):
    deadline = time.monotonic() + seconds
    while time.monotonic() < deadline:
        pid, status = os.waitpid(child, os.WNOHANG)
        if pid:
            code = os.waitstatus_to_exitcode(status)
            return None if code in (-signal.SIGXCPU, -signal.SIGKILL) else code
        time.sleep(_LOOK)
    os.killpg(child, signal.SIGKILL)
    os.waitpid(child, 0)
    return None


if __name__ == "__main__":
    import pytest

    for name in _LOADED:
        # Tests of what is not installed are left out, or fail where nothing is broken too.
        with contextlib.suppress(ImportError):
            importlib.import_module(name)
    assert "asperity" not in sys.modules
    for line in sys.stdin:
        asked = json.loads(line)
        child = os.fork()
        if child == 0:
            os.setsid()
            _run(asked)
        print(json.dumps(_ended(child, asked["seconds"])), flush=True)

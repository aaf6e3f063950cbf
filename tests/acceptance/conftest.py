"""The command line as a user runs it, with caches of its own: in this process or in another.

Most of a short command's time is the start of Python and of the libraries. What a command answers
is therefore tested in this process; a process of its own is for what is about processes: start,
signals, pipes, what is imported. That both answer alike is tested in ``test_cli.py``.
"""

import contextlib
import io
import os
import sqlite3
import subprocess
import sys
import time
from pathlib import Path
from unittest import mock

import pytest
from observe import new_cache

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="session")
def new_user(tmp_path_factory):
    """Make the environment of a user without results, whose kernels are compiled already."""

    def make():
        cache = new_cache(tmp_path_factory.mktemp("user"))
        return {**os.environ, "ASPERITY_CACHE": str(cache), "COLUMNS": "100"}

    return make


@pytest.fixture(scope="module")
def environment(new_user):
    """Environment of the module's own user."""
    return new_user()


def _results(environment):
    return list(Path(environment["ASPERITY_CACHE"]).glob("asperity/sweep/*.sqlite"))


@pytest.fixture(scope="session")
def kept():
    """Count a user's results, while a sweep may be writing to them."""

    def count(environment):
        for path in _results(environment):
            try:
                with contextlib.closing(sqlite3.connect(path, timeout=10)) as database:
                    return database.execute("SELECT count(*) FROM results").fetchone()[0]
            except sqlite3.OperationalError:
                break
        return 0

    return count


@pytest.fixture(scope="session")
def wait_for(kept):
    """Wait until a sweep has kept so many results."""

    def wait(process, environment, least):
        deadline = time.monotonic() + 180
        while kept(environment) < least:
            assert process.poll() is None, process.communicate()
            assert time.monotonic() < deadline
            time.sleep(0.01)

    return wait


@pytest.fixture(scope="module")
def asperity(environment):
    """Run the command line in this process: exit code, standard output, standard error."""
    from asperity.cli.main import main

    def run(*arguments, env=environment, cwd="."):
        if "--out" in arguments and Path(cwd).resolve() == ROOT:
            out = Path(arguments[arguments.index("--out") + 1])
            assert out.is_absolute(), f"{out} would be left in the repository; give cwd"
        output, errors = io.StringIO(), io.StringIO()
        with (
            mock.patch.dict(os.environ, env, clear=True),
            contextlib.chdir(cwd),
            contextlib.redirect_stdout(output),
            contextlib.redirect_stderr(errors),
            pytest.raises(SystemExit) as ended,
        ):
            main(list(map(str, arguments)))
        return ended.value.code, output.getvalue(), errors.getvalue()

    return run


@pytest.fixture(scope="module")
def start(environment):
    """Start the command line in a process of its own and return that."""

    def begin(*arguments, **options):
        return subprocess.Popen(
            [sys.executable, "-m", "asperity", *map(str, arguments)],
            **{
                "env": environment,
                "stdout": subprocess.PIPE,
                "stderr": subprocess.PIPE,
                "text": True,
                **options,
            },
        )

    return begin


@pytest.fixture(scope="module")
def asperity_process(start):
    """Run the command line in a process of its own to its end, and return what `asperity` does."""

    def run(*arguments, **options):
        process = start(*arguments, **options)
        output, errors = process.communicate(timeout=300)
        return process.returncode, output, errors

    return run


@pytest.fixture(scope="session")
def page(new_user, tmp_path_factory):
    """A page that is served, one for all tests."""
    from apparatus.page import Served

    served = Served(tmp_path_factory.mktemp("page"), new_user())
    yield served
    output, errors = served.close()
    # Nothing that was asked has made the server fail or print a token.
    assert (output, errors) == ("", "")

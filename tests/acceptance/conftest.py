"""The command line as a user runs it: a process of its own, with caches of its own."""

import contextlib
import os
import sqlite3
import subprocess
import sys
import time
from pathlib import Path

import pytest

from asperity.folders import cache_folder


@pytest.fixture(scope="session")
def new_user(tmp_path_factory):
    """Make the environment of a user without results, whose kernels are compiled already."""

    def make():
        home = tmp_path_factory.mktemp("cache")
        kernels = cache_folder("kernels")
        if kernels is not None:
            (home / "asperity").mkdir()
            (home / "asperity" / "kernels").symlink_to(kernels)
        return {**os.environ, "ASPERITY_CACHE": str(home), "COLUMNS": "100"}

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
def start(environment):
    """Start the command line and return its process."""

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
def asperity(start):
    """Run the command line to its end: exit code, standard output, standard error."""

    def run(*arguments, **options):
        process = start(*arguments, **options)
        output, errors = process.communicate(timeout=300)
        return process.returncode, output, errors

    return run

"""The command line as a user runs it: a process of its own, with caches of its own."""

import os
import subprocess
import sys

import pytest

from asperity.compiled import cache_folder


@pytest.fixture(scope="module")
def environment(tmp_path_factory):
    """Environment of a user who has no results yet, and whose kernels are compiled already."""
    home = tmp_path_factory.mktemp("cache")
    kernels = cache_folder("kernels")
    if kernels is not None:
        (home / "asperity").mkdir()
        (home / "asperity" / "kernels").symlink_to(kernels)
    return {**os.environ, "ASPERITY_CACHE": str(home), "COLUMNS": "100"}


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
        output, errors = process.communicate(timeout=120)
        return process.returncode, output, errors

    return run

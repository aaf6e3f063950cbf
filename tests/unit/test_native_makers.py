"""Processes that make kernels begin with the command, on an empty cache, and end with it."""

import subprocess
import sys

import pytest

from asperity.kernels.native import makers

IDLE = [sys.executable, "-c", "import sys; sys.stdin.read()"]


@pytest.fixture
def made(monkeypatch, tmp_path):
    monkeypatch.setenv("ASPERITY_CACHE", str(tmp_path))
    for name in ("ASPERITY_NATIVE", "NUMBA_DISABLE_JIT"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setattr(makers, "_SHIPPED", tmp_path / "none")
    monkeypatch.setattr(makers, "platform_name", lambda: makers.MADE_HERE)
    monkeypatch.setattr(makers, "most_makers", lambda: 2)
    monkeypatch.setattr(makers, "_EARLY", [])
    monkeypatch.setattr(makers, "WORDS", [])
    processes = []

    def new(kernels):
        pipe = subprocess.PIPE
        process = subprocess.Popen(IDLE, stdin=pipe, stdout=pipe, text=True)
        processes.append(process)
        return process

    monkeypatch.setattr(makers, "_new", new)
    yield processes
    makers._leave()
    for process in processes:
        for each in (process.stdin, process.stdout):
            each.close()
        process.returncode = None
        process.wait(20)


def test_on_an_empty_cache_they_begin_once_and_are_those_that_are_asked(made, tmp_path):
    makers.begin_for(["slide", "table-4.3"])
    assert len(made) == 2
    kernels = tmp_path.resolve() / "asperity" / "kernels"
    assert [makers.begun(kernels) for _ in range(2)] == made[:2]
    assert makers.begun(kernels) is made[2]
    assert len(made) == 3


def test_another_folder_has_others(made, tmp_path):
    makers.begin_for(["slide", "table-4.3"])
    assert makers.begun(tmp_path) is made[2]


def test_those_that_nothing_was_asked_of_end(made):
    makers.begin_for(["slide", "table-4.3"])
    makers._leave()
    for process in made:
        process.returncode = None
        assert process.wait(20) == 0


@pytest.mark.parametrize("command", ["cases", "materials", "no such", "--version"])
def test_a_command_that_calls_no_kernels_begins_none(made, command):
    makers.begin_for([command])
    assert not made


def test_where_one_is_kept_or_ships_or_none_is_wanted_none_begins(made, monkeypatch, tmp_path):
    (tmp_path / "none").mkdir()
    makers.begin_for(["slide", "table-4.3"])
    (tmp_path / "none").rmdir()
    for name, value in (("ASPERITY_NATIVE", "0"), ("NUMBA_DISABLE_JIT", "1")):
        monkeypatch.setenv(name, value)
        makers.begin_for(["slide", "table-4.3"])
        monkeypatch.delenv(name)
    (tmp_path / "asperity" / "kernels" / ("0" * 32)).mkdir(parents=True, mode=0o700)
    makers.begin_for(["slide", "table-4.3"])
    assert not made

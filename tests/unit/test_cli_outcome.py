"""How a command ends does not hang on a terminal that is gone, nor on a disk that is full."""

import contextlib
import os
import sys
from types import SimpleNamespace

import pytest

from asperity.casefile import read_case
from asperity.cli import outcome, show
from asperity.commands.execution import execute
from asperity.errors import ConvergenceError, StorageError
from asperity.tribometer.tables import TABLES


class Gone:
    """Standard error of a terminal that was closed."""

    def __init__(self, file):
        self._file = file

    def write(self, text):
        raise OSError(5, "input/output error")

    def flush(self):
        """Find nobody there."""

    def isatty(self):
        return True

    def fileno(self):
        return self._file


@pytest.fixture
def gone(tmp_path):
    file = os.open(tmp_path / "terminal", os.O_WRONLY | os.O_CREAT)
    yield file
    os.close(file)


def test_a_line_for_a_terminal_that_is_gone_ends_nothing(gone, tmp_path, monkeypatch):
    with monkeypatch.context() as closed:
        closed.setattr(sys, "stderr", Gone(gone))
        outcome.tell("the guardian has switched off")
    # What Python still writes at its end goes nowhere, and changes no exit status.
    os.write(gone, b"more")
    assert (tmp_path / "terminal").read_bytes() == b""


def test_a_bar_on_a_terminal_that_goes_ends_nothing(gone, monkeypatch):
    with monkeypatch.context() as closed:
        closed.setattr(sys, "stderr", Gone(gone))
        with show.progress_bar("cells") as moved:
            moved(1, 2)


def test_what_latched_is_raised_though_a_disk_takes_no_picture(tmp_path):
    def full(folder, *, pictures):
        raise StorageError("run.png cannot be written: no space left on device")

    failure = ConvergenceError("latched")
    result = SimpleNamespace(write=full, whole=False, reported=True, failure=failure)
    command = SimpleNamespace(
        options=(), arguments=(), out="DIR", into="", counts="cells", stem="run",
        case_of=lambda *_: read_case("rig-final", TABLES), prepared=lambda *_: None,
        solved=lambda *_: result,
    )  # fmt: skip
    notes = []
    teller = SimpleNamespace(
        read=lambda _: None, note=notes.append, progress=lambda _: contextlib.nullcontext(),
        so_far=None, show=lambda *_: None, written=lambda *_: None,
    )  # fmt: skip
    with pytest.raises(ConvergenceError, match="latched"):
        execute(command, "rig-final", (), teller, version="1", out=tmp_path / "out")
    assert notes == ["run.png cannot be written: no space left on device"]
    result.failure = None
    with pytest.raises(StorageError, match="no space left"):
        execute(command, "rig-final", (), teller, version="1", out=tmp_path / "out")

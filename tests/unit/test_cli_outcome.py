"""How a command ends does not hang on a terminal that is gone."""

import os
import sys

import pytest

from asperity.cli import outcome, show


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

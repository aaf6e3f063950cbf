"""Ctrl-C where nothing can be raised is heard all the same."""

import os
import signal
import subprocess
import sys
import zipfile

import pytest
from apparatus.grid import slow

from asperity.processes.interrupts import reraise_pending
from asperity.runs.interrupt import Signals

CLEANED_UP = """
import signal, time
from asperity.processes.interrupts import reraise_pending

reraise_pending()

class Kept:
    def __del__(self):
        # It comes while something is being cleaned up.
        signal.raise_signal(signal.SIGINT)

try:
    Kept()
    time.sleep(30)
except KeyboardInterrupt:
    print("heard")
"""


def test_a_ctrl_c_that_python_drops_is_heard_a_moment_later():
    done = subprocess.run(
        [sys.executable, "-c", CLEANED_UP], capture_output=True, text=True, timeout=60, check=True
    )
    assert (done.stdout, done.stderr) == ("heard\n", "")


def test_what_else_is_dropped_is_told_as_before():
    text = CLEANED_UP.replace("signal.raise_signal(signal.SIGINT)", "raise ValueError('lost')")
    done = subprocess.run(
        [sys.executable, "-c", text.replace("time.sleep(30)", "print('done')")],
        capture_output=True, text=True, timeout=60, check=True,
    )  # fmt: skip
    assert done.stdout == "done\n"
    assert "ValueError: lost" in done.stderr


def test_an_archive_whose_making_was_broken_off_is_dropped_without_a_word(monkeypatch):
    said = []
    monkeypatch.setattr(sys, "unraisablehook", said.append)
    reraise_pending()
    half_made = zipfile.ZipFile.__new__(zipfile.ZipFile)
    del half_made
    assert said == []

    class Other:
        def __del__(self):
            raise AttributeError("a defect")

    other = Other()
    del other
    assert len(said) == 1


ENDED = """
import os, signal
from asperity.cli import interrupt
from asperity.runs.interrupt import Signals

number = signal.{name}
# A shell may have it ignored, as under nohup.
signal.signal(number, signal.default_int_handler if number == signal.SIGINT else signal.SIG_DFL)
interrupt.at_once(to_the_end=True)
interrupt.as_exception()
signals = Signals()
with signals.listening():
    {within}
for _ in range(5):
    os.kill(os.getpid(), number)
os._exit(3)
"""
NAMES = {"SIGINT": "interrupted", "SIGTERM": "terminated", "SIGHUP": "ended with its terminal",
         "SIGQUIT": "quit"}  # fmt: skip


@pytest.mark.slow
@pytest.mark.skipif(os.name != "posix", reason="needs signals")
@pytest.mark.parametrize("name", ["SIGINT", "SIGTERM", slow("SIGHUP"), slow("SIGQUIT")])
def test_what_ends_a_run_before_it_listens_is_told_and_nothing_ends_it_after(name):
    def ended(text):
        done = subprocess.run(
            [sys.executable, "-c", text], capture_output=True, text=True, timeout=60, check=False
        )
        return done.returncode, done.stderr

    text = ENDED.format(name=name, within="os.kill(os.getpid(), number)")
    assert ended(text) == (3, "")
    assert ended(text.replace("signals = ", "os.kill(os.getpid(), number)\nsignals = ")) == (
        130, f"{NAMES[name]}\n"
    )  # fmt: skip


def test_a_signal_is_told_whether_it_came_before_or_comes_after():
    signals, (hears, tells) = Signals(), os.pipe()
    os.set_blocking(hears, False)
    os.set_blocking(tells, False)
    try:
        with signals.listening():
            os.kill(os.getpid(), signal.SIGTERM)
            assert signals.heard == "terminated"
            with signals.told_to(tells):
                assert os.read(hears, 8) == bytes([signal.SIGTERM])
                os.kill(os.getpid(), signal.SIGINT)
                assert os.read(hears, 8) == bytes([signal.SIGINT])
        assert signals.heard == "terminated"
    finally:
        os.close(hears)
        os.close(tells)

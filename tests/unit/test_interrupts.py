"""Ctrl-C where nothing can be raised is heard all the same."""

import subprocess
import sys
import zipfile

from asperity.processes.interrupts import reraise_pending

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

"""Tasks in processes of their own, told to end."""

import os
import signal
import subprocess
import sys

import pytest

ASLEEP = """
import functools, time
from asperity.runs.workers import Task, done

if __name__ == "__main__":
    tasks = [Task(name, functools.partial(time.sleep, 120.0), "") for name in "ab"]
    for _ in done(tasks, 2, functools.partial(print, "asleep", flush=True)):
        pass
"""


@pytest.mark.slow
@pytest.mark.skipif(os.name != "posix", reason="nothing else has SIGTERM")
def test_told_to_end_it_leaves_nothing_that_python_would_warn_of(tmp_path):
    script = tmp_path / "asleep.py"
    script.write_text(ASLEEP)
    process = subprocess.Popen(
        [sys.executable, script], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    assert process.stdout.readline() == "asleep\n"
    process.send_signal(signal.SIGTERM)
    _, said = process.communicate(timeout=60.0)
    assert process.returncode == 128 + signal.SIGTERM
    assert said == ""

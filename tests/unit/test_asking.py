"""A question on a terminal stands alone, its units with it."""

import contextlib
import os
import sys
import threading

import pytest

pty = pytest.importorskip("pty")

PROGRAM = """
import threading, time
from asperity.cli.show import progress_bar
from asperity.tribometer.instruments.manual import Operator

with progress_bar("cells") as update:
    update(1, 7)
    time.sleep(0.3)
    over = threading.Event()

    def work():
        while not over.is_set():
            update(2, 7)
            time.sleep(0.01)

    beside = threading.Thread(target=work)
    beside.start()
    value = Operator().read("Weight [kg] of the steel disc", "kg")
    over.set()
    beside.join()
    time.sleep(0.3)
print(repr(value))
"""


@pytest.mark.slow
def test_a_bar_is_not_shown_over_a_question_which_keeps_its_brackets():
    child, end = pty.fork()
    if not child:
        os.execv(sys.executable, [sys.executable, "-c", PROGRAM])
    shown, asked = b"", b"[with its unit, such as '500 g' or '0.5 kg'] "
    deadline = threading.Timer(60.0, lambda: os.kill(child, 9))
    deadline.start()
    answered = 0
    with contextlib.suppress(OSError):
        while came := os.read(end, 4096):
            shown += came
            if not answered and asked in shown:
                # Whatever is drawn at ten times a second would be by then.
                threading.Event().wait(0.5)
                os.write(end, b"12.3 g\n")
                answered = len(shown)
    deadline.cancel()
    _, status = os.waitpid(child, 0)
    assert os.waitstatus_to_exitcode(status) == 0
    text = shown.decode()
    assert "Weight [kg] of the steel disc [with its unit" in text
    # Nothing but what was typed between the question and the answer.
    between = text.split(asked.decode())[1]
    assert between.lstrip().startswith("12.3 g")
    assert text.rstrip().endswith("0.0123")
    # The bar was there before, and is again behind.
    assert "1/7" in text.split("Weight")[0]
    assert "2/7" in between

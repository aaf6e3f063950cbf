"""Stages of a long work: how far it is told while one of them goes on, and what ends it."""

import threading

import pytest

from asperity.drive.root_stress import stages
from asperity.processes import interrupts
from asperity.runs import Interrupted, Run


def test_while_a_stage_goes_on_it_is_told_how_far_it_is(monkeypatch):
    monkeypatch.setattr(stages, "_TICK", 0.01)
    told, enough = [], threading.Event()

    def progress(done, total):
        told.append(done)
        assert total == 100
        # By the estimate the stage has ended, and it still goes on.
        if done >= 59:
            enough.set()

    made = stages.Stages(Run(progress=progress), [0.2, 0.4, 0.4])
    made.done()
    assert made.wait(lambda: enough.wait(20.0)) is True
    made.done()
    assert made.wait(lambda: "all") == "all"
    made.done()
    assert told == sorted(told)
    assert told[0] == 20
    assert told[-1] == 100
    assert len(set(told)) > 5
    assert max(each for each in told if each < 60) == 59


def test_what_fails_in_a_stage_fails_where_it_is_waited_for():
    def fail():
        raise ValueError("no such mesh")

    with pytest.raises(ValueError, match="no such mesh"):
        stages.Stages(Run(), [1.0]).wait(fail)


def test_a_stage_is_interrupted_while_it_goes_on(monkeypatch):
    monkeypatch.setattr(stages, "_TICK", 0.01)
    never = threading.Event()

    class Stopped(Run):
        def checkpoint(self, done, total, state=None, what="steps"):
            raise Interrupted("")

    with pytest.raises(Interrupted):
        stages.Stages(Stopped(), [1.0]).wait(lambda: never.wait(20.0))
    # Python's own end waits for nobody and crashes what calculates on: a command ends before that.
    assert interrupts.left_working.pop().is_alive()
    never.set()

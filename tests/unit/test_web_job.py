"""What ends a job of the page: its work, an error, or Ctrl-C wherever it comes in."""

import pytest

from asperity.runs.interrupt import stop_of


class _Interrupts:
    def __set_name__(self, owner, name):
        raise KeyboardInterrupt


def test_a_job_that_is_stopped_while_a_class_is_made_is_stopped():
    # As an import is interrupted that makes classes.
    with pytest.raises((KeyboardInterrupt, RuntimeError)) as caught:
        type("Made", (), {"field": _Interrupts()})
    assert stop_of(caught.value) is not None


def test_an_error_of_a_job_is_no_stop():
    assert stop_of(RuntimeError("of another kind")) is None

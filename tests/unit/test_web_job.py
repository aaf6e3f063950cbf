"""What ends a job of the page: its work, an error, or Ctrl-C wherever it comes in."""

import pytest

from asperity.errors import StorageError
from asperity.runs.interrupt import stop_of
from asperity.web.teller import JobTeller


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


def test_a_look_at_a_sweep_that_cannot_be_written_ends_nothing_and_is_told_once(tmp_path):
    class Grid:
        looks = 0

        def save(self, path):
            Grid.looks += 1
            raise StorageError(f"{path} cannot be written: no space left on device")

    told = []
    teller = JobTeller(None, None, tmp_path, lambda **what: told.append(what))
    for _ in range(2):
        teller.so_far(Grid)
    assert Grid.looks == 1
    (line,) = (one["note"] for one in told)
    assert line.endswith("no space left on device; goes on without")

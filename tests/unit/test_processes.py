"""Processes beside this one, and what one holds alone."""

import asyncio
import sys

import pytest

from asperity.errors import InputError
from asperity.processes import sessions
from asperity.processes.alone import alone
from asperity.web import jobs, warm_worker
from asperity.web.folder import Folder

SAYS = "is ours; take another"


def test_what_one_holds_another_is_refused_and_may_have_later(tmp_path):
    file = tmp_path / "held"
    told = pytest.raises(InputError, match=f"{tmp_path} {SAYS}")
    with alone(file, SAYS), told, alone(file, "theirs"):
        pass
    with alone(file, SAYS):
        assert file.read_text() == SAYS
    assert not file.exists()


def test_who_comes_before_the_holder_has_said_anything_is_told_all_the_same(tmp_path):
    fcntl = pytest.importorskip("fcntl")
    file = tmp_path / "held"
    with file.open("a+") as other:
        fcntl.flock(other, fcntl.LOCK_EX)
        with pytest.raises(InputError, match=SAYS), alone(file, SAYS):
            pass


def test_a_file_that_was_removed_since_it_was_opened_keeps_nobody_out(tmp_path, monkeypatch):
    fcntl = pytest.importorskip("fcntl")
    file, real = tmp_path / "held", fcntl.flock

    def removed_before(opened, how):
        # As when the one that held it gives it up between this one's opening and locking.
        monkeypatch.setattr(fcntl, "flock", real)
        file.unlink()
        real(opened, how)

    monkeypatch.setattr(fcntl, "flock", removed_before)
    with alone(file, SAYS), pytest.raises(InputError, match=SAYS), alone(file, SAYS):
        pass


def test_where_there_are_no_locks_nothing_is_held(tmp_path, monkeypatch):
    fcntl = pytest.importorskip("fcntl")

    def none(opened, how):
        raise OSError(37, "No locks available")

    monkeypatch.setattr(fcntl, "flock", none)
    with alone(tmp_path / "held", SAYS), alone(tmp_path / "held", SAYS):
        pass


def test_a_worker_that_could_not_begin_is_begun_at_the_next_question(tmp_path, monkeypatch):
    async def cannot(*_):
        raise OSError(11, "Resource temporarily unavailable")

    async def nobody():
        return False

    async def asked_twice():
        lookup = warm_worker.WarmWorker("lookup", tmp_path)
        with monkeypatch.context() as patched:
            patched.setattr(sessions, "begun", cannot)
            first = await lookup.ask("forms", b"{}", nobody)
        try:
            return first, await asyncio.wait_for(lookup.ask("forms", b"{}", nobody), 60.0)
        finally:
            await lookup.stop()

    (status, line), (then, _) = asyncio.run(asked_twice())
    assert status == 500
    assert b"does not begin" in line
    assert then != 500


_SAYS_TOO_MUCH = """
import json
print(json.dumps({"note": "x" * 200_000}), flush=True)
print("no object", flush=True)
for done in range(3000):
    print(json.dumps({"done": done + 1, "total": 3000}), flush=True)
"""


def test_a_job_that_says_too_much_at_once_is_heard_to_its_end(tmp_path, monkeypatch):
    async def begun(*_):
        return await asyncio.create_subprocess_exec(
            sys.executable, "-c", _SAYS_TOO_MUCH,
            stdin=asyncio.subprocess.PIPE, stdout=asyncio.subprocess.PIPE,
        )  # fmt: skip

    async def done():
        monkeypatch.setattr(jobs, "begun", begun)
        held = jobs.Jobs(Folder(tmp_path))
        held.submit("a" * 32, "line", {"command": "slide"})
        job = held.found("a" * 32)
        await asyncio.wait_for(job.task, 60.0)
        return job

    job = asyncio.run(done())
    assert (job.state, job.done) == ("done", 3000)


def test_what_is_begun_behind_an_ampersand_hears_no_ctrl_c(monkeypatch):
    import signal

    from asperity.processes.interrupts import hears_ctrl_c

    assert hears_ctrl_c()
    monkeypatch.setattr(signal, "getsignal", lambda _: signal.SIG_IGN)
    assert not hears_ctrl_c()

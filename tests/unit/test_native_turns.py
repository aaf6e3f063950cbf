"""Who makes which entry: one process at a time, of those that live."""

import errno
import fcntl
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from asperity.kernels.building import turns

KEY = "0" * 32
HOST = os.uname().nodename


@pytest.fixture
def pulse(monkeypatch):
    """Beats when it is told to; nothing is told yet."""
    pulse = turns._Pulse()
    monkeypatch.setattr(turns.kernel_folder, "_TOLD", set())
    monkeypatch.setattr(turns, "_pulse", lambda: pulse)
    return pulse


@pytest.fixture
def other(tmp_path):
    """Hold locks as another process does."""
    files = []

    def hold(name, host=HOST):
        files.append((tmp_path / name).open("wb", buffering=0))
        fcntl.flock(files[-1], fcntl.LOCK_EX)
        files[-1].write(f"4711 {host}".encode())

    yield hold
    for file in files:
        file.close()


def is_ours(folder):
    with turns.entry(folder, KEY) as ours:
        return ours


def test_an_entry_is_held_alone_and_its_lock_goes_with_it(tmp_path, pulse):
    with turns.entry(tmp_path, KEY) as ours:
        assert ours
        assert (tmp_path / f"{KEY}.lock").read_text() == f"{os.getpid()} {HOST}"
        assert not is_ours(tmp_path)
    assert not list(tmp_path.iterdir())
    assert not pulse.held


def test_what_is_held_is_touched(tmp_path, pulse):
    path = tmp_path / f"{KEY}.lock"
    with turns.entry(tmp_path, KEY), turns.turn(tmp_path, 1):
        for each in (path, tmp_path / "maker-0.lock"):
            os.utime(each, (1.0, 1.0))
        pulse.beat()
        assert path.stat().st_mtime > 1e9
        assert (tmp_path / "maker-0.lock").stat().st_mtime > 1e9


def test_who_shows_no_life_is_not_waited_for_and_told(tmp_path, pulse, other, caplog):
    other(f"{KEY}.lock")
    assert not is_ours(tmp_path)
    for _ in range(turns._BEATS - 1):
        pulse.beat()
        assert not is_ours(tmp_path)
    assert not caplog.messages
    pulse.beat()
    with turns.entry(tmp_path, KEY) as ours:
        assert ours
        # Of those beside it one does it.
        assert not is_ours(tmp_path)
    (told,) = caplog.messages
    assert told.startswith("process 4711 is at kernels that are wanted here and has stood still ")
    assert told.endswith("(fg, or kill -CONT 4711) or end it (kill -9 4711)")
    assert [path.name for path in tmp_path.iterdir()] == [f"{KEY}.lock"]


@pytest.mark.parametrize(
    ("host", "told"), [("elsewhere", "process 4711 on elsewhere is"), ("", "process 4711 is")]
)
def test_nobody_is_told_to_end_what_may_be_a_stranger_here(
    host, told, tmp_path, pulse, other, caplog
):
    other(f"{KEY}.lock", host)
    for _ in range(turns._BEATS):
        assert not is_ours(tmp_path)
        pulse.beat()
    assert is_ours(tmp_path)
    (line,) = caplog.messages
    assert line.startswith(told)
    assert "kill" not in line


def test_who_lives_is_waited_for_however_long_it_takes(tmp_path, pulse, other, caplog):
    other(f"{KEY}.lock")
    for second in range(3 * turns._BEATS):
        os.utime(tmp_path / f"{KEY}.lock", (second, second))
        pulse.beat()
        assert not is_ours(tmp_path)
    for _ in range(turns._BEATS):
        pulse.beat()
    # It goes on before anybody looks.
    os.utime(tmp_path / f"{KEY}.lock", (1e3, 1e3))
    assert not is_ours(tmp_path)
    assert not caplog.messages


def test_who_shows_no_life_has_no_turn_and_is_told_once(
    tmp_path, pulse, other, monkeypatch, caplog
):
    other("maker-0.lock")
    other("maker-1.lock")
    waited = []

    def sleep(seconds):
        waited.append(seconds)
        assert len(waited) <= turns._BEATS
        os.utime(tmp_path / "maker-1.lock", (len(waited), len(waited)))
        pulse.beat()

    monkeypatch.setattr(turns.time, "sleep", sleep)
    for _ in range(3):
        with turns.turn(tmp_path, 2):
            assert len(waited) == turns._BEATS
            held = {path.name for path in tmp_path.iterdir()}
            assert held == {f"maker-{n}.lock" for n in range(3)}
    (told,) = caplog.messages
    assert told.startswith("process 4711 is at kernels")


def test_a_lock_that_cannot_be_removed_is_let_go(tmp_path, pulse, monkeypatch):
    def unlink(path, **_options):
        raise OSError(errno.ESTALE, "Stale file handle")

    monkeypatch.setattr(Path, "unlink", unlink)
    assert is_ours(tmp_path)
    assert not pulse.held
    assert is_ours(tmp_path)


def test_a_lock_of_what_was_removed_meanwhile_is_none(tmp_path, pulse, other, monkeypatch):
    """Its holder went, and another began, between opening and locking."""
    flock = fcntl.flock

    def later(file, how):
        monkeypatch.setattr(fcntl, "flock", flock)
        (tmp_path / f"{KEY}.lock").unlink()
        other(f"{KEY}.lock")
        flock(file, how)

    monkeypatch.setattr(fcntl, "flock", later)
    assert not is_ours(tmp_path)
    assert not pulse.held


def test_where_the_disk_knows_no_locks_everybody_goes_on(tmp_path, pulse, monkeypatch):
    def flock(file, how):
        raise OSError(errno.ENOLCK, "No locks available")

    monkeypatch.setattr(fcntl, "flock", flock)
    with turns.entry(tmp_path, KEY) as ours, turns.turn(tmp_path, 1):
        assert ours
        assert is_ours(tmp_path)
        with turns.turn(tmp_path, 1):
            pass


HOLDS = """
import sys
from pathlib import Path
from asperity.kernels.building import turns
turns._BEAT = 0.01
with turns.entry(Path(sys.argv[1]), sys.argv[2]):
    print(flush=True)
    sys.stdin.read()
"""


def test_a_process_that_is_stopped_shows_no_life_until_it_goes_on(tmp_path, pulse):
    command = [sys.executable, "-c", HOLDS, str(tmp_path), KEY]
    pipe = subprocess.PIPE
    process = subprocess.Popen(command, stdin=pipe, stdout=pipe, text=True)
    try:
        assert process.stdout.readline() == "\n"
        process.send_signal(signal.SIGSTOP)
        os.waitpid(process.pid, os.WUNTRACED)
        for _ in range(turns._BEATS):
            assert not is_ours(tmp_path)
            pulse.beat()
        assert is_ours(tmp_path)
        process.send_signal(signal.SIGCONT)
        until = time.monotonic() + 60.0
        while is_ours(tmp_path) and time.monotonic() < until:
            time.sleep(0.01)
        assert not is_ours(tmp_path)
        process.communicate(timeout=60)
    finally:
        process.kill()
        process.communicate()
    assert process.returncode == 0
    assert not list(tmp_path.iterdir())


WAITS = """
import sys
from asperity.kernels.native import kept
from asperity.kernels.native.entries import listed
(entry,) = listed().named("asperity.slider.pressed.friction_limit")
kept.make([entry])
print(kept._obtained(entry).entry(entry.name)((0.5, 2.0)))
"""


@pytest.mark.slow
def test_a_command_goes_on_beside_a_process_that_is_stopped_and_says_so(tmp_path, other):
    """The locks are those of a process that does nothing; it was a wait for ever."""
    from asperity.kernels.native import keys
    from asperity.kernels.native.entries import listed

    (entry,) = listed().named("asperity.slider.pressed.friction_limit")
    folder = tmp_path / "asperity" / "kernels"
    folder.mkdir(parents=True, mode=0o700)
    for name in (keys.key(entry), *(f"maker-{n}" for n in range(8))):
        other(f"asperity/kernels/{name}.lock")
    done = subprocess.run(
        [sys.executable, "-c", WAITS],
        env=os.environ | {"ASPERITY_CACHE": str(tmp_path)},
        capture_output=True,
        text=True,
        timeout=200,
        check=False,
    )
    assert done.stdout == "0.25\n"
    (told,) = done.stderr.splitlines()
    assert told.startswith("process 4711 is at kernels that are wanted here and has stood still ")
    assert "kill -CONT 4711" in told

"""A guardian in a process that is forked, so that it costs no start, in time that it is given."""

import contextlib
import itertools
import mmap
import os
import signal
import struct
import subprocess
import threading
import time
import traceback
import types

from asperity.tribometer.guardian import backends, guard, guardian, in_time, process, verdicts
from asperity.tribometer.guardian.in_time import ScopeInTime

_close = os.close  # which a test may replace
_EVERY, _SHARP = 0.005, 0.002  # s between two beats, and what a computer with nothing to do is late


class OwnTime:
    """Seconds in which the computer gave this process its time.

    A bare heartbeat that is late, while this process itself did nothing, tells that others had the
    processor; so long its clock stands still.
    """

    def __init__(self):
        self._told = 0.0, time.monotonic() + _EVERY, time.process_time()
        threading.Thread(target=self._beat, daemon=True).start()

    def _lost(self):
        lost, due, busy = self._told
        worked = time.process_time() - busy
        return lost + max(0.0, time.monotonic() - due - _SHARP - worked)

    def _beat(self):
        while True:
            time.sleep(_EVERY)
            lost = self._lost()
            self._told = lost, time.monotonic() + _EVERY, time.process_time()

    def now(self):
        return time.monotonic() - self._lost()

    def lost(self):
        """How long it stood still so far, s."""
        return self._lost()


class Dials:
    """What guardians of a test go by, which the test turns while they are at work."""

    def __init__(self, **values):
        self._names = list(values)
        self._shared = mmap.mmap(-1, 8 * len(values))
        self.turn(**values)

    def turn(self, **values):
        for name, value in values.items():
            struct.pack_into("d", self._shared, 8 * self._names.index(name), value)

    def __getattr__(self, name):
        return struct.unpack_from("d", self._shared, 8 * self._names.index(name))[0]


def forked_guardians(dials, keep=(), begins=lambda number: None):
    """Let guardians of this process be forked, with dials.

    ``keep`` stays open in them; ``begins`` is called in each of them with its number.
    """
    numbers = itertools.count()

    class Popen:
        """What is used of the one in `subprocess`."""

        def __init__(self, _words, *, pass_fds=(), **_):
            (hears, tells), (reads, says) = os.pipe(), os.pipe()
            number = next(numbers)
            self.pid = os.fork()
            if not self.pid:
                _be_guardian(hears, says, {*pass_fds, *keep}, dials, lambda: begins(number))
            os.close(hears)
            os.close(says)
            self.stdin, self.stdout = os.fdopen(tells, "wb", 0), os.fdopen(reads, "rb", 0)
            self._ended = None

        def kill(self):
            if self._ended is None:
                os.kill(self.pid, 9)

        def wait(self, timeout=None):
            until = None if timeout is None else time.monotonic() + timeout
            while self._ended is None:
                gone, status = os.waitpid(self.pid, 0 if until is None else os.WNOHANG)
                if gone:
                    self._ended = os.waitstatus_to_exitcode(status)
                elif time.monotonic() > until:
                    raise subprocess.TimeoutExpired("guardian", timeout)
                else:
                    time.sleep(0.005)
            return self._ended

    class Dialled(ScopeInTime):
        _deadline = property(lambda self: dials.deadline, lambda self, _: None)

    in_time._OPENING = dials.opening
    backends.ScopeInTime = Dialled
    told = {name: getattr(subprocess, name) for name in ("PIPE", "TimeoutExpired")}
    guard.subprocess = types.SimpleNamespace(Popen=Popen, **told)


def _be_guardian(hears, says, keep, dials, begins):
    code = 70
    try:
        signal.set_wakeup_fd(-1)
        os.setsid()
        os.dup2(hears, 0)
        os.dup2(says, 1)
        # As one that is begun: nobody else's lines are open in it.
        for number in map(int, os.listdir("/dev/fd")):
            if number > 2 and number not in keep:
                with contextlib.suppress(OSError):
                    _close(number)
        begins()
        _dialled(dials)
        code = process.main()
    except BaseException:
        os.write(2, traceback.format_exc().encode())
    finally:
        os._exit(code)


def _dialled(dials):
    class Dialled(guardian.Guardian):
        def __init__(self, *given, **named):
            super().__init__(*given, **named)
            self._switching.limit = dials.limit

        _patience = property(lambda self: dials.patience, lambda self, _: None)
        _deadline = property(lambda self: dials.deadline, lambda self, _: None)

    guardian.Guardian = Dialled
    verdicts.OPENING = dials.opening
    process._clock = OwnTime().now

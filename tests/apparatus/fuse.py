"""Processes that are killed at a moment that is drawn: at a write, half of it done, or by time."""

import os
import signal

_CALLS = "write", "fsync", "ftruncate", "replace", "unlink", "close"
_REAL = {name: getattr(os, name) for name in _CALLS}


class Fuse:
    """Kills the process in which it is lit.

    Parameters
    ----------
    rng : random.Random
        Draws the moment.
    calls : int
        How many calls of the operating system that change files it may last.
    seconds : float
        How long it may last where it goes by processor time, s.
    """

    def __init__(self, rng, calls, seconds):
        self._by_time = rng.random() < 0.3
        self._call = rng.randint(1, calls)
        self._share = rng.random()
        self._seconds = rng.uniform(0.02, 1.0) * seconds
        self.says = f"{self._seconds:.3f} s" if self._by_time else f"call {self._call}"

    def light(self, first=lambda: None, count=None):
        """Begin; ``first`` is done before it kills, ``count`` takes every call."""
        if self._by_time and count is None:
            # Nothing hears this signal: it ends the process wherever it stands, as kill -9 does.
            signal.signal(signal.SIGPROF, signal.SIG_DFL)
            signal.setitimer(signal.ITIMER_PROF, self._seconds)
            return
        left = [self._call]

        def fused(name, real):
            def call(*given, **named):
                left[0] -= 1
                if count is not None:
                    count()
                elif left[0] == 0:
                    if name == "write":
                        real(given[0], bytes(given[1])[: int(self._share * len(given[1]))])
                    elif self._share > 0.5:
                        real(*given, **named)
                    first()
                    os.kill(os.getpid(), signal.SIGKILL)
                return real(*given, **named)

            return call

        for name, real in _REAL.items():
            setattr(os, name, fused(name, real))

    def put_out(self):
        """Let a process that was forked from the one in which it burns live."""
        for name, real in _REAL.items():
            setattr(os, name, real)

"""The guardian's process: ``python -m asperity.tribometer.guardian.process``.

It is a session of its own, so that no terminal takes it along. Its standard input and output lead
to the procedure; a pipe beside these brings the numbers of the procedure's signals, as they come.
"""

import contextlib
import os
import queue
import signal
import sys
import threading
import time
from pathlib import Path
from typing import Any

from asperity.tribometer.guardian.wire import Wire

SIGNALS = tuple(
    number for name in ("SIGHUP", "SIGINT", "SIGQUIT", "SIGTERM", "SIGBREAK")
    if (number := getattr(signal, name, None)) is not None
)  # fmt: skip
"""That end a run."""


class _HeldSignals:
    """Takes signals from the first moment on; the guardian hears of them when it is there."""

    def __init__(self) -> None:
        self.early: list[int] = []
        self.tell: Any = self.early.append
        for number in SIGNALS:
            signal.signal(number, self._hear)

    def _hear(self, number: int, _frame: object) -> None:
        self.tell(number)


class _Words:
    """Lines for a person; a terminal that takes none keeps nobody waiting."""

    def __init__(self) -> None:
        self._lines: queue.SimpleQueue[str | None] = queue.SimpleQueue()
        self._ended = threading.Event()
        threading.Thread(target=self._write, daemon=True).start()

    def say(self, line: str) -> None:
        self._lines.put(line)

    def end(self) -> None:
        self._lines.put(None)
        self._ended.wait(1.0)

    def _write(self) -> None:
        while (line := self._lines.get()) is not None:
            with contextlib.suppress(OSError):
                os.write(2, f"guardian: {' '.join(line.split())}\n".encode(errors="replace"))
        self._ended.set()


def _clock() -> float:
    """Return seconds that go on while the computer sleeps, where it has such a clock."""
    which = getattr(time, "CLOCK_BOOTTIME", None)
    return time.monotonic() if which is None else time.clock_gettime(which)


def main() -> int:
    """Guard until the procedure has ended; returns 0, or 4 where something may be on."""
    held = _HeldSignals()
    wire = Wire(os.fdopen(os.dup(0), "rb", 0), os.fdopen(os.dup(1), "wb", 0))
    # What a driver prints is nobody's answer.
    os.dup2(2, 1)
    first = wire.receive()
    if first is None:
        return 0
    told = first[0]
    words = _Words()
    from asperity.tribometer.guardian.casing import cased
    from asperity.tribometer.guardian.devices import deadline_of, devices_of, owned_by
    from asperity.tribometer.guardian.guardian import Guardian
    from asperity.tribometer.guardian.relay import Relay
    from asperity.tribometer.instruments.off import said
    from asperity.tribometer.instruments.parameters import Guard

    case, backend = cased(told["case"]), told["backend"]
    table = case.get(Guard, Guard())
    relay, trouble = None, ""
    if table.relay_port:
        # Before all else: without it nothing has power to answer with.
        try:
            relay = Relay(table)
            relay.hold()
        except Exception as error:
            trouble = said(error)
            words.say(trouble)
    rig = None if told["rig"] is None else (int(told["rig"][0]), str(told["rig"][1]))
    simulated = backend == "sim"
    guardian = Guardian(
        devices_of(case, backend, rig), owned_by(case, backend)[1], wire,
        patience=table.patient(simulated=simulated),
        deadline=deadline_of(case, simulated=simulated), say=words.say, relay=relay,
        now=_clock, trouble=trouble, folder=Path(told["folder"]) if told.get("folder") else None,
        since=told["since"], ended_by=told["ended_by"],
    )  # fmt: skip
    for number in held.early:
        guardian.signal(number)
    held.tell = guardian.signal
    if told["signals"] is not None:
        threading.Thread(target=_watch, args=(told["signals"], guardian), daemon=True).start()
    threading.Thread(target=_hear, args=(wire, guardian), daemon=True).start()
    code = guardian.work()
    words.end()
    return code


def _hear(wire: Wire, guardian: Any) -> None:
    while (message := wire.receive()) is not None:
        guardian.message(message[0])
    guardian.deserted()


def _watch(pipe: int, guardian: Any) -> None:
    with contextlib.suppress(OSError):
        while came := os.read(pipe, 1):
            if came[0] in SIGNALS:
                guardian.signal(came[0])


if __name__ == "__main__":
    ended = main()
    sys.stderr.flush()
    # A thread that a driver never returns to would keep it.
    os._exit(ended)

"""The procedure's end of the line to its guardian."""

import contextlib
import json
import os
import queue
import subprocess
import sys
import threading
import time
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from asperity.casefile import Case
from asperity.processes.began import began
from asperity.processes.interrupts import hears_ctrl_c
from asperity.tribometer.guardian import wire as wires
from asperity.tribometer.guardian.casing import packed
from asperity.tribometer.guardian.devices import deadline_of, owned_by
from asperity.tribometer.guardian.guardian import BEAT
from asperity.tribometer.guardian.journal import Journal, Lines
from asperity.tribometer.guardian.rig import Address
from asperity.tribometer.guardian.switching import LISTENING, longest
from asperity.tribometer.guardian.verdicts import CTRL_C
from asperity.tribometer.guardian.wire import Head, Wire
from asperity.tribometer.instruments.parameters import Guard as Table
from asperity.tribometer.instruments.protocols import SWITCHED_OFF, InstrumentError, StillOnError
from asperity.tribometer.journal_lines import ENDED, NAME, Line

LOST = "guardian lost"  #: Kind of the error where the guardian is there no more.
_STOP = "a file .stop in the run's folder"
_STARTING = 60.0  # s that it may take to begin
_UNANSWERED = 5.0  # s without an answer, after which nothing more is told
_SLACK = 1.0  # s that a busy computer may need
_ENDING = 15.0  # s that it may take to end


class Guard:
    """The guardian as the procedure sees it.

    Parameters
    ----------
    case : Case
        The configuration.
    backend : str
        Which instruments.
    rig : tuple, optional
        Where a simulated rig is.
    folder : Path, optional
        Of the run: what was not read back to be off is written there whatever becomes of it.

    Attributes
    ----------
    generation : int
        Which guardian it is: another is begun where one is lost.
    """

    def __init__(
        self, case: Case, backend: str, rig: Address | None, folder: Path | None = None
    ) -> None:
        where = None if folder is None else str(folder.absolute())
        self._told: dict[str, Any] = {
            "case": packed(case),
            "backend": backend,
            "rig": rig,
            "folder": where,
        }
        self._told |= {"since": began(), "ended_by": CTRL_C if hears_ctrl_c() else _STOP}
        table, simulated = case.get(Table, Table()), backend == "sim"
        # two attempts, the second as the end comes
        busy = 2.0 * longest(deadline_of(case, simulated=simulated))
        self._limit = _SLACK + busy + table.patient(simulated=simulated)
        self._owned = tuple(owned_by(case, backend)[0].values())
        self.generation = 0
        self._heard, self._signals = os.pipe() if os.name == "posix" else (-1, -1)
        if self._signals >= 0:
            os.set_blocking(self._signals, False)
        self._start()

    def _start(self) -> None:
        self.generation += 1
        self._tripped, self._kind = "", SWITCHED_OFF
        self._found: Mapping[str, Any] | None = None
        self._number = 0
        self._waiting: float | None = None
        self._answered = time.monotonic()
        self._answers: queue.SimpleQueue[Head | None] = queue.SimpleQueue()
        passed: dict[str, Any] = {"pass_fds": (self._heard,)} if self._heard >= 0 else {}
        try:
            self._process = subprocess.Popen(
                [sys.executable, "-P", "-m", "asperity.tribometer.guardian.process"],
                bufsize=0, stdin=subprocess.PIPE, stdout=subprocess.PIPE, start_new_session=True,
                **passed,
            )  # fmt: skip
        except OSError as error:
            raise InstrumentError(f"no guardian can be started: {error}", kind=LOST) from None
        self._wire = Wire(self._process.stdout, self._process.stdin)
        with contextlib.suppress(OSError):
            pipe = self._heard if self._heard >= 0 else None
            self._wire.send(self._told | {"signals": pipe})
        threading.Thread(target=self._hear, args=(self._wire, self._answers), daemon=True).start()

    @property
    def signals(self) -> int:
        """A pipe that takes numbers of signals, -1 where there is none."""
        return self._signals

    @property
    def process(self) -> int:
        """Number of its process."""
        return self._process.pid

    def _hear(self, wire: Wire, answers: "queue.SimpleQueue[Head | None]") -> None:
        while (message := wire.receive()) is not None:
            head = message[0]
            # Whatever it says, it is there.
            self._waiting, self._answered = None, time.monotonic()
            if "tripped" in head:
                self._kind, self._tripped = head["kind"], head["tripped"]
            elif "n" in head:
                answers.put(head)
        wire.deaf()
        answers.put(None)

    def ask(self, to: str, do: str, *arguments: Any) -> Any:
        """Return what an object of the guardian gives; raises what it raises."""
        self.begun()
        return self._ask(self._limit, to, do, arguments)

    def ask_bytes(self, to: str, do: str, *arguments: Any) -> tuple[Any, bytes]:
        """Return the same; a guardian has no bytes to give."""
        return self.ask(to, do, *arguments), b""

    def _ask(self, limit: float, to: str, do: str, arguments: Sequence[Any]) -> Any:
        self._number += 1
        self._send({"to": to, "do": do, "with": list(arguments), "n": self._number})
        while True:
            try:
                answer = self._answers.get(timeout=0.5 * BEAT)
            except queue.Empty:
                # Who waits for it is there as well.
                self._send(_HERE)
                self._look(limit)
                continue
            if answer is None:
                raise self._lost("has ended")
            if answer["n"] == self._number:
                return wires.given(answer)

    def beat(self) -> None:
        """Tell that the procedure goes on; raises InstrumentError where the guardian does not.

        Raises
        ------
        InstrumentError
            It has switched everything off, or is there no more.
        """
        self._send(_HERE)
        self._look(self._limit)
        if error := self.switched_off():
            raise error

    def here(self) -> None:
        """Tell that the procedure goes on, whatever has become of the guardian."""
        with contextlib.suppress(OSError, ValueError):
            self._wire.send(_HERE)

    @contextlib.contextmanager
    def beating(self) -> Iterator[None]:
        """Tell that the procedure goes on while it waits for a person, everything off."""
        left, begun = threading.Event(), time.monotonic()
        wire = self._wire

        def beat() -> None:
            # Whether the guardian is there is for whoever asks it next to find.
            with contextlib.suppress(OSError, ValueError):
                while not left.wait(BEAT):
                    # One that stands still would leave its end of the line to fill up.
                    if time.monotonic() - max(begun, self._answered) < _UNANSWERED:
                        wire.send(_HERE)

        threading.Thread(target=beat, name="beat", daemon=True).start()
        try:
            yield
        finally:
            left.set()

    def switched_off(self) -> InstrumentError | None:
        """Return why the guardian has switched everything off unasked, as far as it has told."""
        if not self._tripped:
            return None
        return InstrumentError(f"everything was told to be off: {self._tripped}", kind=self._kind)

    def _send(self, head: Head) -> None:
        if self._waiting is None:
            self._waiting = time.monotonic()
        try:
            self._wire.send(head)
        except (OSError, ValueError):
            raise self._lost("has ended") from None

    def _look(self, limit: float) -> None:
        waiting = self._waiting
        if waiting is not None and time.monotonic() - waiting > limit:
            raise self._lost(f"has said nothing for {limit:g} s")

    def _lost(self, why: str) -> InstrumentError:
        self._hang_up()
        return InstrumentError(
            f"the guardian, which holds the outputs, {why}; another one switches them off",
            kind=LOST,
        )

    def _hang_up(self) -> None:
        # One that stands still would hold the instruments' lines.
        with contextlib.suppress(OSError):
            self._process.kill()
        self._process.wait()
        self._wire.close()

    def begun(self) -> Mapping[str, Any]:
        """Return what was read back when it made everything safe, which is its first act.

        Raises
        ------
        StillOnError
            It has ended meanwhile.
        """
        if self._found is None:
            try:
                self._found = self._ask(_STARTING, "guardian", "started", ())
            except InstrumentError as error:
                if error.kind != LOST:
                    raise
                why = "the guardian, which switches off, has ended as it began"
                raise StillOnError.of(why, LOST, self._owned) from None
        return dict(self._found)

    def off(self, why: str, *, listen: bool) -> Mapping[str, Any]:
        """Have everything switched off and read back; by another guardian where one is lost."""
        try:
            return dict(self._ask(self._limit + LISTENING, "guardian", "off", (why, listen)))
        except InstrumentError as error:
            if error.kind != LOST:
                raise
        try:
            self._start()
            return self.begun()
        except InstrumentError as error:
            return {"still_on": [f"{name}: {error}" for name in self._owned]}

    def close(self) -> None:
        """Let it end, everything off."""
        with contextlib.suppress(InstrumentError):
            self._ask(self._limit, "guardian", "goodbye", ())
        with contextlib.suppress(OSError, AttributeError):
            self._process.stdin.close()  # type: ignore[union-attr]
        for pipe in (self._heard, self._signals):
            if pipe >= 0:
                os.close(pipe)
        self._heard = self._signals = -1
        # One that still tries to switch something off is left to it.
        with contextlib.suppress(subprocess.TimeoutExpired):
            self._process.wait(_ENDING)


_HERE: Head = {"to": "guardian", "do": "beat"}


class GuardedJournal(Lines):
    """A journal that the guardian writes, whom nothing that ends the procedure reaches.

    Parameters
    ----------
    guard : Guard
        Who writes.
    folder : Path
        Of the run.
    """

    def __init__(self, guard: Guard, folder: Path) -> None:
        self.path = folder / NAME
        self._guard = guard
        self._generation = 0
        self.lines: list[Line] = []
        self._open()

    def _open(self) -> None:
        if self._generation != self._guard.generation:
            self.lines = self._guard.ask("journal", "open", str(self.path.parent.absolute()))
            self._generation = self._guard.generation

    def write(self, kind: str, **what: Any) -> Line:
        """Write a line and bring it to the disk; how a run ends also where no guardian is left."""
        # Numbers of arrays are plain ones in JSON.
        plainly = json.loads(json.dumps(what, allow_nan=False))
        try:
            self._open()
            line: Line = self._guard.ask("journal", "write", kind, plainly)
        except InstrumentError as error:
            if error.kind != LOST or kind not in ENDED:
                raise
            book = Journal(self.path.parent)
            try:
                line = book.write(kind, **plainly)
            finally:
                book.close()
        self.lines.append(line)
        return line

    def close(self, *, finished: bool = False) -> None:
        """Let go of the file."""
        with contextlib.suppress(InstrumentError):
            self._open()
            self._guard.ask("journal", "close", finished)

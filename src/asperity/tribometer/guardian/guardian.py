"""The guardian: does with the outputs what the procedure asks, and switches off when it must.

Everything that happens comes to it as an event in one queue: a message, an answer of an instrument,
a signal, the end of the procedure. It waits for nothing but these, and for no longer than until the
next heartbeat is due.
"""

import concurrent.futures as cf
import contextlib
import queue
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from asperity import exit_codes
from asperity.tribometer.guardian import wire as wires
from asperity.tribometer.guardian.alarm import Alarm
from asperity.tribometer.guardian.owned import LISTENER, Device, PendingRequest, Verdict
from asperity.tribometer.guardian.relay import Relay
from asperity.tribometer.guardian.stop import StopButton, named
from asperity.tribometer.guardian.switching import Switching, longest
from asperity.tribometer.guardian.verdicts import CTRL_C, NOBODY, NOT_YET, Verdicts
from asperity.tribometer.guardian.wire import Head, Wire
from asperity.tribometer.guardian.writing import Writing
from asperity.tribometer.instruments.off import said
from asperity.tribometer.instruments.protocols import STOPPED, SWITCHED_OFF, InstrumentError

BEAT = 0.1  #: s
_POLLED = 0.5  # s between two looks at a supply that is on
_AGAIN = 1.0  # s between two attempts at what was not read back
_TRIES = 3  # at switching off where it fails itself
_ATTEMPTS = 10  # of these, when the procedure has ended
_WRITTEN = 60.0  # s that the end waits for the journal and for recordings
_CLOSED = 0.5  # s that it waits for a device to be let go of
_LEAVING = 20.0  # s that a procedure which was told to end may take until it has all read back
_STOPPED = "somebody asks for a stop"


class Guardian:
    """Owns outputs.

    Parameters
    ----------
    devices : sequence of Device
        What it owns.
    by_hand : sequence of str
        Names of outputs that only a person can switch off.
    wire : Wire
        To the procedure.
    patience, deadline : float
        How long the procedure may be silent while something is on, and an instrument, s.
    say : callable
        Tells a person at the terminal; must not wait.
    relay : Relay, optional
        Cuts the power.
    trouble : str
        Why there is none, where there should be.
    folder : Path, optional
        Of the run, where its journal is, or will be.
    since : float, optional
        When the run's command was given, in seconds since 1970; left out, now.
    ended_by : str
        What a person can end it by.
    now : callable
        The computer's clock, s; it goes on while the computer sleeps.
    """

    def __init__(
        self,
        devices: Sequence[Device],
        by_hand: Sequence[str],
        wire: Wire,
        *,
        patience: float,
        deadline: float,
        say: Callable[[str], None],
        relay: Relay | None = None,
        trouble: str = "",
        folder: Path | None = None,
        since: float | None = None,
        ended_by: str = CTRL_C,
        now: Callable[[], float] = time.monotonic,
    ) -> None:
        self._devices = devices
        self._by_hand = tuple(by_hand)
        self._wire = wire
        self._patience, self._deadline = patience, deadline
        self._say = say
        self._alarm, self._trouble = Alarm(say, relay), trouble
        self._now = now
        self._of = {key: device for device in devices for key in device.keys}
        self._events: queue.SimpleQueue[Callable[[], None]] = queue.SimpleQueue()
        self._tripped, self._urgent = "", False
        self._pulses = True
        self._stop_button = StopButton(self.stop, since)
        self._writing = Writing(self._stop_button.watch, folder)
        self._switching = Switching(
            devices, by_hand, limit=longest(deadline), now=now, tick=self._tick
        )
        self._verdicts = Verdicts(
            self._switching, self._writing, self._alarm, by_hand, say, now, ended_by
        )
        self._awaited: dict[cf.Future[Any], PendingRequest] = {}
        self._on: set[str] = set()
        self._kind = SWITCHED_OFF
        self._switched = True  # whether that has had everything told to be off
        self._deserted: float | None = None
        self._failures = 0
        self._heard = self._looked = now()
        self._orderly = False
        self._left: int | None = None

    def signal(self, number: int) -> None:
        """Take a signal, as often as it comes; may be called from its handler."""
        came, self._urgent = self._now(), True
        self._events.put(lambda: self._trip(f"signal {named(number)}", came, wrong=False))

    def stop(self) -> None:
        """Take that somebody asks for an end; may be called from any thread."""
        came, self._urgent = self._now(), True
        self._events.put(lambda: self._trip(_STOPPED, came, kind=STOPPED, wrong=False))

    def message(self, head: Head) -> None:
        """Take a message of the procedure; may be called from any thread."""
        came = self._now()
        self._events.put(lambda: self._take(head, came))

    def deserted(self) -> None:
        """Take that the procedure is there no more; may be called from any thread."""
        came, self._urgent = self._now(), True
        self._events.put(lambda: self._end(came))

    def work(self) -> int:
        """Make everything safe, then guard until the procedure has ended; returns an exit code."""
        try:
            self._verdicts.first(lambda: self._urgent)
        except Exception as error:
            self._failed(error)
        while self._left is None:
            try:
                self._next()
                self._look()
            except Exception as error:
                self._failed(error)
        self._close()
        return self._left

    def _failed(self, error: Exception) -> None:
        """Switch off after an error; where that fails itself, cut the power and name all."""
        # Of ours: whatever it is, nothing is to stay on.
        ours = "" if isinstance(error, InstrumentError) else "a fault of the guardian: "
        for _ in range(_TRIES):
            try:
                self._trip(f"{ours}{said(error)}", self._now())
            except Exception as again:
                error = again
            if self._switched:
                break
        else:
            self._name_all(error)
        if self._deserted is not None:
            # Nothing else would end it.
            self._failures += 1
            time.sleep(_AGAIN)
            self.deserted()
            if self._failures >= _ATTEMPTS:
                self._name_all(error)
                self._left = exit_codes.STILL_ON

    def _name_all(self, error: Exception) -> None:
        names = *(self._called(key) for key in self._of if key != LISTENER), *self._by_hand
        with contextlib.suppress(Exception):
            self._verdicts.fail(self._tripped, names, error)

    def _next(self) -> None:
        """Take what has come."""
        try:
            event = self._events.get(timeout=0.5 * BEAT)
        except queue.Empty:
            return
        event()

    def _look(self) -> None:
        """See that nothing is late."""
        now = self._now()
        if self._tripped:
            self._pulse()
            if now - self._verdicts.tried > _AGAIN:
                if self._switched:
                    self._verdicts.again()
                else:
                    self._trip(self._tripped, self._verdicts.event)
            return
        if self._on and now - self._heard > self._patience:
            silent = f"the procedure has said nothing for {now - self._heard:.2g} s"
            self._trip(silent, self._heard, unasked=NOBODY)
            return
        for future, asked in list(self._awaited.items()):
            if now - asked.since > self._deadline and not future.done():
                del self._awaited[future]
                said_late = f"{asked.what} has not answered within {self._deadline:g} s"
                self._fault(asked, InstrumentError(said_late, kind="late"), asked.since)
                return
        self._pulse()
        if now - self._looked > _POLLED:
            self._looked = now
            # What is slow to answer is not asked ever more.
            waits = {asked.what for asked in self._awaited.values()}
            for key in self._on - {"vibration"}:
                if self._called(key) in waits:
                    continue
                self._begin(0, key, lambda one: one.reading())
        # Where it hears nothing the procedure may stand still, and its end of the line be full.
        if now - self._heard < 10.0 * BEAT:
            self._send({"here": True})

    def _pulse(self) -> None:
        """Show a watchdog that somebody is there, as long as nothing has been found wrong.

        Who is told to stop reads back first: without power nothing answers.
        """
        if self._tripped and self._now() - self._verdicts.event > _LEAVING:
            self._pulses = False
        if self._pulses:
            self._alarm.pulse()

    def _tick(self) -> None:
        # Switching off goes on without a relay; whoever looks next finds that it is lost.
        with contextlib.suppress(Exception):
            self._pulse()

    def _take(self, head: Head, came: float) -> None:
        self._heard = came
        name, number = head["to"], head.get("n", 0)
        if name == "guardian":
            self._asked_itself(head["do"], number, head.get("with", ()), came)
        elif name == "journal":
            future = self._writing.asked(head)
            future.add_done_callback(lambda ended: self._events.put(
                lambda: self._send(wires.answered(number, ended.result)[0])
            ))  # fmt: skip
        elif self._tripped:
            self._send(wires.failed(number, self._off_already()))
        elif name not in self._of:
            self._send(wires.failed(number, InstrumentError(f"nobody owns {name}")))
        else:
            if head["do"] == "on":
                self._on.add(name)
            verb, given = head["do"], head.get("with", ())
            self._begin(number, name, lambda one: getattr(one, verb)(*given))

    def _asked_itself(self, verb: str, number: int, arguments: Sequence[Any], came: float) -> None:
        if verb == "beat":
            waits = any(asked.what == self._called("vibration") for asked in self._awaited.values())
            if "vibration" in self._on and not self._tripped and not waits:
                self._begin(0, "vibration", lambda one: one.keep_alive())
        elif verb == "started":
            last = self._verdicts.last
            assert last is not None
            trouble = self._trouble or self._alarm.cut
            told = last.line() | ({"trouble": trouble} if trouble else {})
            self._send({"n": number, "gave": told})
        elif verb == "off":
            why, listen = arguments
            # Switched off already it has its line, and who asks again may have waited for that.
            event = self._now() if self._tripped else came
            found = self._off(why, event, listen=listen, last=listen)
            # Then all is read back that is to be.
            self._pulses = self._pulses and not (self._tripped and listen)
            self._send({"n": number, "gave": found.line()})
        elif verb == "goodbye":
            self._orderly = True
            self._send({"n": number, "gave": None})

    def _begin(self, number: int, key: str, act: Callable[[Any], Any]) -> None:
        asked = PendingRequest(number, self._called(key), self._now())
        future = self._of[key].begin(key, act)
        self._awaited[future] = asked

        def answered(ended: "cf.Future[Any]") -> None:
            came = self._now()
            self._events.put(lambda: self._answered(ended, came))

        future.add_done_callback(answered)

    def _answered(self, future: "cf.Future[Any]", came: float) -> None:
        asked = self._awaited.pop(future, None)
        if asked is None:
            return
        error = future.exception()
        if error is not None:
            self._fault(asked, error, came)
        elif asked.number:
            self._send(wires.answered(asked.number, future.result)[0])

    def _fault(self, pending: PendingRequest, error: BaseException, event: float) -> None:
        """Tell of an instrument that is late or lost, and switch off."""
        if pending.number:
            self._send(wires.failed(pending.number, error))
        self._trip(str(error), event)

    def _trip(
        self, why: str, event: float, kind: str = SWITCHED_OFF, unasked: str = NOT_YET, *,
        wrong: bool = True,
    ) -> None:  # fmt: skip
        """Switch everything off, for good; ``wrong``: by a fault, with which a watchdog opens."""
        self._pulses = self._pulses and not wrong
        if self._tripped and self._switched:
            return
        if not self._tripped:
            self._tripped, self._kind = why, kind
            self._verdicts.began(event)
        why, event = self._tripped, self._verdicts.event
        self._verdicts.tried, self._switched = self._now(), False
        found = self._off(why, event, listen=False, unasked=unasked)
        self._switched = True
        self._send({"tripped": why, "kind": kind, "still_on": found.still_on})

    def _off(
        self, why: str, event: float, *, listen: bool, unasked: str = "", last: bool = True
    ) -> Verdict:
        """Switch everything off; ``last``: nobody will listen afterwards."""
        for future, asked in self._awaited.items():
            # What an instrument has not begun is not to be waited for.
            answered = not future.cancel() and future.done()
            if answered and asked.number:
                self._send(wires.answered(asked.number, future.result)[0])
            elif asked.number:
                self._send(wires.failed(asked.number, self._off_already()))
        self._awaited.clear()
        found = self._verdicts.off(why, event, listen=listen, unasked=unasked, last=last)
        self._on.clear()
        return found

    def _end(self, came: float) -> None:
        """Leave, everything off."""
        self._deserted, verdicts = came, self._verdicts
        last = verdicts.last
        if self._orderly and last is not None and not last.unheard and not self._on:
            self._left = exit_codes.STILL_ON if last.still_on else exit_codes.DONE
            return
        # Who took its leave has told a person what was not off, and was itself told of it.
        attempts = 0 if self._orderly and not self._on else _ATTEMPTS
        if not self._tripped:
            verdicts.began(came)
        ended = "the procedure has ended" + ("" if self._orderly else " without a word")
        why = self._tripped = self._tripped or ended
        self._switched = self._pulses = False
        found = self._off(why, came, listen=False, unasked=NOBODY, last=LISTENER not in self._of)
        self._switched = True
        if LISTENER in self._of:
            heard = f"{why}, and the drive signal is heard"
            found = self._off(heard, self._now(), listen=True, unasked=NOBODY)
        self._writing.end(why, found)
        for _ in range(attempts if any(self._of) else 0):
            if verdicts.last is None or not verdicts.last.still_on:
                break
            time.sleep(_AGAIN)
            if not verdicts.again(listen=True):
                break
        seconds = verdicts.took
        if verdicts.last is None or seconds is None:
            self._left = exit_codes.STILL_ON
            return
        self._say(f"{why}; read back to be off within {seconds:.2g} s: {verdicts.last.names}")
        self._left = exit_codes.DONE

    def _close(self) -> None:
        """Let go of everything; what does not let go is left."""
        self._stop_button.leave()
        written = self._writing.all_written()
        cf.wait([device.close() for device in self._devices], timeout=_CLOSED)
        cf.wait([written], timeout=_WRITTEN)
        self._alarm.close()

    def _off_already(self) -> InstrumentError:
        return InstrumentError(
            f"everything was told to be off: {self._tripped or 'asked for'}", kind=self._kind
        )

    def _called(self, key: str) -> str:
        return self._of[key].keys[key] if key in self._of else key

    def _send(self, head: Head) -> None:
        # Its end is read, and told, elsewhere.
        with contextlib.suppress(OSError, ValueError):
            self._wire.send(head)

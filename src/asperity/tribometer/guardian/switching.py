"""Everything switched off in its order and read back, within a time that nothing can stretch."""

import concurrent.futures as cf
import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

from asperity.tribometer.guardian.owned import LISTENER, STAGES, Device, Verdict
from asperity.tribometer.instruments import off
from asperity.tribometer.instruments.off import Off
from asperity.tribometer.instruments.protocols import InstrumentError

_LIMIT = 0.8  # s, after which what was not read back is named
LISTENING = 5.0  #: s that an oscilloscope may take to be opened and to hear.
_STAGE = 0.1  # s that an output may keep those of the next stage waiting.
_AGAIN = 0.02  # s until what was not found off is told and asked again.

Clock = Callable[[], float]


def longest(deadline: float) -> float:
    """Return how long switching off may take, s, where an answer may take a deadline."""
    return max(_LIMIT, deadline)


class Switching:
    """Switches the outputs of some devices off.

    Parameters
    ----------
    devices : sequence of Device
        All that is owned.
    by_hand : sequence of str
        Names of outputs that only a person can switch off.
    limit : float
        How long it is tried, s; what is not off by then is named.
    now : callable
        The computer's clock, s.
    tick : callable
        Called every now and then while it waits, ten times a second at least.

    Attributes
    ----------
    limit : float
        As given.
    """

    def __init__(
        self,
        devices: Sequence[Device],
        by_hand: Sequence[str] = (),
        *,
        limit: float = _LIMIT,
        now: Clock = time.monotonic,
        tick: Callable[[], None] = lambda: None,
    ) -> None:
        self.limit = limit
        self._tick = tick
        self._devices = devices
        self._by_hand = by_hand
        self._now = now
        self._of = {key: device for device in devices for key in device.keys}
        self._moved = False  # as it was heard last

    def off(
        self,
        why: str,
        event: float,
        *,
        limit: float | None = None,
        listen: bool,
        unasked: str = "",
        meanwhile: Callable[[Verdict], bool] = lambda _: False,
    ) -> Verdict:
        """Switch everything off, and read back that it is.

        Parameters
        ----------
        why : str
            The reason.
        event : float
            When it was noticed, s.
        limit : float, optional
            Another time than usual, s.
        listen : bool
            Whether the drive signal may be listened to: nobody else uses the oscilloscope.
        unasked : str
            Why no person has been asked to switch off what only a person can; none, where the
            procedure asks.
        meanwhile : callable, optional
            Takes what is found so far, at every look; ends it by returning True.
        """
        end = self._now() + (self.limit if limit is None else limit)
        safes: dict[str, cf.Future[Any]] = {}
        for device in self._devices:
            device.open_again()
        for stage in STAGES:
            begun = {key: self._safe(key) for key in stage if key in self._of}
            safes |= begun
            cf.wait(begun.values(), timeout=min(_STAGE, max(0.0, end - self._now())))
            self._tick()
        came: dict[str, float] = {}
        asked = {key: self._read(key, came) for key in safes}
        known: dict[str, Any] = {}
        listens = listen and LISTENER in self._of and "vibration" in self._of
        patient = self._now() + LISTENING
        while True:
            self._tick()
            # Heard before its command was taken, a drive that is still may yet begin.
            if listens and LISTENER not in asked and asked["vibration"].done():
                asked[LISTENER] = self._read(LISTENER, came)
            answered = [key for key, future in asked.items() if future.done()]
            # Of what was asked again, what it answered last.
            known |= {key: _result_or_error(asked[key]) for key in answered}
            if isinstance(known.get(LISTENER), bool):
                self._moved = known[LISTENER]
            listening = LISTENER in asked and LISTENER not in known
            found = self._found(asked, known, ear="asked" if listening else "")
            # What is heard of the drive is waited for by itself.
            proven = all(one.proven or (listening and one.unheard) for one in found)
            if proven and (not listens or LISTENER in known):
                break
            # Who was never heard keeps no other from being waited for.
            if self._now() >= (max(patient, 0.0 if proven else end) if listening else end):
                break
            if meanwhile(self._verdict(why, event, found, came)):
                break
            # What it may hear is to be known whatever else is absent.
            if self._hopeless(found) and (not listens or LISTENER in known):
                break
            if not proven:
                waits = [one for one in found if not (listening and one.unheard)]
                self._ask_again(asked, answered, waits, came)
            cf.wait(
                [one for one in asked.values() if not one.done()],
                timeout=max(0.0, min(_AGAIN, end - self._now())),
            )
        ear = "there" if LISTENER in self._of and not listens else ""
        found = self._found(asked, known, ear=ear)
        return self._verdict(why, event, found, came, unasked=unasked)

    def _verdict(
        self, why: str, event: float, outputs: Sequence[Off], came: Mapping[str, float], *,
        unasked: str = "",
    ) -> Verdict:  # fmt: skip
        hands = [Off(name, False, unasked) for name in self._by_hand] if unasked else []
        named: dict[str, float] = {}
        # More may come meanwhile.
        for key, at in dict(came).items():
            named[self._named(key)] = max(at - event, named.get(self._named(key), 0.0))
        return Verdict(
            why, event, self._now() - event, (*outputs, *hands), named,
            () if unasked else tuple(self._by_hand),
        )  # fmt: skip

    def _safe(self, key: str) -> "cf.Future[Any]":
        return self._of[key].begin(key, lambda one: one.safe())

    def _read(self, key: str, came: dict[str, float]) -> "cf.Future[Any]":
        """Ask what proves an output to be off; notes when the answer came."""
        acts: dict[str, Callable[[Any], Any]] = {
            "vibration": off.drive_state,
            LISTENER: lambda one: one.moves(),
        }
        future = self._of[key].begin(key, acts.get(key, off.read_back))
        future.add_done_callback(lambda _: came.update({key: self._now()}))
        return future

    def _ask_again(
        self,
        asked: dict[str, "cf.Future[Any]"],
        answered: Sequence[str],
        outputs: Iterable[Off],
        came: dict[str, float],
    ) -> None:
        """Tell and ask what has answered and was not found off."""
        names = {one.name for one in outputs if not one.proven}
        # An answer that comes meanwhile was not looked at, and is not to be lost.
        again = [key for key in answered if self._named(key) in names]
        if not again:
            return
        time.sleep(_AGAIN)
        for key in again:
            if key != LISTENER:
                self._safe(key)
            asked[key] = self._read(key, came)

    def _named(self, key: str) -> str:
        return self._of_vibration() if key == LISTENER else self._of[key].keys[key]

    def _of_vibration(self) -> str:
        return self._of["vibration"].keys["vibration"] if "vibration" in self._of else ""

    def _found(self, asked: Iterable[str], known: Mapping[str, Any], *, ear: str) -> list[Off]:
        """Judge what is known; ``ear`` as of :func:`off.drive_off`."""
        found = {key: known.get(key, self._silent(key)) for key in asked}
        made: dict[str, Off] = {}
        for key in asked:
            if key not in ("vibration", LISTENER):
                made[key] = off.supply_off(self._of[key].keys[key], found[key])
        if "vibration" in asked and "vibration" not in known:
            made["vibration"] = Off(self._of_vibration(), False, str(found["vibration"]))
        elif "vibration" in asked:
            moves = None if ear else found.get(LISTENER)
            made["vibration"] = off.drive_off(
                self._of_vibration(), found["vibration"], moves, made.get("amplifier"),
                moved=self._moved, ear=ear,
            )  # fmt: skip
        return [made[key] for stage in STAGES for key in stage if key in made]

    def _silent(self, key: str) -> InstrumentError:
        # What could not be opened is no less absent while that is tried again.
        trouble = self._of[key].trouble
        return InstrumentError(trouble, kind="line lost") if trouble else _SILENT

    def _hopeless(self, outputs: Iterable[Off]) -> bool:
        """Whether all that is not off could not even be opened."""
        left = {one.name for one in outputs if not one.proven}
        return bool(left) and all(
            self._of[key].trouble
            for stage in STAGES for key in stage
            if key in self._of and self._of[key].keys[key] in left
        )  # fmt: skip


_SILENT = InstrumentError("it has not answered", kind="late")


def _result_or_error(future: "cf.Future[Any]") -> Any:
    error = future.exception()
    return error if error is not None else future.result()

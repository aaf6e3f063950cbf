"""The instruments that a guardian owns, each device with a thread of its own."""

import concurrent.futures as cf
import dataclasses
from collections.abc import Callable, Iterable, Mapping
from typing import Any

from asperity.tribometer.guardian.hand import Hand
from asperity.tribometer.instruments import off
from asperity.tribometer.instruments.off import Off
from asperity.tribometer.instruments.protocols import InstrumentError

STAGES = ("vibration",), ("amplifier",), ("steel", "bronze")
"""Outputs in the order in which they are switched off."""
LISTENER = "listener"


class Device:
    """A device that is opened by itself, and whose outputs share its line.

    Parameters
    ----------
    name : str
        What messages call it.
    keys : mapping of str to str
        What messages call its outputs, by what they feed.
    opened : callable
        Opens it; returns its instruments by key.
    """

    def __init__(
        self, name: str, keys: Mapping[str, str], opened: Callable[[], Mapping[str, Any]]
    ) -> None:
        self.name, self.keys = name, keys
        self.trouble = ""
        self._opened = opened
        self._instruments: dict[str, Any] = {}
        self._hand = Hand(name)
        self._opening = self._hand.begin(self._open)

    def open_again(self) -> None:
        """Begin to open it once more where that has failed; it may have been plugged in since."""
        if self.trouble and self._opening.done():
            self._opening = self._hand.begin(self._open)

    def _open(self) -> None:
        if self._instruments:
            return
        try:
            self._instruments = dict(self._opened())
            self.trouble = ""
        except Exception as error:
            self.trouble = off.said(error)

    def begin(self, key: str, act: Callable[[Any], Any]) -> "cf.Future[Any]":
        """Have something done with one of its instruments, when all before it is done."""

        def do() -> Any:
            if key not in self._instruments:
                raise InstrumentError(self.trouble or f"{self.name} has no {key}", kind="line lost")
            return act(self._instruments[key])

        return self._hand.begin(do)

    def close(self) -> "cf.Future[Any]":
        """Let go of it."""

        def do() -> None:
            for one in self._instruments.values():
                off.tried(one.close)

        return self._hand.begin(do)


@dataclasses.dataclass
class PendingRequest:
    """A request whose answer is awaited; ``number`` is 0 where nobody waits for it."""

    number: int
    what: str
    since: float


@dataclasses.dataclass(frozen=True)
class Verdict:
    """What was read back when everything was switched off.

    Attributes
    ----------
    why : str
        What was the reason.
    event, seconds : float
        When that came, by the computer's clock, and how long it then took, s: a signal came to the
        process, the procedure was heard of last, an instrument was asked that has not answered.
    found : tuple of Off
        Of each output.
    answered : mapping of str to float
        When what proves each to be off had come, s after the event.
    asked : tuple of str
        Outputs that a person is asked to switch off, by the procedure; nothing is known of them.
    """

    why: str
    event: float
    seconds: float
    found: tuple[Off, ...]
    answered: Mapping[str, float] = dataclasses.field(default_factory=dict)
    asked: tuple[str, ...] = ()

    @property
    def still_on(self) -> list[str]:
        """What was not read back to be off, and why."""
        return [str(one) for one in self.found if not one.proven]

    @property
    def names(self) -> str:
        """What was read back to be off, or named."""
        names = ", ".join(one.name for one in self.found) or "nothing, for none of it is owned"
        unheard = ", ".join(one.name for one in self.unheard)
        return f"{names}; not yet heard to be still: {unheard}" if unheard else names

    @property
    def unheard(self) -> list[Off]:
        """What is off by what it says of itself, and has yet to be listened to."""
        return [one for one in self.found if one.proven and one.unheard]

    def since(self, event: float, before: "Verdict") -> "Verdict":
        """Return it with times since an earlier event; what was off before was off by then."""
        answered = {name: at + self.event - event for name, at in self.answered.items()}
        for one in before.found:
            if one.proven and one.name in before.answered:
                answered[one.name] = before.answered[one.name] + before.event - event
        seconds = self.seconds + self.event - event
        return dataclasses.replace(self, event=event, seconds=seconds, answered=answered)

    def line(self) -> dict[str, Any]:
        """Return it for a journal."""
        proven = [one for one in self.found if one.proven and not one.unheard]
        told: dict[str, Any] = {
            "why": self.why,
            "event_s": self.event,
            "took_s": round(self.seconds, 4),
            "read_back": {one.name: one.evidence for one in proven},
            "off_s": {
                one.name: round(self.answered[one.name], 4)
                for one in self.found if one.proven and one.name in self.answered
            },
        }  # fmt: skip
        if self.unheard:
            told["not_yet_heard"] = {one.name: one.evidence for one in self.unheard}
        told |= {"by_hand": list(self.asked)} if self.asked else {}
        return told | ({"still_on": self.still_on} if self.still_on else {})


def unproven(why: str, event: float, seconds: float, names: Iterable[str], error: str) -> Verdict:
    """Return what is known where switching off itself has failed: of nothing that it is off."""
    found = tuple(Off(name, False, f"switching off has failed: {error}") for name in names)
    return Verdict(why, event, seconds, found)

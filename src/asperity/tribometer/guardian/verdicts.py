"""What is found when everything is switched off: written down, told to a person, tried again."""

import time
from collections.abc import Callable, Iterable, Mapping, Sequence

from asperity.tribometer.guardian.alarm import Alarm
from asperity.tribometer.guardian.owned import Verdict, unproven
from asperity.tribometer.guardian.switching import Switching
from asperity.tribometer.guardian.writing import Writing
from asperity.tribometer.instruments.off import Off, said

CTRL_C = "Ctrl-C"
OPENING = 20.0  #: s that a device may take at the start.
NOT_YET = "nobody was asked yet to switch it off"
NOBODY = "nobody was asked to switch it off"
_ATTEMPT = 0.5  # s that another attempt takes


class Verdicts:
    """Has everything switched off, and keeps what was found.

    Parameters
    ----------
    switching : Switching
        Who does it.
    writing : Writing
        Of the journal.
    alarm : Alarm
        Names what was not read back.
    by_hand : sequence of str
        Names of outputs that only a person can switch off.
    say : callable
        Tells a person at the terminal; must not wait.
    now : callable
        The computer's clock, s.
    ended_by : str
        What a person can end it by.

    Attributes
    ----------
    last : Verdict or None
        What was found last.
    tried : float
        When that was.
    event : float
        What everything was switched off by, first, s.
    """

    def __init__(
        self,
        switching: Switching,
        writing: Writing,
        alarm: Alarm,
        by_hand: Sequence[str],
        say: Callable[[str], None],
        now: Callable[[], float] = time.monotonic,
        ended_by: str = CTRL_C,
    ) -> None:
        self._ended_by = ended_by
        self._switching, self._writing, self._alarm = switching, writing, alarm
        self._by_hand = frozenset(by_hand)
        self._say, self._now = say, now
        self._unasked = ""
        self.last: Verdict | None = None
        self.tried = self.event = now()
        self._proven: float | None = None  # when all was read back, since then

    def first(self, urgent: Callable[[], bool]) -> None:
        """Switch off what an earlier run left.

        What is not read back by the time that switching off takes is named, and tried on until
        devices have had theirs to be opened; what comes true then is said.

        Parameters
        ----------
        urgent : callable
            Whether something has come that is not to wait for that.
        """
        named: dict[str, bool] = {}

        def meanwhile(verdict: Verdict) -> bool:
            if verdict.seconds < self._switching.limit:
                return False
            self._name_first(verdict, named)
            return urgent()

        found = self._switching.off(
            "start", self._now(), limit=OPENING, listen=True, meanwhile=meanwhile
        )
        if named:
            self._name_first(found, named)
        self._note(found)

    def _name_first(self, verdict: Verdict, named: dict[str, bool]) -> None:
        """Name what is not read back yet, and say of what was named that it is.

        ``named`` keeps of each that was named whether it was read to be on: one that was silent
        before, and now is, is named again.
        """
        left = {one.name: one for one in verdict.found if not one.proven}
        fresh = _worse(left.values(), named)
        proven = sorted(set(named) - set(left))
        if not fresh and not proven:
            return
        # What was read to be on once is not named anew with every answer that it owes.
        still = {name: one.on or named.get(name, False) for name, one in left.items()}
        named.clear()
        named.update(still)
        self._writing.verdict(verdict)
        if proven:
            self._say(
                f"read back to be off {verdict.seconds:.2g} s after the start: {', '.join(proven)}"
            )
        # Without power nothing answers that may only be slow.
        self._alarm.name(
            fresh,
            cut=any(one.on for one in fresh),
            on=f" It is tried for {OPENING:g} s from the start; {self._ended_by} ends that.",
        )

    def began(self, event: float) -> None:
        """Take that something has come that everything is to be off for."""
        self.event, self._proven = event, None

    def off(
        self, why: str, event: float, *, listen: bool, unasked: str = "", last: bool = True
    ) -> Verdict:
        """Switch everything off; ``last``: nobody will listen afterwards."""
        self._unasked = unasked
        found = self._switching.off(why, event, listen=listen, unasked=unasked)
        self._tell(found, last=last)
        return found

    def fail(self, why: str, names: Iterable[str], error: Exception) -> None:
        """Take that switching off has failed itself: nothing is known to be off."""
        after = self._now() - self.event
        self._tell(unproven(why, self.event, after, names, said(error)), last=True)

    def _tell(self, verdict: Verdict, *, last: bool) -> None:
        """Write down what was found, and tell a person what has to be switched off by hand."""
        self._note(verdict)
        unread = [one for one in verdict.found if not one.proven and (last or not one.unheard)]
        # Without power nothing answers; a procedure that lives has yet to ask, and to read.
        waits = self._unasked == NOT_YET and all(map(self._switched_by_hand, unread))
        self._alarm.name(unread, cut=not waits)

    def _note(self, verdict: Verdict) -> None:
        """Write a verdict down, and when there was nothing more that was not read back."""
        self.last, self.tried = verdict, self._now()
        self._writing.verdict(verdict)
        if verdict.still_on:
            self._proven = None
        elif self._proven is None:
            self._proven = verdict.event + verdict.seconds

    def again(self, *, listen: bool = False) -> bool:
        """Try once more what was not read back to be off; with nobody there it may listen.

        Returns whether there was any: of what a person switches nothing can be read back.
        """
        last, self.tried = self.last, self._now()
        if last is None or all(one.proven or self._switched_by_hand(one) for one in last.found):
            return False
        # Shortly: who asks meanwhile is not to wait long.
        found = self._switching.off(
            last.why, self._now(), limit=_ATTEMPT, listen=listen, unasked=self._unasked
        ).since(self.event, last)
        self.tried = self._now()
        if found.still_on != last.still_on:
            self._note(found)
            before = {one.name: one.on for one in last.found if not one.proven}
            self._alarm.name(_worse((one for one in found.found if not one.proven), before))
            if not found.still_on:
                self._say(f"read back to be off at last: {found.names}")
        return True

    def _switched_by_hand(self, output: Off) -> bool:
        return output.name in self._by_hand

    @property
    def took(self) -> float | None:
        """How long it took from the event until all was read back, s; None: it was not."""
        if self.last is None or self.last.still_on or self._proven is None:
            return None
        return self._proven - self.event


def _worse(left: Iterable[Off], named: Mapping[str, bool]) -> list[Off]:
    """Return what was not named, or was while nothing said that it is on, as something now does."""
    return [one for one in left if one.name not in named or (one.on and not named[one.name])]

"""The journal as the guardian writes it: in a thread of its own, since a disk may hang."""

import concurrent.futures as cf
from collections.abc import Callable
from pathlib import Path
from typing import Any

from asperity.tribometer.guardian.hand import Hand
from asperity.tribometer.guardian.journal import Journal
from asperity.tribometer.guardian.owned import Verdict
from asperity.tribometer.guardian.wire import Head
from asperity.tribometer.instruments.protocols import InstrumentError
from asperity.tribometer.journal_lines import ENDED


class Writing:
    """What is written down of a run, in the order in which it is told.

    Verdicts that come before there is a journal wait for it.

    Parameters
    ----------
    opened : callable
        Takes the folder of a journal that was opened.
    """

    def __init__(self, opened: Callable[[Path], None]) -> None:
        self._opened = opened
        self._journal: Journal | None = None
        self._hand = Hand("journal")
        self._unwritten: list[Verdict] = []

    def asked(self, head: Head) -> "cf.Future[Any]":
        """Do what the procedure asks of the journal; returns what tells of it."""

        def act() -> Any:
            if head["do"] == "open":
                folder = Path(head["with"][0])
                self._journal = Journal(folder)
                self._write_down()
                self._opened(folder)
                return self._journal.lines
            if self._journal is None:
                raise InstrumentError("no journal is open")
            if head["do"] == "close":
                self._journal.close(finished=head["with"][0])
                self._journal = None
                return None
            return self._journal.write(head["with"][0], **head["with"][1])

        return self._hand.begin(act)

    def verdict(self, found: Verdict) -> None:
        """Take what was found when everything was switched off."""
        self._unwritten.append(found)
        self._hand.begin(self._write_down)

    def end(self, why: str, found: Verdict) -> None:
        """Write how a run ended whose procedure is there no more, and save what it recorded."""
        self._hand.begin(lambda: self._write_end(why, found))
        self._hand.begin(self._join)

    def all_written(self) -> "cf.Future[Any]":
        """Return what tells that everything so far is written."""
        return self._hand.begin(lambda: None)

    def _write_down(self) -> None:
        while self._unwritten and self._journal is not None:
            self._journal.write("off", **self._unwritten[0].line())
            # What a full disk does not take is written when it does.
            del self._unwritten[0]

    def _write_end(self, why: str, found: Verdict) -> None:
        journal = self._journal
        kinds = [] if journal is None else [line["kind"] for line in journal.lines]
        last = next((kind for kind in reversed(kinds) if kind != "off"), "")
        if journal is None or last in ENDED:
            return
        if found.still_on:
            journal.write("latched", interlock="still on", reason=why, still_on=found.still_on)
        elif "started" in kinds:
            journal.write("interrupted", reason=why)

    def _join(self) -> None:
        """Make files of what the procedure had recorded."""
        if self._journal is None:
            return
        from asperity.tribometer.recording.recorder import joined_all

        joined_all(self._journal.path.parent)

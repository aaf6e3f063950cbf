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
        Takes the folder of the run.
    folder : Path, optional
        Of the run. What may be on is written there whoever is gone, or has yet to ask.
    """

    def __init__(self, opened: Callable[[Path], None], folder: Path | None = None) -> None:
        self._opened = opened
        self._folder = folder
        self._journal: Journal | None = None
        self._was_open = False
        self._hand = Hand("journal")
        self._unwritten: list[Verdict] = []
        if folder is not None:
            # A stop may be asked for before there is a journal.
            self._hand.begin(lambda: opened(folder))

    def asked(self, head: Head) -> "cf.Future[Any]":
        """Do what the procedure asks of the journal; returns what tells of it."""

        def act() -> Any:
            if head["do"] == "open":
                folder = Path(head["with"][0])
                journal = self._open(folder)
                self._write_down()
                self._opened(folder)
                return journal.lines
            if self._journal is None:
                raise InstrumentError("no journal is open")
            if head["do"] == "close":
                self._journal.close(finished=head["with"][0])
                self._journal = None
                return None
            return self._journal.write(head["with"][0], **head["with"][1])

        return self._hand.begin(act)

    def verdict(self, verdict: Verdict) -> None:
        """Take what was found when everything was switched off."""
        self._unwritten.append(verdict)
        self._hand.begin(self._write_down)

    def end(self, why: str, verdict: Verdict) -> None:
        """Write how a run ended whose procedure is there no more, and save what it recorded."""
        self._hand.begin(lambda: self._write_end(why, verdict))
        self._hand.begin(self._join)

    def all_written(self) -> "cf.Future[Any]":
        """Return what tells that everything so far is written."""
        return self._hand.begin(lambda: None)

    def _open(self, folder: Path) -> Journal:
        """Return the journal of a folder, which is held by one at a time."""
        if self._journal is not None and self._journal.path.parent != folder:
            self._journal.close()
            self._journal = None
        if self._journal is None:
            self._journal = Journal(folder)
        self._folder, self._was_open = folder, True
        return self._journal

    def _write_down(self) -> None:
        left = self._journal is None and self._folder is not None
        if left and any(one.still_on or self._was_open for one in self._unwritten):
            # Nobody else holds it: the procedure has yet to ask for it, or is done with it.
            assert self._folder is not None
            self._open(self._folder)
        while self._unwritten and self._journal is not None:
            self._journal.write("off", **self._unwritten[0].line())
            # What a full disk does not take is written when it does.
            del self._unwritten[0]

    def _write_end(self, why: str, verdict: Verdict) -> None:
        journal = self._journal
        kinds = [] if journal is None else [line["kind"] for line in journal.lines]
        last = next((kind for kind in reversed(kinds) if kind != "off"), "")
        # What has not begun cannot be gone on with; lines "off" say what may be on.
        if journal is None or "started" not in kinds or last == "latched":
            return
        if last in ENDED and not verdict.still_on:
            return
        if verdict.still_on:
            journal.write("latched", interlock="still on", reason=why, still_on=verdict.still_on)
        else:
            journal.write("interrupted", reason=why)

    def _join(self) -> None:
        """Make files of what the procedure had recorded."""
        if self._journal is None:
            return
        from asperity.tribometer.recording.hdf5 import joined_all

        joined_all(self._journal.path.parent)

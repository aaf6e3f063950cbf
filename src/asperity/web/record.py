"""What is known of a job: how far it is, kept in its folder, and who waits for news of it."""

import asyncio
import contextlib
import dataclasses
import json
import re
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from asperity import exit_codes
from asperity.errors import AsperityError
from asperity.files.store import read_text, write_text
from asperity.web.folder import ANSWER, REQUEST, SO_FAR, STATE

ENDED = ("stopped", "done", "failed")

_OWN = frozenset((STATE, REQUEST, ANSWER, SO_FAR))
_FILE = re.compile(r"[A-Za-z0-9][\w.+ -]*")


@dataclasses.dataclass
class Job:
    """A command that takes longer.

    Attributes
    ----------
    id : str
        A key of all that its answer follows from.
    command, case, line : str
        What is done, with what, and how on a terminal.
    state : str
        queued, running, stopped, done or failed.
    done, total : int
        How far it is.
    seconds : float
        How long it has run.
    notes : list of str
        What was said on the way.
    error : str
        Why there is no answer, or not all of it.
    exit_code : int
        Of the error.
    reached : dict or None
        What was reached where an iteration ended without an answer.
    """

    id: str
    command: str
    case: str
    line: str
    state: str = "queued"
    done: int = 0
    total: int = 0
    seconds: float = 0.0
    notes: list[str] = dataclasses.field(default_factory=list)
    error: str = ""
    exit_code: int = exit_codes.DONE
    reached: dict[str, Any] | None = None

    def __post_init__(self) -> None:
        # What belongs to this server alone, and is not kept.
        self.home = Path()
        self.process: asyncio.subprocess.Process | None = None
        self.task: asyncio.Task[None] | None = None
        self.stopping = self.begun = False
        self.since = 0.0
        self.news = asyncio.Event()

    @property
    def answered(self) -> bool:
        """Whether its answer is there."""
        path = self.home / ANSWER
        return path.is_file() and not path.is_symlink()

    @property
    def asked(self) -> Any:
        """What was asked for, as the page asked it; None where that cannot be read."""
        path = self.home / REQUEST
        with contextlib.suppress(OSError, ValueError, AsperityError):
            # What is no number there would be none in the list of all.
            return None if path.is_symlink() else json.loads(read_text(path), parse_constant=str)
        return None

    @property
    def brief(self) -> dict[str, str]:
        """What is told to whoever begins or ends it."""
        return {"id": self.id, "state": self.state}

    def to_json(self) -> dict[str, Any]:
        """Return all that is known of it."""
        self._look()
        return dataclasses.asdict(self) | {"answered": self.answered, "files": list(self.files())}

    def files(self) -> Iterator[str]:
        """Yield the names of the files that it left."""
        for path in sorted(self.home.iterdir()) if self.home.is_dir() else ():
            named = _FILE.fullmatch(path.name) and path.name not in _OWN
            if named and path.is_file() and not path.is_symlink():
                yield path.name

    def notify(self) -> None:
        """Let everybody who waits see what is new."""
        self._look()
        self.news.set()
        self.news = asyncio.Event()

    def _look(self) -> None:
        """Look at the clock."""
        if self.process is not None:
            self.seconds = round(time.monotonic() - self.since, 3)

    def set(self, state: str) -> None:
        """Enter a state and keep it."""
        self.state = state
        with contextlib.suppress(OSError):
            write_text(self.home / STATE, json.dumps(dataclasses.asdict(self)))
        self.notify()

    def hear(self, line: bytes) -> None:
        """Take what its process says."""
        event = json.loads(line)
        if not isinstance(event, dict):
            raise ValueError("it must be an object")
        if "begun" in event:
            self.begun = True
        elif "done" in event:
            self.done, self.total = event["done"], event["total"]
        elif "note" in event:
            self.notes = [*self.notes[-49:], event["note"]]
        elif "error" in event:
            self.error, self.exit_code = event["error"], event["exit_code"]
            self.reached = event["reached"]
        self.notify()

    def ended(self, code: int) -> str:
        """Return the state in which its process left it."""
        if code == exit_codes.DONE or (self.error and self.answered):
            return "done"
        if self.stopping or code == exit_codes.INTERRUPTED:
            return "stopped"
        if not self.error:
            self.error = "its process ended, killed or out of memory; the same job again goes on"
            self.exit_code = exit_codes.FAILED
        return "failed"

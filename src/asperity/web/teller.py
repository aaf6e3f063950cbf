"""Who asked for a job: the server, which is told how far it is, and the job's folder."""

import contextlib
import json
import time
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

from asperity.casefile import Case
from asperity.commands.execution import Teller
from asperity.commands.request import CommandRequest
from asperity.errors import ConvergenceError
from asperity.files.store import write_text
from asperity.results import Result
from asperity.results.files import write_content
from asperity.results.payload import as_shown
from asperity.web.answer import answer_of
from asperity.web.ask import confine
from asperity.web.folder import ANSWER, SO_FAR, Folder

_OFTEN = 0.1


class JobTeller(Teller):
    """Tells the server, and leaves the answer in the job's folder."""

    def __init__(
        self, request: CommandRequest, folder: Folder, home: Path, say: Callable[..., None]
    ) -> None:
        self._request = request
        self._folder = folder
        self._home = home
        self._say = say
        self._next = 0.0
        self._look = 0.0

    def read(self, case: Case) -> None:
        """Refuse a case that reads anything outside the folder."""
        confine(case, self._folder)

    def note(self, line: str) -> None:
        """Tell a line."""
        self._say(note=line)

    @contextlib.contextmanager
    def progress(self, counts: str) -> Iterator[Callable[[int, int], None]]:
        """Tell how much is done, now and then."""

        def tell(done: int, total: int) -> None:
            if done >= total or time.monotonic() >= self._next:
                self._next = time.monotonic() + _OFTEN
                self._say(done=done, total=total)

        # From here on there may be something to keep: it is stopped, and before that ended.
        self._say(begun=True)
        yield tell

    def so_far(self, made: Callable[[], Result]) -> None:
        """Leave what is there of an answer where it is looked at, in a tenth of the time."""
        began = time.monotonic()
        if began >= self._look:
            made().save(self._home / SO_FAR)
            self._look = time.monotonic() + max(1.0, 10.0 * (time.monotonic() - began))

    def unsolved(self, error: ConvergenceError) -> None:
        """Tell nothing more than the line that follows."""

    def show(self, source: str, case: Case, result: Result) -> None:
        """Keep the answer with what goes with it."""
        answer = answer_of(self._request, case, result) | {"told": as_shown(result)}
        write_text(self._home / ANSWER, json.dumps(answer, allow_nan=False))
        for name, content in result.attached().items():
            write_content(self._home / name, content)

    def written(self, where: Path, names: Sequence[str]) -> None:
        """Tell nothing; what lies in the folder is listed."""
        (self._home / SO_FAR).unlink(missing_ok=True)

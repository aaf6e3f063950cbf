"""What goes on around a long work: how far it is, where it stands, whether it is to stop."""

import contextlib
import time
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any

from asperity.errors import StorageError
from asperity.runs.checkpoint_file import CheckpointFile
from asperity.runs.interrupt import Interrupted, SignalFlag
from asperity.runs.tree import Tree

Progress = Callable[[int, int], None]
Notify = Callable[[str], None]
Watch = Callable[[Callable[[], Any]], None]


# A work that takes a minute is announced: before, where there is a forecast, else once it has been
# looked at for a while. The estimate wavers, so the line is drawn a little lower.
_LONG_SECONDS = 50.0
_LOOK_SECONDS = 2.0
_SHORT_SECONDS = 5.0  # that are left, and not worth a line


def duration(seconds: float) -> str:
    """Return a time in words, in the unit that suits it."""
    for size, unit in ((86400.0, "days"), (3600.0, "hours"), (60.0, "minutes")):
        if seconds >= 2.0 * size:
            return f"{seconds / size:.0f} {unit}"
    return f"{seconds:.0f} seconds"


def _silent(*_: object) -> None:
    pass


class Run:
    """How a work is run; as it stands, in silence and without a trace.

    A solver that takes long calls :meth:`resume` before its first step, works inside
    :meth:`interruptible`, and calls :meth:`checkpoint` between two steps, with its state as a
    tree of arrays.

    Parameters
    ----------
    progress : callable, optional
        Told how much is done, and of how much.
    notify : callable, optional
        Takes one line about what happens on the way.
    folder : path, optional
        Where files of the answer go; the state is kept there.
    stem : str
        What those files are called.
    watch : callable, optional
        Takes what makes an answer of as much as is there, whenever there is more.

    Attributes
    ----------
    detailed : bool
        Whether histories are wanted, because files are.
    """

    def __init__(
        self,
        *,
        progress: Progress | None = None,
        notify: Notify | None = None,
        folder: Path | None = None,
        stem: str = "run",
        watch: Watch | None = None,
    ) -> None:
        self.notify = notify or _silent
        self._watch = watch or _silent
        self._progress = progress or _silent
        self._begun: tuple[float, int] | None = None
        self._marks: list[tuple[float, int]] = []
        self._announced = False
        self.folder = folder
        self.detailed = folder is not None
        self._path = None if folder is None else folder / f"{stem}.interrupted.npz"
        self._file: CheckpointFile | None = None
        self._signals = SignalFlag()

    def watch(self, made: Callable[[], Any]) -> None:
        """Let what is there of an answer be looked at; a full disk costs the look and no more.

        Parameters
        ----------
        made : callable
            Makes what is to be looked at; it is called where somebody looks.
        """
        try:
            self._watch(made)
        except StorageError as error:
            self._watch = _silent
            self.notify(f"{error}; goes on without")

    def forecast(self, seconds: float, what: str) -> None:
        """Announce a work that will take long, before it begins.

        Parameters
        ----------
        seconds : float
            What it is estimated to take, s.
        what : str
            What takes it, in the plural: "9e+09 steps".
        """
        if seconds > _LONG_SECONDS and not self._announced:
            self._announced = True
            self.notify(f"{what} take about {duration(seconds)}")

    def _tell(self, done: int, total: int) -> None:
        """Tell how much is done; once it can be seen, also that it will take long."""
        self._progress(done, total)
        now = time.monotonic()
        # A work that begins anew, in finer steps say, is measured anew.
        if self._begun is None or done - self._begun[1] < self._marks[1][1]:
            self._begun = now, done
            self._marks = [(now, 0), (now, 0)]
        began, first = self._begun
        steps = done - first
        # What the first steps take says nothing: kernels may be compiled in them. What is measured
        # begins where a quarter to a half of what is done now was done, not before two steps.
        if steps >= max(1, 2 * self._marks[1][1]):
            self._marks = [self._marks[1], (now, steps)]
        since, before = self._marks[0]
        if self._announced or now - began < _LOOK_SECONDS or not 1 < before < steps:
            return
        left = (now - since) / (steps - before) * (total - done)
        if left > _SHORT_SECONDS and now - began + left > _LONG_SECONDS:
            self._announced = True
            self.notify(f"this will take about {duration(left)}")

    def resume(self, key: str) -> Tree | None:
        """Return the state in which this very work was left, None where it begins anew.

        Parameters
        ----------
        key : str
            Of all that the work follows from, see `asperity.runs.key`.

        Returns
        -------
        tree of ndarray of any shape, or None
            As `checkpoint` was given it.
        """
        if self._path is None:
            return None
        self._file = CheckpointFile(self._path, key, self.notify)
        return self._file.restore()

    @contextlib.contextmanager
    def interruptible(self) -> Iterator[None]:
        """Hear Ctrl-C at the next checkpoint instead of anywhere; a second one stops at once."""
        with self._signals.listening():
            yield

    def checkpoint(
        self,
        done: int,
        total: int,
        state: Callable[[], Mapping[str, Any]] | None = None,
        what: str = "steps",
    ) -> None:
        """Tell how far a work is, keep it if it is time to, and end it if it is to stop.

        Parameters
        ----------
        done, total : int
            How much is done, and of how much.
        state : callable, optional
            Gives the state to go on from; left out, nothing is kept here.
        what : str
            What is counted.

        Raises
        ------
        Interrupted
            Ctrl-C was pressed; what is kept is said.
        """
        self._tell(done, total)
        file = self._file
        if self._signals.heard:
            line = f"interrupted after {done} of {total} {what}"
            if file is not None and state is not None and done:
                with contextlib.suppress(StorageError):
                    file.save(state())
            if file is not None and file.saved:
                line += f"; the same command goes on from {file.path}"
            raise Interrupted(line)
        if file is not None and state is not None:
            file.now_and_then(state)

    def finished(self) -> None:
        """Remove what was kept, when the files of the answer are written."""
        if self._path is not None:
            self._path.unlink(missing_ok=True)

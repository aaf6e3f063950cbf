"""How far a work is whose stages take a minute each and tell nothing by themselves."""

import threading
import time
from collections.abc import Callable, Sequence
from typing import TypeVar

from asperity.processes import interrupts
from asperity.runs import Run

_T = TypeVar("_T")
_PARTS = 100
_TICK = 0.5  # s
# Of a stage, at most what is told before it has ended.
_MOST = 0.98


class Stages:
    """Tells how far it is by what stages are estimated to take, and hears an interrupt in each.

    Parameters
    ----------
    run : Run
        Who is told.
    seconds : sequence of float
        What each stage is estimated to take, s.
    """

    def __init__(self, run: Run, seconds: Sequence[float]) -> None:
        self._run, self._seconds = run, list(seconds)
        self._ended = 0
        run.forecast(sum(seconds), "loads and two meshes")

    def done(self) -> None:
        """Tell that a stage has ended."""
        self._ended += 1
        self._tell(0.0)

    def wait(self, work: Callable[[], _T]) -> _T:
        """Return what the work of a stage returns, telling meanwhile how far it is.

        An interrupt is raised at once, and the stage works on by itself to its end: a command ends
        before that, in Python it keeps its core and memory until then.
        """
        found: list[_T] = []
        failed: list[BaseException] = []

        def go() -> None:
            try:
                found.append(work())
            except BaseException as error:
                failed.append(error)

        # What factorises lets others go on; where it is interrupted it ends with the process.
        thread = threading.Thread(target=go, daemon=True)
        began = time.monotonic()
        thread.start()
        try:
            while thread.is_alive():
                thread.join(_TICK)
                share = (time.monotonic() - began) / self._seconds[self._ended]
                self._tell(min(share, _MOST))
        except BaseException:
            interrupts.left_working.append(thread)
            raise
        if failed:
            raise failed[0]
        return found[0]

    def _tell(self, share: float) -> None:
        """Tell how far it is with a share of the stage that is on."""
        within = self._seconds[self._ended] * share if self._ended < len(self._seconds) else 0.0
        done = (sum(self._seconds[: self._ended]) + within) / sum(self._seconds)
        self._run.checkpoint(round(_PARTS * done), _PARTS, what="parts")

"""A thread for each device: one that is late, or blocks for ever, holds up none of the others."""

import concurrent.futures as cf
import queue
import threading
from collections.abc import Callable
from typing import Any

Act = Callable[[], Any]


class Hand:
    """Does one thing after the other with a device, in a thread of its own.

    A thread that a driver never returns to is left behind: it ends with the process.

    Parameters
    ----------
    name : str
        Of the device.
    """

    def __init__(self, name: str) -> None:
        self.name = name
        self._acts: queue.SimpleQueue[tuple[cf.Future[Any], Act]] = queue.SimpleQueue()
        threading.Thread(target=self._work, name=name, daemon=True).start()

    def begin(self, act: Act) -> "cf.Future[Any]":
        """Have something done when all before it is done; returns what tells of it."""
        future: cf.Future[Any] = cf.Future()
        self._acts.put((future, act))
        return future

    def _work(self) -> None:
        while True:
            future, act = self._acts.get()
            if not future.set_running_or_notify_cancel():
                continue
            try:
                gave = act()
            except BaseException as error:
                future.set_exception(error)
            else:
                future.set_result(gave)

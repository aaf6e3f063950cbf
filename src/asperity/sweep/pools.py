"""Where the tasks of a sweep are solved: this machine's cores, or a Dask cluster."""

import concurrent.futures as cf
import logging
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from asperity.errors import AsperityError, InputError, MissingExtraError, StorageError
from asperity.runs.row_cache import Row
from asperity.runs.workers import cores
from asperity.sweep.tasks import solve_remote, solve_task, versions

_CONNECT_SECONDS = 5
_RETRIES = 5
_ROOM_PER_THREAD = 4
_LEAST_ROOM = 32


class Pool:
    """Solves tasks elsewhere than in the thread that asks."""

    room: int  # how many tasks to hand in ahead, so that nobody waits and memory stays small

    def submit(self, problems: Sequence[Any]) -> "cf.Future[list[Row]]":
        """Hand in a task."""
        raise NotImplementedError

    def check(self) -> None:
        """Raise if the tasks handed in can never be solved; called now and then."""

    def failure(self, error: BaseException) -> BaseException:
        """Return what to raise for a task that raised."""
        return error

    def stop(self) -> None:
        """Drop what has not begun and end what has, soon."""
        raise NotImplementedError

    def close(self) -> None:
        """Give everything back."""
        raise NotImplementedError


class _Cores(Pool):
    """The cores of this machine: threads, since the compiled loops leave the interpreter free."""

    def __init__(self, subject: str) -> None:
        self.room = 2 * cores()
        self._subject = subject
        self._threads = cf.ThreadPoolExecutor(cores(), thread_name_prefix="sweep")
        self._stop = np.zeros(1, dtype=np.int64)

    def submit(self, problems: Sequence[Any]) -> "cf.Future[list[Row]]":
        return self._threads.submit(solve_task, problems, self._stop, self._subject)

    def stop(self) -> None:
        self._stop[0] = 1
        self._threads.shutdown(wait=True, cancel_futures=True)

    def close(self) -> None:
        self._threads.shutdown(wait=True)


class _Cluster(Pool):
    """The workers of a Dask scheduler, which must have this version of the package.

    Its address is such as ``tcp://127.0.0.1:8786``; what is being waited for is told in one line.
    """

    def __init__(self, address: str, notify: Callable[[str], None], subject: str) -> None:
        try:
            import distributed
        except ImportError:
            raise MissingExtraError(
                "a cluster needs dask.distributed; install it: pip install asperity[cluster]"
            ) from None
        # What goes wrong is said in one line below, not by the library's own log.
        for log in ("distributed", "distributed.client"):
            logging.getLogger(log).setLevel(logging.CRITICAL)
        self._address = address
        self._subject = subject
        self._notify = notify
        self._waits = False
        try:
            # Looked at before, since a client that fails to begin with this takes long to end.
            scheme, place = distributed.comm.parse_address(address)
            distributed.comm.registry.get_backend(scheme)
            distributed.comm.addressing.parse_host_port(place)
            self._client: Any = distributed.Client(
                address, timeout=_CONNECT_SECONDS, set_as_default=False
            )
        except (OSError, ValueError, ImportError) as error:
            reason = str(error).splitlines()[0] if str(error) else type(error).__name__
            raise InputError(
                f"--cluster {address}: no scheduler answers ({reason}); start one with 'dask "
                "scheduler' and give its address, as in tcp://127.0.0.1:8786"
            ) from None
        self._executor = self._client.get_executor(pure=False, retries=_RETRIES)
        threads = sum(self._client.nthreads().values())
        self.room = max(_LEAST_ROOM, _ROOM_PER_THREAD * threads)

    def submit(self, problems: Sequence[Any]) -> "cf.Future[list[Row]]":
        future: cf.Future[list[Row]] = self._executor.submit(
            solve_remote, problems, versions(self._subject), self._subject
        )
        return future

    def check(self) -> None:
        try:
            waits = not self._client.nthreads()
        except (OSError, ValueError, RuntimeError):
            raise StorageError(
                f"--cluster {self._address}: the scheduler is gone; the same command goes on from "
                "what is kept"
            ) from None
        if waits and not self._waits:
            self._notify(
                f"no worker at {self._address}; waiting for one that has asperity: dask worker "
                f"{self._address}"
            )
        self._waits = waits

    def failure(self, error: BaseException) -> BaseException:
        if isinstance(error, AsperityError):
            return error
        reason = " ".join(str(error).split()) or type(error).__name__
        return StorageError(f"--cluster {self._address}: a task failed: {reason}")

    def stop(self) -> None:
        self._executor.shutdown(wait=False)

    def close(self) -> None:
        self._client.close()


def pool(cluster: str, notify: Callable[[str], None], subject: str = "") -> Pool:
    """Return the workers of a scheduler at an address, or the cores of this machine.

    The subject is what they solve, by name; sliding bodies if left out.
    """
    return _Cluster(cluster, notify, subject) if cluster else _Cores(subject)

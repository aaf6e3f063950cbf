"""Tasks done in processes on all cores, what others wait for first."""

import concurrent.futures as cf
import contextlib
import dataclasses
import multiprocessing
import os
import signal
import threading
from collections.abc import Callable, Generator, Iterator, Sequence
from concurrent.futures.process import BrokenProcessPool
from multiprocessing.connection import Connection
from typing import Any

from asperity import exit_codes
from asperity.errors import StorageError

_THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")

# Seconds between two times that what is done meanwhile is done.
_PAUSE = 1.0


@dataclasses.dataclass(frozen=True)
class Task:
    """Something to be done in one process.

    Attributes
    ----------
    name : str
        What it is called; a task is known by it.
    do : callable
        A function of a module, and what it takes if it is a partial one.
    room : str
        Tasks of one room share compiled code: the first of them is done before others begin, so
        that it is compiled once. Empty for what calls no compiled code.
    seconds : float
        About how long it takes, s.
    after : tuple of str
        Names of tasks that must be done before, if they are among those that are done.
    """

    name: str
    do: Callable[[], Any]
    room: str
    seconds: float = 1.0
    after: tuple[str, ...] = ()


Done = tuple[Task, "cf.Future[Any]"]


def cores() -> int:
    """Return the number of cores this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def done(
    tasks: Sequence[Task], processes: int, meanwhile: Callable[[], object] = lambda: None
) -> Generator[Done, None, None]:
    """Yield tasks with what they gave or raised, as they end.

    First begins what needs no compiled code, then one task of each room, since to compile takes
    longest where it has not been done; what takes longest begins first among equals. ``meanwhile``
    is called now and then while nothing ends.

    Left early, as by Ctrl-C, it ends the processes at once, whatever they are at. So does the end
    of this process, however it ends; where it is told to (SIGTERM), it tidies up what they share.

    Raises
    ------
    StorageError
        A process died.
    """
    # Processes begin anew instead of with a copy of this one, whose threads a copy would not have.
    context = multiprocessing.get_context("spawn")
    ear, mouth = context.Pipe(duplex=False)
    with _single_threaded(), _tidily_terminated(), ear, mouth:
        pool = cf.ProcessPoolExecutor(
            processes, mp_context=context, initializer=_begin, initargs=(ear,)
        )
        try:
            yield from _fed(pool, processes, tasks, meanwhile)
        except BrokenProcessPool:
            raise StorageError(
                "a process ended: killed, perhaps for memory, or begun by a script without "
                "\"if __name__ == '__main__':\"; the same again goes on from what is kept"
            ) from None
        except BaseException:
            mouth.close()
            raise
        finally:
            pool.shutdown(wait=True, cancel_futures=True)


def _fed(
    pool: cf.Executor, processes: int, tasks: Sequence[Task], meanwhile: Callable[[], object]
) -> Generator[Done, None, None]:
    waiting = list(tasks)
    to_do = {task.name for task in tasks}
    running: dict[cf.Future[Any], Task] = {}
    compiled: set[str] = set()

    def may_begin(task: Task) -> bool:
        alone = not task.room or task.room in compiled
        alone = alone or all(task.room != other.room for other in running.values())
        return alone and to_do.isdisjoint(task.after)

    def order(task: Task) -> tuple[bool, bool, float]:
        return bool(task.room), task.room in compiled, -task.seconds

    while waiting or running:
        while len(running) < processes and (ready := [*filter(may_begin, waiting)]):
            task = min(ready, key=order)
            waiting.remove(task)
            running[pool.submit(task.do)] = task
        ended, _ = cf.wait(running, timeout=_PAUSE, return_when=cf.FIRST_COMPLETED)
        if not ended:
            meanwhile()
        for future in ended:
            if isinstance(future.exception(), BrokenProcessPool):
                future.result()
            task = running.pop(future)
            to_do.remove(task.name)
            compiled.add(task.room)
            yield task, future


def _begin(ear: Connection) -> None:
    """Let Ctrl-C be heard by the process that feeds this one, and end with that."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)

    def listen() -> None:
        with contextlib.suppress(EOFError, OSError):
            ear.recv()
        os._exit(1)

    threading.Thread(target=listen, daemon=True).start()


@contextlib.contextmanager
def _tidily_terminated() -> Iterator[None]:
    """Leave by SystemExit when told to end: else Python warns of semaphores that nobody closed."""
    number = signal.SIGTERM
    main = threading.current_thread() is threading.main_thread()
    if not main or signal.getsignal(number) is not signal.SIG_DFL:
        yield
        return

    def leave(_number: int, _frame: object) -> None:
        raise SystemExit(exit_codes.TERMINATED)

    signal.signal(number, leave)
    try:
        yield
    finally:
        signal.signal(number, signal.SIG_DFL)


@contextlib.contextmanager
def _single_threaded() -> Iterator[None]:
    """Keep linear algebra in processes begun here to one thread: they have the cores already."""
    before = {name: os.environ.get(name) for name in _THREADS}
    os.environ.update(dict.fromkeys(_THREADS, "1"))
    try:
        yield
    finally:
        for name, value in before.items():
            if value is None:
                os.environ.pop(name, None)
            else:
                os.environ[name] = value

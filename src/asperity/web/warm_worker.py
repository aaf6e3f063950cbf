"""A warm worker: a process that answers while a slider is dragged, and is replaced if it hangs.

It is asked one thing after the other. Whoever has gone by the time it is his turn is passed over,
so that a slider that was dragged fast leaves no queue behind; whoever goes while it works at an
answer for long has it begun anew, so that what was asked last is answered soon.
"""

import asyncio
import contextlib
import json
from pathlib import Path

from asperity.processes import sessions
from asperity.web.verbs import VERBS, error_body

_TRIES = 3
_SLOWEST_START = 600.0  # of the first of all, in which every kernel is compiled
_PATIENCE = 1.0  # with an answer for which nobody waits: to begin anew takes longer

Answer = tuple[int, bytes]
Gone = sessions.Gone


class WarmWorker:
    """The owner of a worker.

    Parameters
    ----------
    kind : {'solver', 'lookup'}
        Whether it solves, or looks things up.
    folder : path
        The folder of the page.

    Attributes
    ----------
    up, ready : asyncio.Event
        Set once it can answer; once the kernels of one that solves are compiled and loaded.
    """

    def __init__(self, kind: str, folder: Path) -> None:
        self.up, self.ready, self._over = (asyncio.Event() for _ in range(3))
        self._begin = ("asperity.web.worker", kind, str(folder))
        self._turn = asyncio.Lock()
        self._process: asyncio.subprocess.Process | None = None
        self._frames: asyncio.Queue[Answer | None] = asyncio.Queue()
        self._reader: asyncio.Task[None] | None = None

    async def start(self) -> None:
        """Begin the process, which warms by itself; where it cannot, whoever asks next does."""
        if self._over.is_set():
            return
        self.up.clear()
        self.ready.clear()
        self._frames = asyncio.Queue()
        with contextlib.suppress(OSError):
            self._process = await sessions.begun(*self._begin)
            self._reader = asyncio.create_task(self._read(self._process, self._frames))
            if self._over.is_set():  # since it was asked to begin
                await self.stop()

    def kill(self) -> None:
        """End the process at once."""
        sessions.end(self._process)

    async def stop(self, *, for_good: bool = True) -> None:
        """End the process, though somebody may wait for its answer, and wait until it has ended."""
        if for_good:
            self._over.set()
        self.kill()
        process, self._process = self._process, None
        reader, self._reader = self._reader, None
        if process is not None and reader is not None:
            await asyncio.gather(process.wait(), reader)

    async def ask(self, verb: str, body: bytes, gone: Gone) -> Answer:
        """Return status and body of an answer.

        The verb is one of `asperity.web.verbs.VERBS`, the body what is asked as JSON; ``gone``
        tells whether nobody waits for the answer any more.
        """
        asked = VERBS[verb]
        for _ in range(_TRIES):
            # What it takes to begin, on a busy machine or for the first time, is not its answer's.
            await self._warm(asked.kernels)
            async with self._turn:
                # Begun anew, it may be, while others had their turn.
                await self._warm(asked.kernels)
                if await gone():
                    return _GONE
                if sessions.lives(self._process):
                    return await self._answer(verb, body, asked.seconds, gone)
                await self.start()
        return _line(500, f"the process that answers {verb} does not begin", 1)

    async def _warm(self, kernels: bool) -> None:
        if sessions.lives(self._process):
            with contextlib.suppress(TimeoutError):
                await asyncio.wait_for((self.ready if kernels else self.up).wait(), _SLOWEST_START)

    async def _answer(self, verb: str, body: bytes, seconds: float, gone: Gone) -> Answer:
        process = self._process
        assert process is not None
        assert process.stdin is not None
        head = json.dumps({"verb": verb, "length": len(body)}).encode()
        failed = _line(500, f"the process that solves ended at {verb}; it is started anew", 1)
        try:
            process.stdin.write(head + b"\n" + body)
            async with asyncio.timeout(seconds):
                if answer := await sessions.wanted(self._frames.get(), gone, _PATIENCE):
                    return answer
        except sessions.Unwanted:
            failed = _GONE
        except TimeoutError:
            line = f"{verb} took more than {seconds:g} s, longer than a page waits; ask for less"
            failed = _line(504, line, 3)
        except asyncio.CancelledError:
            # Its answer would be taken for that of whoever asks next.
            await self._again()
            raise
        await self._again()
        return failed

    async def _again(self) -> None:
        await self.stop(for_good=False)
        await self.start()

    async def _read(
        self, process: asyncio.subprocess.Process, frames: asyncio.Queue[Answer | None]
    ) -> None:
        """Take what the process says until it ends."""
        assert process.stdout is not None
        with contextlib.suppress(asyncio.IncompleteReadError, ConnectionError, ValueError):
            while line := await process.stdout.readline():
                head = json.loads(line)
                if "length" in head:
                    body = await process.stdout.readexactly(head["length"])
                    frames.put_nowait((head["status"], body))
                else:
                    (self.ready if "ready" in head else self.up).set()
        frames.put_nowait(None)
        if frames is self._frames:  # nobody waits for one that has ended
            self.up.set()
            self.ready.set()


def _line(status: int, line: str, exit_code: int) -> Answer:
    return status, json.dumps(error_body(line, exit_code)).encode()


_GONE = _line(499, "nobody waits for the answer", 1)

"""Jobs: commands in processes of their own, two at once, kept in the folder of the page."""

import asyncio
import contextlib
import dataclasses
import json
import shutil
import signal
import time
from collections.abc import AsyncIterator
from pathlib import Path
from typing import Any

from asperity import exit_codes
from asperity.errors import AsperityError, StorageError
from asperity.files.store import read_bytes, read_text, reason, write_text
from asperity.processes.sessions import begun, end, heard
from asperity.tribometer.preview import stop
from asperity.web.folder import ANSWER, REQUEST, STATE, Folder
from asperity.web.guard import Refused
from asperity.web.record import ENDED, Job
from asperity.web.verbs import object_of

AT_ONCE = 2
MOST_WAITING = 8
GRACE = 10.0
"""Seconds in which a job that is stopped keeps what it has, before it is ended."""

_HEARTBEAT = 15.0
_BLANK = Job("", "", "", "")


def _kept(path: Path) -> Job:
    """Return a job as it was kept; ValueError or TypeError of what is none."""
    if path.is_symlink():
        raise ValueError("it is a link")
    fields = json.loads(read_text(path))
    # What is no number there would be none in the list of all.
    json.dumps(fields, allow_nan=False)
    job = Job(**fields)
    for field in dataclasses.fields(Job):
        kind, value = type(getattr(_BLANK, field.name)), getattr(job, field.name)
        if (
            not isinstance(value, (int, float) if kind is float else kind)
            and field.name != "reached"
        ):
            raise TypeError(field.name)
    return job


class Jobs:
    """All jobs of a folder.

    Parameters
    ----------
    folder : Folder
        Where they are.
    """

    def __init__(self, folder: Folder) -> None:
        self._folder = folder
        self._held: dict[str, Job] = {}
        self._waiting: list[Job] = []
        self._closing = False
        for path in sorted(folder.jobs.glob(f"*/{REQUEST}"), key=lambda one: one.stat().st_mtime):
            with contextlib.suppress(OSError, ValueError, TypeError, AsperityError):
                job = _kept(path.with_name(STATE))
                if job.id == path.parent.name:
                    # What ran when the server ended does so no more.
                    job.state = job.state if job.state in ENDED else "stopped"
                    job.home = folder.job(job.id)
                    self._held[job.id] = job

    def listed(self) -> list[dict[str, Any]]:
        """Return all of them, the newest first, each with what was asked for."""
        return [job.to_json() | {"asked": job.asked} for job in reversed(self._held.values())]

    def found(self, identity: str) -> Job:
        """Return a job by its name."""
        if identity not in self._held:
            raise Refused(404, "there is no such job")
        return self._held[identity]

    def submit(self, identity: str, line: str, asked: dict[str, Any]) -> dict[str, str]:
        """Begin a job, or go on with it; one that is done is there already."""
        job = self._held.get(identity)
        if job is None:
            job = Job(identity, str(asked["command"]), str(asked.get("case") or ""), line)
            job.home = self._folder.job(identity)
        elif job.state not in ENDED or (job.state == "done" and job.answered):
            return job.brief
        if len(self._running()) >= AT_ONCE and len(self._waiting) >= MOST_WAITING:
            raise Refused(
                429, f"{AT_ONCE} jobs run and {MOST_WAITING} wait; stop one, or ask again later"
            )
        job.home.mkdir(parents=True, exist_ok=True)
        (job.home / ANSWER).unlink(missing_ok=True)
        write_text(job.home / REQUEST, json.dumps(asked))
        self._held[identity] = job
        job.stopping = job.begun = False
        job.error, job.exit_code, job.reached, job.notes = "", exit_codes.DONE, None, []
        job.set("queued")
        self._waiting.append(job)
        self._next()
        return job.brief

    def resume(self, identity: str) -> dict[str, str]:
        """Go on with a job as it was asked for."""
        job = self.found(identity)
        return self.submit(job.id, job.line, object_of(read_bytes(job.home / REQUEST)))

    def stop(self, identity: str) -> dict[str, str]:
        """Stop a job; what is done of it is kept."""
        job = self.found(identity)
        if job in self._waiting:
            self._waiting.remove(job)
            job.set("stopped")
        elif job.state == "running" and not job.stopping:
            job.stopping = True
            with contextlib.suppress(OSError):
                # A rig is switched off by its guardian, whatever its process does.
                stop(job.home)
            if job.process is not None and job.begun:
                with contextlib.suppress(ProcessLookupError, ValueError):
                    job.process.send_signal(signal.SIGINT)
                asyncio.get_running_loop().call_later(GRACE, end, job.process)
            else:
                end(job.process)
        return job.brief

    def forget(self, identity: str) -> dict[str, str]:
        """Remove a job that has ended, with its files."""
        job = self.found(identity)
        if job.state not in ENDED:
            raise Refused(409, f"the job is {job.state}; stop it first")
        try:
            # Where its name is a link it is refused here, not followed.
            shutil.rmtree(self._folder.jobs / identity)
        except OSError as error:
            raise StorageError(f"the job's files cannot be removed: {reason(error)}") from None
        return self._held.pop(identity).brief

    async def close(self) -> None:
        """Stop all of them and wait until they are."""
        self._closing = True
        self._waiting.clear()
        running = self._running()
        for job in running:
            self.stop(job.id)
        tasks = [job.task for job in running if job.task is not None]
        await asyncio.gather(*tasks, return_exceptions=True)

    def kill(self) -> None:
        """End all processes at once."""
        for job in self._running():
            end(job.process)

    async def events(self, job: Job) -> AsyncIterator[str]:
        """Yield what is known of a job whenever it changes, until it has ended."""
        while True:
            news = job.news
            yield f"data: {json.dumps(job.to_json())}\n\n"
            if job.state in ENDED:
                return
            while not news.is_set():
                with contextlib.suppress(TimeoutError):
                    await asyncio.wait_for(news.wait(), _HEARTBEAT)
                if not news.is_set():
                    yield ": still there\n\n"

    def file(self, identity: str, name: str) -> Path:
        """Return a file that a job left."""
        job = self.found(identity)
        if name not in job.files():
            raise Refused(404, "the job has left no such file")
        return job.home / name

    def answer(self, identity: str) -> Path:
        """Return the file of its answer, there or not."""
        return self.found(identity).home / ANSWER

    def _running(self) -> list[Job]:
        return [job for job in self._held.values() if job.state == "running"]

    def _next(self) -> None:
        while self._waiting and len(self._running()) < AT_ONCE and not self._closing:
            job = self._waiting.pop(0)
            job.set("running")
            job.task = asyncio.create_task(self._run(job))

    async def _run(self, job: Job) -> None:
        """Do a job from its begin to its end."""
        job.since = time.monotonic() - job.seconds
        ended = "stopped"
        try:
            job.process = await begun("asperity.web.job", str(self._folder.path), job.id)
            if job.stopping:
                end(job.process)
            await heard(job.process, job.hear)
            ended = job.ended(await job.process.wait())
        except OSError as error:
            job.error, job.exit_code = f"the job cannot begin: {error}", exit_codes.FAILED
            ended = "failed"
        finally:
            job.notify()
            job.process = None
            job.set(ended)
            self._next()

"""What is answered at which address."""

import asyncio
import errno
import filecmp
import json
from collections.abc import Awaitable, Callable
from pathlib import Path
from typing import Any

from starlette.applications import Starlette
from starlette.exceptions import HTTPException
from starlette.requests import Request
from starlette.responses import FileResponse, JSONResponse, Response, StreamingResponse
from starlette.routing import Mount, Route
from starlette.staticfiles import StaticFiles

from asperity import __version__
from asperity.errors import AsperityError
from asperity.files.leftovers import temporary_beside
from asperity.files.store import read_text, reason, write_atomically, write_text
from asperity.start.openable import openable_cases
from asperity.tribometer.preview import runs, stop
from asperity.web.folder import CASE, MOST_FILE, Folder
from asperity.web.guard import Refused, body_of, parts_of, refusal
from asperity.web.jobs import Jobs
from asperity.web.verbs import LIVE, object_of
from asperity.web.warm_worker import WarmWorker

Endpoint = Callable[[Request], Awaitable[Response]]

_NO_ROOM, _FULL = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG), 507
_STATIC = Path(__file__).with_name("static")


class Page:
    """What is behind the addresses of a page.

    Parameters
    ----------
    folder : Folder
        Where cases are read and written.
    """

    def __init__(self, folder: Folder) -> None:
        self.folder = folder
        self.workers = {kind: WarmWorker(kind, folder.path) for kind in ("solver", "lookup")}
        self.jobs = Jobs(folder)

    def application(self) -> Starlette:
        """Return what answers."""
        folder, jobs = self.folder, self.jobs
        asked = {
            "GET /api/about": self._about,
            "GET /api/forms": self._looked_up("forms"),
            "GET /api/case/{case}": self._looked_up("opened"),
            "GET /api/thesis": self._looked_up("thesis"),
            "GET /api/thesis/{name}": _file(lambda at: folder.thesis_file(at["name"])),
            "POST /api/do/{verb}": self._do,
            "POST /api/save": self._save,
            "GET /api/files/{name}": _file(lambda at: folder.file(at["name"])),
            "PUT /api/files/{name}": self._upload,
            "GET /api/runs": self._runs,
            "POST /api/runs/stop": self._stop_run,
            "GET /api/jobs": _answering(lambda _: jobs.listed()),
            "POST /api/jobs": self._submit,
            "GET /api/jobs/{id}": _answering(lambda at: jobs.found(at["id"]).to_json()),
            "DELETE /api/jobs/{id}": _answering(lambda at: jobs.forget(at["id"])),
            "POST /api/jobs/{id}/stop": _answering(lambda at: jobs.stop(at["id"])),
            "POST /api/jobs/{id}/resume": _answering(lambda at: jobs.resume(at["id"])),
            "GET /api/jobs/{id}/events": self._events,
            "GET /api/jobs/{id}/answer": _file(lambda at: jobs.answer(at["id"])),
            "GET /api/jobs/{id}/data": self._looked_up("data"),
            "GET /api/jobs/{id}/files/{name}": _file(lambda at: jobs.file(at["id"], at["name"])),
            "GET /": _index,
        }
        routes = [Route(at.split()[1], to, methods=at.split()[:1]) for at, to in asked.items()]
        files = Mount("/", StaticFiles(directory=_STATIC))
        kinds = AsperityError, Refused, HTTPException, OSError, UnicodeError
        refused: Any = dict.fromkeys(kinds, _refused)
        made = Starlette(routes=[*routes, files], exception_handlers=refused)
        made.router.redirect_slashes = False
        return made

    async def _about(self, request: Request) -> Response:
        names = self.folder.files()
        own = [self.folder.path / name for name in names if name.endswith(CASE)]
        told = {
            "version": __version__,
            "folder": str(self.folder.path),
            "ready": self.workers["solver"].ready.is_set(),
            "cases": [case._asdict() for case in openable_cases(own)],
            "files": names,
        }
        return JSONResponse(told)

    def _looked_up(self, verb: str) -> Endpoint:
        """Return what looks something up by what stands in the address."""

        async def found(request: Request) -> Response:
            asked = {**request.query_params, **request.path_params}
            return await self._ask(verb, request, json.dumps(asked).encode())

        return found

    async def _do(self, request: Request) -> Response:
        verb = request.path_params["verb"]
        if verb not in LIVE:
            raise Refused(404, f"{verb} is not answered at once; what takes longer is a job")
        return await self._ask(verb, request, await body_of(request))

    async def _ask(self, verb: str, request: Request, asked: bytes) -> Response:
        worker = self.workers["solver" if verb in LIVE else "lookup"]
        status, answer = await worker.ask(verb, asked, request.is_disconnected)
        return Response(answer, status, media_type="application/json")

    async def _save(self, request: Request) -> Response:
        asked = object_of(await body_of(request))
        name, text = asked.get("name"), asked.get("toml")
        if not isinstance(name, str) or not isinstance(text, str):
            raise Refused(400, "name and toml must be texts")
        path = self.folder.file(name if name.endswith(CASE) else f"{name}{CASE}")
        if asked.get("replace") is not True and path.exists() and read_text(path) != text:
            raise Refused(409, f"{path.name} is there already; take another name, or replace it")
        write_text(path, text)
        return JSONResponse({"name": path.name})

    async def _upload(self, request: Request) -> Response:
        path = self.folder.file(request.path_params["name"])
        path = path.with_suffix(path.suffix.lower())
        query = request.query_params
        part = temporary_beside(path)
        try:
            with part.open("xb") as file:
                async for each in parts_of(request, MOST_FILE):
                    file.write(each)
            asked = {"part": str(part), "name": path.name, "recorded": "recorded" in query}
            looked = await self._ask("received", request, json.dumps(asked).encode())
            if looked.status_code != 200:
                return looked
            if "replace" not in query and path.exists() and not filecmp.cmp(part, path, False):
                raise Refused(409, f"{path.name} is there already and holds something else")
            write_atomically(path, part.replace)
        finally:
            part.unlink(missing_ok=True)
        return JSONResponse({"name": path.name, "bytes": path.stat().st_size})

    async def _submit(self, request: Request) -> Response:
        body = await body_of(request)
        named = await self._ask("named", request, body)
        if named.status_code != 200:
            return named
        told = json.loads(bytes(named.body))
        return JSONResponse(self.jobs.submit(told["id"], told["line"], object_of(body)))

    async def _runs(self, request: Request) -> Response:
        # A folder may hold many others.
        return JSONResponse(await asyncio.to_thread(runs, self.folder.path))

    async def _stop_run(self, request: Request) -> Response:
        """Have a run of the rig switched off, whoever began it."""
        name = object_of(await body_of(request)).get("run")
        if not isinstance(name, str):
            raise Refused(400, "run must be the name of one that is listed")
        if not stop(self.folder.inside(name)):
            raise Refused(404, "there is no such run")
        return JSONResponse({"run": name})

    async def _events(self, request: Request) -> Response:
        events = self.jobs.events(self.jobs.found(request.path_params["id"]))
        return StreamingResponse(events, media_type="text/event-stream")


def _answering(look_up: Callable[[dict[str, str]], object]) -> Endpoint:
    """Return what tells what is found by what stands in the address."""

    async def answer(request: Request) -> Response:
        return JSONResponse(look_up(request.path_params))

    return answer


def _file(look_up: Callable[[dict[str, str]], Path]) -> Endpoint:
    """Return what hands out the file that is found by what stands in the address."""

    async def answer(request: Request) -> Response:
        path = look_up(request.path_params)
        if path.is_symlink() or not path.is_file():
            raise Refused(404, f"{path.name} is not there")
        return FileResponse(path, filename=path.name)

    return answer


async def _index(request: Request) -> Response:
    return FileResponse(_STATIC / "index.html")


async def _refused(request: Request, error: Exception) -> Response:
    """Return what was refused in one line."""
    if isinstance(error, HTTPException):
        return refusal(error.status_code, f"{error.detail}: {request.method} {request.url.path}")
    if isinstance(error, AsperityError):
        return refusal(400, str(error), error.exit_code)
    if isinstance(error, OSError):
        line = f"{request.method} {request.url.path}: {reason(error)}"
        return refusal(_FULL if error.errno in _NO_ROOM else 500, line, 1)
    if isinstance(error, UnicodeError):
        return refusal(400, "there is half a character in it, of which no text can be made")
    return refusal(getattr(error, "status", 500), str(error))

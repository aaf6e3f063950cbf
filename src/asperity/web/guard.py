"""Who may ask the page for something, and what a browser may do with it.

Other programs of the machine, other users and other pages reach the same address. A request must
name this server as its host, so that no name of elsewhere that is made to point here gets through;
what is behind ``/api/`` takes the token that was printed with the address, and the page's own
origin.
"""

import asyncio
import hmac
import sys
import traceback
from collections.abc import AsyncIterator, Awaitable, Callable, MutableMapping
from typing import Any

from starlette.requests import ClientDisconnect, Request
from starlette.responses import JSONResponse

from asperity import exit_codes
from asperity.web.verbs import error_body

Scope = MutableMapping[str, Any]
Message = MutableMapping[str, Any]
Receive = Callable[[], Awaitable[Message]]
Send = Callable[[Message], Awaitable[None]]
App = Callable[[Scope, Receive, Send], Awaitable[None]]

PATIENCE = 20.0
"""Seconds in which the next part of a request must come."""

MOST_BODY = 1_000_000
"""Bytes of a request, but for files that are uploaded."""

_HEADERS = {
    "content-security-policy": (
        "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob:; "
        "connect-src 'self'; font-src 'self'; base-uri 'none'; form-action 'none'; "
        "frame-ancestors 'none'; require-trusted-types-for 'script'"
    ),
    "x-content-type-options": "nosniff",
    "referrer-policy": "no-referrer",
    "cross-origin-opener-policy": "same-origin",
    "cross-origin-resource-policy": "same-origin",
}
_SENT = [(name.encode(), value.encode()) for name, value in _HEADERS.items()]


class Refused(Exception):  # noqa: N818 - a request that is not answered is no error of the server
    """A request that is not answered, with the status that says why."""

    def __init__(self, status: int, line: str) -> None:
        super().__init__(line)
        self.status = status


def refusal(status: int, line: str, exit_code: int = exit_codes.BAD_INPUT) -> JSONResponse:
    """Return what is answered where there is no answer: one line."""
    # What was given may stand in the line, with half a character in it.
    line = line.encode("utf-8", "replace").decode()
    return JSONResponse(error_body(line, exit_code), status)


class Guard:
    """An application behind its guard.

    Parameters
    ----------
    app : callable
        What answers what is let through.
    token : str
        What a request to ``/api/`` must bring.
    port : int
        Where the server listens.
    """

    def __init__(self, app: App, token: str, port: int) -> None:
        self._app = app
        self._token = token.encode()
        self._hosts = tuple(f"{name}:{port}".encode() for name in ("127.0.0.1", "localhost"))
        self._origins = tuple(b"http://" + host for host in self._hosts)

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer a request or refuse it."""
        if scope["type"] != "http":
            if scope["type"] == "lifespan":
                await self._app(scope, receive, send)
            return
        begun = False

        async def sent(message: Message) -> None:
            nonlocal begun
            if message["type"] == "http.response.start":
                begun = True
                kept = b"no-store" if scope["path"].startswith("/api/") else b"no-cache"
                message["headers"] = [*message["headers"], *_SENT, (b"cache-control", kept)]
            await send(message)

        try:
            self._look_at(scope)
            await self._app(scope, receive, sent)
        except ClientDisconnect:
            return
        except Refused as error:
            await refusal(error.status, str(error))(scope, receive, sent)
        except Exception as error:
            # For who maintains this; whoever asked is told no more than that it failed.
            traceback.print_exc(file=sys.stderr)
            if begun:
                raise
            line = f"the server failed ({type(error).__name__}); what it printed says more"
            await refusal(500, line, 1)(scope, receive, sent)

    def _look_at(self, scope: Scope) -> None:
        """Refuse a request that does not come from the page."""
        headers: dict[bytes, list[bytes]] = {}
        for name, value in scope["headers"]:
            headers.setdefault(name.lower(), []).append(value)
        hosts = headers.get(b"host", [])
        if len(hosts) != 1 or hosts[0].lower() not in self._hosts:
            raise Refused(421, "this server answers at 127.0.0.1 and localhost only")
        if not scope["path"].startswith("/api/"):
            if scope["method"] not in ("GET", "HEAD"):
                raise Refused(405, f"{scope['method']} is not for files")
            return
        given = headers.get(b"x-asperity-token", [b""])
        if len(given) != 1 or not hmac.compare_digest(given[0], self._token):
            raise Refused(403, "the token is missing or of another server; open the address that "
                               "asperity page printed")  # fmt: skip
        if any(origin not in self._origins for origin in headers.get(b"origin", [])):
            raise Refused(403, "the request comes from another page")
        if any(site != b"same-origin" for site in headers.get(b"sec-fetch-site", [])):
            raise Refused(403, "the request comes from another site")
        kind = headers.get(b"content-type", [b""])[0].partition(b";")[0].strip().lower()
        if scope["method"] == "POST" and kind != b"application/json":
            raise Refused(415, "the body must be application/json")


async def body_of(request: Request) -> bytes:
    """Return the body of a request; refuses one that is too long."""
    return b"".join([part async for part in parts_of(request, MOST_BODY)])


async def parts_of(request: Request, most: int) -> AsyncIterator[bytes]:
    """Yield the body of a request as it comes; refuses one that is too long, before it is read."""
    size = 0
    if int(request.headers.get("content-length", 0)) > most:
        raise Refused(413, f"at most {most} bytes are taken")
    stream = request.stream()
    while True:
        try:
            async with asyncio.timeout(PATIENCE):
                part = await anext(stream, None)
        except TimeoutError:
            raise Refused(408, f"nothing more of the request has come for {PATIENCE:g} s") from None
        if part is None:
            return
        size += len(part)
        if size > most:
            raise Refused(413, f"at most {most} bytes are taken")
        yield part

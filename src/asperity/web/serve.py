"""The server: its address, its life and its end."""

import asyncio
import contextlib
import contextvars
import html
import os
import socket
import webbrowser
from collections.abc import Callable
from pathlib import Path
from urllib.parse import urlencode

from asperity.errors import InputError, StorageError
from asperity.files.store import reason
from asperity.processes.alone import alone
from asperity.start.openable import opened
from asperity.web.folder import Folder
from asperity.web.token import token_of

HOST = "127.0.0.1"
_HELD = ".asperity-page"
_DOOR = "asperity-page.html"  # no hidden name: browsers that are packed away cannot read those
PORT = 8321
"""Where the page is if nothing else is asked for and nobody else is there."""


def serve(
    case: str, port: int, folder: Path | None, tell: Callable[[str], None], units: str = "", *,
    browser: bool,
) -> None:  # fmt: skip
    """Serve the page until Ctrl-C.

    Parameters
    ----------
    case : str
        One that is opened, a file or the name of one that ships; empty: none.
    port : int
        Where to listen; 0: at the usual place, or where there is room.
    folder : path or None
        Where cases, uploads and jobs are; None: where the case is, or the working directory.
    tell : callable
        Takes the address.
    units, browser : str, bool
        What it opens in, empty: as its reader chose or the case has it; and whether to open it.
    """
    import uvicorn

    from asperity.web.app import Page
    from asperity.web.guard import Guard
    from asperity.web.patience import Patient

    place, name, screen = opened(case, folder)
    listening = _socket(port)
    number = listening.getsockname()[1]
    token = token_of(place)
    door = place.resolve() / _DOOR
    query = urlencode({k: v for k, v in (("case", name), ("token", token), ("units", units)) if v})
    address = f"http://{HOST}:{number}/#/{screen}?{query}"

    async def life() -> None:
        page = Page(Folder(place))
        config = uvicorn.Config(
            Guard(page.application(), token, number), http=Patient, loop="asyncio", ws="none",
            lifespan="off", access_log=False, log_config=None, log_level="critical",
            server_header=False, timeout_graceful_shutdown=1,
        )  # fmt: skip
        server = uvicorn.Server(config)

        def ended(_number: int, _frame: object) -> None:
            server.should_exit = True

        # It ends by Ctrl-C as by its own will, so that jobs are stopped after it.
        server.handle_exit = ended  # type: ignore[method-assign, assignment]
        for worker in page.workers.values():
            await worker.start()
        tell(address)
        try:
            if browser:
                _open(address, door)
            await server.serve(sockets=[listening])
            await page.jobs.close()
            for worker in page.workers.values():
                await worker.stop()
        finally:
            # Whatever came between, as a second Ctrl-C: nothing goes on without the page.
            page.jobs.kill()
            for worker in page.workers.values():
                worker.kill()
            door.unlink(missing_ok=True)

    taken = f"is served already at http://{HOST}:{number}; open the address printed there, or "
    held = alone(place.resolve() / _HELD, taken + "take another --folder")
    with contextlib.suppress(KeyboardInterrupt), contextlib.closing(listening), held:
        # What the page reads it may also write: nothing is noted as the input of a command.
        contextvars.Context().run(asyncio.run, life())


def _open(address: str, door: Path) -> None:
    """Open an address in the browser by a file that leads to it and is its owner's alone.

    What is called with the address itself shows the token to every user of the machine.
    """
    door.unlink(missing_ok=True)
    descriptor = os.open(door, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600)
    with os.fdopen(descriptor, "w", encoding="utf-8") as file:
        file.write(
            '<!doctype html><meta charset="utf-8"><title>asperity</title>'
            f'<meta http-equiv="refresh" content="0;url={html.escape(address)}">'
            f'<a href="{html.escape(address)}">asperity page</a>'
        )
    webbrowser.open(door.resolve().as_uri())


def _socket(port: int) -> socket.socket:
    """Return a socket of this machine alone."""
    for number in (port,) if port else (PORT, 0):
        # Named as TCP, so that asyncio sends what is small at once: it would wait 40 ms otherwise.
        made = socket.socket(socket.AF_INET, socket.SOCK_STREAM, socket.IPPROTO_TCP)
        made.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            made.bind((HOST, number))
            # Whoever opens the address at once waits until it is answered.
            made.listen(128)
            return made
        except OSError as error:
            made.close()
            why = reason(error)
        except OverflowError:
            made.close()
            raise InputError(f"--port {port}: it must be from 1 to 65535") from None
    raise StorageError(f"--port {port}: {why}; give another, or leave it out")

"""A process that answers: ``python -m asperity.web.worker solver FOLDER``, or ``lookup``.

It reads requests from standard input, a line of JSON and a body each, and writes answers to what
was its standard output in the same way; what else is printed goes to standard error. It ends with
the server, however that ends: the end of its input is heard at any time.
"""

import functools
import importlib
import json
import os
import queue
import sys
import threading
import traceback
from collections.abc import Callable
from pathlib import Path
from typing import Any, BinaryIO

from asperity.errors import AsperityError, ConvergenceError
from asperity.web.folder import Folder
from asperity.web.verbs import LIVE, error_body, object_of


def main(kind: str, folder: str) -> None:
    """Answer until the server is gone; what is live has its kernels compiled at once."""
    output = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)
    asked: queue.SimpleQueue[tuple[str, bytes]] = queue.SimpleQueue()
    threading.Thread(target=_listen, args=(sys.stdin.buffer, asked), daemon=True).start()
    sending = threading.Lock()

    def send(head: dict[str, Any], body: bytes = b"") -> None:
        with sending:
            output.write(json.dumps(head).encode() + b"\n" + body)
            output.flush()

    def warm(solve: Callable[[], object]) -> None:
        try:
            solve()
        finally:
            # What could not be done now is done, or refused, when it is asked for.
            send({"ready": True})

    place = Folder(Path(folder))
    # A name of a file in a setting begins here, as on the command line.
    os.chdir(place.path)
    importlib.import_module("asperity.web.answer")
    if kind == "solver":
        threading.Thread(target=warm, args=(_load(),), daemon=True).start()
    send({"up": True})
    while True:
        verb, body = asked.get()
        status, answer = _answered(verb, body, place)
        send({"status": status, "length": len(answer)}, answer)


def _listen(source: BinaryIO, asked: "queue.SimpleQueue[tuple[str, bytes]]") -> None:
    """Take requests; end the process when there is nobody left to ask."""
    while line := source.readline():
        head = json.loads(line)
        asked.put((head["verb"], source.read(head["length"])))
    os._exit(0)


def _answered(verb: str, body: bytes, folder: Folder) -> tuple[int, bytes]:
    """Return status and body of an answer, whatever happens."""
    from asperity.results.quantity import plain as jsonable
    from asperity.web import answer as answers

    status = 400
    try:
        asked = object_of(body)
        answer = getattr(answers, verb, answers.solved)(folder, {**asked, "verb": verb})
        return 200, json.dumps(answer, allow_nan=False, separators=(",", ":")).encode()
    except ConvergenceError as error:
        status, refused = 422, error_body(str(error), error.exit_code, jsonable(error.reached))
    except AsperityError as error:
        refused = error_body(str(error), error.exit_code)
    except Exception as error:
        # For who maintains this; whoever asked is told no more than that it failed.
        traceback.print_exc(file=sys.stderr)
        line = f"{verb} failed ({type(error).__name__}); what the server printed says more"
        status, refused = 500, error_body(line, 1)
    return status, json.dumps(refused).encode()


def _load() -> Callable[[], object]:
    """Import what is solved with; returns what compiles and loads the kernels.

    Modules are imported in one thread: of two that import what belongs together, one may see the
    half of it.
    """
    from asperity.casefile import read_case
    from asperity.commands import COMMANDS, case_tables
    from asperity.slider.slide import prepare, solve

    for command in COMMANDS:
        if command.name in LIVE:
            importlib.import_module(command.module)
    for module in ("slider.curves", "start.check", "tribometer.reduction.overview"):
        importlib.import_module(f"asperity.{module}")
    importlib.import_module("numba")
    model = prepare(read_case("table-4.3", case_tables(), ["solve.method=periodic"]))
    return functools.partial(solve, model)


if __name__ == "__main__":
    main(*sys.argv[1:])

"""The process of a job: ``python -m asperity.web.job FOLDER ID``.

It does what ``request.json`` in the job's folder says, in the order of every command, and tells how
far it is in lines of JSON on what was its standard output. Ctrl-C from the server, or the end of
the server, stops it as Ctrl-C on a terminal does: what is done is kept.
"""

import contextlib
import json
import os
import sys
from pathlib import Path
from typing import Any

from asperity import exit_codes
from asperity.processes.interrupts import reraise_pending
from asperity.runs.interrupt import stop_of, stop_with_input
from asperity.web.folder import REQUEST, Folder

_GRACE = 10.0


def main(folder: str, identity: str) -> int:
    """Do a job; returns its exit code."""
    output = os.fdopen(os.dup(1), "w", encoding="utf-8")
    os.dup2(2, 1)

    def say(**told: Any) -> None:
        with contextlib.suppress(BrokenPipeError):
            output.write(json.dumps(told) + "\n")
            output.flush()

    reraise_pending()
    stop_with_input(_GRACE)
    try:
        return _done(Folder(Path(folder)), identity, say)
    except (KeyboardInterrupt, RuntimeError) as error:
        stop = stop_of(error)
        if stop is None:
            raise
        say(note=str(stop) or "stopped")
        return exit_codes.INTERRUPTED


def _done(folder: Folder, identity: str, say: Any) -> int:
    from asperity import __version__
    from asperity.commands.execution import execute
    from asperity.errors import AsperityError, ConvergenceError
    from asperity.results.quantity import plain
    from asperity.web.ask import request_of
    from asperity.web.teller import JobTeller

    # A name of a file begins here, as on the command line.
    os.chdir(folder.path)
    home = folder.job(identity)
    try:
        asked = request_of(json.loads((home / REQUEST).read_text("utf-8")), folder)
        command, options = asked.command, dict(asked.options)
        source = folder.case_name(asked.name) if asked.name else ""
        if "resume" in options and (home / "journal.jsonl").exists():
            options["resume"] = True
        out = home if command.out == "DIR" else home / command.out
        teller = JobTeller(asked, folder, home, say)
        execute(command, source, asked.settings, teller, version=__version__, out=out, **options)
    except AsperityError as error:
        reached = error.reached if isinstance(error, ConvergenceError) else None
        say(error=str(error), exit_code=error.exit_code, reached=plain(reached))
        return error.exit_code
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))

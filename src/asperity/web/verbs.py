"""What workers are asked: commands that take milliseconds, and what a page needs besides."""

import json
from typing import Any, NamedTuple

from asperity.errors import InputError, plain


class Verb(NamedTuple):
    """Something a worker is asked for: a command, or a function of `asperity.web.answer`.

    Attributes
    ----------
    seconds : float
        How long it may take.
    kernels : bool
        Whether it needs what is compiled.
    """

    seconds: float
    kernels: bool = False


# Of what is solved, several times what the longest march takes: a busy machine is no hung process,
# and who goes meanwhile has it begun anew within a second.
LIVE = {
    "slide": Verb(30.0, kernels=True),
    "rate": Verb(30.0),
    "sensitivity": Verb(20.0, kernels=True),
    "methods": Verb(20.0, kernels=True),
    "curve": Verb(60.0, kernels=True),
    "size": Verb(60.0),
    "check": Verb(20.0),
    "signals": Verb(60.0),
}
"""Those that are asked at ``/api/do/``, of the worker that solves."""

LOOKUP = dict.fromkeys(("forms", "opened", "named", "received", "thesis", "data"), Verb(60.0))
"""Those that look something up, of a worker that never waits for one that solves."""

VERBS = LIVE | LOOKUP


def error_body(line: str, exit_code: int, reached: object = None) -> dict[str, Any]:
    """Return an error as the page takes it: one line with nothing in it that would act."""
    return {"error": plain(" ".join(line.split())), "exit_code": exit_code, "reached": reached}


def object_of(body: bytes) -> dict[str, Any]:
    """Return the JSON object that a body is; refuses any other."""
    try:
        asked = json.loads(body)
    except (ValueError, RecursionError):
        raise InputError("the body is not JSON") from None
    if not isinstance(asked, dict):
        raise InputError("the body must be a JSON object")
    return asked

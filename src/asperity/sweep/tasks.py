"""What is solved at a time, here or on a worker, and what is kept of each point."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from asperity.errors import AsperityError, ConvergenceError, InputError
from asperity.kernels.closure import source_key
from asperity.kernels.fingerprint import machine
from asperity.results import Result
from asperity.runs.row_cache import Row
from asperity.sweep.subject import Subject, named

FAILED = "failed"
REFUSED = "refused"


def solve_task(
    problems: Sequence[Any], stop: np.ndarray | None = None, subject: str = ""
) -> list[Row]:
    """Solve a few points and return the scalars of each, or why there are none.

    Parameters
    ----------
    problems : sequence
        At best of one kind and not more than the subject's `task_size`.
    stop : ndarray of int64, shape (1,), optional
        Set it to 1 from another thread to have it end soon.
    subject : str
        What they are, by name; sliding bodies if left out.
    """
    of = named(subject)
    return [_row(of, answer) for answer in of.solve(problems, stop)]


def versions(subject: str = "") -> dict[str, str]:
    """Return the versions that two machines must share to get the same results."""
    # The processor is not among them, though it is in the key a result is kept under: which
    # instructions it has moves the last bits of a result, and a cluster may well be of several
    # kinds.
    numba, numpy, _ = machine()
    sources = source_key(__name__, named(subject).module)
    return {"asperity": sources, "numba": numba, "numpy": numpy}


def solve_remote(
    problems: Sequence[Any], wanted_versions: Mapping[str, str], subject: str = ""
) -> list[Row]:
    """Solve a task on a worker, which must have the `versions` of who asked."""
    # Otherwise results of other code would be kept as results of this one.
    own = versions(subject)
    if different := [name for name in wanted_versions if own.get(name) != wanted_versions[name]]:
        raise InputError(
            f"a worker runs another version of {' and '.join(different)}; install the same "
            "everywhere"
        )
    return solve_task(problems, subject=subject)


def _row(subject: Subject, answer: Result | AsperityError) -> Row:
    if isinstance(answer, ConvergenceError):
        reached = ", ".join(f"{name} {value:.3g}" for name, value in answer.reached.items())
        return {FAILED: f"{answer} ({reached})" if reached else str(answer)}
    if isinstance(answer, AsperityError):
        return {FAILED if subject.gaps else REFUSED: str(answer)}
    # What a body does not have at all, as one without normal freedom, is not in its row.
    return subject.scalars(answer)

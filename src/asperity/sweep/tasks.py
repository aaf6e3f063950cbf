"""What is solved at a time, here or on a worker, and what is kept of each point."""

import functools
from collections.abc import Mapping, Sequence

import numpy as np

from asperity.closure import source_key
from asperity.compiled import machine
from asperity.errors import AsperityError, ConvergenceError, InputError
from asperity.runs.rows import Row
from asperity.slider.batch import fits_batch, solve_many
from asperity.slider.batch_rows import WIDTH
from asperity.slider.model import Model
from asperity.slider.result import SlideResult

FAILED = "failed"
REFUSED = "refused"
VARIABLES = SlideResult.scalars()


def task_size(model: Model) -> int:
    """Points solved before they are kept: a compiled batch, or one where each is slow."""
    if fits_batch(model) or model.solve.method == "periodic":
        return WIDTH
    return 1


def solve_task(models: Sequence[Model], stop: np.ndarray | None = None) -> list[Row]:
    """Solve a few points and return the scalars of each, or why there are none.

    They are at best of one kind and not more than `task_size`; ``stop`` is as for `solve_many`.
    """
    return [_row(answer) for answer in solve_many(models, stop=stop)]


@functools.cache
def versions() -> dict[str, str]:
    """Return the versions that two machines must share to get the same results."""
    # The processor is not among them, though it is in the key a result is kept under: which
    # instructions it has moves the last bits of a result, and a cluster may well be of several
    # kinds.
    numba, numpy, _ = machine()
    return {"asperity": source_key(__name__), "numba": numba, "numpy": numpy}


def solve_remote(models: Sequence[Model], asked: Mapping[str, str]) -> list[Row]:
    """Solve a task on a worker, which must have the `versions` of who asked."""
    # Otherwise results of other code would be kept as results of this one.
    own = versions()
    if different := [name for name in asked if own.get(name) != asked[name]]:
        raise InputError(
            f"a worker runs another version of {' and '.join(different)}; install the same "
            "everywhere"
        )
    return solve_task(models)


def _row(answer: SlideResult | AsperityError) -> Row:
    if isinstance(answer, ConvergenceError):
        reached = ", ".join(f"{name} {value:.3g}" for name, value in answer.reached.items())
        return {FAILED: f"{answer} ({reached})" if reached else str(answer)}
    if isinstance(answer, AsperityError):
        return {REFUSED: str(answer)}
    scalars = answer.to_json()
    # What a body does not have at all, as one without normal freedom, is not in its row.
    return {entry.name: scalars[entry.key] for entry in VARIABLES if entry.key in scalars}

"""What is solved at a time, here or on a worker, and what is kept of each point."""

import dataclasses
import functools
from collections.abc import Mapping, Sequence

import numpy as np

from asperity.closure import source_key
from asperity.compiled import machine
from asperity.errors import AsperityError, ConvergenceError, InputError
from asperity.slider.batch import fits_lanes, solve_many
from asperity.slider.lanes import LANES
from asperity.slider.model import Model
from asperity.slider.result import SlideResult
from asperity.sweep.cache import Row

FAILED = "failed"
REFUSED = "refused"


@dataclasses.dataclass(frozen=True)
class Variable:
    """A scalar of a result that a sweep keeps.

    Attributes
    ----------
    name : str
        In the dataset.
    key : str
        In :meth:`asperity.slider.result.SlideResult.to_json`.
    units, long_name : str
        As written in the dataset.
    """

    name: str
    key: str
    units: str
    long_name: str


VARIABLES = (
    Variable("ratio", "ratio", "1", "mean drive force over mu F_N"),
    Variable("drive_force", "drive_force_N", "N", "mean drive force"),
    Variable(
        "static_drive_force", "static_drive_force_N", "N", "drive force without vibration, mu F_N"
    ),
    Variable(
        "breakaway_time", "breakaway_time_s", "s", "time of breakaway; NaN where there is none"
    ),
    Variable("friction_x_mean", "friction_x_mean_N", "N", "mean friction along the drive"),
    Variable("friction_x_max", "friction_x_max_N", "N", "greatest friction along the drive"),
    Variable("friction_x_min", "friction_x_min_N", "N", "least friction along the drive"),
    Variable("friction_y_mean", "friction_y_mean_N", "N", "mean friction across the drive"),
    Variable("friction_y_max", "friction_y_max_N", "N", "greatest size of friction across"),
    Variable("power_drive", "power_drive_W", "W", "power of the drive"),
    Variable("power_vibration", "power_vibration_W", "W", "power of the vibration"),
    Variable("power_friction", "power_friction_W", "W", "power lost to friction"),
    Variable("power_damping", "power_damping_W", "W", "power lost in the drive's damper"),
    Variable("power_stored", "power_stored_W", "W", "rate of change of stored energy"),
    Variable(
        "power_untransferred", "power_untransferred_W", "W",
        "power friction would take from the untransferred vibration",
    ),
    Variable(
        "power_residual", "power_residual", "1", "missing power over that of the drive"
    ),
    Variable("residual", "residual", "1", "residual of the method"),
)  # fmt: skip


def task_size(model: Model) -> int:
    """Points solved before they are kept: a batch of lanes, or one where each is slow."""
    if fits_lanes(model) or model.solve.method == "periodic":
        return LANES
    return 1


def solve_task(models: Sequence[Model], stop: np.ndarray | None = None) -> list[Row]:
    """Solve a few points and return the scalars of each, or why there are none.

    Parameters
    ----------
    models : sequence of Model
        At best of one kind and not more than `task_size`.
    stop : ndarray of int64, shape (1,), optional
        As for :func:`asperity.slider.batch.solve_many`.
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
    return {variable.name: scalars.get(variable.key) for variable in VARIABLES}

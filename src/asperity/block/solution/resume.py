"""Where a block's march stands, as a tree of arrays to go on from.

Numbers that decide the result are kept to the last bit, and what the solvers have learnt on their
way as well: a march that goes on ends exactly as one that was never interrupted.
"""

import dataclasses
import functools

import numpy as np

from asperity.arrays import FloatArray
from asperity.block.problem import BlockProblem
from asperity.block.result import inputs
from asperity.block.series import Frame
from asperity.contact.increment.solver import SolverMemory
from asperity.contact.motion.ledger import Energies
from asperity.contact.motion.steps import Snapshot
from asperity.runs.key import code_key, key


@dataclasses.dataclass(frozen=True, eq=False)
class MarchState:
    """All that a march goes on from, see `asperity.block.solution.march.BlockMarch`.

    Attributes
    ----------
    done : int
        Increments solved.
    seconds, march_seconds, timed : float, float, int
        Times and their number as in `asperity.block.result.BlockResult`.
    rows : ndarray
        Recorded history.
    frames : list of Frame
        Recorded for an animation.
    window_energies, first_half, first_pressure : Energies, ndarray, ndarray; or None
        Of the window, as far as it is reached.
    snapshot : Snapshot
        Of the stepper.
    memories : dict of SolverMemory
        Its solvers', by the length of their step.
    """

    done: int
    seconds: float
    march_seconds: float
    timed: int
    rows: FloatArray
    frames: list[Frame]
    window_energies: Energies | None
    first_half: FloatArray | None
    first_pressure: FloatArray | None
    snapshot: Snapshot
    memories: dict[str, SolverMemory]


def march_key(problem: BlockProblem) -> str:
    """Return a text that is the same for what calculates the same, by these sources."""
    parts = [repr(sorted(inputs(problem).items()))]
    shape = problem.model.shape
    if shape is None:
        return key(_sources(), *parts)
    parts.append(repr((shape.code, shape.frequency, shape.rise)))
    return key(_sources(), *parts, np.ascontiguousarray(shape.table))


@functools.cache
def _sources() -> str:
    return code_key("asperity.block.solution.march")

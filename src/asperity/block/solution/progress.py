"""What a march of a block has come to, as it is kept and gone on with."""

import dataclasses

from asperity.arrays import FloatArray
from asperity.block.series import Frame
from asperity.contact.increment.solver import SolverMemory
from asperity.contact.motion.ledger import Energies
from asperity.contact.motion.steps import Snapshot
from asperity.contact.motion.sums import Sums


@dataclasses.dataclass(frozen=True, eq=False)
class Progress:
    """What a march has come to, in one piece: no interruption can split it."""

    snapshot: Snapshot  #: Of the stepper
    done: int = 0  #: Increments solved
    #: seconds, march_seconds, timed: As in `asperity.block.result.BlockResult`
    seconds: float = 0.0
    march_seconds: float = 0.0
    timed: int = 0
    #: (3, numbers of a node): Mean, least and greatest of each recorded stretch
    rows: tuple[FloatArray, ...] | FloatArray = ()
    nodes: tuple[FloatArray, ...] | FloatArray = ()  #: Of the stretch under way
    frames: tuple[Frame, ...] = ()  #: For an animation
    #: window_energies, first_half, first_pressure: Of the window, as far as it is reached
    window_energies: Energies | None = None
    first_half: Sums | None = None
    first_pressure: FloatArray | None = None
    #: Of the first quarter of the window, and of the third
    quarters: tuple[Sums, ...] = ()
    durations: tuple[float, ...] = ()  #: It has gone on to since that of the case, s


@dataclasses.dataclass(frozen=True, eq=False)
class Kept:
    """What a march is gone on with: how far it is, and what its solvers have learnt."""

    progress: Progress
    memories: dict[str, SolverMemory]

"""Elastic blocks beside the sliding bodies they are: settled under vibration, or from rest.

A block settles as `asperity.block.solution.settled` has it, and so do the bodies it is compared
with, over the same cycles.
"""

import dataclasses
import functools
import shlex
from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from asperity.block.problem import BlockProblem
from asperity.block.result import BlockResult
from asperity.block.solution import settled
from asperity.block.solution.march import solve_block
from asperity.block.tables import TABLES as BLOCK_TABLES
from asperity.casefile import read_case
from asperity.contact.interface.surface import contact_surface
from asperity.contact.motion import mechanism as mo
from asperity.contact.motion.rest import rest_under_load
from asperity.contact.motion.system import System, SystemState
from asperity.mesh import box
from asperity.slider import Model
from asperity.slider.periodic import solve_periodic
from asperity.slider.tables import TABLES as SLIDER_TABLES

FloatArray = npt.NDArray[np.float64]

_TABLES = {**SLIDER_TABLES, **BLOCK_TABLES}

LIGHT = ("block.elements=[4, 3, 3]", "block.element=hex8")
"""A mesh of 20 contact nodes; without these settings a shipped block has 221."""


@dataclasses.dataclass(frozen=True)
class Settled:
    """What an elastic block under vibration comes to, and the sliding bodies beside it.

    Attributes
    ----------
    ratio : float
        Mean friction along the drive over mu F_N, at the drive's velocity.
    slider : float
        The sliding body's periodic state.
    in_series : float
        The sliding body with the block's compliance as a spring between it and its asperities,
        settled as the block is.
    rocking : float
        The same where the block's turns on its contact, most of that compliance, have inertia.
    unsteadiness : float
        Half of what the highest and the lowest of four successive windows of the block's ratio, as
        long as one another, are apart.
    cycles : int
        In the four windows together.
    late : float
        By how much of the drive's velocity the block was slower in the cycles measured.
    """

    ratio: float
    slider: float
    in_series: float
    rocking: float
    unsteadiness: float
    cycles: int
    late: float


@dataclasses.dataclass(frozen=True)
class Block:
    """A shipped case of an elastic block with settings."""

    case: str
    settings: tuple[str, ...] = ()

    def model(self, **changes: float) -> Model:
        """The sliding body it is, with values of keys in SI (``slider__drive_velocity=...``)."""
        case = read_case(self.case, _TABLES, self.settings)
        values = {key.replace("__", "."): value for key, value in changes.items()}
        return Model.from_case(case.replace_values(values) if values else case)

    def settled(self) -> Settled:
        """Its friction under steady vibration; solved once in a process."""
        return _settled(self)

    def march(self) -> BlockResult:
        """From rest, as ``asperity block`` has it; solved once in a process."""
        return _marched(self)

    @property
    def unshaken(self) -> tuple[str, ...]:
        """Settings but those of the vibration."""
        return tuple(s for s in self.settings if not s.startswith("vibration."))

    @property
    def how(self) -> str:
        """How to come by what it settles to."""
        settings = "".join(f"{setting!r}, " for setting in self.settings)
        return f"asperity.thesis.contact.blocks.Block({self.case!r}, ({settings})).settled()"

    @property
    def command(self) -> str:
        """The march from rest on the command line."""
        settings = " ".join(f"--set {shlex.quote(setting)}" for setting in self.settings)
        return f"asperity block {self.case} {settings}".strip()


def settle_all(blocks: Sequence[Block]) -> list[Settled]:
    """Settle blocks one after the other.

    Threads would not be faster: between the compiled loops, which are short, they wait for the
    interpreter and wake each other.
    """
    return [block.settled() for block in blocks]


@functools.cache
def _marched(block: Block) -> BlockResult:
    return solve_block(BlockProblem.from_case(read_case(block.case, _TABLES, block.settings)))


@dataclasses.dataclass(frozen=True, eq=False)
class _Resting:
    """A block, and the sliding bodies with its compliance, all at rest under their loads."""

    block: tuple[System, SystemState]
    in_series: tuple[System, SystemState]
    rocking: tuple[System, SystemState]


@functools.cache
def _at_rest(case: str, settings: tuple[str, ...]) -> _Resting:
    problem = BlockProblem.from_case(read_case(case, _TABLES, settings))

    def resting(system: System, loads: tuple[mo.Port, ...] = ()) -> tuple[System, SystemState]:
        load = system.mechanism.load
        if load is None:
            raise ValueError("not loaded")
        return system, rest_under_load(system, loads or (load,))

    return _Resting(
        resting(problem.system, problem.loads),
        resting(in_series(problem)),
        resting(in_series(problem, rocking=True)),
    )


@functools.cache
def _settled(block: Block) -> Settled:
    resting = _at_rest(block.case, block.unshaken)
    model = block.model()
    slider = solve_periodic(model)
    bodies = (resting.block, resting.in_series, resting.rocking)
    reading = settled.read_settled(bodies, slider, settled.slope_over_velocity(model))
    ratio, springy, rocking = (float(ratios.mean()) for ratios in reading.windows)
    return Settled(
        ratio=ratio,
        slider=slider.ratio,
        in_series=springy,
        rocking=rocking,
        unsteadiness=0.5 * float(np.ptp(reading.windows[0])),
        cycles=reading.cycles,
        late=reading.late[0],
    )


def in_series(problem: BlockProblem, *, rocking: bool = False) -> System:
    """Return the sliding body of a block with the block's compliance before its asperities.

    A body that only shifts, under its constant normal force, on one face whose nodes give together
    under all the friction there is: by `BlockProblem.compliance`, which nothing is fitted to.

    Parameters
    ----------
    problem : BlockProblem
        The block.
    rocking : bool
        Whether the block's turns on its contact have their inertia; without, all of the
        compliance is a spring.
    """
    surface = contact_surface(box(problem.block.size, (1, 1, 1), 1), "bottom")
    count = len(surface.nodes)
    compliance, slider = problem.compliance, problem.model.slider
    levers = compliance.levers if rocking else np.empty((2, 0))
    turns, size = levers.shape[1], 3 + levers.shape[1]
    face, give = np.zeros((3, size)), np.zeros((3, 3))
    face[:, :3] = np.eye(3)
    face[:2, 3:] = levers
    give[:2, :2] = compliance.at_once if rocking else compliance.static
    mass, stiffness = problem.mass * np.eye(size), np.zeros((size, size))
    if rocking:
        mass[3:, 3:], stiffness[3:, 3:] = compliance.mass, compliance.stiffness
    shapes, none = np.tile(face, (count, 1)), np.zeros(3 * count)
    along, down = np.zeros(size), np.zeros(size)
    along[0], down[2] = 1.0, -slider.normal_force
    mechanism = mo.Mechanism(
        flexibility=np.tile(give, (count, count)),
        shapes=shapes,
        mass=mass,
        stiffness=stiffness,
        held=np.array([False, not slider.free, False] + [False] * turns),
        drive=mo.Drive(mo.Port(along, none), slider.drive_stiffness or 0.0, slider.drive_damping),
        load=mo.Port(down, none),
    )
    return dataclasses.replace(problem.system, mechanism=mechanism, surface=surface)

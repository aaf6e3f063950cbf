"""Elastic blocks beside the sliding bodies they are: settled under vibration, or from rest.

A block settles as `asperity.block.solution.settled` has it, and so do the bodies it is compared
with, over the same cycles.
"""

import dataclasses
import functools
from collections.abc import Sequence

import numpy as np

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

_TABLES = {**SLIDER_TABLES, **BLOCK_TABLES}


@dataclasses.dataclass(frozen=True)
class Settled:
    """What an elastic block under vibration comes to, and the sliding bodies beside it."""

    ratio: float  # mean friction along the drive over mu F_N, at the drive's velocity
    slider: float  # that of the sliding body's periodic state
    # The sliding body with the block's compliance as a spring between it and its asperities,
    # settled as the block is; and the same where the block's turns on its contact, most of that
    # compliance, have inertia.
    in_series: float
    rocking: float
    # Half of what the highest and the lowest of four successive windows of the block's ratio, as
    # long as one another, are apart; and the cycles in the four together.
    unsteadiness: float
    cycles: int
    late: float  # the share of the drive's velocity by which the block was slower in these cycles


def problem_of(case: str, settings: Sequence[str] = ()) -> BlockProblem:
    """The problem of a shipped block."""
    return BlockProblem.from_case(read_case(case, _TABLES, settings))


def march(case: str, settings: Sequence[str]) -> BlockResult:
    """March a shipped block from rest, as ``asperity block`` does."""
    return solve_block(problem_of(case, settings))


@functools.cache
def _at_rest(case: str, settings: tuple[str, ...]) -> tuple[tuple[System, SystemState], ...]:
    """A block, and the sliding bodies with its compliance, all at rest under their loads."""
    problem = problem_of(case, settings)

    def resting(system: System, loads: tuple[mo.Port, ...] = ()) -> tuple[System, SystemState]:
        load = system.mechanism.load
        if load is None:
            raise ValueError("not loaded")
        return system, rest_under_load(system, loads or (load,))

    springs = (in_series(problem, rocking=rocking) for rocking in (False, True))
    return resting(problem.system, problem.loads), *map(resting, springs)


def settle(case: str, settings: Sequence[str]) -> Settled:
    """Settle a shipped block, and the sliding bodies beside it over the same cycles."""
    unshaken = (setting for setting in settings if not setting.startswith("vibration."))
    bodies = _at_rest(case, tuple(unshaken))
    model = Model.from_case(read_case(case, _TABLES, settings))
    slider = solve_periodic(model)
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
    under all the friction there is: by `BlockProblem.compliance`, which nothing is fitted to. All
    of it is a spring, unless the block's turns on its contact have their inertia (``rocking``).
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

"""Elastic blocks of chapter 5 by what decides them, and which of them a figure or claim compares.

Light, so that a run can hand them out before anything of theirs is imported.
"""

import dataclasses
import functools
from typing import TYPE_CHECKING

import numpy as np

from asperity.arrays import FloatArray
from asperity.results.dataset import described
from asperity.runs.workers import Task
from asperity.thesis.cached import once
from asperity.thesis.cases import Shipped

if TYPE_CHECKING:
    import xarray as xr

    from asperity.block.result import BlockResult
    from asperity.thesis.contact.blocks import Settled

LONGITUDINAL, TRANSVERSE = "block-longitudinal", "block-transverse"
SLIDING = {LONGITUDINAL: "table-4.3", TRANSVERSE: "table-4.4"}
"""The sliding bodies of chapter 4 that the blocks are."""

RATIO = "vibration.velocity_ratio"
DIRECTION = "vibration.direction"
LIGHT = ("block.elements=[4, 3, 3]", "block.element=hex8")
"""A mesh of 20 contact nodes; without these settings a shipped block has 221."""

ON_BODY = "vibration.applied_to=body"
RATIOS = {
    LONGITUDINAL: (1.0, 2.0, 3.0, 4.0, 6.0, 8.0, 10.0, 15.0, 20.0),
    TRANSVERSE: (0.5, 1.0, 2.0, 3.0, 4.0, 6.0, 10.0, 20.0),
}
AROUND = (2.0, 3.0, 4.0, 6.0, 20.0)
DIRECTIONS = {False: (30.0, 135.0, 240.0), True: tuple(15.0 * n for n in range(25))}
"""Those shown, and those shown in full."""

_MESH: dict[bool, tuple[str, ...]] = {False: LIGHT, True: ()}
_STEP = {False: "solve.step=4 us", True: "solve.step=1 us"}
_MARCHED = {LONGITUDINAL: "6", TRANSVERSE: "20"}

_ROOM = "asperity.thesis.contact"
_SOLVED_BY = f"{_ROOM}.blocks"
_SETTLING, _MARCH = 2.0, 6.0  # s, about


class ElasticBlock(Shipped):
    """An elastic block under steady vibration."""

    verb = "block"

    def settled(self) -> "Settled":
        """Its friction and that of the sliding bodies beside it, solved once for all runs."""
        from asperity.thesis.contact.blocks import Settled, settle

        return once(self, Settled, _SOLVED_BY, lambda: settle(self.case, self.settings))

    @property
    def task(self) -> Task:
        """To settle it, for those that ask later."""
        return Task(f"settle {self.name}", self.settled, _ROOM, _SETTLING)

    def command(self, verb: str = "", **options: tuple[str, ...]) -> str:
        """How to come by what it settles to, on the command line."""
        return Shipped.command(self.plus("solve.method=settled"), verb, **options)


@dataclasses.dataclass(frozen=True, eq=False)
class FromRest:
    """What is shown of a block's march from rest."""

    ratio: float  # mean drive force over mu F_N in the window of the march
    time: FloatArray  # s
    drive_force: FloatArray  # N
    friction: FloatArray  # along and across the drive, N

    @classmethod
    def of(cls, result: "BlockResult") -> "FromRest":
        """What is shown of a result."""
        history = result.history
        if history is None:
            raise ValueError("marched without a history")
        return cls(result.ratio, history.time, history.drive_force, history.friction)

    def to_dataset(self) -> "xr.Dataset":
        """Return the histories."""
        return described(
            time=(("time",), self.time, "s", "time"),
            axis=(("axis",), np.array(["x", "y"], dtype=object), "1", "axis"),
            drive_force=(("time",), self.drive_force, "N", "drive force"),
            friction=(("time", "axis"), self.friction, "N", "friction force"),
        )


class BlockFromRest(Shipped):
    """An elastic block marched from rest."""

    verb = "block"

    def marched(self) -> FromRest:
        """What is shown of its march, solved once for all runs."""
        from asperity.thesis.contact.blocks import march

        marched = functools.partial(march, self.case, self.settings)
        return once(self, FromRest, _SOLVED_BY, lambda: FromRest.of(marched()))

    @property
    def task(self) -> Task:
        """To march it, for those that ask later."""
        return Task(f"march {self.name}", self.marched, _ROOM, _MARCH)


def over_ratio(case: str, full: bool = False, *, on_body: bool = False) -> list[ElasticBlock]:
    """Blocks over the velocity ratio, with the base shaken and, if asked for, then the body."""
    modes = [(), (ON_BODY,)] if on_body else [()]
    return [
        ElasticBlock(case, (*_MESH[full], *mode, f"{RATIO}={ratio:g}"))
        for mode in modes
        for ratio in RATIOS[case]
    ]


def over_direction(full: bool = False) -> list[ElasticBlock]:
    """Blocks for each velocity ratio and direction, the latter running fastest."""
    return [
        ElasticBlock(TRANSVERSE, (*_MESH[full], f"{RATIO}={k:g}", f"{DIRECTION}={theta:g} deg"))
        for k in AROUND
        for theta in DIRECTIONS[full]
    ]


def from_rest(case: str, full: bool = False) -> list[BlockFromRest]:
    """The block marched from rest that is shown of a case."""
    settings = f"{RATIO}={_MARCHED[case]}", "solve.duration=0.3 s", _STEP[full]
    return [BlockFromRest(case, (*_MESH[full], *settings))]


def equal_ratios(full: bool = False) -> list[ElasticBlock | BlockFromRest]:
    """Blocks beside the sliding bodies they are."""
    del full
    return [
        *over_ratio(LONGITUDINAL),
        *over_ratio(TRANSVERSE),
        *over_direction(),
        STIFF,
        *from_rest(LONGITUDINAL),
    ]


def base_or_body(full: bool = False) -> list[ElasticBlock]:
    """Blocks on a base that is shaken, and such that are shaken themselves."""
    del full
    return [*over_ratio(LONGITUDINAL, on_body=True), *over_ratio(TRANSVERSE, on_body=True)]


STIFF = ElasticBlock(LONGITUDINAL, (*LIGHT, "block.youngs_modulus=20900 GPa", f"{RATIO}=20"))
"""A block a hundred times as stiff as steel."""

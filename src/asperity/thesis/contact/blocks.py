"""Elastic blocks beside the sliding bodies they are: settled under vibration, or from rest.

A block is marched from the sliding body's periodic state: at its velocity, drive force and
deflection of the asperities. The asperities and the swing of the body within a cycle settle in
some ten cycles; its rocking on the contact, which nothing but friction damps, may take a hundred.
The drive force would take tens of milliseconds to follow, so that it would say more about the
start than about the block. Read is therefore the block's own friction, averaged over whole cycles,
and the mean velocity it slid at. That velocity is not quite the drive's; the sliding body's slope
of friction over velocity brings the one to the other. It is read in four windows, one after the
other, and anew in four twice as long until they agree.
"""

import dataclasses
import functools
import shlex
from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from asperity.block.march import solve_block
from asperity.block.problem import BlockProblem, shaking
from asperity.block.result import BlockResult
from asperity.block.tables import TABLES as BLOCK_TABLES
from asperity.casefile import read_case
from asperity.contact.interface.surface import contact_surface
from asperity.contact.motion import hht, ledger
from asperity.contact.motion import mechanism as mo
from asperity.contact.motion.rest import rest_under_load
from asperity.contact.motion.steps import Stepper
from asperity.contact.motion.system import Shaking, System, SystemState
from asperity.mesh import box
from asperity.slider import Model, SlideResult
from asperity.slider.periodic import solve_periodic
from asperity.slider.tables import TABLES as SLIDER_TABLES

FloatArray = npt.NDArray[np.float64]

_TABLES = {**SLIDER_TABLES, **BLOCK_TABLES}

LIGHT = ("block.elements=[4, 3, 3]", "block.element=hex8")
"""A mesh of 20 contact nodes; without these settings a shipped block has 221."""

STEPS = 200
"""Increments a cycle."""

# Long steps and much numerical damping first, which end most of the rocking on the contact that the
# start excites; then steps that follow everything.
_CALM_STEPS, _CALM_CYCLES, _CALM_ALPHA = 50, 12, -1.0 / 3.0
_SETTLE_CYCLES = 14
# The rocking that is left makes cycles differ by far more than their mean is off: windows of whole
# cycles tell whether it has gone.
_WINDOWS = 4
_SHORTEST, _LONGEST = 4, 32
_SLOPE = 0.01

STEADY = 1e-3
"""How far windows may be apart, over the ratio of the sliding body, for a block to have settled."""


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
    slider = solve_periodic(block.model())
    slope = _slope(block)
    bodies = (resting.block, resting.in_series, resting.rocking)
    steppers = [_calmed(*body, slider) for body in bodies]
    length = _SHORTEST
    while True:
        # All over the same cycles: the drive force has not settled, but it stands alike for all.
        windows, late = zip(*(_read(w, slider.model, slope, length) for w in steppers), strict=True)
        apart = max(float(np.ptp(ratios)) for ratios in windows)
        if apart <= STEADY * abs(slider.ratio) or length >= _LONGEST:
            break
        length *= 2
    ratio, springy, rocking = (float(ratios.mean()) for ratios in windows)
    return Settled(
        ratio=ratio,
        slider=slider.ratio,
        in_series=springy,
        rocking=rocking,
        unsteadiness=0.5 * float(np.ptp(windows[0])),
        cycles=_WINDOWS * length,
        late=late[0],
    )


def _calmed(system: System, rest: SystemState, slider: SlideResult) -> Stepper:
    """A body on its way from the sliding body's periodic state, most of its rocking gone."""
    model = slider.model
    shaken = dataclasses.replace(system, shaking=_from_the_start(model))
    calm = Stepper(dataclasses.replace(shaken, alpha=_CALM_ALPHA), _begin(system, rest, slider))
    _cycles(calm, model, _CALM_CYCLES, _CALM_STEPS)
    stepper = Stepper(shaken, calm.state)
    _cycles(stepper, model, _SETTLE_CYCLES, STEPS)
    return stepper


def _read(stepper: Stepper, model: Model, slope: float, length: int) -> tuple[FloatArray, float]:
    """Ratio in each window, brought to the drive's velocity, and how much slower the body was."""
    # The rocking comes round in other than whole cycles. Weights that fade in and out let it
    # cancel within a window, where equal ones would leave what is cut off at its ends.
    weights = np.sin(np.pi * (np.arange(length) + 0.5) / length) ** 2
    cycles = np.array([_cycle(stepper, model) for _ in range(_WINDOWS * length)])
    means = np.average(cycles.reshape(_WINDOWS, length, 2), axis=1, weights=weights)
    late = 1.0 - means[:, 1] / model.slider.drive_velocity
    return means[:, 0] / model.full_friction + slope * late, float(late.mean())


def _from_the_start(model: Model) -> Shaking | None:
    wave = shaking(model)
    return None if wave is None else dataclasses.replace(wave, start=0.0)


def _begin(system: System, rest: SystemState, slider: SlideResult) -> SystemState:
    """A body at rest under its loads, set going as the sliding body is between two cycles."""
    history = slider.history
    if history is None or system.mechanism.drive is None:
        raise ValueError("solved without a history, or without a drive")
    coordinates, drive = rest.coordinates.copy(), rest.drive.copy()
    coordinates[hht.VELOCITY, :2] = history.velocity[-1]
    pull = float(history.drive_force[-1])
    drive[mo.FORCE] = pull
    drive[mo.REACH] = drive[mo.WAY] + pull / system.mechanism.drive.stiffness
    contact = rest.contact
    deflection = np.zeros_like(contact.state.deflection)
    deflection[:, :2] = history.deflection[-1]
    contact = dataclasses.replace(
        contact, state=dataclasses.replace(contact.state, deflection=deflection)
    )
    return dataclasses.replace(rest, coordinates=coordinates, drive=drive, contact=contact)


def _cycles(stepper: Stepper, model: Model, count: int, steps: int) -> None:
    step = 1.0 / (model.frequency * steps)
    first = round(stepper.state.time / step)
    for n in range(first + 1, first + count * steps + 1):
        stepper.step_to(n * step, step)


def _cycle(stepper: Stepper, model: Model) -> tuple[float, float]:
    """Friction along the drive and velocity, averaged over a cycle."""
    stepper.clear()
    begin, place = stepper.state.time, stepper.state.coordinates[hht.PLACE, 0]
    _cycles(stepper, model, 1, STEPS)
    way = stepper.state.coordinates[hht.PLACE, 0] - place
    friction = stepper.sums[ledger.FRICTION_X] / stepper.sums[ledger.TIME]
    return float(friction), float(way / (stepper.state.time - begin))


def _slope(block: Block) -> float:
    """Rise of the sliding body's ratio over a relative rise of its velocity, v_a being the same."""
    model = block.model()
    low, high = (
        solve_periodic(
            block.model(
                slider__drive_velocity=share * model.slider.drive_velocity,
                vibration__velocity_amplitude=model.peak_velocity,
            ),
            history=False,
        ).ratio
        for share in (1.0 - _SLOPE, 1.0 + _SLOPE)
    )
    return (high - low) / (2.0 * _SLOPE)


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

"""What an elastic block settles to under vibration, without a march from rest.

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
import time
from collections.abc import Callable, Mapping, Sequence
from typing import Any, ClassVar

import numpy as np

from asperity.arrays import FloatArray
from asperity.block.problem import BlockProblem, shaking
from asperity.block.result import inputs
from asperity.block.solution.notes import GAINS
from asperity.block.solution.stability import Stability, flutter_note
from asperity.contact.motion.march import Row
from asperity.contact.motion.rest import rest_under_load
from asperity.contact.motion.steps import Stepper
from asperity.contact.motion.system import Shaking, System, SystemState
from asperity.results import Result, labelled, quantity
from asperity.results.dataset import Labels
from asperity.results.settled import Standing, by_what, error_of_step, told, whether_settled
from asperity.runs import Run
from asperity.slider import Model, SlideResult
from asperity.slider.periodic import solve_periodic
from asperity.slider.timetable import drifts_sideways, pull_across
from asperity.vibration import Vibration

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
_OVER_CYCLE = ("phase", "axis")
_PHASE = np.arange(1, STEPS + 1) / STEPS

STEADY = 1e-3
"""How far windows may be apart, over the ratio of the sliding body, for a block to have settled."""


class SettledBlock(Result):
    """What an elastic block under vibration comes to."""

    title: ClassVar[str] = "Settled elastic block"
    stem: ClassVar[str] = "block"
    drawings: ClassVar[Mapping[str, str]] = {"block": "asperity.block.plots:plot_settled"}
    labels: ClassVar[Labels] = SlideResult.labels

    problem: BlockProblem
    #: At the drive's velocity; of the block's own friction.
    ratio: float = quantity("F_dv/F_ds", "", "mean drive force over mu F_N")
    #: Of four successive windows as long as one another.
    unsteadiness: float = quantity("", "", "how far windows of the ratio are apart, half of it")
    settled: bool = whether_settled()
    settled_by: str = by_what()
    step_error: float | None = error_of_step()
    slider_ratio: float = quantity("", "", "mean drive force over mu F_N, sliding body")
    cycles: int = quantity("", "", "whole cycles of the vibration that were read")
    late: float = quantity("", "", "how much slower than the drive the block was, corrected for")
    increments: int = quantity("", "", "increments")
    seconds: float = quantity("", "s", "time it took", key="seconds", only="json", swept=False)
    phase: FloatArray = quantity(
        "t/T", "", "share of a cycle of the vibration", dims=("phase",), coordinate=True
    )
    friction: FloatArray = quantity(
        "F", "N", "friction force on the body in the last cycle read", dims=_OVER_CYCLE
    )
    slider_friction: FloatArray = quantity(
        "F", "N", "friction force on the sliding body", dims=_OVER_CYCLE
    )

    def headline(self) -> tuple[str, ...]:
        """Return that it has not settled, where it has not."""
        return told(self)

    @property
    @labelled("F_dv", "N", "mean drive force", variable="mean_drive_force")
    def drive_force(self) -> float:
        """Mean drive force of the steady state, N."""
        return self.ratio * self.problem.model.full_friction

    @property
    @labelled("mu F_N", "N", "drive force without vibration")
    def static_drive_force(self) -> float:
        r"""Drive force without vibration, :math:`\mu F_N`, N."""
        return self.problem.model.full_friction

    @property
    @labelled("", "", "method", only="json", shown=False)
    def method(self) -> str:
        """How it was solved."""
        return self.problem.model.solve.method

    @property
    def inputs(self) -> Mapping[str, Any]:
        """The values of the problem's tables in SI, by ``table.key``."""
        return inputs(self.problem) | {"solver": self.problem.body.solver}


@dataclasses.dataclass(frozen=True, eq=False)
class Reading:
    """Ratios of some bodies over the same cycles."""

    #: (4,): Ratio of each body in each window, at the drive's velocity
    windows: tuple[FloatArray, ...]
    late: tuple[float, ...]  #: By how much of the drive's velocity each was slower
    #: Mean friction across the drive over mu F_N, of each that is free to yield to it
    across: tuple[float, ...]
    #: (steps, 2): Friction on each in the last cycle, N
    friction: tuple[FloatArray, ...]
    cycles: int  #: In the four windows together

    @property
    def apart(self) -> float:
        """How far the windows of a body are apart, at most."""
        return max(float(np.ptp(ratios)) for ratios in self.windows)


def settle(problem: BlockProblem, run: Run | None = None) -> SettledBlock:
    """Return what a vibrated block settles to.

    Parameters
    ----------
    problem : BlockProblem
        The block.
    run : Run, optional
        Told how far it is.

    Raises
    ------
    ConvergenceError
        The sliding body has no periodic state to start from, or an increment did not converge.
    """
    run = run or Run()
    began = time.perf_counter()
    slider = solve_periodic(_periodic(problem.model))
    system = problem.system
    taken, length = 0, _SHORTEST
    expected = _CALM_CYCLES * _CALM_STEPS + (_SETTLE_CYCLES + _WINDOWS * length) * STEPS

    def between(steps: int) -> None:
        nonlocal taken, expected, length
        taken += steps
        if taken > expected:
            length *= 2
            expected += _WINDOWS * length * STEPS
        run.checkpoint(taken, expected, what="increments")

    with run.interruptible():
        body = (system, rest_under_load(system, problem.loads))
        reading = read_settled([body], slider, slope_over_velocity(problem.model), between)
    ratios = reading.windows[0]
    return SettledBlock(
        problem=problem,
        ratio=float(ratios.mean()),
        unsteadiness=0.5 * float(np.ptp(ratios)),
        **_standing(reading, slider.ratio)._asdict(),
        slider_ratio=slider.ratio,
        cycles=reading.cycles,
        late=reading.late[0],
        increments=taken,
        seconds=time.perf_counter() - began,
        phase=_PHASE,
        friction=reading.friction[0],
        slider_friction=_over_a_cycle(slider),
        notes=_notes(problem, reading, slider.ratio),
    )


def _standing(reading: Reading, ratio: float) -> Standing:
    windows = f"{_WINDOWS} windows of {reading.cycles // _WINDOWS} cycles"
    drifts = drifts_sideways(max(reading.across))
    missing = (
        drifts
        if reading.apart <= STEADY * abs(ratio)
        else (f"{windows} are apart by {reading.apart:.2g}", *drifts)
    )
    return Standing.of(missing, f"{windows} agree to {STEADY:g} of the ratio")


def _notes(problem: BlockProblem, reading: Reading, ratio: float) -> tuple[str, ...]:
    flutter = Stability(problem).flutter()
    notes = [] if flutter is None else [flutter_note(problem, flutter)]
    if problem.friction.keeps_deflection:
        notes.append(f"{GAINS}; solve.method 'march' says how much")
    if reading.apart > STEADY * abs(ratio):
        notes.append(
            f"not steady: in {reading.cycles} cycles the ratio still swings by "
            f"{reading.apart:.2g}, as that of a block that rocks or flutters; solve.method "
            "'march' shows it in time" + _fed(problem)
        )
    return tuple(notes)


def _fed(problem: BlockProblem) -> str:
    """Say what may feed the rocking of a block that nothing damps."""
    if problem.friction.reference == 0.0 or problem.contact.damping_ratio > 0.0:
        return ""
    return (
        ". Friction that follows the pressure late feeds the rocking, and nothing damps it: give "
        "contact.damping_ratio"
    )


def _periodic(model: Model) -> Model:
    """The sliding body a block is, to be solved for its periodic state."""
    plain = {field.name: getattr(model, field.name) for field in dataclasses.fields(Model)}
    plain["solve"] = model.solve.model_copy(update={"method": "periodic"})
    return Model(**plain)


def slope_over_velocity(model: Model) -> float:
    """Rise of the sliding body's ratio over a relative rise of its velocity.

    The peak velocity of the vibration stays the same.
    """
    periodic = _periodic(model)
    slider = periodic.slider
    low, high = (
        solve_periodic(
            dataclasses.replace(
                periodic,
                slider=slider.model_copy(
                    update={"drive_velocity": share * slider.drive_velocity}, units="SI"
                ),
                vibration=_at_peak_velocity(model),
            ),
            history=False,
        ).ratio
        for share in (1.0 - _SLOPE, 1.0 + _SLOPE)
    )
    return (high - low) / (2.0 * _SLOPE)


def _at_peak_velocity(model: Model) -> Vibration:
    assert model.vibration is not None
    given = {"velocity_amplitude": model.peak_velocity}
    others = dict.fromkeys(("velocity_ratio", "displacement_amplitude"))
    return model.vibration.model_copy(update=others | given, units="SI")


def read_settled(
    bodies: Sequence[tuple[System, SystemState]],
    slider: SlideResult,
    slope: float,
    between: Callable[[int], None] = lambda steps: None,
) -> Reading:
    """Let bodies settle under vibration, and read their ratios, all over the same cycles.

    The bodies are at rest under their loads; ``slider`` is the periodic state of the sliding body
    they are, with its history, ``slope`` that of `slope_over_velocity`. ``between`` is told of
    increments that were taken. The drive force has not settled at the end, but it stands alike for
    all.
    """
    steppers = [_calmed(*body, slider, between) for body in bodies]
    length = _SHORTEST
    while True:
        read = [_read(stepper, slider.model, slope, length, between) for stepper in steppers]
        windows, late, across, friction = zip(*read, strict=True)
        reading = Reading(windows, late, across, friction, _WINDOWS * length)
        if reading.apart <= STEADY * abs(slider.ratio) or length >= _LONGEST:
            return reading
        length *= 2


def _calmed(
    system: System, rest: SystemState, slider: SlideResult, between: Callable[[int], None]
) -> Stepper:
    """A body on its way from the sliding body's periodic state, most of its rocking gone."""
    model = slider.model
    shaken = dataclasses.replace(system, shaking=_from_the_start(model))
    calm = Stepper(dataclasses.replace(shaken, alpha=_CALM_ALPHA), _begin(system, rest, slider))
    _cycles(calm, model, _CALM_CYCLES, _CALM_STEPS, between)
    stepper = Stepper(shaken, calm.state)
    _cycles(stepper, model, _SETTLE_CYCLES, STEPS, between)
    return stepper


def _read(
    stepper: Stepper, model: Model, slope: float, length: int, between: Callable[[int], None]
) -> tuple[FloatArray, float, float, FloatArray]:
    """Ratio in each window, brought to the drive's velocity; how much slower the body was.

    And the pull across, see `pull_across`, and its friction in the last cycle, (steps, 2), N.
    """
    # The rocking comes round in other than whole cycles. Weights that fade in and out let it
    # cancel within a window, where equal ones would leave what is cut off at its ends.
    weights = np.sin(np.pi * (np.arange(length) + 0.5) / length) ** 2
    read = [_cycle(stepper, model, between) for _ in range(_WINDOWS * length)]
    cycles = np.array([means for means, _ in read])
    means = np.average(cycles.reshape(_WINDOWS, length, 3), axis=1, weights=weights)
    late = 1.0 - means[:, 1] / model.slider.drive_velocity
    ratios = means[:, 0] / model.full_friction + slope * late
    across = pull_across(model, means[:, 2].mean() / model.full_friction)
    return ratios, float(late.mean()), across, read[-1][1]


def _over_a_cycle(slider: SlideResult) -> FloatArray:
    """Friction of the sliding body at the phases of the block's."""
    history = slider.history
    assert history is not None
    phase = 1.0 + (history.time - history.time[-1]) * slider.model.frequency
    columns = [np.interp(_PHASE, phase, axis, period=1.0) for axis in history.friction.T]
    return np.stack(columns, axis=1)


def _from_the_start(model: Model) -> Shaking | None:
    wave = shaking(model)
    return None if wave is None else dataclasses.replace(wave, start=0.0)


def _begin(system: System, rest: SystemState, slider: SlideResult) -> SystemState:
    """A body at rest under its loads, set going as the sliding body is between two cycles."""
    history = slider.history
    if history is None:
        raise ValueError("solved without a history")
    coordinates, drive = rest.coordinates, rest.drive
    velocity = np.concatenate([history.velocity[-1], coordinates.velocity[2:]])
    if system.mechanism.drive is not None:
        pull = float(history.drive_force[-1])
        reach = drive.way + pull / system.mechanism.drive.stiffness
        drive = drive._replace(force=pull, reach=reach)
    contact = rest.contact
    deflection = np.zeros_like(contact.state.deflection)
    deflection[:, :2] = history.deflection[-1]
    contact = dataclasses.replace(
        contact, state=dataclasses.replace(contact.state, deflection=deflection)
    )
    coordinates = coordinates._replace(velocity=velocity)
    return dataclasses.replace(rest, coordinates=coordinates, drive=drive, contact=contact)


def _cycles(
    stepper: Stepper, model: Model, count: int, steps: int, between: Callable[[int], None]
) -> FloatArray:
    """Take cycles of so many steps; their rows."""
    step = 1.0 / (model.frequency * steps)
    first = round(stepper.state.time / step)
    ends = step * np.arange(first + 1, first + count * steps + 1, dtype=np.float64)
    taken = []
    for rows in stepper.through(ends, step):
        taken.append(rows)
        between(len(rows))
    return np.concatenate(taken)


def _cycle(
    stepper: Stepper, model: Model, between: Callable[[int], None]
) -> tuple[tuple[float, float, float], FloatArray]:
    """Friction along the drive, velocity and friction across, means of a cycle; and (steps, 2)."""
    stepper.clear()
    begin, place = stepper.state.time, stepper.state.coordinates.place[0]
    rows = _cycles(stepper, model, 1, STEPS, between)
    way = stepper.state.coordinates.place[0] - place
    friction = np.stack([Row(*rows.T).friction_x, Row(*rows.T).friction_y], axis=1)
    velocity = float(way / (stepper.state.time - begin))
    sums = stepper.sums
    return (sums.friction_x / sums.time, velocity, sums.friction_y / sums.time), friction

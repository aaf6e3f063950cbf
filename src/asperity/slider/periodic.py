"""The periodic state of a sliding body, without marching through the transient."""

import math
import time

import numpy as np

from asperity.arrays import FloatArray
from asperity.errors import ConvergenceError, InputError
from asperity.results.settled import Standing
from asperity.slider import kernels as k
from asperity.slider.history import History
from asperity.slider.integrators import Pressed, integrator
from asperity.slider.model import Model
from asperity.slider.parameters import in_proportion
from asperity.slider.pressed import march_pressed
from asperity.slider.result import SlideResult
from asperity.slider.shooting import ACCEPTED, SETTLING, differentiated, shoot
from asperity.slider.summary import history_of, summarise
from asperity.slider.unknowns import most_unknowns

_LEAST_STEPS = 256
_REST_STEPS = 64
_MOST_STEPS = 1e6
UNSTABLE = 1.0 + 1e-3
_PUSH = 1e-3


@in_proportion()
def cycle_steps(model: Model) -> int:
    """Steps a cycle is divided into: at least 256, a multiple of 4, or those that meet corners."""
    if not model.vibrates:
        return _REST_STEPS
    asked = model.substeps / (model.frequency * model.step)
    if asked > _MOST_STEPS:
        raise InputError(
            f"solve.step is {model.step:g} s, {asked:.3g} steps a vibration cycle; a periodic "
            f"state is found with at most {_MOST_STEPS:g}: give a larger step"
        )
    if model.meets_corners:
        whole = round(asked)
        return whole * math.ceil(_LEAST_STEPS / whole)
    return 4 * math.ceil(max(asked * (1.0 - 1e-9), _LEAST_STEPS) / 4)


class Cycle:
    """The map of a body's state over one cycle of the vibration, or over several.

    Attributes
    ----------
    body : Integrator
        At the start of the cycle.
    residual : float
        Largest scaled change of an unknown over the cycle.
    run : int
        Cycles integrated so far.
    """

    def __init__(self, model: Model, steps: int, step: float) -> None:
        self.body = integrator(model, step)
        self.residual = math.inf
        self.run = 0
        self.period = 1
        still = np.zeros(steps + 1)
        shaken = model.shape is not None and model.vibrates
        self.increments = model.shape.cycle(steps) if shaken and model.shape else still
        self.rises = still
        self.springs = np.zeros((2, 0))
        self.q = None
        if isinstance(self.body, Pressed):
            self.q, self.springs = self.body.q, self.body.kept["springs"]
            if shaken and model.shape is not None:
                self.rises = model.shape.cycle(steps, model.normal_lead)
            self.body.place(1.0, ramped=False)

    def repeat(self, times: int) -> None:
        """Ask for a state that repeats itself only after so many times the cycles."""
        self.period *= times
        self.increments = _repeated(self.increments, times)
        self.rises = _repeated(self.rises, times)

    def find(self, settle: int) -> bool:
        """Look for the state that repeats itself; ``settle`` as in `shoot`."""
        size = most_unknowns(self.springs)
        jacobian = np.zeros((size, size))
        self.residual, cycles, unknowns = shoot(
            self.body.kept["state"], self.springs, self.body.p, self.q, self.increments,
            self.rises, self.body.sums, jacobian, settle,
        )  # fmt: skip
        self.jacobian = jacobian[:unknowns, :unknowns]
        self.run += cycles * self.period
        return bool(self.residual <= ACCEPTED)

    def multiplier(self) -> float:
        """Return how much the least stable disturbance grows over the cycle."""
        if self.q is not None:
            self.jacobian = differentiated(
                self.body.kept["state"], self.springs, self.body.p, self.q, self.increments,
                self.rises, self.body.no_sums()[0], len(self.jacobian),
            )  # fmt: skip
        return _growth(self.jacobian)

    def record(self) -> FloatArray:
        """March over the cycle; returns what `history_of` takes, a row a step."""
        body = self.body
        steps = self.increments.size - 1
        nodes = np.empty(steps, body.node_type)
        here = body.kept["state"].copy()
        here["lateral"] = 0.0
        sums = body.no_sums()[0]
        if self.q is None:
            k.march_block(here[0], sums, body.p, self.increments, steps, nodes)
        else:
            here["height"] = 0.0
            march_pressed(
                here[0], self.springs.copy(), sums, body.p, self.q, self.increments, self.rises,
                steps, nodes,
            )  # fmt: skip
        # Recorded in one stretch, and given as one a step.
        nodes["position_x"] -= body.p.drive * np.arange(steps)
        rows: FloatArray = nodes.view(np.float64).reshape(steps, -1)
        return rows

    def disturb(self) -> None:
        """Push the body off its state, for it to go where it goes."""
        self.body.state["velocity_x"] *= 1.0 + _PUSH
        if self.q is not None:
            self.body.state["rise"] += _PUSH * math.sqrt(self.q.mobility)


def _repeated(increments: FloatArray, times: int) -> FloatArray:
    return np.append(np.tile(increments[:-1], times), increments[0])


class AperiodicError(ConvergenceError):
    """No stable state was found that repeats itself after 1, 2 or 4 cycles.

    Attributes
    ----------
    notes : tuple of str
        What is known of states that are not stable.
    """

    notes: tuple[str, ...] = ()

    @classmethod
    def of(cls, cycle: Cycle, notes: tuple[str, ...]) -> "AperiodicError":
        """Return the error of a cycle in which nothing stable was found."""
        found = "no stable state was found that repeats itself after 1, 2 or 4 cycles"
        if not notes:
            found = (
                f"no periodic state found: after {cycle.run} cycles the state still changes by "
                f"{cycle.residual:.2g} a cycle (1e-9 is asked for)"
            )
        error = cls(
            f"{found}; solve.method 'march' shows what it does",
            reached={"residual": float(cycle.residual), "cycles": float(cycle.run)},
        )
        error.notes = notes
        return error


def solve_periodic(model: Model, *, history: bool = True) -> SlideResult:
    """Find the state that repeats itself every vibration cycle; of a pressed body, 1, 2 or 4.

    Parameters
    ----------
    model : Model
        The body. Start, duration and breakaway have no meaning here.
    history : bool
        Whether to keep motion and forces over one period.

    Raises
    ------
    AperiodicError
        No state repeats within 1e-9 (a body that sticks and slips at a rate of its own, say).
    ConvergenceError
        The powers of the state do not balance, or friction gives energy.
    """
    began = time.perf_counter()
    steps = cycle_steps(model)
    step = 1.0 / (model.frequency * steps) if model.vibrates else model.step
    cycle = Cycle(model, steps, step)
    found, growth, notes = settle(cycle)
    if not found:
        raise AperiodicError.of(cycle, notes)
    return answer_of(model, step, cycle, growth, notes, began, history=history)


def answer_of(
    model: Model,
    step: float,
    cycle: Cycle,
    growth: float,
    notes: tuple[str, ...],
    began: float,
    *,
    history: bool,
) -> SlideResult:
    """Return the result of a state that was found, with its multiplier, since a `perf_counter`."""
    end = cycle.body.energies()
    return summarise(
        model, cycle.body.p, step, cycle.body.sums, end, end,
        standing=standing_of(cycle, growth),
        residual=float(cycle.residual),
        steps=cycle.run * (len(cycle.increments) - 1) // cycle.period,
        cycles=cycle.run,
        seconds=time.perf_counter() - began,
        substeps=model.substeps,
        notes=notes,
        history=_one_period(model, step, cycle) if history else None,
        period=cycle.period,
        multiplier=growth,
    )  # fmt: skip


def standing_of(cycle: Cycle, growth: float) -> Standing:
    """Return whether a state that was found is one that a body stays in."""
    cycles = "every cycle" if cycle.period == 1 else f"every {cycle.period} cycles"
    repeats = f"the state repeats itself {cycles} to {ACCEPTED:g}"
    if growth > UNSTABLE:
        return Standing(False, f"{repeats}, but a disturbance grows {growth:.3g} times")
    return Standing(True, repeats)


def settle(cycle: Cycle) -> tuple[bool, float, tuple[str, ...]]:
    """Find the state from rest, or after ever more cycles; of a pressed body, a stable one.

    Returns
    -------
    found : bool
        Whether the cycle is in it now.
    growth : float
        Its multiplier.
    notes : tuple of str
        What a reader should know of states that are not stable.
    """
    found = any(cycle.find(cycles) for cycles in (0, *SETTLING))
    growth = cycle.multiplier() if found else math.inf
    notes: tuple[str, ...] = ()
    if found and growth > UNSTABLE:
        notes = (
            f"this periodic state is unstable: a disturbance grows {growth:.3g} times a cycle",
        )
    if cycle.q is not None and not growth <= UNSTABLE:
        if found:
            ratio = cycle.body.sums["drive_force"] / cycle.body.sums["steps"]
            notes = (
                f"the state that repeats itself every cycle, with the ratio {ratio:.5g}, is "
                f"unstable: a disturbance grows {growth:.3g} times a cycle",
            )
        found, growth = _longer(cycle)
    return found, growth, notes


def _longer(cycle: Cycle) -> tuple[bool, float]:
    """Look for stable states that repeat themselves after two and after four cycles."""
    growth = math.inf
    for _ in range(2):
        cycle.repeat(2)
        for settle in SETTLING[1:]:
            # Newton may have ended on the unstable state, where the body would stay.
            cycle.disturb()
            if cycle.find(settle) and (growth := cycle.multiplier()) <= UNSTABLE:
                return True, growth
    return False, growth


def _growth(jacobian: FloatArray) -> float:
    """Largest multiplier of the cycle's map, whose Jacobian less one is given; 0 if not taken."""
    if not jacobian.any():
        return 0.0
    return float(np.abs(np.linalg.eigvals(jacobian + np.eye(len(jacobian)))).max())


def _one_period(model: Model, step: float, cycle: Cycle) -> History:
    rows = cycle.record()
    begin = step * np.arange(float(len(rows)))
    return history_of(model, step, begin, np.full(len(rows), step), rows)

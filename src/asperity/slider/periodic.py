"""The periodic state of a sliding body, without marching through the transient."""

import math
import time

import numpy as np

from asperity.arrays import FloatArray
from asperity.errors import ConvergenceError, InputError
from asperity.slider import kernels as k
from asperity.slider.model import Model, in_proportion
from asperity.slider.result import History, SlideResult
from asperity.slider.scaled import NODE, STATE, SUMS, Parameters
from asperity.slider.shooting import ACCEPTED, MOST_UNKNOWNS, SETTLING, shoot
from asperity.slider.summary import energies, history_of, summarise

_LEAST_STEPS = 256
_REST_STEPS = 64
_MOST_STEPS = 1e6
_UNSTABLE = 1.0 + 1e-3


@in_proportion()
def cycle_steps(model: Model) -> int:
    """Steps a cycle is divided into: at least 256, a multiple of 4 to meet the waveform's kinks."""
    if not model.vibrates:
        return _REST_STEPS
    asked = model.substeps / (model.frequency * model.step)
    if asked > _MOST_STEPS:
        raise InputError(
            f"solve.step is {model.step:g} s, {asked:.3g} steps a vibration cycle; a periodic "
            f"state is found with at most {_MOST_STEPS:g}: give a larger step"
        )
    return 4 * math.ceil(max(asked * (1.0 - 1e-9), _LEAST_STEPS) / 4)


def solve_periodic(model: Model, *, history: bool = True) -> SlideResult:
    """Find the state that repeats itself every vibration cycle.

    Parameters
    ----------
    model : Model
        The body. Start, duration and breakaway have no meaning here.
    history : bool
        Whether to keep motion and forces over one cycle.

    Raises
    ------
    ConvergenceError
        No state repeats within 1e-9 (a body that sticks and slips at a rate of its own, say).
    """
    began = time.perf_counter()
    steps = cycle_steps(model)
    step = 1.0 / (model.frequency * steps) if model.vibrates else model.step
    increments = np.zeros(steps + 1)
    if model.shape is not None and model.vibrates:
        # One cycle late, so that the wave's rest before its start is not met.
        increments = model.shape.increments(1.0, 1.0 / steps, steps + 1)
    p = model.parameters(step)
    state, sums = np.zeros(1, STATE)[0], np.zeros(1, SUMS)[0]
    jacobian = np.zeros((MOST_UNKNOWNS, MOST_UNKNOWNS))
    residual, cycles, unknowns = shoot(state, p, increments, sums, jacobian, 0)
    for settle in SETTLING:
        if residual <= ACCEPTED:
            break
        residual, more, unknowns = shoot(state, p, increments, sums, jacobian, settle)
        cycles += more
    if not residual <= ACCEPTED:
        raise ConvergenceError(
            f"no periodic state found: after {cycles} cycles the state still changes by "
            f"{residual:.2g} a cycle (1e-9 is asked for); solve.method 'march' shows what it does",
            reached={"residual": float(residual), "cycles": float(cycles)},
        )
    elastic = model.friction.model != "coulomb"
    end = energies(state, p, elastic=elastic)
    notes: tuple[str, ...] = ()
    growth = _growth(jacobian[:unknowns, :unknowns])
    if growth > _UNSTABLE:
        notes = (
            f"this periodic state is unstable: a disturbance grows {growth:.3g} times a cycle",
        )
    return summarise(
        model, p, step, sums, end, end,
        residual=float(residual),
        steps=int(cycles) * steps,
        cycles=int(cycles),
        seconds=time.perf_counter() - began,
        substeps=model.substeps,
        notes=notes,
        history=_one_cycle(model, step, state, p, increments) if history else None,
    )  # fmt: skip


def _growth(jacobian: FloatArray) -> float:
    """Largest multiplier of the cycle's map, whose Jacobian less one is given; 0 if not taken."""
    if jacobian.size == 0 or not np.any(jacobian):
        return 0.0
    return float(np.abs(np.linalg.eigvals(jacobian + np.eye(len(jacobian)))).max())


def _one_cycle(
    model: Model, step: float, state: np.void, p: Parameters, increments: FloatArray
) -> History:
    steps = increments.size - 1
    here = np.array([state], STATE)
    here["lateral"] = 0.0
    nodes = np.empty(steps, NODE)
    k.march_block(here[0], np.zeros(1, SUMS)[0], p, increments, steps, nodes)
    # Recorded in one stretch, and given as one a step.
    nodes["position_x"] -= p.drive * np.arange(steps)
    rows = nodes.view(np.float64).reshape(steps, -1)
    begin = step * np.arange(float(steps))
    return history_of(model, step, begin, np.full(steps, step), rows)

"""The map of a body's state over a cycle of the vibration, whose fixed point repeats itself."""

import math

import numpy as np

from asperity.arrays import FloatArray
from asperity.slider import kernels as k
from asperity.slider.integrators import Pressed, integrator
from asperity.slider.model import Model
from asperity.slider.pressed import march_pressed
from asperity.slider.shooting import ACCEPTED, differentiated, shoot
from asperity.slider.unknowns import most_unknowns
from asperity.waveform import cycle_of_wave

UNSTABLE = 1.0 + 1e-3
_PUSH = 1e-3


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

    Parameters
    ----------
    phase : float
        Where in the wave it begins, in cycles.
    """

    def __init__(self, model: Model, steps: int, step: float, phase: float = 0.0) -> None:
        self.body = integrator(model, step)
        self.step = step
        self.residual = math.inf
        self.run = 0
        self.period = 1
        still = np.zeros(steps + 1)
        shaken = model.vibrates
        self.increments = cycle_of_wave(model.wave(step, lead=phase), steps) if shaken else still
        self.rises = still
        self.springs = np.zeros((2, 0))
        self.q = None
        if isinstance(self.body, Pressed):
            self.q, self.springs = self.body.q, self.body.kept["springs"]
            if shaken:
                lead = phase + model.normal_lead
                self.rises = cycle_of_wave(model.wave(step, lead=lead), steps)
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


def _growth(jacobian: FloatArray) -> float:
    """Largest multiplier of the cycle's map, whose Jacobian less one is given; 0 if not taken."""
    if not jacobian.any():
        return 0.0
    return float(np.abs(np.linalg.eigvals(jacobian + np.eye(len(jacobian)))).max())

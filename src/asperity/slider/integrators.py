"""One body's numbers as they go through the compiled loops: in the plane, two-phase, in space."""

from typing import ClassVar

import numpy as np
import numpy.typing as npt

from asperity.arrays import FloatArray
from asperity.runs.tree import Tree
from asperity.slider import kernels as k
from asperity.slider import pressed
from asperity.slider.model import Model
from asperity.slider.scaled import (
    NODE,
    PRESSED_NODE,
    PRESSED_STATE,
    PRESSED_SUMS,
    STATE,
    SUMS,
)
from asperity.slider.summary import energies, pressed_energies
from asperity.slider.two_phase import MEMORY, march_two_phase
from asperity.vibration.waveform import fill_increments


class Integrator:
    """A body in the plane, by the exponential midpoint.

    Parameters
    ----------
    model : Model
        The body.
    step : float
        Time step, s.

    Attributes
    ----------
    p : Parameters
        The body's numbers.
    kept : dict of str to ndarray
        All that changes on the way: ``state`` and ``sums``, records in an array of one.
    """

    state_type: ClassVar[np.dtype] = STATE
    sums_type: ClassVar[np.dtype] = SUMS
    node_type: ClassVar[np.dtype] = NODE

    def __init__(self, model: Model, step: float) -> None:
        self.model = model
        self.p = model.parameters(step)
        self.rate = model.frequency * step
        self.wave = model.wave(step)
        self.kept: Tree = {"state": np.zeros(1, self.state_type), "sums": self.no_sums()}
        self.sums["breakaway"] = -1.0
        self.clear()

    def no_sums(self) -> np.ndarray:
        """Return a record of sums, of zeros, in an array of one."""
        return np.zeros(1, self.sums_type)

    @property
    def state(self) -> np.void:
        """The body at the present node, see `asperity.slider.scaled`."""
        record: np.void = self.kept["state"][0]
        return record

    @property
    def sums(self) -> np.void:
        """Sums since they were last cleared, see `asperity.slider.scaled`."""
        record: np.void = self.kept["sums"][0]
        return record

    def clear(self) -> None:
        """Empty the sums but for the breakaway."""
        k.clear(self.sums)

    def start(self, cycles: float) -> None:
        """Start from rest at a time in cycles of the vibration."""
        first = np.empty(1)
        fill_increments(self.wave, cycles, self.rate, first)
        k.prime(self.state, self.p, first)

    def energies(self) -> tuple[float, float]:
        """Mechanical and elastic energy at the present node, see `asperity.slider.summary`."""
        elastic = self.model.friction.model != "coulomb"
        return energies(self.state, self.p, elastic=elastic)

    def march(self, cycles: float, length: int, rows: FloatArray, *, record: bool) -> None:
        """March as many stretches of ``length`` steps as ``rows`` has in its second dimension."""
        room = np.empty(length + 1)
        wave = self.wave, cycles, self.rate
        if record:
            nodes = _nodes(length, self.node_type)
            k.march_recorded(self.state, self.sums, self.p, *wave, room, *nodes, *rows)
        else:
            k.march_stretches(self.state, self.sums, self.p, *wave, rows.shape[1], room)


class TwoPhase(Integrator):
    """A body in the plane by the thesis's explicit scheme."""

    def __init__(self, model: Model, step: float) -> None:
        super().__init__(model, step)
        self.kept["memory"] = np.zeros(1, MEMORY)

    def start(self, cycles: float) -> None:
        """Start from rest; the scheme has no half steps."""
        self.kept["memory"]["cos"] = 1.0
        if self.p.rigid:
            self.state["velocity_x"] = self.p.drive

    def march(self, cycles: float, length: int, rows: FloatArray, *, record: bool) -> None:
        """March stretches, as `Integrator.march`."""
        march_two_phase(
            self.state, self.kept["memory"][0], self.sums, self.p, self.wave, cycles, self.rate,
            np.empty(length + 1), self.model.on_body,
            *_nodes(length if record else 0, NODE), *rows,
        )  # fmt: skip


class LoadedIntegrator(Integrator):
    """A body with a normal freedom, or under a machine that presses it.

    Attributes
    ----------
    q : NormalLoading
        The numbers of what is normal to the plane.
    """

    state_type = PRESSED_STATE
    sums_type = PRESSED_SUMS
    node_type = PRESSED_NODE

    def __init__(self, model: Model, step: float) -> None:
        super().__init__(model, step)
        self.q = model.pressing(step)
        self.unit = model.normal_unit(step)
        self.kept["springs"] = np.zeros((2, self.q.heights.size))
        self.normal_wave = model.wave(step, lead=model.normal_lead)

    def clear(self) -> None:
        """Empty the sums but for the breakaway."""
        pressed.clear_pressed(self.sums)

    def place(self, cycles: float, *, ramped: bool = True) -> None:
        """Put the body on the base as it is at a time in cycles of the vibration."""
        wave = self.normal_wave if ramped else self.normal_wave._replace(ramp=0.0)
        pressed.place(self.state, self.q, wave, cycles)

    def start(self, cycles: float) -> None:
        """Start from rest on the base."""
        self.place(cycles)
        super().start(cycles)

    def energies(self) -> tuple[float, float]:
        """Mechanical and elastic energy, as `Integrator.energies`."""
        springs = self.kept["springs"]
        return pressed_energies(self.state, springs, self.p, self.q, self.unit)

    def march(self, cycles: float, length: int, rows: FloatArray, *, record: bool) -> None:
        """March stretches, as `Integrator.march`."""
        pressed.march_pressed_stretches(
            self.state, self.kept["springs"], self.sums, self.p, self.q, self.wave,
            self.normal_wave, cycles, self.rate, np.empty(length + 1), np.empty(length + 1),
            *_nodes(length if record else 0, PRESSED_NODE), *rows,
        )  # fmt: skip


def _nodes(count: int, kind: np.dtype[np.void]) -> tuple[npt.NDArray[np.void], FloatArray]:
    """Room for so many nodes, and the numbers of these, a row each."""
    nodes = np.empty(count, kind)
    return nodes, nodes.view(np.float64).reshape(count, kind.itemsize // 8)


def integrator(model: Model, step: float) -> Integrator:
    """Return what marches a body."""
    if model.normal is not None:
        return LoadedIntegrator(model, step)
    if model.solve.scheme == "two-phase":
        return TwoPhase(model, step)
    return Integrator(model, step)


def another_at(body: Integrator, step: float) -> Integrator:
    """Return one that is where ``body`` is, with steps of so many s; its sums are empty."""
    other = integrator(body.model, step)
    for name, held in body.kept.items():
        if name != "sums":
            other.kept[name][:] = held
    return other

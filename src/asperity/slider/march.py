"""Marching a body through time: windows, means, the power ledger and the history."""

import math
import time

import numpy as np
import numpy.typing as npt

from asperity.errors import ConvergenceError, InputError
from asperity.results.ledger import PowerLedger
from asperity.slider import kernels as k
from asperity.slider import model as m
from asperity.slider.model import WINDOW_SHARE, FloatArray, Model
from asperity.slider.result import History, SlideResult, finite, mean_pair
from asperity.slider.two_phase import march_two_phase
from asperity.vibration import fill_increments

_RECORDS = 4000
_TAIL_CYCLES = 4
_TAIL_RECORDS = 4000
_BLOCK = 1024
_STRETCH = 2_000_000  # steps in one call of a kernel: a fraction of a second, then Ctrl-C is heard
_MOST_STEPS = 1e10
_UNSTEADY = 1e-3
_NO_TABLE = np.zeros(2)


class Timetable:
    """Steps of a march: how many, and where its window and its finely recorded tail begin."""

    def __init__(self, model: Model) -> None:
        # Counted in the steps asked for, so that rows stand at the same times however they are
        # divided.
        whole = round(model.duration / model.step)
        if model.vibrates:
            span = WINDOW_SHARE * max(whole * model.step - model.start, 0.0)
            self.cycles = math.floor(min(model.window, span) * model.frequency + 1e-9)
            if self.cycles < 1:
                raise InputError(
                    f"solve.duration is {model.duration:g} s; with the vibration of "
                    f"{model.frequency:g} Hz from {model.start:g} s on it must be at least "
                    f"{model.start + 1.5 / model.frequency:.7g} s"
                )
            window = round(self.cycles / (model.frequency * model.step))
            tail = round(_TAIL_CYCLES / (model.frequency * model.step))
        else:
            self.cycles = 0
            window = round(min(model.window, WINDOW_SHARE * model.duration) / model.step)
            tail = 0
        if whole < 8 or window < 2:
            raise InputError(
                f"solve.duration is {model.duration:g} s; it must be at least 8 steps of "
                f"{model.step:g} s"
            )
        if whole * model.substeps > _MOST_STEPS:
            raise InputError(
                f"solve.duration is {model.duration:g} s, {whole * model.substeps:.3g} steps of "
                f"{model.step / model.substeps:.3g} s; a march takes at most {_MOST_STEPS:g}: give "
                "a shorter duration or a larger step, or solve.method 'periodic'"
            )
        window = min(window, whole)
        tail = min(tail, window // 2, _TAIL_RECORDS)
        parts = model.substeps
        self.parts = parts
        self.step = model.step / parts
        self.steps = whole * parts
        self.window = window * parts
        self.window_start = self.steps - self.window
        self.middle = self.window_start + window // 2 * parts
        self.tail = tail * parts


class Stopped(Exception):  # noqa: N818 - being told to stop is no error
    """A march was told to stop before it was done."""


class Walk:
    """State, sums and recorded rows of one march as it goes on."""

    def __init__(
        self,
        model: Model,
        table: Timetable,
        *,
        record: bool = False,
        stop: npt.NDArray[np.int64] | None = None,
    ) -> None:
        self.record = record
        self.stop = stop
        self.model = model
        self.table = table
        self.p = model.parameters(table.step)
        self.state = np.zeros(k.STATE)
        self.sums = np.zeros(k.SUMS)
        self.sums[k.BREAKAWAY] = -1.0
        self.done = 0
        self.rows: list[FloatArray] = []
        self.at: list[FloatArray] = []
        self.two_phase = model.solve.scheme == "two-phase"
        self.cycles_per_step = model.frequency * table.step
        self.start_cycles = model.frequency * model.start
        if model.shape is not None:
            self.wave = model.shape.kernel_arguments()
        else:
            self.wave = (0, 0.0, _NO_TABLE)
        k.clear(self.sums)
        first = np.empty(1)
        self._fill(first)
        if not self.two_phase:
            k.prime(self.state, self.p, first, m.MODELS[model.friction.model], self._law)
        else:
            self.extra = np.array([1.0, 0.0, 0.0])
            if self.p[m.RIGID]:
                self.state[k.WX] = self.p[m.DRIVE]

    @property
    def _law(self) -> int:
        return self.model.friction.law_code

    def _fill(self, room: FloatArray) -> None:
        fill_increments(*self.wave, self._cycles(), self.cycles_per_step, room)

    def _cycles(self) -> float:
        return self.done * self.cycles_per_step - self.start_cycles

    def energies(self) -> tuple[float, float]:
        """Energies at the present node, see `energies`."""
        return energies(self.state, self.p, elastic=self.model.friction.model != "coulomb")

    def to(self, target: int, stride: int) -> None:
        """March to a step, recording every ``stride`` steps and at the end."""
        while self.done < target:
            if self.stop is not None and self.stop[0]:
                raise Stopped
            length = min(stride, target - self.done)
            count = max(1, min((target - self.done) // length, _STRETCH // length))
            history = np.empty((count, k.STATE))
            room = np.empty(length + 1)
            if self.two_phase:
                march_two_phase(
                    self.state, self.extra, self.sums, self.p, *self.wave, self._cycles(),
                    self.cycles_per_step, count, length, room, history, self.model.on_body,
                )  # fmt: skip
            else:
                k.march_recorded(
                    self.state, self.sums, self.p, *self.wave, self._cycles(),
                    self.cycles_per_step, count, length, room, history,
                    m.MODELS[self.model.friction.model], self._law,
                )  # fmt: skip
            if self.record:
                self.rows.append(history)
                self.at.append(self.done + length * np.arange(1.0, count + 1.0))
            self.done += count * length
        if not finite(self.state):
            raise ConvergenceError(
                f"the march left the finite numbers before {self.done * self.table.step:g} s; "
                "give a smaller solve.step",
                reached={"time_s": self.done * self.table.step},
            )


def march(
    model: Model, *, history: bool = True, stop: npt.NDArray[np.int64] | None = None
) -> SlideResult:
    """Integrate a sliding body from rest over the case's duration.

    Parameters
    ----------
    model : Model
        The body; ``model.solve.scheme`` selects the integrator.
    history : bool
        Whether to keep motion and forces over time (a few thousand rows at any length).
    stop : ndarray of int64, shape (1,), optional
        Set it to 1 from another thread to have the call raise `Stopped` soon.

    Raises
    ------
    InputError
        The step is too coarse for the waveform, or the duration too short.
    ConvergenceError
        The two-phase scheme became unstable.
    """
    began = time.perf_counter()
    table = Timetable(model)
    walk = Walk(model, table, record=history, stop=stop)
    stride = max(1, table.steps // table.parts // _RECORDS) * table.parts if history else _BLOCK
    walk.to(table.window_start, stride)
    start = walk.energies()
    k.clear(walk.sums)
    walk.to(table.middle, stride)
    first_half = walk.sums.copy()
    k.clear(walk.sums)
    if history:
        walk.to(table.steps - table.tail, stride)
    walk.to(table.steps, table.parts if history else stride)
    second_half = walk.sums.copy()
    breakaway = second_half[k.BREAKAWAY]
    sums = first_half + second_half
    for most in (k.MAX_FX, k.MAX_FY):
        sums[most] = max(first_half[most], second_half[most])
    for least in (k.MIN_FX, k.MIN_FY):
        sums[least] = min(first_half[least], second_half[least])
    end = walk.energies()
    halves = [s[k.SUM_FD] / s[k.STEPS] for s in (first_half, second_half)]
    residual = abs(float(halves[1] - halves[0]))
    return summarise(
        model, table.step, sums, start, end,
        residual=residual,
        breakaway_time=float(breakaway) * table.step if breakaway >= 0.0 else None,
        steps=table.steps,
        cycles=table.cycles,
        history=_history(model, table.step, walk) if history else None,
        notes=march_notes(model, table, residual, broke=breakaway >= 0.0),
        substeps=model.substeps,
        seconds=time.perf_counter() - began,
    )  # fmt: skip


def march_notes(model: Model, table: Timetable, residual: float, *, broke: bool) -> tuple[str, ...]:
    """What a reader of a march's numbers should know."""
    notes = []
    span = table.window * table.step
    if model.vibrates and span < 0.999 * model.window - 1.0 / model.frequency:
        notes.append(
            f"the means are over {span:.3g} s: solve.duration has no room for the usual "
            f"{model.window:.3g} s"
        )
    if not (broke or model.vibrates or model.slider.rigid):
        notes.append("the body has not broken away; give a longer solve.duration")
    if residual > _UNSTEADY:
        notes.append(
            "not steady: from the first to the second half of the window the mean drive force "
            f"changes by {residual:.2g} of mu F_N; give a longer solve.duration"
        )
    if model.substeps > 1 and model.friction.model == "coulomb":
        notes.append(
            f"each step of {model.step:g} s was divided by {model.substeps}: the vibration's "
            f"velocity must not change by more than {m.COULOMB_BOUND:g} of the drive velocity in a "
            f"step, nor the step exceed {m.RING_BOUND:g} over the body's angular frequency"
        )
    elif model.substeps > 1:
        notes.append(
            f"each step of {model.step:g} s was divided by {model.substeps}: the slip in a step "
            f"must not exceed {m.SLIP_BOUND:g} max_deflection, nor change by more than "
            f"{m.CHANGE_BOUND:g} of it from step to step, nor the step exceed {m.RING_BOUND:g} "
            "over the body's angular frequency on its asperities"
        )
    return tuple(notes)


def energies(state: FloatArray, p: FloatArray, *, elastic: bool) -> tuple[float, float]:
    r"""Mechanical and elastic energy over :math:`\mu F_N \ell`, matching the trapezoidal sums.

    Mechanical: kinetic and in the drive spring; elastic: in the asperities. The lateral kinetic
    energy counts with the share of the lateral motion the contact sees: where that is not all of
    it (vibration of the body with eta_y < 1), the rest of the force on the body has no
    counterpart in the contact.
    """
    total = 0.5 * p[m.KAPPA] * state[k.STRETCH] ** 2
    if p[m.GIVE_X] > 0.0:
        give = p[m.GIVE_X] * 2.0 / (1.0 + p[m.KEEP])
        before = state[k.WX] - give * (state[k.FD] - state[k.FX])
        total += 0.5 * state[k.WX] * before / give
    if p[m.GIVE_Y] > 0.0:
        before = state[k.WY] + p[m.GIVE_Y] * state[k.FY]
        total += 0.5 * (p[m.OWN_1] + p[m.OWN_2]) * state[k.WY] * before / p[m.GIVE_Y]
    bristle = 0.5 * (state[k.SX] ** 2 + state[k.SY] ** 2) if elastic else 0.0
    return float(total), float(bristle)


def summarise(
    model: Model,
    step: float,
    sums: FloatArray,
    start: tuple[float, float],
    end: tuple[float, float],
    *,
    residual: float,
    steps: int,
    cycles: int,
    seconds: float,
    breakaway_time: float | None = None,
    history: History | None = None,
    notes: tuple[str, ...] = (),
    substeps: int = 1,
) -> SlideResult:
    """Turn the sums over a window, and the energies at its ends, into a result in SI."""
    count = sums[k.STEPS]
    force = model.full_friction
    return SlideResult(
        model=model,
        ratio=float(sums[k.SUM_FD] / count),
        drive_force=float(sums[k.SUM_FD] / count * force),
        friction_mean=mean_pair(sums[k.SUM_FX] / count, sums[k.SUM_FY] / count, force),
        friction_max=mean_pair(sums[k.MAX_FX], sums[k.MAX_FY], force),
        friction_min=mean_pair(sums[k.MIN_FX], sums[k.MIN_FY], force),
        breakaway_time=breakaway_time,
        ledger=_ledger(model, step, sums, end[0] - start[0], end[1] - start[1]),
        residual=residual,
        steps=steps,
        cycles=cycles,
        seconds=seconds,
        substeps=substeps,
        history=history,
        notes=notes,
    )


def _ledger(
    model: Model, step: float, sums: FloatArray, mechanical: float, elastic: float
) -> PowerLedger:
    p = model.parameters(step)
    length = model.length(step)
    watts = model.full_friction * length / (float(sums[k.STEPS]) * step)
    vibration = -(p[m.BASE_X] * sums[k.SUM_VX] + p[m.BASE_Y] * sums[k.SUM_VY])
    whole = model.amplitude * model.unit_direction[1] / length
    whole = -whole if model.on_body else whole
    return PowerLedger(
        drive=float(watts * p[m.DRIVE] * sums[k.SUM_FD]),
        vibration=float(watts * vibration),
        friction=float(watts * (sums[k.SUM_SLIP] - elastic)),
        damping=float(watts * sums[k.SUM_DRAG]) if p[m.CHI] > 0.0 else 0.0,
        stored=float(watts * (mechanical + elastic)),
        untransferred=float(-watts * (1.0 - model.friction.transfer) * whole * sums[k.SUM_VY]),
    )


def _history(model: Model, step: float, walk: Walk) -> History:
    rows = np.concatenate(walk.rows)
    at = np.concatenate(walk.at) / walk.table.parts * model.step
    length = model.length(step)
    force = model.full_friction
    drive = model.slider.drive_velocity
    x = drive * at - rows[:, k.STRETCH] * length
    return History(
        time=at,
        drive_force=rows[:, k.FD] * force,
        friction=rows[:, [k.FX, k.FY]] * force,
        deflection=rows[:, [k.SX, k.SY]] * length,
        position=np.stack([x, rows[:, k.Y] * length], axis=1),
        velocity=rows[:, [k.WX, k.WY]] * (length / step),
    )

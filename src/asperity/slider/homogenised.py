r"""The cycle-mean friction law: what a body that moves slowly against the vibration feels.

Over one vibration cycle a body at the mean velocity :math:`v` feels the mean force :math:`F(v)`.
Tabulated once from periodic states, it replaces the vibrating contact in a model whose own motion
is slow against the vibration,

.. math:: m\ddot X = k_d(v_d t - X) + h_d(v_d - \dot X) - F(\dot X) .

The body's own answer to the vibration (it shakes a little with the base) is in the table.
"""

import dataclasses
import functools
import math
import time
from typing import Any, overload

import numpy as np

from asperity.compiled import kernel
from asperity.errors import ConvergenceError, InputError
from asperity.slider import kernels as k
from asperity.slider.march import Timetable, Walk
from asperity.slider.model import FloatArray, Model
from asperity.slider.periodic import solve_periodic
from asperity.slider.result import History, PowerLedger, SlideResult

_POINTS_BELOW = 64
_POINTS_ABOVE = 56
_HIGHEST = 50.0
_LOWEST = 1e-4
_RECORDS = 4000

# Columns of the table.
FORCE, HIGHEST_X, LOWEST_X, HIGHEST_Y, POWER_IN, POWER_LOST, UNTRANSFERRED = range(7)


@kernel
def interpolate(velocity, breaks, coefficients):
    """Cubic interpolation in a table; beyond its ends as ``1 - c/v^2`` off the limit of 1."""
    last = breaks.size - 1
    if velocity >= breaks[last] or velocity <= breaks[0]:
        end = breaks[last] if velocity > 0.0 else breaks[0]
        piece = last - 1 if velocity > 0.0 else 0
        x = end - breaks[piece]
        value = coefficients[0, piece]
        for i in range(1, 4):
            value = value * x + coefficients[i, piece]
        full = 1.0 if velocity > 0.0 else -1.0
        return full + (value - full) * (end / velocity) ** 2
    piece = np.searchsorted(breaks, velocity, side="right") - 1
    x = velocity - breaks[piece]
    value = coefficients[0, piece]
    for i in range(1, 4):
        value = value * x + coefficients[i, piece]
    return value


@kernel
def _integrate(x, v, steps, h, drive, stiffness, damping, mass, force, breaks, c, stride, rows):
    """Runge-Kutta of order 4 for stretch and velocity; rows of (stretch, velocity, F share)."""
    for n in range(steps):
        sx, sv = 0.0, 0.0
        kx, kv = 0.0, 0.0
        for stage in range(4):
            at = 0.0 if stage == 0 else (1.0 if stage == 3 else 0.5)
            xs = x + at * h * kx
            vs = v + at * h * kv
            kx = drive - vs
            pull = stiffness * xs + damping * kx
            kv = (pull - force * interpolate(vs, breaks, c)) / mass
            weight = 1.0 if stage == 0 or stage == 3 else 2.0
            sx += weight * kx
            sv += weight * kv
        x += h * sx / 6.0
        v += h * sv / 6.0
        if (n + 1) % stride == 0:
            row = (n + 1) // stride - 1
            rows[row, 0] = x
            rows[row, 1] = v
            rows[row, 2] = interpolate(v, breaks, c)
    return x, v


@dataclasses.dataclass(frozen=True, eq=False)
class HomogenisedLaw:
    r"""Cycle-mean friction as a function of the mean velocity.

    Call it with a velocity in m/s, scalar or array, for the force in N. In a compiled model use
    `interpolate` with `arguments`, times ``full_friction``.

    Attributes
    ----------
    velocity : ndarray, shape (n,)
        Tabulated mean velocities, m/s, increasing, both signs.
    table : ndarray, shape (n, 7)
        Mean force, highest and lowest friction along and highest across the drive, over
        :math:`\mu F_N`; power of the vibration, dissipated and untransferred power, W.
    full_friction : float
        :math:`\mu F_N`, N; approached at velocities far above the vibration's.
    residual : float
        Largest change of a state over its cycle in the table.
    """

    velocity: FloatArray
    table: FloatArray
    full_friction: float
    residual: float

    @functools.cached_property
    def arguments(self) -> tuple[FloatArray, FloatArray]:
        """Breakpoints and coefficients of the mean force share, for `interpolate`."""
        return self._pieces(FORCE)

    def _pieces(self, column: int) -> tuple[FloatArray, FloatArray]:
        from scipy.interpolate import PchipInterpolator

        cubic: Any = PchipInterpolator(self.velocity, self.table[:, column])
        return np.ascontiguousarray(cubic.x), np.ascontiguousarray(cubic.c)

    @overload
    def __call__(self, velocity: float) -> float: ...
    @overload
    def __call__(self, velocity: FloatArray) -> FloatArray: ...
    def __call__(self, velocity: float | FloatArray) -> float | FloatArray:
        """Mean friction force in N at mean velocities in m/s."""
        values = np.atleast_1d(np.asarray(velocity, dtype=float))
        if not np.all(np.isfinite(values)):
            raise InputError("the velocity is not finite; give finite velocities in m/s")
        force = self.full_friction * np.array(
            [interpolate(v, *self.arguments) for v in values.ravel()]
        )
        return float(force[0]) if np.ndim(velocity) == 0 else force.reshape(values.shape)

    def column(self, column: int, velocity: FloatArray) -> FloatArray:
        """One column of the table at some velocities (inside the table's range)."""
        breaks, c = self._pieces(column)
        inside = np.clip(velocity, breaks[0], breaks[-1] * (1.0 - 1e-12))
        return np.array([interpolate(v, breaks, c) for v in inside])


def homogenise(model: Model) -> HomogenisedLaw:
    """Tabulate the cycle-mean friction of a body with its mass, drive and vibration.

    Raises
    ------
    InputError
        Nothing vibrates.
    ConvergenceError
        A velocity in the table has no periodic state; the message names it.
    """
    if not model.vibrates:
        raise InputError("solve.method 'homogenised' needs a vibration; give [vibration]")
    speeds = _grid(model.peak_velocity)
    ahead = [_row(model, v, 0.0) for v in speeds]
    symmetric = model.vibration is not None and model.vibration.waveform != "sampled"
    # F(-v) is -F(v) with the vibration turned by half a turn, and a wave whose halves mirror each
    # other does not notice that.
    behind = ahead if symmetric else [_row(model, v, math.pi) for v in speeds]
    mirror = np.array([-1.0, -1.0, -1.0, 1.0, 1.0, 1.0, 1.0])
    back = np.array([row[[0, 2, 1, 3, 4, 5, 6]] for row, _ in behind]) * mirror
    front = np.array([row for row, _ in ahead])
    rest = 0.5 * (front[:1] + back[:1])
    return HomogenisedLaw(
        velocity=np.concatenate([-speeds[::-1], [0.0], speeds]),
        table=np.concatenate([back[::-1], rest, front]),
        full_friction=model.full_friction,
        residual=max(residual for _, residual in ahead + behind),
    )


def _grid(peak: float) -> FloatArray:
    # Rigid friction goes as asin(v/v_a): even spacing in the angle follows its steep end.
    below = peak * np.sin(0.5 * math.pi * np.arange(1, _POINTS_BELOW + 1) / _POINTS_BELOW)
    above = peak * np.geomspace(1.0, _HIGHEST, _POINTS_ABOVE + 1)[1:]
    return np.concatenate([[_LOWEST * peak], below, above])


def _row(model: Model, velocity: float, turn: float) -> tuple[FloatArray, float]:
    if model.vibration is None:
        raise InputError("nothing vibrates")
    slider = model.slider.model_copy(update={"drive_velocity": float(velocity)})
    vibration = model.vibration.model_copy(
        update={
            "velocity_ratio": None,
            "velocity_amplitude": None,
            "displacement_amplitude": model.amplitude,
            "direction": model.direction + turn,
        }
    )
    at = dataclasses.replace(model, slider=slider, vibration=vibration)
    try:
        answer = solve_periodic(at, history=False)
    except ConvergenceError as error:
        raise ConvergenceError(
            f"at the mean velocity {velocity:.4g} m/s: {error}", reached=error.reached
        ) from None
    force = model.full_friction
    ledger = answer.ledger
    if ledger is None:
        raise ConvergenceError("a periodic state came without its ledger")
    row = [
        answer.ratio, answer.friction_max[0] / force, answer.friction_min[0] / force,
        answer.friction_max[1] / force, ledger.vibration, ledger.friction, ledger.untransferred,
    ]  # fmt: skip
    return np.array(row), answer.residual


def solve_homogenised(model: Model, *, history: bool = True) -> SlideResult:
    """March a body with the cycle-mean friction in place of the vibrating contact.

    Up to the start of the vibration the full model is marched. A rigid drive needs no march: the
    answer is the law at the drive velocity. Friction extremes are those of the cycle at the mean
    velocity. The first cycles after the start are not resolved.
    """
    began = time.perf_counter()
    law = homogenise(model)
    if model.slider.rigid:
        return _result(model, law, np.array([model.slider.drive_velocity]), None, began)
    table = Timetable(model)
    walk = Walk(model, table)
    begin = min(round(model.start / table.step), table.window_start)
    walk.to(begin, max(1, begin))
    slider = model.slider
    length, step = model.length(table.step), table.step
    stretch = float(walk.state[k.STRETCH]) * length
    velocity = float(walk.state[k.WX]) * length / step
    h, count = _ode_step(model, law, (table.steps - begin) * step)
    stride = max(1, count // _RECORDS)
    rows = np.zeros((count // stride, 3))
    _integrate(
        stretch, velocity, count, h, slider.drive_velocity, slider.drive_stiffness or 0.0,
        slider.drive_damping, slider.mass or 1.0, law.full_friction, *law.arguments, stride, rows,
    )  # fmt: skip
    at = begin * step + h * stride * np.arange(1, len(rows) + 1)
    rows = np.column_stack([at, rows])
    breakaway = float(walk.sums[k.BREAKAWAY])
    broke = breakaway * step if breakaway >= 0.0 else None
    return _result(model, law, None, rows, began, broke, begin + count, history)


def _ode_step(model: Model, law: HomogenisedLaw, span: float) -> tuple[float, int]:
    """Step of the slow motion: bounded by the law's steepest slope and by the drive's ring."""
    breaks, _ = law.arguments
    slope = float(np.max(np.abs(np.diff(law.table[:, FORCE]) / np.diff(breaks))))
    rate = slope * law.full_friction / (model.slider.mass or 1.0)
    ring = 2.0 * math.pi / model.ring_period
    h = min(1.0 / rate, 0.02 / ring)
    count = max(8, math.ceil(span / h))
    return span / count, count


def _result(
    model: Model,
    law: HomogenisedLaw,
    velocity: FloatArray | None,
    rows: FloatArray | None,
    began: float,
    breakaway: float | None = None,
    steps: int = 0,
    history: bool = False,
) -> SlideResult:
    force = law.full_friction
    drive = model.slider.drive_velocity
    stored = 0.0
    damping = 0.0
    record = None
    if rows is None:
        if velocity is None:
            raise InputError("no velocity to evaluate the law at")
        share = law(velocity) / force
        pull = share * force
        cycles = 0
        residual = law.residual
    else:
        table = Timetable(model)
        inside = rows[rows[:, 0] >= table.window_start * table.step - 1e-12]
        _, stretch, velocity, share = inside.T
        pull = (model.slider.drive_stiffness or 0.0) * stretch
        pull = pull + model.slider.drive_damping * (drive - velocity)
        damping = model.slider.drive_damping * float(np.mean((drive - velocity) ** 2))
        energy = 0.5 * (model.slider.drive_stiffness or 0.0) * stretch**2
        energy = energy + 0.5 * (model.slider.mass or 0.0) * velocity**2
        span = inside[-1, 0] - inside[0, 0]
        stored = float(energy[-1] - energy[0]) / span
        cycles, residual = table.cycles, law.residual
        record = _history(model, rows) if history else None

    def mean(column: int) -> float:
        return float(np.mean(law.column(column, np.asarray(velocity))))

    return SlideResult(
        model=model,
        ratio=float(np.mean(pull)) / force,
        drive_force=float(np.mean(pull)),
        friction_mean=(float(np.mean(share)) * force, 0.0),
        friction_max=(mean(HIGHEST_X) * force, mean(HIGHEST_Y) * force),
        friction_min=(mean(LOWEST_X) * force, -mean(HIGHEST_Y) * force),
        breakaway_time=breakaway,
        ledger=PowerLedger(
            drive=float(np.mean(pull)) * drive,
            vibration=mean(POWER_IN),
            friction=mean(POWER_LOST),
            damping=damping,
            stored=stored,
            untransferred=mean(UNTRANSFERRED),
        ),
        residual=residual,
        steps=steps,
        cycles=cycles,
        seconds=time.perf_counter() - began,
        substeps=model.substeps,
        history=record,
        notes=("friction and powers are means over a vibration cycle, from a table",),
    )


def _history(model: Model, rows: FloatArray) -> History:
    at, stretch, velocity, share = rows.T
    drive = model.slider.drive_velocity
    none = np.zeros_like(at)
    limit = model.length(1.0) if model.friction.model != "coulomb" else 0.0
    pull = (model.slider.drive_stiffness or 0.0) * stretch
    pull = pull + model.slider.drive_damping * (drive - velocity)
    return History(
        time=at,
        drive_force=pull,
        friction=np.column_stack([share * model.full_friction, none]),
        deflection=np.column_stack([share * limit, none]),
        position=np.column_stack([drive * at - stretch, none]),
        velocity=np.column_stack([velocity, none]),
    )

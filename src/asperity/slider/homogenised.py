r"""Marching a body with the cycle-mean friction law in place of the vibrating contact.

.. math:: m\ddot X = k_d(v_d t - X) + h_d(v_d - \dot X) - F(\dot X)

where the body's own motion is slow against the vibration.
"""

import dataclasses
import math
import time

import numpy as np

from asperity.arrays import FloatArray
from asperity.errors import ConvergenceError
from asperity.kernels.compiled import kernel
from asperity.results.ledger import REFUSED, PowerLedger, PressedLedger, guard
from asperity.results.settled import Standing
from asperity.slider import cycle_mean_law as hl
from asperity.slider.advice import advice
from asperity.slider.beside_the_law import STEADY, made_up_ring, what_it_is
from asperity.slider.cycle_mean_law import HomogenisedLaw, homogenise
from asperity.slider.cycle_mean_normal import gain_notes, mean_motion
from asperity.slider.foreseen import needed
from asperity.slider.history import History
from asperity.slider.march import March
from asperity.slider.model import Model
from asperity.slider.pieces import interpolate, value_and_slope
from asperity.slider.result import SlideResult
from asperity.slider.steady import growth_rate, sticks_and_slips
from asperity.slider.timetable import WindowMeans, march_notes, march_standing
from asperity.slider.wear import wear_and_heat

__all__ = ["HomogenisedLaw", "homogenise", "interpolate", "solve_homogenised"]

_RECORDS = 2000
_BLOCK = 1024
_RING_SHARE = 0.02
_FAST_STEPS = 200_000
_ADVICE = "solve.method 'march' shows what the body does"
# Alexander's diagonally implicit Runge-Kutta method of order 3, three stages, L-stable.
_G = 0.43586652150845967
_A21 = 0.5 * (1.0 - _G)
_B1 = -1.5 * _G * _G + 4.0 * _G - 0.25
_B2 = 1.5 * _G * _G - 5.0 * _G + 1.25


@kernel
def _stage(x0, v0, w, drive, stiffness, damping, mass, force, breaks, c, viscous):
    """Solve ``v = v0 + w dv/dt`` where the stretch is ``x0 + w (drive - v)``; returns v.

    Newton within a bracket: the law bends, and Newton alone can go back and forth at a bend.
    """
    mobility = w / mass
    low = -math.inf
    high = math.inf
    v = v0
    for _ in range(80):
        share, slope = value_and_slope(v, breaks, c, viscous)
        pull = stiffness * (x0 + w * (drive - v)) + damping * (drive - v)
        rest = v - v0 - mobility * (pull - force * share)
        if rest == 0.0:
            break
        if rest > 0.0:
            high = v
        else:
            low = v
        steep = 1.0 + mobility * (stiffness * w + damping + force * slope)
        new = v - rest / steep if steep > 0.0 else 0.5 * (low + high)
        if not low < new < high and math.isfinite(high - low):
            new = 0.5 * (low + high)
        done = abs(new - v) <= 1e-14 * (abs(v) + drive)
        v = new
        if done:
            break
    return v


@kernel
def _rates(x, v, drive, stiffness, damping, mass, force, breaks, c, viscous):
    pull = stiffness * x + damping * (drive - v)
    return drive - v, (pull - force * interpolate(v, breaks, c, viscous)) / mass


@kernel
def _integrate(
    x, v, h, drive, stiffness, damping, mass, force, breaks, c, viscous, stride, rows
):  # fmt: skip
    """March ``stride`` steps for each of ``rows``, which become (stretch, velocity, F share).

    Implicit, for a strong damper or a light body is far faster than what is looked for. Returns
    the number of steps up to the first full drive force, -1 where it does not come.
    """
    w = h * _G
    broke = -1
    done = 0
    for row in range(len(rows)):
        for _ in range(stride):
            v1 = _stage(x, v, w, drive, stiffness, damping, mass, force, breaks, c, viscous)
            x1 = x + w * (drive - v1)
            ax, av = _rates(x1, v1, drive, stiffness, damping, mass, force, breaks, c, viscous)
            x0 = x + h * _A21 * ax
            v0 = v + h * _A21 * av
            v2 = _stage(x0, v0, w, drive, stiffness, damping, mass, force, breaks, c, viscous)
            x2 = x0 + w * (drive - v2)
            bx, bv = _rates(x2, v2, drive, stiffness, damping, mass, force, breaks, c, viscous)
            x0 = x + h * (_B1 * ax + _B2 * bx)
            v0 = v + h * (_B1 * av + _B2 * bv)
            v = _stage(x0, v0, w, drive, stiffness, damping, mass, force, breaks, c, viscous)
            x = x0 + w * (drive - v)
            done += 1
            if broke < 0 and stiffness * x + damping * (drive - v) >= force:
                broke = done
        rows[row, 0] = x
        rows[row, 1] = v
        rows[row, 2] = interpolate(v, breaks, c, viscous)
    return broke


def solve_homogenised(model: Model, *, history: bool = True) -> SlideResult:
    """March a body with the cycle-mean friction in place of the vibrating contact.

    Up to the start of the vibration the full model is marched. A rigid drive needs no march: the
    answer is the law at the drive velocity. Nor has a body without vibration a slow motion of its
    own: there it is steady sliding. Friction extremes are those of the cycle at the mean velocity.
    The first cycles after the start are not resolved.

    Raises
    ------
    InputError
        The case cannot be solved this way.
    ConvergenceError
        There is no law (see `homogenise`), or the march left the finite numbers.
    """
    began = time.perf_counter()
    law = homogenise(model)
    if model.slider.rigid:
        return _steady(model, law, began, history=history)
    walk = March(model)
    table = walk.table
    if not model.vibrates:
        walk.to(table.steps, _BLOCK)
        broke = walk.breakaway
        answer = _steady(model, law, began, broke, table.steps, history=history)
        if broke is None:
            late = f"within {model.duration:g} s, the solve.duration, the body has not broken away"
            answer = dataclasses.replace(answer, notes=(*answer.notes, f"{late}: no time of it"))
        if (rate := growth_rate(model)) > 0.0:
            why = sticks_and_slips(rate)
            notes = (*answer.notes, why)
            answer = dataclasses.replace(answer, settled=False, settled_by=why, notes=notes)
        return answer
    begin = min(round(model.start / table.step), table.window_start)
    walk.to(begin, _BLOCK)
    breakaway = walk.breakaway
    length, step = model.length(table.step), table.step
    slider = model.slider
    at = begin * step
    row = np.array(
        [
            float(walk.state["stretch"]) * length,
            float(walk.state["velocity_x"]) * length / step,
            0.0,
        ]
    )
    row[2] = law(row[1]) / law.full_friction
    parts = [np.append(at, row)[None]]
    taken = begin
    for end in (table.window_start * step, table.steps * step):
        if end <= at:
            continue
        h, stride, count = _division(model, law, end - at)
        rows = np.zeros((count, 3))
        full = _integrate(
            row[0], row[1], h, slider.drive_velocity, slider.drive_stiffness or 0.0,
            slider.drive_damping, slider.mass or 1.0, law.full_friction, *law.arguments,
            stride, rows,
        )  # fmt: skip
        if breakaway is None and full >= 0:
            breakaway = at + h * full
        parts.append(np.column_stack([at + h * stride * np.arange(1, count + 1), rows]))
        taken += count * stride
        at, row = end, rows[-1]
    # The window starts at the last row of what was before it.
    window = np.concatenate([parts[-2][-1:], parts[-1]])
    record = None
    if history:
        rows = np.concatenate(parts[1:])
        record = _history(model, law, rows, _pull(model, rows))
    pull = _pull(model, window) / law.full_friction
    means = [float(np.mean(part)) for part in np.array_split(pull, 4)]
    first, second = (np.mean(half) for half in np.array_split(pull, 2))
    if ring := made_up_ring(model, law, window[:, 2], float(np.mean(pull))):
        answer = _steady(model, law, began, breakaway, taken, history=False)
        notes = (*answer.notes, ring)
        return dataclasses.replace(answer, cycles=table.cycles, history=record, notes=notes)
    answer = _marched(model, law, window, began, breakaway, taken)
    come_to = WindowMeans(model, table, float(second - first), means, breakaway is not None)
    marched = march_standing(come_to)
    standing = Standing(
        answer.settled and marched.settled,
        f"{marched.settled_by}; {answer.settled_by}",
    )
    notes = march_notes(come_to)
    if answer.settled and not marched.settled:  # no duration makes up for what the law lacks
        notes += (advice(needed(come_to), model),)
    return dataclasses.replace(
        answer, cycles=table.cycles, history=record, notes=(*answer.notes, *notes),
        **standing._asdict(),
    )  # fmt: skip


def _division(model: Model, law: HomogenisedLaw, span: float) -> tuple[float, int, int]:
    """Step, steps a row and rows: the drive's ring resolved, and what is faster if affordable."""
    slope = float(np.max(np.abs(np.diff(law.table[:, hl.FORCE]) / np.diff(law.velocity))))
    rate = slope * law.full_friction + model.slider.drive_damping
    rate /= model.slider.mass or 1.0
    ring = math.ceil(span * 2.0 * math.pi / model.ring_period / _RING_SHARE)
    steps = max(8, ring, math.ceil(min(span * rate, _FAST_STEPS)))
    rows = min(_RECORDS, steps)
    stride = math.ceil(steps / rows)
    return span / (rows * stride), stride, rows


def _steady(
    model: Model,
    law: HomogenisedLaw,
    began: float,
    breakaway: float | None = None,
    steps: int = 0,
    *,
    history: bool,
) -> SlideResult:
    """Steady sliding at the drive velocity."""
    slider = model.slider
    force = law(slider.drive_velocity)
    stretch = 0.0 if slider.rigid else force / (slider.drive_stiffness or 1.0)
    row = np.array([[0.0, stretch, slider.drive_velocity, force / law.full_friction]])
    pull = row[:, 3] * law.full_friction
    answer = _result(model, law, row, began, breakaway, steps, pull=pull)
    if not history:
        return answer
    ends = np.repeat(row, 2, axis=0)
    ends[1, 0] = model.duration
    return dataclasses.replace(answer, history=_history(model, law, ends, np.repeat(pull, 2)))


def _marched(
    model: Model,
    law: HomogenisedLaw,
    rows: FloatArray,
    began: float,
    breakaway: float | None,
    steps: int,
) -> SlideResult:
    slider = model.slider
    at, stretch, velocity, _ = rows.T
    energy = 0.5 * (slider.drive_stiffness or 0.0) * stretch**2
    energy = energy + 0.5 * (slider.mass or 0.0) * velocity**2
    return _result(
        model, law, rows, began, breakaway, steps, pull=_pull(model, rows),
        damping=slider.drive_damping * (slider.drive_velocity - velocity) ** 2,
        stored=float(energy[-1] - energy[0]) / float(at[-1] - at[0]),
    )  # fmt: skip


def _pull(model: Model, rows: FloatArray) -> FloatArray:
    slider = model.slider
    pull = (slider.drive_stiffness or 0.0) * rows[:, 1]
    return pull + slider.drive_damping * (slider.drive_velocity - rows[:, 2])


def _result(
    model: Model,
    law: HomogenisedLaw,
    rows: FloatArray,
    began: float,
    breakaway: float | None,
    steps: int,
    *,
    pull: FloatArray,
    damping: FloatArray | float = 0.0,
    stored: float = 0.0,
) -> SlideResult:
    force = law.full_friction
    weights = np.ones(len(rows))
    if len(rows) > 1:
        weights[[0, -1]] = 0.5

    def mean(values: FloatArray | float) -> float:
        return float(np.average(np.broadcast_to(values, weights.shape), weights=weights))

    def column(column: int) -> float:
        return mean(law.column(column, rows[:, 2]))

    drive_force = mean(pull)
    powers = {
        "drive": drive_force * model.slider.drive_velocity,
        "vibration": column(hl.POWER_IN),
        "friction": column(hl.POWER_LOST),
        "damping": mean(damping) + column(hl.POWER_DAMPED),
        "stored": stored,
        "untransferred": column(hl.UNTRANSFERRED) + 0.0,  # no -0.0
    }
    ledger, normal, wear = PowerLedger(**powers), None, None
    noted: tuple[str, ...] = ()
    if law.pressed:
        told = law.normal_to_the_plane(rows[:, 2])
        ledger = PressedLedger(
            **powers,
            normal=mean(told.pop("normal")),
            contact_damping=mean(told.pop("contact_damping")),
        )
        # On the way there are other states, with periods and multipliers of their own.
        drive = model.slider.drive_velocity
        steady = bool(np.all(np.abs(rows[:, 2] - drive) <= STEADY * drive))
        there = None
        if steady and drive not in law.missing:
            there = law.normal_to_the_plane(np.array([drive]))
        normal = mean_motion(model, told, there, mean, drive_force)
        noted = gain_notes(model, normal, ledger.friction)
        if model.wear is not None:
            integral = normal.wear_integral
            slip = integral / normal.normal_mean
            wear = wear_and_heat(model.wear, integral, (ledger.friction, slip), model.frequency)
    answer = SlideResult(
        model=model,
        **law.standing(model.slider.drive_velocity)._asdict(),
        ratio=drive_force / force,
        drive_force=drive_force,
        friction_mean=(mean(rows[:, 3]) * force, column(hl.FORCE_Y) * force),
        friction_max=(column(hl.HIGHEST_X) * force, column(hl.HIGHEST_Y) * force),
        friction_min=(column(hl.LOWEST_X) * force, column(hl.LOWEST_Y) * force),
        breakaway_time=breakaway,
        ledger=ledger,
        normal=normal,
        wear=wear,
        step_error=law.step_error,
        ratio_from_rest=law.ratio_from_rest,
        residual=law.residual,
        steps=steps,
        cycles=0,
        seconds=time.perf_counter() - began,
        substeps=model.substeps,
        notes=(
            *what_it_is(model, law),
            *law.notes,
            *(f"at the drive velocity {note}" for note in law.remarks),
            *noted,
            *(() if wear is None else wear.notes),
        ),
    )
    numbers = [entry.value for entry in answer.entries() if isinstance(entry.value, float)]
    if not np.all(np.isfinite(numbers)):
        raise ConvergenceError(
            f"the march with the cycle-mean law left the finite numbers; {_ADVICE}"
        )
    # Between states next to the drive velocity a balance is as good as the interpolation.
    most = math.inf if model.slider.drive_velocity in law.missing else REFUSED
    noted = guard(ledger, _ADVICE, reached={"ratio": answer.ratio}, most=most)
    return dataclasses.replace(answer, notes=(*answer.notes, *noted))


def _history(model: Model, law: HomogenisedLaw, rows: FloatArray, pull: FloatArray) -> History:
    at, stretch, velocity, along = rows.T
    none = np.zeros_like(at)
    limit = model.length(1.0) if model.friction.model != "coulomb" else 0.0
    share = np.column_stack([along, law.column(hl.FORCE_Y, velocity)])

    def of_a_cycle(*columns: int) -> FloatArray:
        shares = [law.column(column, velocity) for column in columns]
        return law.full_friction * np.column_stack(shares)

    return History(
        time=at,
        drive_force=pull,
        friction=share * law.full_friction,
        friction_min=of_a_cycle(hl.LOWEST_X, hl.LOWEST_Y),
        friction_max=of_a_cycle(hl.HIGHEST_X, hl.HIGHEST_Y),
        deflection=share * limit,
        position=np.column_stack([model.slider.drive_velocity * at - stretch, none]),
        velocity=np.column_stack([velocity, none]),
    )

"""Bodies of a batch as columns of its buffer: how they are put in, and what is taken out."""

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from asperity.arrays import FloatArray
from asperity.normal import elastic_force
from asperity.slider import batch_rows as row
from asperity.slider.batch_fits import FORCES
from asperity.slider.model import Model
from asperity.slider.scaled import (
    PRESSED_STATE,
    PRESSED_SUMS,
    STATE,
    SUMS,
    NormalLoading,
    Parameters,
)
from asperity.slider.summary import energies, pressed_energies
from asperity.slider.timetable import Timetable
from asperity.vibration.waveform import displacement_at

# Rows of what the single-body kernels carry, by its name there.
_STATE_ROWS = {
    "stretch": row.STRETCH,
    "velocity_x": row.WX,
    "velocity_y": row.WY,
    "deflection_x": row.SX,
    "deflection_y": row.SY,
    "friction_x": row.SX,
    "friction_y": row.SY,
    "rise": row.RISE,
    "height": row.HEIGHT,
    "penetration": row.PENETRATION,
    "load": row.LOAD,
}
# Of a step the batch adds the forces in the plane at both its ends, not their mean.
_SUM_ROWS = {
    "friction_x": (row.SUM_FX, 0.5),
    "friction_y": (row.SUM_FY, 0.5),
    "unit_work_x": (row.SUM_VX, 0.5),
    "unit_work_y": (row.SUM_VY, 0.5),
    "slip_work": (row.SUM_SLIP, 0.5),
    "friction_x_max": (row.MAX_FX, 1.0),
    "friction_x_min": (row.MIN_FX, 1.0),
    "friction_y_max": (row.MAX_FY, 1.0),
    "friction_y_min": (row.MIN_FY, 1.0),
    "load": (row.SUM_LOAD, 1.0),
    "load_max": (row.MAX_LOAD, 1.0),
    "load_min": (row.MIN_LOAD, 1.0),
    "penetration": (row.SUM_PENETRATION, 1.0),
    "penetration_max": (row.MAX_PENETRATION, 1.0),
    "penetration_min": (row.MIN_PENETRATION, 1.0),
    "approach_max": (row.MAX_APPROACH, 1.0),
    "open": (row.SUM_OPEN, 1.0),
    "landings": (row.SUM_LANDINGS, 1.0),
    "rise_work": (row.SUM_RISE, 1.0),
    "contact_damping": (row.SUM_LOSS, 1.0),
    "gain": (row.SUM_GAIN, 1.0),
    "wear": (row.SUM_WEAR, 1.0),
}


class Body(NamedTuple):
    """One of a batch: its numbers for the kernels."""

    model: Model
    table: Timetable
    p: Parameters
    q: NormalLoading | None


def body_of(model: Model, table: Timetable) -> Body:
    """Return a body with its numbers for the kernels."""
    q = None if model.normal is None else model.pressing(table.step)
    return Body(model, table, model.parameters(table.step), q)


def load(column: FloatArray, body: Body) -> None:
    """Put a body at rest on its base."""
    p, q = body.p, body.q
    column[row.DRIVE] = p.drive
    column[row.STIFFNESS] = p.stiffness
    column[row.MOBILITY_X] = p.mobility_x
    column[row.MOBILITY_Y] = p.mobility_y
    column[row.BASE_X] = p.base_x
    column[row.BASE_Y] = p.base_y
    column[row.WX] = p.drive if p.rigid else 0.0
    column[row.WAITING] = 1.0
    if q is None:
        return
    column[[row.LINEAR, row.ROOT]] = FORCES[q.law]
    column[row.BASE_Z] = q.base
    column[row.MOBILITY_Z] = q.mobility
    column[row.LOSS] = q.damping
    column[row.PENETRATION] = q.reference
    if q.mobility == 0.0 and body.model.shape is not None:
        wave = body.model.wave(body.table.step, lead=body.model.normal_lead)
        begin = body.model.start * body.model.frequency
        column[row.PENETRATION] += q.base * displacement_at(wave, -begin)
    column[[row.LOAD, row.ELASTIC]] = elastic_force(q.law, column[row.PENETRATION])


def waves_of(bodies: Sequence[Body]) -> tuple[FloatArray, FloatArray, bool]:
    """Return the bodies' waves, the tables of these, and whether all have the same one.

    A column of waves a body, as `asperity.slider.batch_kernels.fill_batch` takes it.
    """
    waves = np.zeros((10, row.WIDTH))
    first = bodies[0].model.shape
    shapes = np.zeros((row.WIDTH, 2 if first is None else first.table.size))
    for place in range(row.WIDTH):
        model, table = bodies[min(place, len(bodies) - 1)][:2]
        if model.shape is None:
            continue
        rate = model.frequency * table.step
        turn = 2.0 * math.pi * rate
        waves[:6, place] = (
            model.shape.code, model.wave(table.step).rise, -model.start * model.frequency, rate,
            math.cos(turn), math.sin(turn),
        )  # fmt: skip
        waves[8, place] = model.shape.ramp
        shapes[place] = model.shape.table
    shared = bool(np.all(waves == waves[:, :1]) and np.all(shapes == shapes[:1]))
    return waves, shapes, shared


def state_of(column: FloatArray, body: Body) -> np.void:
    """A body's state as the single-body kernels have it."""
    p = body.p
    state: np.void = np.zeros(1, STATE if body.q is None else PRESSED_STATE)[0]
    for name, at in _STATE_ROWS.items():
        if name in (state.dtype.names or ()):
            state[name] = column[at]
    state["drive_force"] = state["friction_x"] if p.rigid else p.stiffness * state["stretch"]
    return state


def energies_of(column: FloatArray, body: Body) -> tuple[float, float]:
    """Mechanical and elastic energy, see `asperity.slider.summary`."""
    model, table, p, q = body
    state = state_of(column, body)
    if q is None:
        return energies(state, p, elastic=True)
    return pressed_energies(state, np.zeros((2, 0)), p, q, model.normal_unit(table.step))


def drive_sum(column: FloatArray, p: Parameters, start: float) -> float:
    """Trapezoidal sum of the drive force since the start of the window."""
    if p.rigid:
        return float(0.5 * column[row.SUM_FX])
    end = p.stiffness * column[row.STRETCH]
    return float(column[row.SUM_FREE] + 0.5 * (start - end))


def sums_of(column: FloatArray, body: Body, start: float) -> np.void:
    """A body's sums as the single-body kernels have them."""
    sums: np.void = np.zeros(1, SUMS if body.q is None else PRESSED_SUMS)[0]
    for name, (at, share) in _SUM_ROWS.items():
        if name in (sums.dtype.names or ()):
            sums[name] = share * column[at]
    sums["drive_force"] = drive_sum(column, body.p, start)
    sums["steps"] = body.table.window
    return sums

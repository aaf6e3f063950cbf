"""A cycle of a solved body: what shakes it, how it slides, and what it carries."""

import numpy as np
import numpy.typing as npt

from asperity.arrays import FloatArray
from asperity.slider.history import History, PressedHistory
from asperity.slider.model import Model
from asperity.vibration.waveform import displacement_at

_WIDTH = 1e-4  # of a cycle, for the slope of the waveform


def cycle_of(model: Model, history: History, points: int) -> dict[str, FloatArray]:
    """Return the last cycle of the vibration, in SI by name.

    Parameters
    ----------
    model : Model
        What was solved.
    history : History
        What came of it.
    points : int
        How many are kept of each.

    Returns
    -------
    dict of str to ndarray
        ``phase`` in cycles, velocities of the base along the drive, across it and up (of the body
        itself where it is shaken), sliding velocities along and across, friction along and across,
        and normal force.
    """
    if len(history.time) < 2:
        return {}
    rows = _last(history.time, model.frequency, points)
    time = history.time[rows]
    frequency = model.frequency or 1.0 / (time[-1] - time[0])
    # A periodic state is counted from the beginning of a cycle.
    start = 0.0 if model.solve.method == "periodic" else model.start
    along, across, up = _base_velocity(model, np.mod(model.frequency * (time - start), 1.0))
    own, aside = history.velocity[rows, 0], history.velocity[rows, 1]
    sense = 1.0 if model.on_body else -1.0
    load = np.full(len(rows), model.slider.normal_force)
    if isinstance(history, PressedHistory):
        load = history.normal_force[rows]
    return {
        "phase": frequency * (time - time[0]),
        "base_velocity": along,
        "base_velocity_across": across,
        "base_velocity_up": up,
        # Prescribed to the body, the motion comes on top of its own.
        "sliding_velocity": own + sense * along,
        "sliding_velocity_across": aside + sense * across,
        "force": history.friction[rows, 0],
        "force_across": history.friction[rows, 1],
        "normal_force": load,
    }


def _last(time: FloatArray, frequency: float, points: int) -> npt.NDArray[np.int64]:
    first = int(np.searchsorted(time, time[-1] - 1.0 / frequency)) if frequency else 0
    rows = np.arange(first, len(time))
    return rows[np.linspace(0, len(rows) - 1, min(points, len(rows))).round().astype(np.int64)]


def _base_velocity(model: Model, phase: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Velocity of what shakes along the drive, across it and up, m/s."""
    if model.shape is None or not model.vibrates:
        return np.zeros(len(phase)), np.zeros(len(phase)), np.zeros(len(phase))
    wave = model.shape.wave(ramped=False)

    def rate(lead: float) -> FloatArray:
        # A cycle late, so that the wave's rest before its start is not met.
        rise = [
            displacement_at(wave, 1.0 + p + _WIDTH) - displacement_at(wave, 1.0 + p - _WIDTH)
            for p in np.mod(phase + lead, 1.0)
        ]
        return model.amplitude * model.frequency / (2.0 * _WIDTH) * np.array(rise)

    along, across, up = model.unit_direction
    plane = rate(0.0) if along or across else np.zeros(len(phase))
    normal = rate(model.normal_lead) if up else np.zeros(len(phase))
    return along * plane, across * plane, up * normal

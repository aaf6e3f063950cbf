"""Figures 6.8, 6.9 and 6.24: the measured table that survives, and two waveforms."""

import numpy as np

from asperity.results.dataset import described
from asperity.thesis.exhibits import Computed, figure
from asperity.thesis.rig import drawings
from asperity.thesis.rig import measured as m
from asperity.thesis.rig.readings import velocities
from asperity.vibration import Vibration

_LOADS = m.LOADS_LB * m.POUND_FORCE


@figure("6.8", drawings.speeds)
def _speeds() -> Computed:
    dataset = described(
        load=(("load",), _LOADS, "N", "normal load"),
        steel=(("load",), m.STEEL_RPM, "rpm", "speed of the steel disc"),
        bronze=(("load",), m.BRONZE_RPM, "rpm", "speed of the bronze disc"),
        steel_current=(("load",), m.STEEL_CURRENT, "A", "current of the steel disc's motor"),
        bronze_current=(("load",), m.BRONZE_CURRENT, "A", "current of the bronze disc's motor"),
    )
    return dataset, ["Table 6.3"]


@figure("6.9", drawings.sliding)
def _sliding() -> Computed:
    sliding, rolling, ratio = velocities()
    dataset = described(
        load=(("load",), _LOADS, "N", "normal load"),
        sliding=(("load",), sliding, "m/s", "sliding velocity"),
        rolling=(("load",), rolling, "m/s", "rolling velocity"),
        ratio=(("load",), ratio, "1", "slide-roll ratio"),
        printed_sliding=(("load",), 1e-3 * m.PRINTED_SLIDING, "m/s", "sliding velocity, printed"),
        printed_rolling=(("load",), 1e-3 * m.PRINTED_ROLLING, "m/s", "rolling velocity, printed"),
        printed_ratio=(("load",), m.PRINTED_RATIO, "1", "slide-roll ratio, printed"),
    )
    return dataset, ["asperity.tribometer.discs, on the speeds of Table 6.3"]


@figure("6.24", drawings.waveforms)
def _waveforms() -> Computed:
    steps = 2000
    time = np.arange(steps + 1) / steps * 2.0 / 750.0
    curves, speeds = [], []
    for waveform in ("sine", "triangle"):
        given = {"waveform": waveform, "frequency": 750.0, "displacement_amplitude": 16e-6}
        shape = Vibration.model_validate(given).shape()
        moved = np.concatenate(([0.0], np.cumsum(shape.increments(0.0, 2.0 / steps, steps))))
        curves.append(16e-6 * moved)
        speeds.append(np.gradient(16e-6 * moved, time))
    dataset = described(
        time=(("time",), time, "s", "time"),
        waveform=(("waveform",), np.array(["sine", "triangle"], dtype=object), "1", "waveform"),
        displacement=(("waveform", "time"), np.array(curves), "m", "displacement"),
        velocity=(("waveform", "time"), np.array(speeds), "m/s", "velocity"),
    )
    return dataset, ["asperity.vibration.Vibration.shape"]

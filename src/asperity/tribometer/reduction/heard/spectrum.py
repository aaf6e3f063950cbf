"""The spectrum of a signal in a window with vibration, as a picture."""

import numpy as np

from asperity.tribometer.channels import Channels
from asperity.tribometer.reduction import drive_signal
from asperity.tribometer.reduction.blocks import lines_of
from asperity.tribometer.reduction.heard.finding import Curve
from asperity.tribometer.reduction.heard.material import Material
from asperity.tribometer.signals import SIGNALS

_HARMONICS = 8
_POINTS = 240


def spectrum_of(of: Material, index: int, signal: str) -> Curve:
    """Return what tones a signal holds while a segment vibrates."""
    one = of.segments[index]
    samples = of.blocks.samples
    values = of.recording.values(signal, one.shaken.first * samples, one.shaken.last * samples)
    scale, line = lines_of(of.recording, of.case.require(Channels))[signal]
    found = drive_signal.Spectrum.of(line.of(scale * values), of.recording.sample_interval)
    across, up = "frequency (Hz)", f"{signal} ({SIGNALS[signal].unit_in_text})"
    if found is None or one.tone is None:
        return Curve(np.zeros(1), np.zeros(1), across, up)
    most = min(int(_HARMONICS * one.tone.frequency / found.step), found.lines.size)
    # The largest of what falls on a point, so that no tone is lost.
    every = max(1, -(-most // _POINTS))
    whole = most // every * every
    y = found.lines[:whole].reshape(-1, every).max(axis=1)
    x = found.step * (np.arange(y.size) * every + 0.5 * (every - 1))
    half = 2.0 * every * found.step
    frequency = one.tone.frequency
    return Curve(x, y, across, up, ((frequency - half, frequency + half),))

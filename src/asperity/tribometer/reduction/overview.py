"""A recording at a glance: its signals over time, and the windows that are taken from it."""

from typing import Any

from asperity.arrays import FloatArray
from asperity.results.dataset import rounded
from asperity.tribometer.channels import Channels
from asperity.tribometer.reduction.blocks import Blocks, blocks_of
from asperity.tribometer.reduction.drive_signal import Stretch
from asperity.tribometer.reduction.study import Reducible, heard_in
from asperity.tribometer.signals import SIGNALS

_SPREAD = "drive_deviation"


def overview(reducible: Reducible, points: int) -> dict[str, Any]:
    """Return a recording's signals and segments, as JSON has them.

    Parameters
    ----------
    reducible : Reducible
        A recording with its configuration.
    points : int
        How many are kept of each signal: means over as many blocks as that takes.

    Returns
    -------
    dict
        ``time`` in s, ``signals`` in SI and ``segments``, each with the windows before and with
        vibration in s, and why it is refused.
    """
    given, recording = reducible.reduction, reducible.recording
    blocks = blocks_of(recording, reducible.case.require(Channels), given.block)
    every = max(1, -(-blocks.count // points))
    signals = [
        {"name": name, "unit": SIGNALS[name].unit, "meaning": SIGNALS[name].meaning,
         "values": rounded(_thinned(values, every))}
        for name, values in blocks.means.items()
    ]  # fmt: skip
    signals.append(
        {"name": _SPREAD, "unit": "V", "meaning": "deviation of the drive signal within a block",
         "values": rounded(_thinned(blocks.drive_deviation, every))}
    )  # fmt: skip
    segments = [
        {
            "start": segment.start,
            "before": _ends(segment.before, blocks),
            "with": _ends(segment.shaken, blocks),
            "commanded_Hz": segment.commanded,
            "waveform": segment.waveform,
            "refused": segment.refused,
            "flags": list(segment.flags),
        }
        for segment in heard_in(reducible)[0]
    ]
    return {
        "recording": recording.name,
        "duration_s": recording.duration,
        "simulated": recording.simulated,
        "settling_s": given.settling,
        "time": rounded(_thinned(blocks.time, every)),
        "signals": signals,
        "segments": segments,
    }


def _thinned(values: FloatArray, every: int) -> FloatArray:
    whole = len(values) // every
    kept: FloatArray = values[: whole * every].reshape(whole, every).mean(axis=1)
    return kept


def _ends(stretch: Stretch, blocks: Blocks) -> list[float]:
    return [stretch.first * blocks.length, max(stretch.first, stretch.last) * blocks.length]

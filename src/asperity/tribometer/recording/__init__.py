"""Recordings of a rig: written block by block so that nothing is lost, read with what is missing.

A recording is netCDF-4. ``raw(sample, channel)`` holds counts; ``offset + scale * raw`` is what the
oscilloscope saw, in ``units``, of ``signal``. Counts say by themselves where there is no value:
`MISSING`, a gap, and `BEYOND` on either side, past the range of the channel.
"""

from asperity.tribometer.recording.hdf5 import Source
from asperity.tribometer.recording.recorder import Recorder
from asperity.tribometer.recording.recording import Event, Gap, Recording

__all__ = ["Event", "Gap", "Recorder", "Recording", "Source"]

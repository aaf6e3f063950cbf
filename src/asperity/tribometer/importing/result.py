"""The answer of ``asperity rig import``."""

import contextlib
import datetime
import os
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from asperity.results import Result, quantity
from asperity.results.table import Table, table_of, table_of_rows
from asperity.tribometer.importing.columns import Sampled
from asperity.tribometer.recording import Event, Recorder
from asperity.tribometer.recording.blocks import blocks_beside

_BLOCK = 1 << 16


@contextlib.contextmanager
def _left_out(path: Path) -> Iterator[None]:
    """Leave no blocks of a recording that could not be written: its file is there still."""
    try:
        yield
    except BaseException:
        blocks_beside(path).unlink(missing_ok=True)
        raise


class Imported(Result):
    """A recording out of a file, to be saved as one.

    Attributes
    ----------
    sampled : Sampled
        Its counts.
    began : datetime
        When it began.
    configuration : str
        Of the rig, as JSON.
    events : tuple of Event
        What is set.
    findings : tuple of dict
        What is wrong with what was heard.
    """

    title = "Recording imported"
    stem = "import"

    sampled: Sampled
    began: datetime.datetime
    configuration: str
    events: tuple[Event, ...]
    simulated: bool = False
    findings: tuple[dict[str, Any], ...] = ()
    source: str = quantity("", "", "file")
    form: str = quantity("", "", "format", key="format")
    samples: int = quantity("", "", "samples of each channel")
    sample_interval: float = quantity("dt", "s", "time between samples")
    duration: float = quantity("t", "s", "duration")
    missing: int = quantity("", "", "samples missing, of all channels", default=0)
    beyond: int = quantity("", "", "samples past a range, of all channels", default=0)

    def to_json(self) -> dict[str, Any]:
        """Return what was found, with the channels."""
        channels = [
            {"signal": one.signal, "units": one.units, "scale": one.scale}
            for one in self.sampled.sources
        ]
        told = {
            "start": self.began.isoformat(timespec="seconds"), "channels": channels,
            "findings": list(self.findings),
        }  # fmt: skip
        return super().to_json() | told

    def tables(self) -> tuple[Table, ...]:
        """Return what was found, and a row a channel."""
        columns = {"signal": "signal", "unit": "units", "a count is worth": "scale"}
        told = [
            one["flag"] if one["start_s"] is None else f"at {one['start_s']:.0f} s: {one['flag']}"
            for one in self.findings
        ]
        listed = table_of_rows(self.sampled.sources, columns, remarks=(*self.notes, *told))
        return table_of(self), listed

    def save(self, path: str | os.PathLike[str]) -> Path:
        """Write the recording, whole or not at all."""
        from asperity.files.store import write_atomically

        return write_atomically(path, self._record)

    def _record(self, path: Path) -> None:
        one = self.sampled
        made = Recorder(
            path, one.sources, one.interval, configuration=self.configuration, block=_BLOCK,
            simulated=self.simulated, start=self.began,
        )  # fmt: skip
        with _left_out(path), made:
            for event in self.events:
                made.event(event.time, event.kind, event.text)
            for first in range(0, len(one.counts), _BLOCK):
                part = one.counts[first : first + _BLOCK]
                made.append(part, (first + len(part)) * one.interval)
            made.close(compress=False)

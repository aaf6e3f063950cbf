"""What an imported recording says of its own sensors, before it is written."""

import contextlib
import dataclasses
import datetime
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from asperity.casefile import Case
from asperity.errors import InputError
from asperity.tribometer.importing.columns import Sampled
from asperity.tribometer.recording import Event, Recording
from asperity.tribometer.recording.hdf5 import Counts
from asperity.tribometer.reduction.study import Reducible, heard_in


@dataclasses.dataclass(frozen=True)
class _Held(Recording):
    """A recording that is in memory, and in no file yet."""

    counts: Counts = dataclasses.field(default_factory=lambda: np.zeros((0, 0), np.int16))

    @contextlib.contextmanager
    def _counts(self) -> Iterator[Any]:
        yield self.counts


# Bytes that were changed may be scales that no sensor has.
@np.errstate(all="ignore")
def findings(
    found: Sampled, events: Sequence[Event], case: Case, name: str, began: datetime.datetime
) -> tuple[dict[str, Any], ...]:
    """Return what is wrong with what was heard; nothing where it cannot be reduced at all."""
    rows, _ = found.counts.shape
    held = _Held(
        Path(name), found.sources, rows, found.interval, began, {},
        tuple(events), (), simulated=False, counts=found.counts,
    )  # fmt: skip
    try:
        segments, heard = heard_in(Reducible(held, case))
    except InputError:
        return ()
    return heard.told(segments)

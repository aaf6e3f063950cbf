"""The command ``asperity rig import``: what a laboratory's program wrote, to a recording."""

import contextlib
import dataclasses
import datetime
import json
import os
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from asperity.casefile import Case
from asperity.errors import InputError, plain
from asperity.runs import Run
from asperity.tribometer.channels import Channels
from asperity.tribometer.importing.columns import Sampled, sampled
from asperity.tribometer.importing.files import OWN, declaration_of, form_of, read_joined
from asperity.tribometer.importing.heads import Declaration
from asperity.tribometer.importing.result import Imported
from asperity.tribometer.pairs import pair_of
from asperity.tribometer.recording import Event, Recording
from asperity.tribometer.recording.hdf5 import Counts
from asperity.tribometer.recording.layout import BEYOND, MISSING
from asperity.tribometer.reduction.study import Reducible, heard_in
from asperity.tribometer.tables import tables_of

_UNDATED = (
    "the file tells no date: its recording is dated by this import; say when it began by --start"
)


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
    sampled: Sampled, events: Sequence[Event], case: Case, name: str, began: datetime.datetime
) -> tuple[dict[str, Any], ...]:
    """Return what is wrong with what was heard; nothing where it cannot be reduced at all."""
    rows, _ = sampled.counts.shape
    held = _Held(
        Path(name), sampled.sources, rows, sampled.interval, began, {},
        tuple(events), (), simulated=False, counts=sampled.counts,
    )  # fmt: skip
    try:
        segments, heard = heard_in(Reducible(held, case))
    except InputError:
        return ()
    return heard.rows(segments)


@dataclasses.dataclass(frozen=True)
class Importable:
    """A file, or those of one recording, their format, and the configuration they are read by."""

    files: tuple[str, ...]
    name: str
    form: str
    case: Case
    declaration: Declaration


def prepare(
    case: Case, *, file: str, join: Sequence[str] | None = None, rate: str = "",
    columns: str = "", units: str = "", start: str = "",
) -> Importable:  # fmt: skip
    """Look at a file's first bytes; refuses one that cannot be read, or a configuration."""
    pair_of(case)
    case.require(Channels)
    declaration = declaration_of(rate, columns, units, start)
    files = (file, *(join or ()))
    names = [plain(one) for one in files]
    if len(set(map(os.path.realpath, files))) < len(files):
        raise InputError(f"{names[0]}: a file is given twice")
    forms = [form_of(Path(one), name) for one, name in zip(files, names, strict=True)]
    if OWN in forms and (len(files) > 1 or declaration != Declaration()):
        raise InputError(
            f"{names[forms.index(OWN)]} is a recording; it is imported alone, without --join, "
            "--rate, --columns, --units or --start"
        )
    return Importable(files, names[0], forms[0], case, declaration)


def answer(problem: Importable, run: Run) -> Imported:
    """Read the file."""
    case, simulated = problem.case, False
    told: tuple[Event, ...] = ()
    form = problem.form
    undated: tuple[str, ...] = ()
    if form == OWN:
        found, told, simulated, began = _own(problem)
    else:
        columns = read_joined(problem.files, problem.declaration)
        began = datetime.datetime.now(datetime.UTC)
        if columns.began is not None:
            began = columns.began[0]
        else:
            undated = (_UNDATED,)
        form = columns.program or form
        found = sampled(columns, case.require(Channels), problem.name)
    drives = pair_of(case).drives
    set_values = (
        Event(0.0, "steel_supply", f"{drives.steel_supply:g} V"),
        Event(0.0, "bronze_supply", f"{drives.bronze_supply:g} V"),
    )
    raw = {
        name: entries
        for name, entries in case.raw.items()
        if name in {*tables_of(case.raw), "friction"}
    }
    rows, _ = found.counts.shape
    events = tuple(told) or set_values
    return Imported(
        sampled=found, began=began, configuration=json.dumps(raw, default=str), events=events,
        simulated=simulated, findings=findings(found, events, case, problem.name, began),
        source=" and ".join(plain(Path(one).name) for one in problem.files), form=form,
        samples=rows, sample_interval=found.interval,
        duration=rows * found.interval, missing=int(np.count_nonzero(found.counts == MISSING)),
        beyond=int(
            np.count_nonzero(found.counts == BEYOND) + np.count_nonzero(found.counts == -BEYOND)
        ),
        notes=(*found.notes, *undated),
    )  # fmt: skip


def _own(problem: Importable) -> tuple[Sampled, tuple[Event, ...], bool, datetime.datetime]:
    """Read a recording again, under another configuration."""
    recording = Recording.open(Path(problem.files[0]))
    parts = [counts for _, counts in recording.stretches()]
    if not parts:
        raise InputError(f"{problem.name} holds no samples")
    notes = tuple(f"at {gap.time:.3g} s: {gap.reason}" for gap in recording.gaps)
    found = Sampled(recording.sources, np.concatenate(parts), recording.sample_interval, notes)
    return found, recording.events, recording.simulated, recording.start

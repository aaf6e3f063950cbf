"""The command ``asperity rig import``: a file of an oscilloscope program to a recording."""

import dataclasses
import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from asperity import store
from asperity.casefile import Case
from asperity.errors import InputError, plain
from asperity.runs import Run
from asperity.tribometer.channels import Channels
from asperity.tribometer.importing.columns import Columns, Sampled, sampled
from asperity.tribometer.importing.mat import read_mat
from asperity.tribometer.importing.result import Imported
from asperity.tribometer.importing.tdms import read_tdms
from asperity.tribometer.importing.text import read_text
from asperity.tribometer.pair import Pair
from asperity.tribometer.recording import Event, Recording
from asperity.tribometer.recording.layout import BEYOND, MISSING
from asperity.tribometer.tables import TABLES

_TEXT, _MAT, _TDMS, _OWN = "text", "mat", "TDMS", "recording"
_READERS: Mapping[str, Any] = {_TEXT: read_text, _MAT: read_mat, _TDMS: read_tdms}
_HDF5 = b"\x89HDF\r\n\x1a\n"


@dataclasses.dataclass(frozen=True)
class Importable:
    """A file, its format, and the configuration it is read by."""

    path: Path
    name: str
    form: str
    case: Case


def prepare(case: Case, *, file: str) -> Importable:
    """Look at a file's first bytes; refuses one that cannot be read, or a configuration."""
    Pair.from_case(case)
    case.require(Channels)
    name = plain(file)
    path = Path(file)
    store.keep_input(path)
    try:
        if not path.is_file():
            reason = "it is a folder; give a file" if path.is_dir() else "no such file"
            if path.exists() and not path.is_dir():
                reason = "it is no regular file; save what it holds to a file"
            raise InputError(f"{name} cannot be read: {reason}")
        with path.open("rb") as opened:
            head = opened.read(128)
    except OSError as error:
        raise InputError(f"{name} cannot be read: {store.reason(error)}") from None
    return Importable(path, name, _form(path, head), case)


def _form(path: Path, head: bytes) -> str:
    if head.startswith(b"TDSm"):
        return _TDMS
    if head.startswith(_HDF5):
        return _MAT if path.suffix.lower() == ".mat" else _OWN
    if head.startswith(b"MATLAB") or path.suffix.lower() == ".mat":
        return _MAT
    return _TEXT


def read_export(path: Path, name: str) -> Columns:
    """Read what an oscilloscope's program wrote; refuses what is no such file.

    Parameters
    ----------
    path : Path
        The file.
    name : str
        What messages call it.
    """
    with path.open("rb") as opened:
        form = _form(path, opened.read(128))
    if form == _OWN:
        raise InputError(f"{name} is HDF5 of no known kind; export it as .csv, .mat or .tdms")
    columns: Columns = _READERS[form](path, name)
    return columns


def answer(problem: Importable, run: Run) -> Imported:
    """Read the file."""
    case, simulated = problem.case, False
    told: tuple[Event, ...] = ()
    if problem.form == _OWN:
        found, told, simulated = _own(problem)
    else:
        columns = _READERS[problem.form](problem.path, problem.name)
        found = sampled(columns, case.require(Channels), problem.name)
    drives = Pair.from_case(case).drives
    set_values = (
        Event(0.0, "steel_supply", f"{drives.steel_supply:g} V"),
        Event(0.0, "bronze_supply", f"{drives.bronze_supply:g} V"),
    )
    raw = {name: entries for name, entries in case.raw.items() if name in (*TABLES, "friction")}
    rows, _ = found.counts.shape
    return Imported(
        sampled=found, configuration=json.dumps(raw, default=str),
        events=tuple(told) or set_values, simulated=simulated, source=plain(problem.path.name),
        form=problem.form, samples=rows, sample_interval=found.interval,
        duration=rows * found.interval, missing=int(np.count_nonzero(found.counts == MISSING)),
        beyond=int(
            np.count_nonzero(found.counts == BEYOND) + np.count_nonzero(found.counts == -BEYOND)
        ),
        notes=found.notes,
    )  # fmt: skip


def _own(problem: Importable) -> tuple[Sampled, tuple[Event, ...], bool]:
    """Read a recording again, under another configuration."""
    recording = Recording.open(problem.path)
    parts = [counts for _, counts in recording.stretches()]
    if not parts:
        raise InputError(f"{problem.name} holds no samples")
    notes = tuple(f"at {gap.time:.3g} s: {gap.reason}" for gap in recording.gaps)
    found = Sampled(recording.sources, np.concatenate(parts), recording.sample_interval, notes)
    return found, recording.events, recording.simulated

"""What a run shows of itself while it goes on: a small file beside its journal.

It is put in place of the one before by its name, so that whoever reads it reads a whole one; that
is quick and no more: of a look nothing is lost with the power. What was read back to be off stands
in the journal, which the guardian writes whether the procedure goes on or not.
"""

import contextlib
import datetime
import json
import math
import os
import time
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

from asperity.files.leftovers import temporary_beside
from asperity.files.store import read_bytes
from asperity.tribometer.guardian.stop import press
from asperity.tribometer.journal_lines import ENDED, NAME, Line, last_lines
from asperity.tribometer.signals import SIGNALS

PREVIEW = ".preview.json"
_EVERY = 0.25  # s between two of them
_STRETCH = 0.5  # s whose mean is a point
_POINTS = 120
_SHOWN = tuple(
    f"{what}_{disc}" for what in ("torque", "speed", "current") for disc in ("steel", "bronze")
)
_MOST_BYTES = 1_000_000

Levels = Mapping[str, float]


class Preview:
    """Written a few times a second while a run goes on.

    Parameters
    ----------
    folder : Path
        Of the run.
    units : mapping of str to str
        Of the signals that are shown, in their order.
    simulated : bool
        Whether what is shown comes from no rig.
    now : callable
        The computer's clock, s.
    """

    def __init__(
        self,
        folder: Path,
        units: Mapping[str, str],
        *,
        simulated: bool,
        now: Callable[[], float] = time.monotonic,
    ) -> None:
        self._path = folder / PREVIEW
        self._units = units
        self._now = now
        self._due = -math.inf
        self._told: dict[str, Any] = {"simulated": simulated, "state": "runs"}
        self._outputs: dict[str, str] = {}
        self._times: list[float] = []
        self._points: dict[str, list[float]] = {name: [] for name in units}
        self._sums, self._weight = dict.fromkeys(units, 0.0), 0.0
        self._begun: float | None = None

    def step(self, text: str, following: str, done: int, cells: int, *, asks: bool) -> None:
        """Say what is done now, by a person or not, what next, and how many cells are done."""
        self._told |= {
            "step": text, "next": following, "done": done, "cells": cells, "asks": asks,
        }  # fmt: skip
        self.write()

    def show_outputs(self, outputs: Mapping[str, str]) -> None:
        """Say what outputs were told to do; of others it is as it was."""
        now = self._outputs | dict(outputs)
        if self._outputs != now:
            self._outputs = now
            self.write()

    def levels(self, clock: float, lasting: float, levels: Levels) -> None:
        """Take means of signals in SI over a time that has just passed, by the rig's clock, s."""
        for name in self._units:
            self._sums[name] += lasting * levels[name]
        self._weight += lasting
        if self._begun is None:
            self._begun = clock - lasting
        if self._weight >= _STRETCH * (1.0 - 1e-6):
            self._times = [*self._times, round(clock - self._begun, 3)][-_POINTS:]
            for name, points in self._points.items():
                mean = float(f"{self._sums[name] / self._weight:.5g}")
                self._points[name] = [*points, mean][-_POINTS:]
            self._sums, self._weight = dict.fromkeys(self._units, 0.0), 0.0

    def beat(self) -> None:
        """Show that the run goes on, whether samples have come or not."""
        if self._now() >= self._due:
            self.write()

    def end(self, state: str) -> None:
        """Say how the run has ended, everything told to be off."""
        self._outputs = dict.fromkeys(self._outputs, "off")
        self._told |= {"state": state, "step": "", "next": ""}
        self.write()

    def write(self) -> None:
        """Write it; a disk that takes none costs the look and no more."""
        self._due = self._now() + _EVERY
        signals = [
            {"name": name, "unit": unit, "values": self._points[name]}
            for name, unit in self._units.items()
        ]
        told = self._told | {
            "written": datetime.datetime.now(datetime.UTC).isoformat(timespec="milliseconds"),
            "outputs": [{"output": key, "told": said} for key, said in self._outputs.items()],
            "time": self._times,
            "signals": signals,
        }
        temporary = temporary_beside(self._path)
        try:
            temporary.write_text(json.dumps(told, allow_nan=False), "utf-8")
            os.replace(temporary, self._path)
        except (OSError, ValueError):
            with contextlib.suppress(OSError):
                temporary.unlink()


def units_of(signals: Sequence[str]) -> dict[str, str]:
    """Return which of some signals are shown, with their units."""
    return {name: SIGNALS[name].unit for name in _SHOWN if name in signals}


def look(folder: Path) -> dict[str, Any] | None:
    """Return what there is to be seen of a run; None where a folder holds none.

    Beside the preview that is its age in s, the journal's last word on what was read back to be
    off (``off``), and how it ended, if it has (``ended``).
    """
    path = folder / PREVIEW
    try:
        if path.is_symlink():
            return None
        age = time.time() - path.stat().st_mtime
        told = json.loads(read_bytes(path, _MOST_BYTES))
        if not isinstance(told, dict):
            return None
        # What is no number there would be none on a page.
        json.dumps(told, allow_nan=False)
    except (OSError, ValueError, RecursionError):
        return None
    lines = last_lines(folder / NAME)
    return told | {"age": max(0.0, round(age, 3)), **_ended(lines)}


def stop(folder: Path) -> bool:
    """Have the run in a folder switched off by its guardian; False where a folder holds none.

    Raises
    ------
    OSError
        The folder cannot be written to.
    """
    if look(folder) is None:
        return False
    press(folder)
    return True


def _ended(lines: Sequence[Line]) -> dict[str, Any]:
    """Return what the last lines of a journal say of outputs and of an end."""
    off, ended = None, None
    for line in lines:
        if line["kind"] == "off":
            off = line
        elif line["kind"] in ENDED:
            ended = line
        elif line["kind"] != "torn":
            # It has gone on since, and switched on what was off.
            ended, off = None, None
    told = "why", "took_s", "read_back", "not_yet_heard", "still_on", "by_hand"
    shown = {
        "off": off and {key: off.get(key) for key in told},
        "ended": ended and {key: ended.get(key) for key in ("kind", "reason")},
    }
    return shown


def runs(folder: Path, most: int = 200) -> list[dict[str, Any]]:
    """Return what there is to be seen of the runs in a folder and two folders below it.

    Parameters
    ----------
    folder : Path
        Where they are looked for.
    most : int
        Of how many folders, the latest first.

    Returns
    -------
    list of dict
        As :func:`look` tells of each, with its ``name``: its path in the folder.
    """
    found = []
    for pattern in (PREVIEW, f"*/{PREVIEW}", f"*/*/{PREVIEW}"):
        for path in folder.glob(pattern):
            with contextlib.suppress(OSError):
                inside = not any(one.is_symlink() for one in (path, *_between(path, folder)))
                if inside:
                    found.append((path.stat().st_mtime, path.parent))
    found.sort(reverse=True)
    told = ((where, look(where)) for _, where in found[:most])
    return [one | {"name": where.relative_to(folder).as_posix()} for where, one in told if one]


def _between(path: Path, folder: Path) -> list[Path]:
    return [one for one in path.parents if one.is_relative_to(folder) and one != folder]

"""Weighings that a run's journal tells, with the recordings that lie between two of them."""

import dataclasses
import math
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from asperity.errors import AsperityError
from asperity.files import store
from asperity.tribometer.journal_lines import NAME, Line, lines_of

DISCS = "steel", "bronze"
_WEIGHED, _AGAIN = 2, 26  # steps of the procedure
_SIMULATED = "sim", "replay"


@dataclasses.dataclass(frozen=True)
class Weighing:
    """What a pair of discs lost over its recordings.

    Attributes
    ----------
    setting : str
        As the journal names it.
    losses : mapping of str to float
        Of each disc, kg.
    files : tuple of str
        The recordings, in their order.
    """

    setting: str
    losses: Mapping[str, float]
    files: tuple[str, ...]


def weighings_in(folders: Sequence[Path]) -> tuple[list[tuple[Path, Weighing]], list[str]]:
    """Return what the journals of folders tell, and why one of them tells nothing."""
    found: list[tuple[Path, Weighing]] = []
    why = []
    for folder in dict.fromkeys(folders):
        path = folder / NAME
        if not path.is_file():
            continue
        try:
            text = store.read_bytes(path)
            lines = lines_of(text[: text.rfind(b"\n") + 1], path)
        except AsperityError as error:
            why.append(f"its weighings are left out: {error}")
            continue
        found += [(folder, one) for one in _between(lines)]
    return found, why


def _between(lines: Sequence[Line]) -> Iterator[Weighing]:
    if any(line.get("backend") in _SIMULATED for line in lines):
        return  # nothing wears there
    before: Line | None = None
    files: dict[str, None] = {}
    for line in lines:
        if line.get("kind") != "done":
            continue
        steps = line.get("steps")
        if steps == [_WEIGHED]:
            before, files = line, {}
        elif isinstance(line.get("recording"), str):
            files[line["recording"]] = None
        elif steps == [_AGAIN] and before is not None:
            losses = dict(_losses(before, line))
            if losses and files:
                setting = str(line.get("action", "")).partition("/")[0]
                yield Weighing(setting, losses, tuple(files))
            before = None


def _losses(before: Line, after: Line) -> Iterator[tuple[str, float]]:
    for disc in DISCS:
        first, last = (_mass(one.get(f"{disc}_kg")) for one in (before, after))
        if first is not None and last is not None and math.isfinite(first - last):
            yield disc, first - last


def _mass(value: Any) -> float | None:
    number = isinstance(value, int | float) and not isinstance(value, bool)
    return float(value) if number and math.isfinite(value) else None

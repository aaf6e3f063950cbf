"""Wear of a recording: how far the discs slid, on what path, and what they lost."""

import dataclasses
import math
import re
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from asperity.errors import AsperityError
from asperity.files import store
from asperity.tribometer.journal_lines import NAME, Line, lines_of
from asperity.tribometer.pair import Pair
from asperity.tribometer.parameters import LONGITUDINAL, Disc
from asperity.tribometer.recording import Event
from asperity.tribometer.reduction.result import FileResult
from asperity.units import to_si


@dataclasses.dataclass(frozen=True)
class Weighing:
    """What a pair of discs lost over its recordings.

    Attributes
    ----------
    setting : str
        As the journal names it.
    masses : mapping of str to tuple of float
        Of each disc before and behind, kg.
    files : tuple of str
        The recordings, in their order.
    """

    setting: str
    masses: Mapping[str, tuple[float, float]]
    files: tuple[str, ...]

    @property
    def losses(self) -> dict[str, float]:
        """What each disc lost, kg."""
        return {disc: first - last for disc, (first, last) in self.masses.items()}


def path_share(velocity_ratio: float, mode: str) -> float:
    """Return the path of a vibrating contact over the distance slid.

    Along the sliding it is 1 up to k = 1, where the base never outruns the body: Archard's wear
    on the path does not rise by such a vibration.

    Examples
    --------
    >>> path_share(0.97, "longitudinal")
    1.0
    >>> round(path_share(2.0, "longitudinal"), 3)
    1.436
    """
    k = velocity_ratio
    if mode == LONGITUDINAL:
        if k <= 1.0:
            return 1.0
        return 2.0 / math.pi * (math.asin(1.0 / k) + math.sqrt(k * k - 1.0))
    from scipy.special import ellipe

    return float(2.0 / math.pi * np.hypot(1.0, k) * ellipe(k * k / (1.0 + k * k)))


def path_change(velocity_ratio: float, mode: str, doubt: float) -> float:
    """Return by what `path_share` changes where k is off by a share of itself, about."""
    ends = (path_share(velocity_ratio * (1.0 + side * doubt), mode) for side in (1.0, -1.0))
    above, below = ends
    return 0.5 * (above - below)


def mass_loss(events: Sequence[Event], disc: str) -> float | None:
    """Return what a disc lost between its first and its last weighing, kg; None without two.

    Parameters
    ----------
    events : sequence of Event
        Of kind ``mass_steel`` and ``mass_bronze``, their text a mass such as ``182.3140 g``.
    disc : {'steel', 'bronze'}
        Which one.
    """
    weighed = []
    for event in events:
        if event.kind == f"mass_{disc}" and re.match(r"\s*[0-9.]", event.text):
            try:
                weighed.append(to_si(event.text, "kg"))
            except ValueError:
                continue
    return weighed[0] - weighed[-1] if len(weighed) > 1 else None


def between_weighings(pair: Pair, files: Sequence[FileResult]) -> Iterator[dict[str, Any]]:
    """Yield wear of each disc whose loss over all recordings the configuration tells."""
    for name, disc in (("steel", pair.steel), ("bronze", pair.bronze)):
        if disc.mass_loss is not None:
            yield _worn(pair, name, disc.mass_loss, files)


def of_journals(
    opened: Sequence[Path], files: Sequence[FileResult], notes: list[str]
) -> Iterator[tuple[Weighing, list[FileResult]]]:
    """Yield the weighings of runs whose recordings are all here, with what lies between them.

    Parameters
    ----------
    opened : sequence of Path
        Where each recording lies.
    files : sequence of FileResult
        What each says, in the same order.
    notes : list of str
        Takes why a weighing is left out.
    """
    here = {path.resolve(): one for path, one in zip(opened, files, strict=True)}
    found, why = weighings_in([path.parent for path in here])
    notes += why
    for folder, weighing in found:
        places = [folder / name for name in weighing.files]
        if missing := [place.name for place in places if place not in here]:
            notes.append(
                f"the weighings of {weighing.setting} are left out: {', '.join(missing)} lies "
                "between them as well, and is not among the recordings"
            )
            continue
        yield weighing, [here[place] for place in places]


def of_weighing(
    pair: Pair, weighing: Weighing, files: Sequence[FileResult]
) -> Iterator[dict[str, Any]]:
    """Yield wear of each disc between two weighings."""
    for disc, loss in weighing.losses.items():
        worn = _worn(pair, disc, loss, files)
        yield worn | {"setting": weighing.setting, "files": list(weighing.files)}


def _worn(pair: Pair, name: str, loss: float, files: Sequence[FileResult]) -> dict[str, Any]:
    disc: Disc = pair.steel if name == "steel" else pair.bronze
    distance = sum(one.distance for one in files)
    path = path_of(files)
    return {
        "disc": name, "mass_loss_mg": 1e6 * loss, "distance_m": distance, "path_m": path,
        "archard": archard(loss, disc, pair.load, path),
    }  # fmt: skip


def path_of(files: Sequence[FileResult]) -> float | None:
    """Return the path of discs over recordings, m; None where that of one is not known."""
    paths = [one.path for one in files]
    known = [path for path in paths if path is not None]
    return sum(known) if len(known) == len(paths) else None


def archard(loss: float | None, disc: Disc, load: float, path: float | None) -> float | None:
    """Return Archard's coefficient of a mass loss in kg; None where something is not known."""
    if loss is None or disc.density is None or disc.hardness is None or not path or path <= 0.0:
        return None
    return loss / disc.density * disc.hardness / (load * path)


DISCS = "steel", "bronze"
_WEIGHED, _AGAIN = 2, 26  # steps of the procedure


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
    simulated = any(line.get("backend") == "sim" for line in lines)
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
            masses = dict(_masses(before, line))
            # Simulated discs that wear not at all were not weighed, whatever the journal says.
            if masses and files and not (simulated and _all_as_before(masses)):
                setting = str(line.get("action", "")).partition("/")[0]
                yield Weighing(setting, masses, tuple(files))
            # In a wear test the discs go on with the weight they have now.
            before, files = line, {}


def _all_as_before(masses: Mapping[str, tuple[float, float]]) -> bool:
    return all(first == last for first, last in masses.values())


def _masses(before: Line, after: Line) -> Iterator[tuple[str, tuple[float, float]]]:
    for disc in DISCS:
        first, last = (_mass(one.get(f"{disc}_kg")) for one in (before, after))
        if first is not None and last is not None and math.isfinite(first - last):
            yield disc, (first, last)


def _mass(value: Any) -> float | None:
    number = isinstance(value, int | float) and not isinstance(value, bool)
    return float(value) if number and math.isfinite(value) else None

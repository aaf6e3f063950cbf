"""All that is reproduced, chapter by chapter, and the module that makes each of it."""

import functools
from collections.abc import Callable, Collection, Mapping, Sequence
from typing import Any

from asperity.errors import InputError, suggestion
from asperity.thesis.contact import elastic
from asperity.thesis.contact.elastic import LONGITUDINAL, TRANSVERSE
from asperity.thesis.drive import simulations
from asperity.thesis.exhibits import CLAIM, FIGURE, TABLE, Exhibit, Part
from asperity.thesis.said import chapters

CHAPTERS = chapters()
"""Those of which something is reproduced."""

_MADE_IN = {
    FIGURE: {
        "sliding.figures": "2.7 2.14 2.15 2.16 4.3 4.4 4.17 4.18 4.19 4.20 4.21 4.22 4.23",
        "sliding.schemes": "4.9 4.10 4.11 4.13 4.14 4.15",
        "rating.figures": "3.1 3.2 3.3 3.4 3.5",
        "flanks.figures": "2.9 2.10 2.11 2.12 2.13",
        "flanks.solids": "7.1 7.2 7.3 7.4 7.11",
        "contact.figures": "5.2 5.3 5.5 5.6 5.7 5.8 5.9 5.10 5.11 7.8 7.9",
        "rig.figures": "6.8 6.9 6.24",
        "drive.models": "7.5 7.6 7.7",
        "drive.figures": "7.10 7.12 7.13 7.14 7.15",
    },
    TABLE: {
        "sliding.tables": "4.1 4.2 4.3 4.4",
        "rating.tables": "3.2 3.3 3.4 3.5 3.6 3.7",
        "rig.tables": "6.1 6.3 6.8 6.10",
        "drive.tables": "7.1 7.2 7.3 7.4",
    },
    CLAIM: {
        "sliding.claims": "4.1 4.2 4.3 4.4 4.5 4.6 4.8",
        "sliding.appendix_a": "4.7",
        "sliding.readings": "2.4 2.5 4.9 4.10 4.11 4.12 5.2",
        "sliding.further": "4.13 4.14 7.20",
        "rating.claims": "3.1 3.2 3.3 3.4 3.5 3.6 3.7 3.8 7.1",
        "rating.words": "1.1 2.6 3.9 3.10 3.11 3.12 3.13 3.14 7.9",
        "rating.standards": "2.8 2.9 2.11 3.15 3.16 3.17 3.18",
        "flanks.claims": "2.1 2.2 2.3",
        "flanks.loaded": "2.7 2.10 7.21",
        "contact.claims": "5.1 5.3 5.4 7.8",
        "contact.derivatives": "7.14",
        "rig.claims": "6.1 6.2 6.3 6.4 6.5 6.6 6.7",
        "rig.readings": "6.8 6.9 6.10 6.11 6.12 6.13 6.14 6.15",
        "rig.numbers": "6.16 6.17 6.18 6.19 6.20 6.21",
        "drive.claims": "7.4 7.11 7.12 7.13 7.16 7.18",
        "drive.laws": "7.6",
        "drive.claims_shaken": "7.2 7.3 7.5 7.7 7.10 7.15 7.17",
        "drive.conclusions": "7.19 7.22 7.23 8.1 8.2",
    },
}

_WITHOUT_KERNELS = {
    FIGURE: "2.7 3.1 3.2 3.3 3.4 3.5 4.11 4.14 4.15 6.8 6.9 7.7",
    TABLE: "3.2 3.3 3.4 3.5 3.6 3.7 4.2 6.1 6.3 6.8 6.10 7.1 7.2 7.3",
    CLAIM: "1.1 2.5 2.6 2.8 2.11 3.1 3.2 3.3 3.4 3.5 3.6 3.7 3.8 3.9 3.10 3.11 3.12 3.13 3.14 "
    "3.15 3.16 3.17 3.18 4.13 5.3 6.1 6.5 "
    "6.7 6.8 6.9 6.10 6.11 6.13 6.14 6.15 6.16 6.17 6.18 6.19 6.20 6.21 7.1 7.4 7.9 7.12 7.14 "
    "7.18 7.19 7.22 8.1",
}
"""Those that call no compiled function: they are there while others wait for theirs."""

_SECONDS = {
    "figure 2.9": 3.0, "figure 2.10": 2.0, "figure 2.11": 2.0, "figure 2.12": 2.0,
    "figure 4.20": 2.0, "figure 4.23": 2.0, "figure 5.2": 1.5, "figure 5.11": 1.5,
    "figure 7.1": 2.5, "figure 7.2": 2.0, "figure 7.6": 2.0, "figure 7.11": 2.5,
    "claim 2.2": 2.0, "claim 2.3": 2.0, "claim 2.7": 2.0, "claim 4.3": 2.5, "claim 7.16": 1.5,
}  # fmt: skip
"""About how long those take that take long, s."""

_BODIES = (*(f"table-4.1-L{n}" for n in range(1, 7)), "table-4.3", "table-4.4")
_CASES = {
    "sliding": _BODIES,
    "rating": ("gearset-2", "gearset-3"),
    "flanks": ("gearset-3b",),
    "contact": ("table-4.3", "table-4.4", LONGITUDINAL, TRANSVERSE),
    "rig": ("rig-final", "rig-preliminary"),
    "drive": ("gearset-2", "gearset-3", "gearset-3b", "drive-thesis", "drive-actuator"),
}

_over_ratio, _from_rest = elastic.over_ratio, elastic.from_rest
_PARTS: dict[str, Callable[[bool], Sequence[Part]]] = {
    "figure 5.5": functools.partial(_over_ratio, LONGITUDINAL),
    "figure 5.6": functools.partial(_from_rest, LONGITUDINAL),
    "figure 5.7": functools.partial(_from_rest, LONGITUDINAL),
    "figure 5.8": functools.partial(_over_ratio, TRANSVERSE),
    "figure 5.9": functools.partial(_from_rest, TRANSVERSE),
    "figure 5.10": functools.partial(_from_rest, TRANSVERSE),
    "figure 5.11": elastic.over_direction,
    "figure 7.8": functools.partial(_over_ratio, TRANSVERSE, on_body=True),
    "figure 7.9": functools.partial(_over_ratio, LONGITUDINAL, on_body=True),
    "claim 5.1": elastic.equal_ratios,
    "claim 5.4": functools.partial(_over_ratio, LONGITUDINAL),
    "claim 7.8": elastic.base_or_body,
    **simulations.PARTS,
}


def _order(number: str) -> tuple[int, ...]:
    return tuple(int(part) for part in number.split("."))


def _shelf(kind: str) -> Mapping[str, Exhibit]:
    found = {}
    without = _WITHOUT_KERNELS[kind].split()
    for module, numbers in _MADE_IN[kind].items():
        cases = _CASES[module.partition(".")[0]]
        for number in numbers.split():
            name = f"{kind} {number}"
            given: dict[str, Any] = {"parts": _PARTS[name]} if name in _PARTS else {}
            if name in _SECONDS:
                given["seconds"] = _SECONDS[name]
            given["calls_kernels"] = number not in without
            place = f"asperity.thesis.{module}"
            found[number] = Exhibit(kind, number, place, cases, **given)
    return {number: found[number] for number in sorted(found, key=_order)}


CLAIMS, FIGURES, TABLES = (_shelf(kind) for kind in (CLAIM, FIGURE, TABLE))


def chapter_of(number: str) -> str:
    """Return the chapter of a claim, figure or table.

    Examples
    --------
    >>> chapter_of("4.17")
    '4'
    """
    return number.partition(".")[0]


def everything() -> list[Exhibit]:
    """Return all that is reproduced, in the order of the page."""
    return [
        exhibit
        for chapter in CHAPTERS
        for shelf in (CLAIMS, FIGURES, TABLES)
        for number, exhibit in shelf.items()
        if chapter_of(number) == chapter.number
    ]


def select(only: Sequence[str]) -> list[Exhibit]:
    """Return exhibits by number, name (``figure 4.17``) or chapter (``7``); all for none.

    Raises
    ------
    InputError
        There is nothing of such a number.
    """
    every = everything()
    known = {exhibit.number for exhibit in every} | {exhibit.name for exhibit in every}
    chapters = {chapter_of(exhibit.number) for exhibit in every}
    for asked in only:
        if asked not in known | chapters:
            raise InputError(
                f"{asked!r} is neither a figure nor a table nor a claim that is reproduced"
                f"{suggestion(asked, sorted(known)) or _chapters(chapters)}"
            )
    return [
        exhibit
        for exhibit in every
        if not only or {exhibit.number, exhibit.name, chapter_of(exhibit.number)} & set(only)
    ]


def _chapters(chapters: Collection[str]) -> str:
    """End of a message about a number that is near to none."""
    numbers = sorted(map(int, chapters))
    return f": give one such as 4.17, or a chapter, {numbers[0]} to {numbers[-1]}"

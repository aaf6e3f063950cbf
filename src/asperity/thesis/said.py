"""What the page says: the thesis's claims in its words with their lines, titles and captions.

The words are those of a text that a machine read from the printed thesis; it lost figures, most
tables and some signs. Where our mending of a word matters, it is listed as a slip.
"""

import dataclasses
import functools
import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

_SAID, _EXHIBITS = (Path(__file__).with_name(f"{name}.toml") for name in ("said", "exhibits"))


@dataclasses.dataclass(frozen=True)
class Said:
    """What the ledger holds of a claim beside what is computed.

    Attributes
    ----------
    said : tuple of (int, str)
        Lines of the text, and the thesis's words there.
    fails_by : str
        What the claim could have failed by.
    rests_on : tuple of str
        Names of findings that are told once.
    see : tuple of str
        Figures and tables that show it, and claims that say more: ``figure 4.17``, ``claim 7.4``.
    """

    said: tuple[tuple[int, str], ...] = ()
    fails_by: str = ""
    rests_on: tuple[str, ...] = ()
    see: tuple[str, ...] = ()


@dataclasses.dataclass(frozen=True)
class Chapter:
    """A chapter of the thesis: its number, what it is about here, and what a reader must know."""

    number: str
    title: str
    text: str


@dataclasses.dataclass(frozen=True)
class Shared:
    """A finding that several claims rest on: a title, and what it is."""

    title: str
    text: str


@dataclasses.dataclass(frozen=True)
class Slip:
    """What the machine that read the text most likely got wrong; without a reason, a letter."""

    line: int
    has: str
    should: str
    why: str = ""


@dataclasses.dataclass(frozen=True)
class Lost:
    """What the text has lost, and what stands in its place."""

    what: str
    instead: str


@dataclasses.dataclass(frozen=True)
class Disputed:
    """A verdict of which one may judge otherwise, and why it is what it is."""

    claim: str
    text: str


@functools.cache
def _read() -> Mapping[str, Any]:
    said, exhibits = (tomllib.loads(path.read_text("utf-8")) for path in (_SAID, _EXHIBITS))
    return said | exhibits


def exhibit_entry(name: str) -> Mapping[str, Any]:
    """Return what is listed of an exhibit, by its kind and number: ``figure 4.17``."""
    kind, _, number = name.partition(" ")
    found: Mapping[str, Any] = _read()[kind].get(number, {})
    return found


def words_of(name: str) -> Mapping[str, Any]:
    """Return what the page says beside an exhibit, by its kind and number: ``figure 4.17``.

    Of a figure or table title and caption; of a claim where the thesis makes it, the claim, the
    thesis's own number or word, and what `said_of` has.
    """
    kind, _, number = name.partition(" ")
    found = exhibit_entry(name)
    if kind != "claim":
        return {"title": found.get("title", ""), "caption": found.get("caption", "")}
    claimed = {key: found.get(key, "") for key in ("section", "claim", "thesis")}
    return {"id": number, **claimed, **dataclasses.asdict(said_of(number))}


def said_of(number: str) -> Said:
    """Return what is held of a claim; nothing for one that is not listed."""
    found = exhibit_entry(f"claim {number}")
    words = tuple((int(line), str(text)) for line, text in found.get("said", ()))
    return Said(
        words, found.get("fails_by", ""), tuple(found.get("rests_on", ())),
        tuple(found.get("see", ())),
    )  # fmt: skip


@functools.cache
def chapters() -> tuple[Chapter, ...]:
    """Return the chapters of which something is reproduced."""
    return tuple(Chapter(**one) for one in _read()["chapter"])


def read_by_a_machine() -> str:
    """Return what a reader of the thesis's words must know of their text."""
    return str(_read()["read"])


@functools.cache
def findings() -> Mapping[str, Shared]:
    """Return the findings that several claims rest on, by their names."""
    return {name: Shared(**one) for name, one in _read()["finding"].items()}


@functools.cache
def slips() -> tuple[Slip, ...]:
    """Return the slips of the reading."""
    return tuple(Slip(**one) for one in _read()["slip"])


@functools.cache
def lost() -> tuple[Lost, ...]:
    """Return what is lost, chapter by chapter."""
    return tuple(Lost(**one) for one in _read()["lost"])


@functools.cache
def disputed() -> tuple[Disputed, ...]:
    """Return the verdicts of which one may judge otherwise."""
    return tuple(Disputed(**one) for one in _read()["disputed"])

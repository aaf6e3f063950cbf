"""What a rating says about each number besides its value, from ``data/entries.toml``.

An equation is written in the symbols of the numbers before it, so that what a number rests on can
be read from it: it is trusted no more than the least of those.
"""

import functools
import math
import re
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any, NamedTuple

from asperity import store
from asperity.gearset.library import GIVEN
from asperity.rating.result import Entry
from asperity.sources import Source, weakest

_FILE = Path(__file__).parent / "data" / "entries.toml"
_SYMBOL = re.compile(r"(?<![\w.])[A-Za-z]\w*\*?")


class Fact(NamedTuple):
    """One number of a rating; the fields are those of `asperity.rating.result.Entry`.

    For a given number ``of`` is where it stands in `asperity.rating.inputs.Inputs`, ``path`` the
    key of a case file that decides on it, and ``derived`` its equation where that is left out.
    """

    key: str
    symbol: str
    unit: str
    meaning: str
    equation: str
    source: Source
    of: str
    path: str
    derived: str


@functools.cache
def facts(section: str) -> tuple[Fact, ...]:
    """Return the numbers of a section in their order.

    Parameters
    ----------
    section : {'given', 'iso14521', 'bs721', 'agma6034'}
        What is given, or the results of a standard.
    """
    raw = _read()
    sources = {name: Source(**values) for name, values in raw["source"].items()}
    return tuple(
        Fact(
            key=key,
            symbol=values["symbol"],
            unit=values.get("unit", ""),
            meaning=values["meaning"],
            equation=values.get("equation", "input" if section == "given" else ""),
            source=sources[values.get("from", "definition")],
            of=values.get("of", ""),
            path=values.get("path", values.get("of", "") if "." in values.get("of", "") else ""),
            derived=values.get("derived", ""),
        )
        for key, values in raw[section].items()
    )


def starts_from(section: str) -> tuple[str, ...]:
    """Return the keys of what the calculation of a standard starts from."""
    return tuple(_read()["starts_from"][section])


@functools.cache
def _read() -> dict[str, Any]:
    return store.read_toml(_FILE)


def words(equation: str) -> tuple[str, ...]:
    """Return the words of an equation, the symbols of what it rests on among them."""
    return tuple(dict.fromkeys(_SYMBOL.findall(equation)))


def entries(
    first: Iterable[Entry],
    section: str,
    values: Mapping[str, Any],
    sources: Mapping[str, Source],
    equations: Mapping[str, str],
) -> tuple[Entry, ...]:
    """Return all entries of a rating.

    Parameters
    ----------
    first : iterable of Entry
        What the calculation started from.
    section : {'iso14521', 'bs721', 'agma6034'}
        The standard.
    values : mapping of str to float
        What it found, by key; what is not there, or NaN, is left out.
    sources : mapping of str to Source
        Where the values of tables come from, by key; `GIVEN` for what the user gave in place of a
        result.
    equations : mapping of str to str
        Equations that depend on the case, by key.
    """
    made = list(first)
    # What the user gave, and what is marked as a default, is no reason to trust a result less.
    trusted = {
        entry.symbol: entry.source
        for entry in made
        if not entry.assumed and entry.source is not GIVEN
    }
    for fact in facts(section):
        value = values.get(fact.key, math.nan)
        if isinstance(value, float) and math.isnan(value):
            continue
        equation = equations.get(fact.key, fact.equation)
        rests_on = [trusted[word] for word in words(equation) if word in trusted]
        source = sources.get(fact.key, fact.source)
        if source is not GIVEN:
            source = weakest(source, fact.source, *rests_on)
            trusted[fact.symbol] = source
        made.append(Entry(fact.key, fact.symbol, value, fact.unit, fact.meaning, equation, source))
    return tuple(made)

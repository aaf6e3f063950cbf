"""What a rating starts from, as entries: what the user gave, what follows, what is a default."""

import functools
import math
from collections.abc import Mapping
from typing import Any

from asperity.gearset.library import GIVEN
from asperity.gearset.proportions import SOURCES as PROPORTIONS
from asperity.rating.facts import Fact, facts, starts_from
from asperity.rating.inputs import Inputs, scaled
from asperity.rating.result import Entry
from asperity.sources import Source

DEFINITION = Source("definition", "verified")

_FROM_SI = {"MPa": 1e-6, "mm2/s": 1e6}


def given_entries(given: Inputs, section: str) -> tuple[Entry, ...]:
    """Return the entries of what the calculation of a standard starts from."""
    known = {fact.key: fact for fact in facts("given")}
    assumed = assumptions(given)
    made = []
    for key in starts_from(section):
        fact = known[key]
        reason = _reason(fact.path, assumed)
        equation, source = fact.equation, _source(given, fact)
        if reason:
            source = Source("default of asperity", "one source", reason)
        elif fact.derived and _at(given, fact.path) is None:
            equation, source = _derived(given, fact), DEFINITION
        value: Any = _at(given, fact.of)
        if fact.unit == "deg":
            value = math.degrees(value)
        elif fact.unit in _FROM_SI:
            value = scaled(value, _FROM_SI[fact.unit])
        meaning = fact.meaning
        made.append(
            Entry(key, fact.symbol, value, fact.unit, meaning, equation, source, bool(reason))
        )
    return tuple(made)


def assumptions(given: Inputs) -> Mapping[str, str]:
    """Return what was assumed, by ``table.key``."""
    return {
        f"{table.table}.{key}": reason
        for table in (given.gearset, given.operation, given.options)
        for key, reason in table.assumed.items()
    }


def _at(thing: Any, path: str) -> Any:
    return functools.reduce(getattr, path.split("."), thing) if path else None


def _reason(path: str, assumed: Mapping[str, str]) -> str:
    """Return what was assumed for a key, or for the thing that it is part of."""
    parts = path.split(".")
    names = (".".join(parts[:count]) for count in range(len(parts), 1, -1))
    return next((assumed[name] for name in names if name in assumed), "")


def _derived(given: Inputs, fact: Fact) -> str:
    if fact.path == "gearset.diameter_factor" and given.gearset.worm_pitch_diameter is not None:
        return "d_m1/m_x1"
    return fact.derived


def _source(given: Inputs, fact: Fact) -> Source:
    if fact.path == "gearset.tooth_proportions":
        return PROPORTIONS[given.gearset.tooth_proportions]
    owner, _, key = fact.of.rpartition(".")
    thing = _at(given, owner)
    if hasattr(thing, "source"):
        found: Source = thing.source(key)
        return found
    return GIVEN if fact.path else DEFINITION

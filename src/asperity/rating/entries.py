"""What a rating says about each number besides its value, from ``data/entries.toml``.

First comes what it starts from: what the user gave, what follows, what is a default. An equation is
written in the symbols of the numbers before it, so that what a number rests on can be read from it:
it is trusted no more than the least of those.
"""

import functools
import importlib
import math
import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple

from asperity.errors import InputError
from asperity.files import store
from asperity.gearset.library import GIVEN
from asperity.gearset.proportions import SOURCES as PROPORTIONS
from asperity.rating.inputs import Inputs, scaled
from asperity.rating.result import Entry
from asperity.sources import Source, weakest
from asperity.units.standards import FROM_SI

DEFINITION = Source("definition", "verified")

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
    return tuple(_fact(section, key, values, sources) for key, values in raw[section].items())


def _fact(section: str, key: str, values: Mapping[str, Any], sources: Mapping[str, Source]) -> Fact:
    found = {"symbol": "", "unit": "", "equation": "input" if section == "given" else ""}
    source = sources[values.get("from", "definition")]
    if "formula" in values:
        module, name = values["formula"].split(".")
        formula = getattr(importlib.import_module(f"asperity.rating.{section}.{module}"), name)
        given = _read().get("shown", {}).get(section, {}) | values.get("given", {})
        equation = _SYMBOL.sub(lambda word: given.get(word[0], word[0]), formula.equation)
        if "times" in values:
            equation = f"{values['times']} ({equation})"
        found = {"symbol": formula.symbol, "unit": formula.unit, "equation": equation}
        source = formula.source
    found |= {name: values[name] for name in found if name in values}
    of = values.get("of", "")
    return Fact(
        key=key,
        **found,
        meaning=values["meaning"],
        source=source,
        of=of,
        path=values.get("path", of if "." in of else ""),
        derived=values.get("derived", ""),
    )


def starts_from(section: str) -> tuple[str, ...]:
    """Return the keys of what the calculation of a standard starts from."""
    return tuple(_read()["starts_from"][section])


@functools.cache
def _read() -> dict[str, Any]:
    return store.read_toml(_FILE)


@functools.lru_cache(maxsize=1024)
def words(equation: str) -> tuple[str, ...]:
    """Return the words of an equation, the symbols of what it rests on among them."""
    return tuple(dict.fromkeys(_SYMBOL.findall(equation)))


def entries(
    inputs: Inputs,
    section: str,
    values: Mapping[str, Any],
    sources: Mapping[str, Source],
    equations: Mapping[str, str],
) -> tuple[Entry, ...]:
    """Return all entries of a rating.

    Parameters
    ----------
    inputs : Inputs
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
    made = _given_entries(inputs, section)
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
        meaning = fact.meaning
        if inputs.duty and fact.key == "theta_S_degC":
            meaning += " in the part of the duty cycle that wears most"
        made.append(
            Entry(
                fact.key, fact.symbol, value, fact.unit, meaning, equation, source,
                of_equation=None if source in (GIVEN, fact.source) else fact.source,
            )
        )  # fmt: skip
    return tuple(made)


def _given_entries(inputs: Inputs, section: str) -> list[Entry]:
    """Return the entries of what the calculation of a standard starts from."""
    known = {fact.key: fact for fact in facts("given")}
    assumed = assumptions(inputs)
    made = []
    for key in starts_from(section):
        fact = known[key]
        reason = _reason(fact.path, assumed)
        equation, source = _equation(inputs, fact), _source(inputs, fact)
        if reason:
            source = Source("default of asperity", "own choice", reason)
        elif fact.derived and _at(inputs, fact.path) is None:
            equation, source = _derived(inputs, fact), DEFINITION
        value: Any = _at(inputs, fact.of)
        if fact.unit == "deg":
            value = math.degrees(value)
        elif "." in fact.of and fact.unit in FROM_SI:
            value = scaled(value, FROM_SI[fact.unit])
        if isinstance(value, float) and not math.isfinite(value):
            raise InputError(
                f"the {fact.meaning} cannot be calculated ({key} is {value}): the numbers of this "
                "case are too far apart; look for a value with a wrong unit or exponent"
            )
        meaning = fact.meaning
        made.append(
            Entry(key, fact.symbol, value, fact.unit, meaning, equation, source, bool(reason))
        )
    return made


def assumptions(inputs: Inputs) -> Mapping[str, str]:
    """Return what was assumed, by ``table.key``."""
    return {
        f"{table.table}.{key}": reason
        for table in (inputs.gearset, inputs.operation, inputs.options, *inputs.operation.parts)
        for key, reason in table.assumed.items()
    }


def _at(thing: Any, path: str) -> Any:
    return functools.reduce(getattr, path.split("."), thing) if path else None


def _reason(path: str, assumed: Mapping[str, str]) -> str:
    """Return what was assumed for a key, or for the thing that it is part of."""
    parts = path.split(".")
    names = (".".join(parts[:count]) for count in range(len(parts), 1, -1))
    return next((assumed[name] for name in names if name in assumed), "")


def _equation(inputs: Inputs, fact: Fact) -> str:
    if fact.of == "effective_face_width" and inputs.options.iso14521_face_width != "tip_chord":
        chord = "sqrt(6 m_x1 d_m1 - 9 m_x1^2)"
        return chord if inputs.gearset.wheel_face_width is None else f"min(b_2, {chord})"
    return fact.equation


def _derived(inputs: Inputs, fact: Fact) -> str:
    if fact.path == "gearset.diameter_factor" and inputs.gearset.worm_pitch_diameter is not None:
        return "d_m1/m_x1"
    return fact.derived


def _source(inputs: Inputs, fact: Fact) -> Source:
    if fact.path == "gearset.tooth_proportions":
        return PROPORTIONS[inputs.gearset.tooth_proportions]
    owner, _, key = fact.of.rpartition(".")
    thing = _at(inputs, owner)
    if hasattr(thing, "source"):
        found: Source = thing.source(key)
        return found
    return GIVEN if fact.path else DEFINITION

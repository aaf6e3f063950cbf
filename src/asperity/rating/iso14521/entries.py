"""What each number of a rating by ISO/TR 14521 is: symbol, unit, equation and source."""

import functools
import tomllib
from collections.abc import Iterable, Mapping
from pathlib import Path
from types import MappingProxyType
from typing import NamedTuple

from asperity.errors import InputError, nearest
from asperity.rating.iso14521.tables import EDITIONS, Edition, check_words
from asperity.rating.result import Entry, Value
from asperity.sources import Confidence, Source, weakest


class Definition(NamedTuple):
    """A quantity of the standard; see `Entry` for its parts."""

    symbol: str
    unit: str
    meaning: str
    equation: str
    confidence: Confidence
    note: str = ""


@functools.cache
def definitions(edition: Edition = "2010") -> Mapping[str, Definition]:
    """Return what the standard calculates, by key, in the order of the calculation."""
    check_words(edition=edition)
    path = Path(__file__).parents[1] / "data" / "iso14521-quantities.toml"
    groups = tomllib.loads(path.read_text("utf-8"))
    changes = groups.pop("edition-1998")
    found = {key: parts for group in groups.values() for key, parts in group.items()}
    if edition == "1998":
        found |= changes
    return MappingProxyType({key: Definition(**parts) for key, parts in found.items()})


def entry(
    key: str,
    value: Value,
    *,
    edition: Edition = "2010",
    rests_on: Iterable[Source] = (),
    assumed: bool = False,
) -> Entry:
    """Return a number as an entry of a rating.

    Parameters
    ----------
    key : str
        One of `definitions`.
    value : float, int, bool or str
        In the unit of the key.
    edition : {'1998', '2010'}
        Family of formulas.
    rests_on : iterable of Source
        Sources of the numbers it was made from; the weakest of them all is shown.
    assumed : bool
        Whether it is a default and not what the user gave.

    Raises
    ------
    InputError
        Unknown key or edition.

    Examples
    --------
    >>> entry("mu_zm", 0.1344).symbol
    'mu_zm'
    """
    known = definitions(edition)
    if key not in known:
        raise InputError(f"{key!r} is no quantity of ISO/TR 14521{nearest(key, known)}")
    definition = known[key]
    source = Source(EDITIONS[edition], definition.confidence, definition.note)
    return Entry(
        key,
        definition.symbol,
        value,
        definition.unit,
        definition.meaning,
        definition.equation,
        weakest(source, *rests_on),
        assumed,
    )

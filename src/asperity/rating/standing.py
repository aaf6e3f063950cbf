"""What each standard comes to: whether a gearset holds by it, or why it cannot tell.

A standard that has no answer, or one that leaves a safety without, is named as such; so is one
whose tables or limits of validity a gearset lies outside of.
"""

import re
import textwrap
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, Literal, NamedTuple

from asperity.rating.demands import DEMANDS
from asperity.rating.result import Rating
from asperity.results.language import Spoken, said
from asperity.results.terminal import lines_of_text
from asperity.results.unit_systems import shown_text

NAMES = {"iso14521": "ISO/TR 14521", "bs721": "BS 721", "agma6034": "AGMA 6034"}
"""What people call the standards."""

WIDTH = 79
"""Longest line."""

Word = Literal["does not hold", "holds", "undecided", "no answer"]
WORDS: tuple[Word, ...] = ("does not hold", "holds", "undecided", "no answer")
"""What a standard comes to, in the order in which it is said."""

# What the efficiencies of ISO/TR 14521 rest on, as its limits of validity name it.
# Friction rests on the oil's viscosity as well, which an oil outside its range has none of.
_OF_EFFICIENCY = (
    "(Y_S)", "(h*, p_m*)", "Y_G", "(eta_ges)", "oil temperature", "of the sump theta_S", "viscosity"
)  # fmt: skip
# A part ends at a semicolon or a full stop, which abbreviations have none of here.
_PART = re.compile(r"(?:;|(?<!\b[a-z])\.)\s")
_CUT = " ..."
_MOST = 2 * WIDTH - 12  # two lines of a text, which break before a word
_SYMBOL = re.compile(r" \([^)]*\)$")


class Standing(NamedTuple):
    """What a standard comes to.

    Attributes
    ----------
    standard : {'iso14521', 'bs721', 'agma6034'}
        Which.
    word : {'holds', 'does not hold', 'undecided', 'no answer'}
        Undecided is one of which every safety that has an answer is enough, but not all have one.
    unrated : tuple of str
        What it is to be safe against and has no answer for, though for others.
    outside : tuple of str
        What lies outside its tables or limits of validity.
    reasons : tuple of str
        Why it has no answer, to all or to some.
    """

    standard: str
    word: Word
    unrated: tuple[str, ...] = ()
    outside: tuple[str, ...] = ()
    reasons: tuple[str, ...] = ()

    @classmethod
    def of(
        cls, ratings: Mapping[str, Rating], unanswered: Mapping[str, str]
    ) -> "Iterator[Standing]":
        """Yield that of every standard that was asked for."""
        for name in NAMES:
            if name in unanswered:
                yield cls(name, "no answer", reasons=(unanswered[name],))
            elif name in ratings:
                yield cls._rated(name, ratings[name])

    @classmethod
    def _rated(cls, name: str, rating: Rating) -> "Standing":
        own = [demand for demand in DEMANDS if demand.standard == name]
        missing = tuple(demand.name for demand in own if demand.key not in rating)
        rated = [demand for demand in own if demand.key in rating]
        fails = any(not demand.holds(float(rating[demand.key])) for demand in rated)
        word: Word = "holds"
        if fails:
            word = "does not hold"
        elif not rated:
            word = "no answer"
        elif missing:
            word = "undecided"
        outside = [_what(sentence) for sentence in rating.violations]
        # A worm that the speed tables of BS 721 do not reach, while its wheel is rated.
        said = (gap.partition(":")[0] for gap in rating.gaps)
        outside += said if not missing else ()
        return cls(name, word, missing if rated else (), tuple(dict.fromkeys(outside)), rating.gaps)

    @property
    def holds(self) -> bool | None:
        """Whether it holds; None where the standard cannot tell."""
        return {"holds": True, "does not hold": False}.get(self.word)

    def to_json(self) -> dict[str, Any]:
        """Return it by key."""
        return {
            "word": self.word,
            "unrated": list(self.unrated),
            "outside": list(self.outside),
            "reasons": list(self.reasons),
        }

    @staticmethod
    def sentences(standing: "Sequence[Standing]", whole: bool = False) -> Iterator[str]:
        """Yield what standards come to, which answers are missing and why, and what is outside."""
        cut = str if whole else _shortened
        parts = []
        for word in WORDS:
            names = [NAMES[one.standard] for one in standing if one.word == word]
            if names:
                parts.append(f"{word} by {listed(names)}")
        yield "; ".join(parts)
        for one in standing:
            name, why = NAMES[one.standard], one.reasons[0] if one.reasons else ""
            if one.unrated:
                yield cut(f"{name} has no answer for {listed(one.unrated)}: {why}")
            elif one.word == "no answer" and why:
                yield cut(f"{name}: {why}")
        outside = [f"{NAMES[one.standard]} ({', '.join(one.outside)})"
                   for one in standing if one.outside]  # fmt: skip
        if outside:
            yield f"outside its range: {'; '.join(outside)}"


def efficiency_outside(iso: Rating) -> tuple[str, ...]:
    """Return what the efficiencies by ISO/TR 14521 rest on that lies outside its range."""
    found = [text for text in iso.violations if any(mark in text for mark in _OF_EFFICIENCY)]
    return tuple(dict.fromkeys(map(_what, found)))


def listed(words: Sequence[str]) -> str:
    """Return words in a row.

    Examples
    --------
    >>> listed(["wear", "root", "heat"])
    'wear, root and heat'
    """
    return " and ".join([", ".join(words[:-1]), words[-1]] if len(words) > 1 else words)


def wrapped(text: str) -> list[str]:
    """Return a text in lines of at most 79 characters."""
    return lines_of_text(shown_text(text), WIDTH, hanging="  ")


def _what(violation: str) -> str:
    """Return what a sentence on a limit of validity is about.

    Examples
    --------
    >>> _what("centre distance a (Y_S) is 60.17 mm; ISO/TR 14521:2010 is valid from 65 to 250 mm")
    'centre distance a'
    """
    what, _, rest = violation.partition(" is ")
    if "(eta_ges)" in what:
        return f"losses without load {float(rest.partition(';')[0]):.3g} of P_2"
    return _SYMBOL.sub("", what)


def _shortened(text: str) -> str:
    """Return at most two lines of a text, ended where a part of it ends.

    Examples
    --------
    >>> _shortened("ISO/TR 14521: h* is 0.05; it must be above 0.07. " + "any one of these, " * 9)
    'ISO/TR 14521: h* is 0.05; it must be above 0.07 ...'
    """
    text = said(text)
    if len(text) <= _MOST:
        return Spoken(text)
    room = text[: _MOST - len(_CUT) + 1]
    ends = [found.start() for found in _PART.finditer(room)]
    if ends:
        return Spoken(room[: ends[-1]] + _CUT)
    return Spoken(textwrap.shorten(text, _MOST, placeholder=_CUT))

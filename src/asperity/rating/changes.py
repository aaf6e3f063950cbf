"""What changes in the words of a verdict from one gearset to another: what holds, what locks."""

from collections.abc import Iterator
from typing import Any

from asperity.rating.standing import NAMES, Word, listed

_SHORT = {"iso14521": "ISO", "bs721": "BS", "agma6034": "AGMA"}
# How much a verdict says for a gearset.
_SAYS: dict[Word, int] = {"does not hold": 0, "no answer": 1, "undecided": 2, "holds": 3}
_STATES = {"static": "at rest", "dynamic": "in motion"}

Rated = Any
"""A `asperity.rating.rated.Rated`, whose module imports this one."""


def changed_words(before: Rated, after: Rated, *, each: bool = True) -> tuple[str, ...]:
    """Return a sentence for each standard whose verdict, and each state whose locking, changes.

    With ``each``, also for what a standard no longer holds against while its verdict stays.
    """
    return (*_standing(before, after, each), *_locking(before, after))


def says_less(before: Rated, after: Rated) -> bool:
    """Whether a standard says less of a gearset than before: what held does not, or is not told.

    What it gave no answer for may fail too, and what it fails can become no less.
    """
    old = {one.standard: one.word for one in before.verdict.standing}
    return any(
        _SAYS[one.word] < _SAYS[old[one.standard]]
        for one in after.verdict.standing
        if one.standard in old
    )


def _standing(before: Rated, after: Rated, each: bool) -> Iterator[str]:
    old = {one.standard: one for one in before.verdict.standing}
    for one in after.verdict.standing:
        was = old.get(one.standard)
        if was is None:
            continue
        if was.word != one.word:
            yield f"{NAMES[one.standard]}: {was.word} -> {one.word}"
        # The verdict was that already: what fails now and held before.
        elif each and (fails := _lost(before, after, one.standard)):
            yield f"{NAMES[one.standard]}: no longer holds against {listed(fails)}"
        lost = [name for name in one.unrated if name not in was.unrated]
        if lost:
            yield f"{NAMES[one.standard]}: no answer for {listed(lost)} any more"


def _lost(before: Rated, after: Rated, standard: str) -> list[str]:
    """Names of what a standard's safety is enough against before, and not after."""
    held = {one.demand.key for one in _of(before, standard) if one.holds}
    return [
        one.demand.name for one in _of(after, standard) if one.demand.key in held and not one.holds
    ]


def _of(rated: Rated, standard: str) -> list[Any]:
    return [one for one in rated.verdict.safeties if one.demand.standard == standard]


def _locking(before: Rated, after: Rated) -> Iterator[str]:
    old = {(one.standard, one.state): one.locks for one in before.self_locking}
    for state, words in _STATES.items():
        for locks, said in ((False, "no longer locks itself"), (True, "now locks itself")):
            names = [
                NAMES.get(one.standard, "the given friction")
                for one in after.self_locking
                if one.state == state
                and old.get((one.standard, state), locks) != one.locks
                and one.locks == locks
            ]
            if names:
                yield f"{said} {words} by {listed(names)}"


def locking_words(rated: Rated) -> dict[str, str]:
    """Return by which standards a worm locks itself, by state, as a table shows it."""
    found = {}
    for state, words in _STATES.items():
        own = [one for one in rated.self_locking if one.state == state]
        names = [_SHORT.get(one.standard, "that given") for one in own if one.locks]
        found[f"locks itself {words}"] = (
            "no" if not names else "yes" if len(names) == len(own) else f"by {listed(names)}"
        )
    return found

"""A rating whose report shows contact pattern and lines besides, where they are asked for."""

import dataclasses
from typing import TYPE_CHECKING, NamedTuple

from asperity.casefile import Case
from asperity.errors import InputError
from asperity.rating.answered import answer as rated_answer
from asperity.rating.answered import prepare as prepare_rating
from asperity.rating.rate import Rated
from asperity.rating.standards import ALL
from asperity.results.report import Section
from asperity.results.table import Table
from asperity.runs import Run

if TYPE_CHECKING:
    from asperity.flanks.study.flank import Prepared
    from asperity.flanks.study.result import FlankStudy

_PICTURES = "pattern", "contact-lines"


class Asked(NamedTuple):
    """What is rated, and its flanks where they are asked for."""

    rating: tuple[Case, tuple[str, ...]]
    flanks: "Prepared | None"


def prepare(case: Case, *, standard: str = ALL, pattern: bool = False) -> Asked:
    """Return what the command rates, and the wheel cut where its pattern is asked for.

    Raises
    ------
    InputError
        As from `asperity.rating.answered.prepare` and `asperity.flanks.study.flank.prepare`.
    """
    rating = prepare_rating(case, standard=standard)
    if not pattern:
        return Asked(rating, None)
    from asperity.flanks.study import flank

    return Asked(rating, flank.prepare(case, density="coarse"))


def answer(asked: Asked, run: Run) -> Rated:
    """Rate the gearset of a case; see how its flanks touch where that is asked for.

    Raises
    ------
    InputError
        The pattern is asked for, and there is no report to show it.
    """
    if asked.flanks is not None and run.folder is None:
        raise InputError("--pattern: it is shown in the report; name a folder for it with --out")
    rated = _with_parts(rated_answer(asked.rating, run), asked.rating[0])
    if asked.flanks is None:
        return rated
    from asperity.flanks.study import flank

    return dataclasses.replace(rated, contact=_contact(flank.study(asked.flanks)))


def _with_parts(rated: Rated, case: Case) -> Rated:
    """Return a rating with what the shafts and bearings of its case come to, where it has any."""
    if not any(name in case for name in ("worm_shaft", "wheel_shaft")):
        return rated
    from asperity.shafts.study import shaft_rows

    return dataclasses.replace(rated, rows=shaft_rows(case, iso=rated.iso14521))


def _contact(found: "FlankStudy") -> Section:
    from asperity.results.report import Picture

    hob = found.assumed.get("hob")
    cut = f"Cut by a hob {hob}" if hob else "Cut by the hob of the case"
    return Section(
        "Contact pattern and lines",
        (f"{cut}, without load; asperity flank tells all of the flanks.",),
        tuple(
            Picture(name.replace("-", " ").capitalize(), found.figure(name), found.captions[name])
            for name in _PICTURES
        ),
        (Table((), (), remarks=found.notes),),
    )

"""Contact pattern and lines for the report of a rating, where they are asked for."""

import dataclasses
from collections.abc import Callable

from asperity.casefile import Case
from asperity.errors import InputError
from asperity.flanks.study import flank
from asperity.flanks.study.result import FlankStudy
from asperity.rating import Rated
from asperity.results.report import Picture, Section
from asperity.results.table import Table
from asperity.runs import Run

_PICTURES = "pattern", "contact-lines"


def beside_rating(case: Case) -> Callable[[Rated, Run], Rated]:
    """Cut the wheel of a case; return what sees how its flanks touch and adds it to a rating.

    Raises
    ------
    InputError
        As from `asperity.flanks.study.flank.prepare`; or there is no report to show it.
    """
    prepared = flank.prepare(case, density="coarse")

    def add(rated: Rated, run: Run) -> Rated:
        if run.folder is None:
            raise InputError(
                "--pattern: it is shown in the report; name a folder for it with --out"
            )
        return dataclasses.replace(rated, contact=_contact(flank.study(prepared)))

    return add


def _contact(study: FlankStudy) -> Section:
    hob = study.assumed.get("hob")
    cut = f"Cut by a hob {hob}" if hob else "Cut by the hob of the case"
    return Section(
        "Contact pattern and lines",
        (f"{cut}, without load; asperity flank tells all of the flanks.",),
        tuple(
            Picture(name.replace("-", " ").capitalize(), study.figure(name), study.captions[name])
            for name in _PICTURES
        ),
        (Table((), (), remarks=study.notes),),
    )

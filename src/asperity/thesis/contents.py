"""All that is reproduced, chapter by chapter."""

import dataclasses
from collections.abc import Iterable, Mapping, Sequence
from typing import TypeVar

from asperity.errors import InputError, nearest
from asperity.thesis.contact import claims as claims_contact
from asperity.thesis.contact import figures as figures_contact
from asperity.thesis.exhibits import FigureOf, TableOf
from asperity.thesis.flanks import figures as figures_flanks
from asperity.thesis.flanks import solids as figures_solids
from asperity.thesis.rating import claims as claims_rating
from asperity.thesis.rating import figures as figures_rating
from asperity.thesis.rating import tables as tables_rating
from asperity.thesis.sliding import claims as claims_sliding
from asperity.thesis.sliding import figures as figures_sliding

E = TypeVar("E", FigureOf, TableOf)


@dataclasses.dataclass(frozen=True)
class Chapter:
    """A chapter of the thesis: its number, what it is about here, and what a reader must know."""

    number: str
    title: str
    text: str


_SLIDING = (
    "A body is pulled over a base that vibrates in the plane of contact; the ratio is the mean "
    "drive force with vibration over the force without, mu F_N, and k is the vibration's peak "
    "velocity over the drive velocity."
)

CHAPTERS = (
    Chapter("2", "Friction laws and gear flanks", f"Sections 2.2.2, 2.6 and 2.7. {_SLIDING}"),
    Chapter(
        "3", "Efficiency and load capacity of worm gearsets",
        "The thesis's calculation sheet (its Appendix C), its Tables 3.1 to 3.7 and the oil's "
        "properties (Table 6.9) are lost but for the numbers in the text. Gearsets 2 and 3 are "
        "reconstructed from these: what was inferred from a number cannot be tested by it, and "
        "each claim and table says so. Gearsets 1 and 4 are lost and are not invented. The "
        "centre distance a and the ratio u of ISO/TR 14521 are the thesis's c and U.",
    ),
    Chapter("4", "The sliding body", f"With Appendix A. {_SLIDING}"),
    Chapter(
        "5", "The elastic block",
        "The sliding body of chapter 4 as a block of steel, meshed with hexahedra and condensed to "
        "the nodes of its base, with its friction integrated over the contact.",
    ),
    Chapter(
        "7", "The worm gearset under vibration",
        "So far, the stiffness of the worm shaft, gearset 3 in space with exact flanks, and the "
        "block of chapter 5 shaken itself.",
    ),
)  # fmt: skip
"""Those of which something is reproduced."""

CASES = (*claims_rating.CASES, *claims_sliding.CASES, *claims_contact.CASES)
"""Cases the claims rest on."""


def _by_number(exhibits: Iterable[E]) -> dict[str, E]:
    found = {exhibit.number: exhibit for exhibit in exhibits}
    return {number: found[number] for number in sorted(found, key=_order)}


def _order(number: str) -> tuple[int, ...]:
    return tuple(int(part) for part in number.split("."))


def chapter_of(number: str) -> str:
    """Return the chapter of a claim, figure or table.

    Examples
    --------
    >>> chapter_of("4.17")
    '4'
    """
    return number.partition(".")[0]


CLAIMS = tuple(
    sorted(
        (*claims_sliding.CLAIMS, *claims_rating.CLAIMS, *claims_contact.CLAIMS),
        key=lambda claim: _order(claim.id),
    )
)
FIGURES: Mapping[str, FigureOf] = _by_number(
    (
        *figures_sliding.FIGURES,
        *figures_rating.FIGURES,
        *figures_contact.FIGURES,
        *figures_flanks.FIGURES,
        *figures_solids.FIGURES,
    )
)
TABLES: Mapping[str, TableOf] = _by_number(tables_rating.TABLES)


def select(only: Sequence[str]) -> tuple[list[FigureOf], list[TableOf]]:
    """Return the figures and tables of some numbers, all for none.

    Raises
    ------
    InputError
        There is neither figure nor table of such a number.
    """
    for number in only:
        if number not in FIGURES and number not in TABLES:
            raise InputError(
                f"{number!r} is neither a figure nor a table that is reproduced"
                f"{nearest(number, sorted({*FIGURES, *TABLES}, key=_order))}"
            )
    figures = [figure for number, figure in FIGURES.items() if not only or number in only]
    tables = [table for number, table in TABLES.items() if not only or number in only]
    return figures, tables

"""All that is reproduced, chapter by chapter."""

import dataclasses
from collections.abc import Iterable, Mapping, Sequence
from typing import TypeVar

from asperity.errors import InputError, nearest
from asperity.thesis.contact import contents as contact
from asperity.thesis.exhibits import Exhibit, FigureOf, TableOf
from asperity.thesis.flanks import contents as flanks
from asperity.thesis.ledger import Claim
from asperity.thesis.rating import contents as rating
from asperity.thesis.sliding import contents as sliding

E = TypeVar("E", bound=Exhibit)


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
    Chapter("1", "Introduction", "What a more efficient gearset is worth."),
    Chapter("2", "Friction laws and gear flanks", f"Sections 2.2.2, 2.4, 2.6 and 2.7. {_SLIDING}"),
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


CLAIMS: Mapping[str, Claim] = _by_number(
    (*sliding.CLAIMS, *rating.CLAIMS, *flanks.CLAIMS, *contact.CLAIMS)
)
FIGURES: Mapping[str, FigureOf] = _by_number(
    (*sliding.FIGURES, *rating.FIGURES, *flanks.FIGURES, *contact.FIGURES)
)
TABLES: Mapping[str, TableOf] = _by_number((*sliding.TABLES, *rating.TABLES))


def everything() -> list[Exhibit]:
    """Return all that is reproduced, in the order of the page."""
    shelves: tuple[Mapping[str, Exhibit], ...] = (CLAIMS, FIGURES, TABLES)
    return [
        exhibit
        for chapter in CHAPTERS
        for shelf in shelves
        for number, exhibit in shelf.items()
        if chapter_of(number) == chapter.number
    ]


def select(only: Sequence[str]) -> list[Exhibit]:
    """Return the exhibits of some numbers, all for none.

    Raises
    ------
    InputError
        There is nothing of such a number.
    """
    numbers = {exhibit.number for exhibit in everything()}
    for number in only:
        if number not in numbers:
            raise InputError(
                f"{number!r} is neither a figure nor a table nor a claim that is reproduced"
                f"{nearest(number, sorted(numbers, key=_order))}"
            )
    return [exhibit for exhibit in everything() if not only or exhibit.number in only]

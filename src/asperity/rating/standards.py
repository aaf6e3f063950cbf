"""The standards by which a gearset is rated, and the tables of BS 721 that are asked for."""

from collections.abc import Sequence
from pathlib import Path

from asperity.errors import InputError, choices, suggestion
from asperity.rating.bs721.tables import Tables, read_tables
from asperity.rating.parameters import RatingOptions

STANDARDS = ("iso14521", "bs721", "agma6034")
"""The standards, by the name they have in results."""

ALL = "all"


def tables_of(options: RatingOptions, folder: Path | None) -> Tables:
    """Return the tables of BS 721 that are asked for."""
    own = options.bs721_tables
    return read_tables(None if own is None else (folder or Path()) / own)


def known_standards(standards: Sequence[str]) -> tuple[str, ...]:
    """Return the standards in their order; raises InputError for one that is not known."""
    for name in standards:
        if name not in STANDARDS:
            raise InputError(
                f"standard is {name!r}; it must be one of {choices(STANDARDS)}"
                f"{suggestion(str(name), STANDARDS)}"
            )
    if not standards:
        raise InputError(f"no standard is asked for; give one of {choices(STANDARDS)}")
    return tuple(name for name in STANDARDS if name in standards)

"""What is asked of a rating before any is made: standards, tables, numbers that belong together."""

from collections.abc import Sequence
from pathlib import Path

from asperity.errors import InputError, choices, suggestion
from asperity.rating.bs721.tables import Tables, read_tables
from asperity.rating.inputs import Inputs
from asperity.rating.iso14521.calculation import film_parameter_of
from asperity.rating.iso14521.film_failure import FilmParameterError
from asperity.rating.parameters import RatingOptions

STANDARDS = ("iso14521", "bs721", "agma6034")
"""The standards, by the name they have in results."""


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


def require_consistent(given: Inputs, by_iso: bool) -> None:
    """Refuse numbers that make no gearset; raises InputError."""
    try:
        given.gearset.require_consistent()
    except InputError as error:
        # The end of h* tells more about a ratio or module that is too large.
        try:
            if by_iso:
                film_parameter_of(given)
        except FilmParameterError as film:
            raise FilmParameterError(
                f"{film}; {error}", film.value, film.driver, film.limits
            ) from None
        raise

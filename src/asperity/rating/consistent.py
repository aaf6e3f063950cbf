"""Whether the numbers of a gearset belong together, in the words that tell most."""

from asperity.errors import InputError
from asperity.rating.inputs import Inputs
from asperity.rating.iso14521.calculation import film_parameter_of
from asperity.rating.iso14521.film_failure import FilmParameterError


def require_consistent(given: Inputs, by_iso: bool) -> None:
    """Refuse a gearset whose numbers do not belong together; raises InputError."""
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

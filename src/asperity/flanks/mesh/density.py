"""How fine a wheel is meshed, as it is asked for: a name or an element size."""

from asperity.errors import InputError, choices, suggestion
from asperity.flanks.mesh.tooth import DENSITIES
from asperity.units import split_unit, to_si

_MILLIMETRES = 1e3


def read_density(text: str) -> str | float:
    """Return a density by its name, or an element size on the flank in mm from text."""
    if text in DENSITIES:
        return text
    expected = (
        f"it must be one of {choices(DENSITIES)}{suggestion(text, DENSITIES)}, or an element size "
        "such as '0.5 mm'"
    )
    if split_unit(text) is None:
        raise InputError(f"--density is {text!r}; {expected}")
    try:
        size = to_si(text, "m") * _MILLIMETRES
    except InputError as error:
        raise InputError(f"--density is {text!r}; {expected}: {error}") from None
    if not size > 0.0:
        raise InputError(f"--density is {text!r}; an element size must be positive")
    return size

"""Parallel keys of DIN 6885-1 by the diameter of the shaft."""

from typing import NamedTuple

from asperity.errors import InputError
from asperity.sources import Source

SOURCE = Source("DIN 6885-1:1968", "from memory", "width and depths of parallel keys by diameter")
"""Where the sizes come from."""

# Diameter up to which they hold, width, depth in the shaft and in the hub, mm.
_SIZES = (
    (8.0, 2.0, 1.2, 1.0), (10.0, 3.0, 1.8, 1.4), (12.0, 4.0, 2.5, 1.8), (17.0, 5.0, 3.0, 2.3),
    (22.0, 6.0, 3.5, 2.8), (30.0, 8.0, 4.0, 3.3), (38.0, 10.0, 5.0, 3.3), (44.0, 12.0, 5.0, 3.3),
    (50.0, 14.0, 5.5, 3.8), (58.0, 16.0, 6.0, 4.3), (65.0, 18.0, 7.0, 4.4), (75.0, 20.0, 7.5, 4.9),
    (85.0, 22.0, 9.0, 5.4), (95.0, 25.0, 9.0, 5.4), (110.0, 28.0, 10.0, 6.4),
    (130.0, 32.0, 11.0, 7.4),
)  # fmt: skip
_LEAST = 6.0


class Key(NamedTuple):
    """Width of a parallel key, and its depths in shaft and hub, mm."""

    width: float
    in_shaft: float
    in_hub: float


def key_of(diameter: float, what: str, remedy: str = "leave blank.keyways out") -> Key:
    """Return the key of a diameter, mm.

    Raises
    ------
    InputError
        There is none of that diameter.

    Examples
    --------
    >>> key_of(25.0, "blank.bore")
    Key(width=8.0, in_shaft=4.0, in_hub=3.3)
    """
    if not _LEAST < diameter <= _SIZES[-1][0]:
        raise InputError(
            f"{what} is {diameter:g} mm; keys are known above {_LEAST:g} and up to "
            f"{_SIZES[-1][0]:g} mm: {remedy}"
        )
    return next(Key(*sizes) for most, *sizes in _SIZES if diameter <= most)

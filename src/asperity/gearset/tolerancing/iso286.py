"""Standard tolerances of ISO 286-1, and symmetric deviations such as ``js7``."""

import re

from asperity.errors import InputError, one_of
from asperity.sources import Source

SOURCE = Source("ISO 286-1:2010, table 1", "verified", "grades 5 to 12")
"""Where the standard tolerances come from."""

_UP_TO = (3.0, 6.0, 10.0, 18.0, 30.0, 50.0, 80.0, 120.0, 180.0, 250.0, 315.0, 400.0, 500.0)
_GRADES = {
    5: (4, 5, 6, 8, 9, 11, 13, 15, 18, 20, 23, 25, 27),
    6: (6, 8, 9, 11, 13, 16, 19, 22, 25, 29, 32, 36, 40),
    7: (10, 12, 15, 18, 21, 25, 30, 35, 40, 46, 52, 57, 63),
    8: (14, 18, 22, 27, 33, 39, 46, 54, 63, 72, 81, 89, 97),
    9: (25, 30, 36, 43, 52, 62, 74, 87, 100, 115, 130, 140, 155),
    10: (40, 48, 58, 70, 84, 100, 120, 140, 160, 185, 210, 230, 250),
    11: (60, 75, 90, 110, 130, 160, 190, 220, 250, 290, 320, 360, 400),
    12: (100, 120, 150, 180, 210, 250, 300, 350, 400, 460, 520, 570, 630),
}  # um
_SYMMETRIC = re.compile(r"[jJ][sS](\d{1,2})")

LARGEST = _UP_TO[-1]
"""Largest size of the table, mm."""


def standard_tolerance(size: float, grade: int) -> float:
    """Return the standard tolerance IT of a size.

    Parameters
    ----------
    size : float
        mm, above zero and at most 500.
    grade : int
        5 to 12.

    Returns
    -------
    float
        mm.

    Raises
    ------
    InputError
        The table has no such grade or size.

    Examples
    --------
    >>> standard_tolerance(100.0, 7)
    0.035
    """
    if grade not in _GRADES:
        raise InputError(f"the grade is {grade}; it must be one of IT5 to IT12")
    if not 0.0 < size <= LARGEST:
        raise InputError(
            f"the size is {size:g} mm; standard tolerances are known above 0 and up to "
            f"{LARGEST:g} mm: give the tolerance as a length"
        )
    place = next(n for n, most in enumerate(_UP_TO) if size <= most)
    return _GRADES[grade][place] / 1000.0


def symmetric_grade(text: str) -> int | None:
    """Return the grade of a symmetric deviation such as ``js7``, None for another text.

    Raises
    ------
    InputError
        The table has no such grade.
    """
    found = _SYMMETRIC.fullmatch(text.strip())
    if found is None:
        return None
    grade = int(found[1])
    if grade not in _GRADES:
        raise InputError(one_of((f"js{known}" for known in _GRADES), text))
    return grade

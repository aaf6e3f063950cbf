r"""Deviations that a grade of accuracy allows, from the tables that can be read openly.

Those of the worm are of GOST 3675-81, as Anuryev's handbook has them; those of the wheel, for want
of an open table for worm wheels, of ISO 1328-1:2013, which is made for cylindrical gears:

.. math:: f_p = (0.001 d + 0.4 m_n + 5)\,2^{(A-5)/2}, \qquad
          F_p = (0.002 d + 0.55\sqrt d + 0.7 m_n + 12)\,2^{(A-5)/2}\ \mu\mathrm m

with diameter and module in mm and the grade :math:`A`.
"""

import math
from typing import Literal, NamedTuple, get_args

from asperity.errors import InputError, one_of
from asperity.gearset.geometry import Geometry
from asperity.sources import Source

GOST = Source(
    "GOST 3675-81 after Anuryev, Designer's handbook, vol. 2, table 140", "one source",
    "modules 1 to 25 mm, worms up to 450 mm",
)  # fmt: skip
ISO_1328 = Source("ISO 1328-1:2013", "from memory", "made for cylindrical gears")

Grade = Literal[6, 7, 8, 9]
"""Grades that the open tables have."""

_MODULES = (3.5, 6.3, 10.0, 16.0, 25.0)
_LEAST_MODULE = 1.0
# By symbol and grade, um, for modules up to those above; a shorter row ends where the table does.
_WORM: dict[str, dict[int, tuple[float, ...]]] = {
    "f_h": {7: (17, 21, 28, 36, 50), 8: (28, 34, 45, 56, 80)},
    "f_hk": {7: (34, 42, 56, 75, 100), 8: (53, 67, 90, 120, 160)},
    "f_px": {6: (7.5, 9, 12, 16), 7: (12, 15, 19, 25, 34), 8: (19, 24, 30, 40, 53),
             9: (30, 36, 48, 63, 85)},
    "f_f1": {6: (11, 14, 19, 25), 7: (18, 24, 30, 40, 56), 8: (28, 36, 48, 63, 90),
             9: (45, 56, 75, 100, 130)},
}  # fmt: skip
_NAMES = {
    "f_h": "helix deviation over a turn",
    "f_hk": "helix deviation over the length",
    "f_px": "axial pitch deviation",
    "f_f1": "thread profile deviation",
}


class Allowed(NamedTuple):
    """A deviation that a grade allows, um.

    Attributes
    ----------
    part : {'worm', 'wheel'}
        What it is of.
    name, symbol : str
        The deviation.
    value : float
        The most that it may be, um.
    source : Source
        Whose grade it is.
    grade : int
        Which.
    """

    part: str
    name: str
    symbol: str
    value: float
    source: Source
    grade: int


def graded(geometry: Geometry, grade: int) -> tuple[Allowed, ...]:
    """Return the deviations of worm and wheel that a grade allows.

    What the open tables do not have, as the helix of grades 6 and 9, is left out.

    Parameters
    ----------
    geometry : Geometry
        Of the gearset.
    grade : int
        6 to 9.

    Returns
    -------
    tuple of Allowed
        Of worm and wheel, um each.

    Raises
    ------
    InputError
        The grade, or the module, is not in the tables.
    """
    if grade not in get_args(Grade):
        raise InputError(
            f"tolerances.grade is {grade}; {one_of(get_args(Grade), grade)}, which the open tables "
            "have"
        )
    m = geometry.axial_module
    if not _LEAST_MODULE <= m <= _MODULES[-1]:
        raise InputError(
            f"tolerances.grade is {grade}; its tables have axial modules from {_LEAST_MODULE:g} to "
            f"{_MODULES[-1]:g} mm, and that of the gearset is {m:g} mm: leave the grade out"
        )
    place = next(n for n, most in enumerate(_MODULES) if m <= most)
    worm = [
        Allowed("worm", _NAMES[symbol], symbol, rows[grade][place], GOST, grade)
        for symbol, rows in _WORM.items()
        if place < len(rows.get(grade, ()))
    ]
    d, m_n = geometry.wheel_mean_diameter, geometry.normal_module
    step = 2.0 ** ((grade - 5) / 2.0)
    single = (0.001 * d + 0.4 * m_n + 5.0) * step
    total = (0.002 * d + 0.55 * math.sqrt(d) + 0.7 * m_n + 12.0) * step
    return (
        *worm,
        Allowed("wheel", "single pitch deviation", "f_p2", single, ISO_1328, grade),
        Allowed("wheel", "cumulative pitch deviation", "F_p2", total, ISO_1328, grade),
    )

r"""What a case allows of worm, wheel and centre distance, resolved to mm.

A fit of GOST 3675-81 names a least normal backlash :math:`j_{n,min}`: none (H), or the standard
tolerance IT7, IT8, IT9, IT10, IT11 of the centre distance (E, D, C, B, A). The upper allowance of
the thread that leaves it in the worst case is a rule of this package, as are the tolerances of the
thickness where none are given; the standard's own tables of allowances are in no open text.
"""

import math
from collections.abc import Mapping
from typing import NamedTuple

from asperity.errors import InputError
from asperity.gearset.geometry import Geometry
from asperity.gearset.tolerancing.iso286 import standard_tolerance, symmetric_grade
from asperity.gearset.tolerancing.table import Tolerances
from asperity.gearset.tolerancing.thickness import thickness_tolerance
from asperity.sources import Source
from asperity.units import to_si

FITS: Mapping[str, int | None] = {"H": None, "E": 7, "D": 8, "C": 9, "B": 10, "A": 11}
"""Standard tolerance of the centre distance that each fit has as its least normal backlash."""

FIT_SOURCE = Source("GOST 3675-81", "from memory", "j_n,min by fit")

_MILLIMETRES = 1e3


class Taken(NamedTuple):
    """What mounting and hob take of the backlash on the mean circle in the worst case, mm.

    ``turned`` is how much there is on it for each part that a thread is thinner in the axial
    section.
    """

    backlash: float
    turned: float = 1.0

    @classmethod
    def of(cls, geometry: Geometry, off: float) -> "Taken":
        """Return it by geometry, of the deviation of the centre distance, mm."""
        return cls(2.0 * off * math.tan(geometry.axial_pressure_angle))


class Allowances(NamedTuple):
    """What a gearset may be off by, mm.

    Attributes
    ----------
    centre_distance : float
        To either side, mm.
    thread : tuple of float
        Upper and lower allowance of the normal thread thickness, mm.
    tooth : tuple of float
        Upper and lower allowance of the wheel's thickness on the mean circle, mm.
    fit_backlash : float or None
        Least normal backlash of the fit, mm.
    words : mapping of str to str
        Where each comes from, by key.
    """

    centre_distance: float
    thread: tuple[float, float]
    tooth: tuple[float, float]
    fit_backlash: float | None
    words: Mapping[str, str]

    @classmethod
    def of(
        cls, geometry: Geometry, tolerances: Tolerances, taken: "Taken | None" = None
    ) -> "Allowances":
        """Return what the table allows of a gearset.

        Parameters
        ----------
        geometry : Geometry
            Of the gearset.
        tolerances : Tolerances
            The table.
        taken : Taken, optional
            What a fit has to make up for by the exact flanks; left out: by geometry, of the centre
            distance.

        Raises
        ------
        InputError
            The centre distance is beyond the standard tolerances, or the fit asks for more than a
            thread has.
        """
        words: dict[str, str] = {}
        off, words["centre_distance"] = _centre(geometry, tolerances.centre_distance)
        slant = math.cos(geometry.lead_angle)
        if tolerances.tooth is not None:
            upper, lower = (value * _MILLIMETRES for value in tolerances.tooth)
            tooth, words["tooth"] = (upper, lower), "given"
        else:
            normal = thickness_tolerance(geometry.wheel_mean_diameter)
            tooth, words["tooth"] = (0.0, -normal / slant), "DIN 3967, series 25"
        least = None
        if tolerances.thread is not None:
            upper, lower = (value * _MILLIMETRES for value in tolerances.thread)
            words["thread"] = "given"
        else:
            upper, words["thread"] = 0.0, "DIN 3967, series 25"
            if tolerances.fit is not None:
                least = fit_backlash(geometry.centre_distance, tolerances.fit)
                upper = _upper(geometry, least, taken or Taken.of(geometry, off), tooth[0])
                words["thread"] = f"GOST 3675, fit {tolerances.fit}; DIN 3967, series 25"
            lower = upper - thickness_tolerance(geometry.worm_pitch_diameter)
        if -lower >= 0.5 * geometry.normal_pitch:
            raise InputError(
                f"tolerances.{'fit' if least is not None else 'thread'} makes threads up to "
                f"{-lower:.3g} mm thinner, and their nominal thickness is "
                f"{0.5 * geometry.normal_pitch:.3g} mm: allow less"
            )
        return cls(off, (upper, lower), tooth, least, words)


def fit_backlash(centre_distance: float, fit: str) -> float:
    """Return the least normal backlash of a fit at a centre distance, both mm.

    Examples
    --------
    >>> [fit_backlash(100.0, fit) for fit in "HEDCBA"]
    [0.0, 0.035, 0.054, 0.087, 0.14, 0.22]
    """
    grade = FITS[fit]
    if grade is None:
        return 0.0
    try:
        return standard_tolerance(centre_distance, grade)
    except InputError as error:
        raise InputError(f"tolerances.fit is {fit!r}; {error}") from None


def _centre(geometry: Geometry, given: str | None) -> tuple[float, str]:
    if given is None:
        return 0.0, "none given"
    grade = symmetric_grade(given)
    if grade is None:
        return to_si(given, "m") * _MILLIMETRES, "given"
    try:
        return 0.5 * standard_tolerance(geometry.centre_distance, grade), f"ISO 286, js{grade}"
    except InputError as error:
        raise InputError(f"tolerances.centre_distance is {given!r}; {error}") from None


def _upper(geometry: Geometry, least: float, taken: Taken, tooth: float) -> float:
    """Upper allowance of the thread that leaves a normal backlash in the worst case, mm."""
    slant = math.cos(geometry.lead_angle)
    along = least / (math.cos(geometry.pressure_angle) * slant)
    return -slant * max(0.0, along + taken.backlash + tooth) / taken.turned

r"""Sizing a worm gearset from centre distance and ratio, as thesis 3.2.1 outlines it.

The thesis names the order: centre distance and ratio from the space and the speeds, starts and
teeth from both, a diameter factor of 6 to 12, with these the least and the largest axial module,
and a module between them. It prints no formula. What is inferred here:

- The module range is what a profile shift of the wheel of 0.5 to -0.5 allows,
  :math:`m_{min,max} = 2c/(q_1 + z_2 \pm 1)`. (The thesis lists the lead angle among what must be
  known; under this reading it is not needed.)
- The wheel has at least :math:`7 + 2.4\sqrt{c}` teeth (:math:`c` in mm), a rule of thumb from
  memory, and at most 60 (more where one start gives more), as both of the thesis's gearsets that
  can be reconstructed have. Of the starts that this leaves, the most give the best efficiency and
  the fewest lock best.
- The diameter factor is 9, the middle of the advised range; 12 for self-locking. The thesis says
  that self-locking asks for the lowest one. That does not follow: locking needs a small lead
  angle, :math:`\tan\gamma = z_1/q_1`, hence few starts and a large diameter factor.
- The module is the one of ISO 54 with the least profile shift, where one lies in the range.

Lengths are in mm.
"""

import dataclasses
import math
from typing import Any

import numpy as np

from asperity.arrays import Real
from asperity.errors import InputError
from asperity.formulas import formula
from asperity.gearset import relations
from asperity.gearset.symbols import a
from asperity.sources import Range, Source

ADVISED_DIAMETER_FACTOR = Range(
    "diameter factor q1", 6.0, 12.0, "", Source("BS 721-2:1983", "one source")
)
"""Range of diameter factors that BS 721 advises, by the thesis (3.2.1)."""

SHIFTS = (-0.5, 0.5)
"""Profile shifts that bound the module, inferred."""

MOST_TEETH = 60
"""Most wheel teeth that are proposed, inferred from the thesis's gearsets."""

MOST_STARTS = 6
"""Most starts that are proposed."""

# ISO 54, first and second series.
MODULES = (
    *(0.5, 0.55, 0.6, 0.7, 0.8, 0.9, 1.0, 1.125, 1.25, 1.375, 1.5, 1.75, 2.0, 2.25, 2.5, 2.75),
    *(3.0, 3.5, 4.0, 4.5, 5.0, 5.5, 6.0, 7.0, 8.0, 9.0, 10.0, 11.0, 12.0, 14.0, 16.0, 18.0, 20.0),
    *(22.0, 25.0, 28.0, 32.0, 36.0, 40.0),
)


@dataclasses.dataclass(frozen=True)
class Sizing:
    """A first size of a worm gearset, lengths in mm, angles in rad.

    Attributes
    ----------
    starts, wheel_teeth : int
        Numbers of threads and teeth.
    gear_ratio : float
        Ratio they give, the nearest to the one asked for.
    diameter_factor, lead_angle : float
        Of the worm.
    least_module, largest_module : float
        Range of the axial module.
    axial_module, profile_shift : float
        The proposal.
    standard : bool
        Whether the module is one of ISO 54.
    """

    starts: int
    wheel_teeth: int
    gear_ratio: float
    diameter_factor: float
    lead_angle: float
    least_module: float
    largest_module: float
    axial_module: float
    profile_shift: float
    standard: bool

    @property
    def violations(self) -> tuple[str, ...]:
        """What lies outside the advised ranges, a sentence each."""
        sentence = ADVISED_DIAMETER_FACTOR.violation(self.diameter_factor)
        return () if sentence is None else (sentence,)


def module_range(centre_distance: Real, diameter_factor: Real, wheel_teeth: Real) -> Any:
    r"""Least and largest axial module, :math:`2c/(q_1 + z_2 \pm 1)`; inferred, see the module.

    Parameters
    ----------
    centre_distance : float or array
        :math:`c`, mm.
    diameter_factor, wheel_teeth : float or array
        :math:`q_1`, :math:`z_2`.

    Returns
    -------
    tuple of float or array
        :math:`m_{min}`, :math:`m_{max}`, mm.

    Examples
    --------
    >>> least, largest = module_range(74.93, 8.2, 60)
    >>> round(least, 3), round(largest, 3)
    (2.166, 2.23)
    """
    low, high = SHIFTS
    return (
        relations.axial_module(centre_distance, diameter_factor, wheel_teeth, high),
        relations.axial_module(centre_distance, diameter_factor, wheel_teeth, low),
    )


@formula(
    symbol="z_2min",
    equation="7 + 2.4 sqrt(a)",
    source=Source("BS 721-2:1983", "from memory"),
)
def least_teeth(centre_distance: a) -> Real:
    """Fewest teeth a wheel should have; the centre distance in mm."""
    return 7.0 + 2.4 * np.sqrt(centre_distance)


def possible_starts(centre_distance: float, gear_ratio: float) -> tuple[int, ...]:
    """Return the numbers of starts whose wheels have a sensible number of teeth.

    Parameters
    ----------
    centre_distance : float
        mm.
    gear_ratio : float
        Ratio of the speeds.

    Examples
    --------
    >>> possible_starts(74.93, 15.0)
    (2, 3, 4)
    """
    fewest = least_teeth(centre_distance)
    if round(gear_ratio) > max(MOST_TEETH, fewest):
        return (1,)
    return tuple(
        starts
        for starts in range(1, MOST_STARTS + 1)
        if fewest <= round(starts * gear_ratio) <= MOST_TEETH
    )


def size(
    centre_distance: float,
    gear_ratio: float,
    *,
    self_locking: bool = False,
    starts: int | None = None,
    diameter_factor: float | None = None,
) -> Sizing:
    """Propose a first size.

    Parameters
    ----------
    centre_distance : float
        mm.
    gear_ratio : float
        Ratio of the speeds, above 1.
    self_locking : bool
        Whether the smallest lead angle is wanted instead of the best efficiency.
    starts : int, optional
        Number of starts, in place of the rule.
    diameter_factor : float, optional
        In place of 9, or 12 for self-locking.

    Raises
    ------
    InputError
        No number of starts gives a sensible wheel.

    Examples
    --------
    >>> proposal = size(74.93, 15.0, diameter_factor=8.2)
    >>> proposal.starts, proposal.wheel_teeth, round(proposal.axial_module, 3)
    (4, 60, 2.197)
    """
    if not (math.isfinite(gear_ratio) and gear_ratio > 1.0):
        raise InputError(f"gear_ratio is {gear_ratio:g}; it must be above 1")
    if starts is None:
        possible = possible_starts(centre_distance, gear_ratio)
        if not possible:
            raise InputError(
                f"gear_ratio is {gear_ratio:g}; no worm of 1 to {MOST_STARTS} starts gives a wheel "
                f"of {math.ceil(least_teeth(centre_distance))} to {MOST_TEETH} teeth, as a centre "
                f"distance of {centre_distance:g} mm asks for: give the starts, or another ratio"
            )
        starts = possible[0] if self_locking else possible[-1]
    elif starts < 1:
        raise InputError(f"starts is {starts}; it must be at least 1")
    teeth = round(starts * gear_ratio)
    q = (12.0 if self_locking else 9.0) if diameter_factor is None else diameter_factor
    least, largest = module_range(centre_distance, q, teeth)
    middle = relations.axial_module(centre_distance, q, teeth)
    standard = [m for m in MODULES if least <= m <= largest]
    shifts = {m: relations.profile_shift(centre_distance, m, q, teeth) for m in standard}
    module = min(standard, key=lambda m: abs(shifts[m])) if standard else middle
    return Sizing(
        starts=starts,
        wheel_teeth=teeth,
        gear_ratio=teeth / starts,
        diameter_factor=q,
        lead_angle=relations.lead_angle(starts, q),
        least_module=least,
        largest_module=largest,
        axial_module=module,
        profile_shift=shifts.get(module, 0.0),
        standard=bool(standard),
    )

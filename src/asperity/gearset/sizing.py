r"""What worm gearsets may be sized from: starts, teeth and modules, as thesis 3.2.1 outlines it.

The thesis prints no formula. What is inferred here: the wheel has at least :math:`7 + 2.4\sqrt{c}`
teeth (:math:`c` in mm), a rule of thumb from memory, and at most 60 (more where one start gives
more), as both of the thesis's gearsets that can be reconstructed have. Of the starts that this
leaves, the most give the best efficiency and the fewest lock best.
"""

import numpy as np

from asperity.arrays import Real
from asperity.formulas import formula
from asperity.gearset.symbols import a
from asperity.sources import Source

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

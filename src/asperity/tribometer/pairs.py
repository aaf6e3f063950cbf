"""Which two a rig has slide on each other: discs, or a worm and its wheel."""

from asperity.casefile import Case
from asperity.gearset import Gearset
from asperity.tribometer.geared import GearPair
from asperity.tribometer.pair import Pair


def pair_of(case: Case) -> Pair:
    """Gather the tables of discs, or with ``[gearset]`` of a worm and its wheel.

    Parameters
    ----------
    case : Case
        The configuration of a rig.

    Returns
    -------
    Pair
        One that reads it.

    Raises
    ------
    InputError
        A table is missing, or one stands there of the other kind.
    """
    return GearPair.of(case) if Gearset.table in case else Pair.from_case(case)

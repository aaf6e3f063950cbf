"""The simulated rig of a configuration: of discs, or of a worm and its wheel."""

from asperity.casefile import Case
from asperity.gearset import Gearset
from asperity.tribometer.twin.geared import GearPlant
from asperity.tribometer.twin.plant import Plant


def plant_of(case: Case) -> Plant:
    """Gather the tables of a simulated rig; raises InputError where one is missing.

    Parameters
    ----------
    case : Case
        The configuration, with ``[twin]`` and ``[sonotrode]``.

    Returns
    -------
    Plant
        Of discs, or with ``[gearset]`` of gears.
    """
    return GearPlant.of(case) if Gearset.table in case else Plant.from_case(case)

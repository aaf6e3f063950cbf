"""The backlash that a rating tells, where a case has tolerances."""

from collections.abc import Mapping

from asperity.gearset.parameters import Gearset
from asperity.gearset.tolerancing.backlash import Backlash, backlash
from asperity.gearset.tolerancing.table import Tolerances
from asperity.rating.result import Rating


def worn(ratings: Mapping[str, Rating]) -> float | None:
    """Return how deep the wheel's flanks are worn at the end of the life by ISO/TR 14521, um."""
    iso = ratings.get("iso14521")
    return None if iso is None or "delta_Wn_mm" not in iso else 1e3 * float(iso["delta_Wn_mm"])


def play_of(
    gearset: Gearset, tolerances: Tolerances | None, ratings: Mapping[str, Rating]
) -> Backlash | None:
    """Return the backlash that tolerances leave, None without any; raises InputError."""
    return None if tolerances is None else backlash(gearset, tolerances, worn(ratings))

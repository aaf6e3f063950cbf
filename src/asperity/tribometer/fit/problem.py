"""What a fit is asked: measurements, a case, and what is free in it."""

import dataclasses

from asperity.casefile import Case
from asperity.tribometer.fit.data import Measurements
from asperity.tribometer.fit.free import Free


@dataclasses.dataclass(frozen=True)
class FitProblem:
    """Measurements, a case, and what is free in it."""

    data: Measurements
    case: Case
    free: tuple[Free, ...]
    laws: tuple[str, ...]
    further: int
    by: str

"""A gearset that runs warm: what its housing and gears grow by, as errors of how it is mounted."""

from typing import NamedTuple

from asperity.drive.problem import DriveProblem
from asperity.flanks.parameters import Modification, Mount
from asperity.gearset.tolerancing.table import Tolerances
from asperity.gearset.tolerancing.warmth import Warmth

_MILLIMETRES, _MICRO = 1e3, 1e6


class Warmed(NamedTuple):
    """How a gearset stands when it is as warm as ``tolerances.temperatures`` says."""

    centre_distance_error: float  #: As `Mount` has it, that of the case with what warmth adds, m
    lead_correction: float  #: As `Modification` has it, rad
    apart: float  #: What warmth adds to the centre distance, m
    pitch: float  #: Growth of the worm's pitch over that of the wheel's, less 1

    @property
    def values(self) -> dict[str, float]:
        """Values of a case that has it so, by key."""
        return {
            "mount.centre_distance_error": self.centre_distance_error,
            "modification.lead_correction": self.lead_correction,
        }

    @property
    def told(self) -> str:
        """What warmth adds, in words."""
        return (
            f"centre distance {_MICRO * self.apart:+.3g} um, lead {_MICRO * self.pitch:+.3g} um/m"
        )


def warmed(problem: DriveProblem) -> Warmed | None:
    """Return how a drive's gearset stands when it is warm; None where no temperatures are given."""
    given = None if problem.case is None else problem.case.get(Tolerances)
    if given is None or given.temperatures is None:
        return None
    warmth = Warmth.of(problem.gearset, given.temperatures, given.housing)
    mount, own = problem.mount or Mount(), problem.modification or Modification()
    apart = warmth.apart / _MILLIMETRES
    return Warmed(
        mount.centre_distance_error + apart,
        own.lead_correction + warmth.lead_correction(problem.geometry.lead_angle),
        apart,
        warmth.pitch,
    )

"""What the teeth are reduced to: radius, deflection under torque, compliance along the flank."""

import dataclasses

from asperity.drive.problem import DriveProblem
from asperity.errors import InputError
from asperity.runs import Run


@dataclasses.dataclass(frozen=True)
class Reduction:
    """Numbers of a mesh that one point on each flank can have.

    Attributes
    ----------
    radius : float or None
        Effective radius on the worm, m; None: that of the reference circle.
    deflection : tuple of pairs of float
        Wheel torques, N m, and the angles that they turn the wheel by, rad.
    compliance : float
        Of the teeth along the flank, m/N.
    notes : tuple of str
        Where they come from, as far as a reader should know.
    """

    radius: float | None
    deflection: tuple[tuple[float, float], ...]
    compliance: float
    notes: tuple[str, ...] = ()


def reduction(problem: DriveProblem, run: Run) -> Reduction:
    """Return what a problem's teeth are reduced to: as given, else by their static solution."""
    drive = problem.drive
    if drive.deflection is None:
        raise InputError(
            "drive.deflection is missing; give torques of the wheel and the angles that they turn "
            'it by, such as [["23 N m", "47.6 urad"], ["366 N m", "365 urad"]]'
        )
    notes = []
    if drive.effective_radius is None:
        notes.append(
            "drive.effective_radius is left out: the flanks touch on the reference circle, where "
            "wheels cut by a larger hob touch further out"
        )
    if drive.tangential_compliance is None:
        notes.append("drive.tangential_compliance is left out: teeth are rigid along the flank")
    return Reduction(
        drive.effective_radius, drive.deflection, drive.tangential_compliance or 0.0, tuple(notes)
    )

"""What the teeth are reduced to: radius, deflection under torque, compliance along the flank."""

import dataclasses

from asperity.drive.problem import DriveProblem
from asperity.drive.static.reduction import teeth_reduced
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
        return _of_teeth(problem, run)
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


def _of_teeth(problem: DriveProblem, run: Run) -> Reduction:
    """What the static solution says; what is given beside it stays."""
    teeth = teeth_reduced(problem, run)
    drive = problem.drive
    compliance = drive.tangential_compliance
    return Reduction(
        drive.effective_radius or teeth.radius,
        tuple(zip(teeth.torque.tolist(), teeth.deflection.tolist(), strict=True)),
        teeth.compliance if compliance is None else compliance,
        (
            f"deflection, radius and compliance are those of {drive.teeth} elastic teeth on a rim, "
            f"{drive.density} mesh",
        ),
    )

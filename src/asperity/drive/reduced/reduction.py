"""What the teeth are reduced to: radius, deflection under torque, compliance along the flank."""

import dataclasses
import json
from typing import TYPE_CHECKING

from asperity.drive.lugre import of_speed
from asperity.drive.problem import DriveProblem
from asperity.rating import RatingOptions
from asperity.runs import Run
from asperity.runs.cache import Cache
from asperity.runs.key import code_key, key
from asperity.runs.tree import from_tree, to_tree

if TYPE_CHECKING:
    from asperity.drive.static.reduction import TeethReduced


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
    mode : float or None
        Lowest natural frequency of a tooth, Hz; None where teeth are not known.
    """

    radius: float | None
    deflection: tuple[tuple[float, float], ...]
    compliance: float
    notes: tuple[str, ...] = ()
    mode: float | None = None


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
    most = max(torque for torque, _ in drive.deflection)
    if problem.load > most:
        notes.append(
            f"drive.deflection goes up to {most:.4g} N m, and the load is {problem.load:.4g} N m: "
            "it is carried on beyond its end"
        )
    return Reduction(
        drive.effective_radius, drive.deflection, drive.tangential_compliance or 0.0, tuple(notes)
    )


# What of a drive bears on its teeth without vibration.
_BEARS = ("model", "teeth", "density", "wheel_body", "threads", "friction", "effective_radius")


def teeth_key(problem: DriveProblem) -> str:
    """Return what the teeth of a problem are kept under, whatever shakes them."""
    drive = problem.drive.model_dump(mode="json", include=set(_BEARS))
    case = problem.case
    rating = case.get(RatingOptions) if case else None
    tables = (
        problem.gearset, problem.hob, problem.mount, problem.modification, problem.disc,
        # Where friction is one number, neither its law nor the speed bears on the teeth.
        *((problem.operation, rating) if drive["friction"] != "constant" else ()),
        *((problem.blank,) if problem.wheel_body is not None else ()),
        *((problem.operation, problem.friction) if of_speed(problem.friction) else ()),
    )  # fmt: skip
    given = [None if table is None else table.model_dump(mode="json") for table in tables]
    asked = [*given, problem.load, problem.friction.mu]
    return key(code_key("asperity.drive.static.reduction"), json.dumps([drive, asked]))


def _teeth(problem: DriveProblem, run: Run) -> "TeethReduced":
    # Flanks and finite elements take a second to load, which drives whose teeth are given do not.
    from asperity.drive.static.reduction import TeethReduced, teeth_reduced

    cache = Cache.of_this_user("reduced", run.notify)
    name = teeth_key(problem)
    kept = cache.get(name)
    if kept is not None:
        return from_tree(TeethReduced, kept)
    found = teeth_reduced(problem, run)
    cache.put(name, to_tree(found))
    return found


def _of_teeth(problem: DriveProblem, run: Run) -> Reduction:
    """What the static solution says; what is given beside it stays."""
    teeth = _teeth(problem, run)
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
        teeth.mode,
    )

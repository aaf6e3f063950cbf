"""Whether a drive that a vibration leaves as it was stays so once something has disturbed it.

A march under constant friction begins in steady sliding. Where the vibration's own speed nowhere
passes the sliding, it may stay there, though the same drive with its mesh ringing would be kept
ringing: friction reverses in the swing and lets it grow. So a march that ends where it began is
made once more from flanks that are nearer to each other.
"""

from typing import Any

from asperity.drive.problem import DriveProblem
from asperity.drive.protocols.equations_of_motion import begin
from asperity.drive.protocols.judgement import PERIODIC, Judgement
from asperity.drive.protocols.march import March, mean
from asperity.drive.protocols.rest import Rest
from asperity.drive.reduced.mesh_model import MeshModel
from asperity.errors import ConvergenceError
from asperity.runs import Run

_AS_IT_WAS = 1e-4  # of the torque without vibration, what next to nothing changes
_DEEPER = 0.05  # of the approach
_WEAKEST = 0.1  # of the sliding, what a vibration is at least that a ring helps to reverse friction


def other_state(
    problem: DriveProblem, model: MeshModel, march: March, judged: Judgement, rest: Rest,
    wanted: dict[str, Any], run: Run,
) -> tuple[str, ...]:  # fmt: skip
    """Return the note of another state that a drive comes to once it is disturbed, if there is one.

    Parameters
    ----------
    problem, model, march : DriveProblem, MeshModel, March
        The drive, its mesh, and its march that has settled.
    judged, rest : Judgement, Rest
        What it was found to be, and the drive without vibration.
    wanted : dict
        As `March.settle` takes it.
    run : Run
        Who may interrupt.
    """
    moving = march.system
    slides = moving.speed and moving.rolls and not rest.marched and model.pitch is None
    if not slides or problem.velocity_ratio < _WEAKEST:
        return ()
    ratio = mean(march.rows[-judged.cycles :], "torque") / rest.torque
    if abs(ratio - 1.0) > _AS_IT_WAS:
        return ()
    states, committed = begin(problem, model, moving)
    states[0]["roll"] -= _DEEPER * model.indentation / (model.point.normal_z * model.point.arm)
    other = March(model, moving, states, committed, run, march.stop, march.tree)
    try:
        found = other.settle(**wanted)
    except ConvergenceError:
        return ()
    there = mean(other.rows[-found.cycles :], "torque") / rest.torque
    if abs(there - ratio) <= PERIODIC:
        return ()
    where = f"as long as nothing disturbs it; from flanks {100.0 * _DEEPER:.2g} % nearer at first"
    if found.settled:
        said = f"it settles in another state, whose torque ratio is {there:.4g}"
    else:
        waited = 1e3 * other.rows.size * other.cycle
        said = f"it has not come back after {waited:.3g} ms, when its torque ratio is {there:.3g}"
    return (f"the vibration changes next to nothing {where} {said}",)

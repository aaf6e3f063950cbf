"""What is said beside a shaken drive's numbers: by what it settled, and what to know of them."""

import math

from asperity.drive.problem import DriveProblem
from asperity.drive.protocols.accuracy import WANTED, StepError
from asperity.drive.protocols.judgement import Judgement
from asperity.drive.protocols.rest import Rest
from asperity.drive.protocols.saving import Saving
from asperity.drive.reduced.mesh_model import MeshModel
from asperity.drive.warmed import warmth
from asperity.results.settled import smaller_step

# Of a tooth's lowest mode: below, its inertia adds an eighth to what it gives at most.
_QUASI_STATIC = 1.0 / 3.0
_OF_BLOCKS = {"back-drive": "wheel's speed", "held-wheel": "wheel's torque"}
WORM_ALONE = ("held-wheel", "back-drive")
"""Protocols that have no sliding of their own."""


def settled_by(problem: DriveProblem, judged: Judgement, rest: Rest) -> str:
    """Return what shows that a drive has settled, or what is missing."""
    if problem.drive.protocol == "window":
        return f"means over the first {judged.cycles} cycles alone, which no state is told by"
    said = judged.said(_what(problem))
    if rest.settled:
        return said
    without = f"without vibration the torque itself spreads by {100.0 * rest.spread:.2g} %"
    return without if judged.settled else f"{said}; {without}"


def _what(problem: DriveProblem) -> str:
    """Return what of a protocol has to stay, in words."""
    return _OF_BLOCKS.get(problem.drive.protocol, "torque ratio")


def notes_of(
    problem: DriveProblem, model: MeshModel, judged: Judgement, rest: Rest,
    off: StepError | None, longest: float,
) -> tuple[str, ...]:  # fmt: skip
    """Return what a reader of a drive's answer should know; steps are up to ``longest``, s."""
    notes = list(model.reduction.notes)
    if problem.drive.protocol == "window":
        notes.append(
            f"means over the first {judged.cycles} cycles, whose wheel is out of balance by "
            f"{100.0 * judged.balance:.2g} %: no state that lasts"
        )
    elif not judged.settled:
        how = "aperiodic" if judged.nearer == math.inf else "not periodic yet"
        notes.append(f"{how}: {judged.said(_what(problem))}")
    marched, asked = judged.cycles / problem.vibrated[1].frequency, problem.solve.duration
    if asked is not None and marched > (1.0 + 1e-9) * asked and problem.drive.protocol != "window":
        notes.append(
            f"marched for {1e3 * marched:.3g} ms where solve.duration asks for {1e3 * asked:.3g}: "
            f"a state is judged by three blocks of {judged.cycles // 3} cycles at least"
        )
    if rest.marched and problem.drive.protocol == "held-wheel":
        notes.append(
            f"the ratio refers to the held wheel without vibration, {rest.wheel_torque:.4g} N m: "
            "friction of the worm that stands is not that of the worm that slid"
        )
    elif rest.marched:
        notes.append(
            "without vibration the drive shakes by itself, since friction falls with the speed: "
            f"ratios refer to the mean of that, {rest.torque:.4g} N m, where steady sliding would "
            f"take {model.worm_torque:.4g} N m"
        )
    if off is not None and off.ratio > WANTED and judged.settled:
        notes.append(_of_step(problem, off, longest))
    mode, frequency = model.tooth_mode, problem.vibrated[1].frequency
    if mode is not None and frequency > _QUASI_STATIC * mode:
        notes.append(
            f"the teeth are quasi-static, but the vibration's {1e-3 * frequency:.3g} kHz are more "
            f"than a third of their lowest mode, {1e-3 * mode:.3g} kHz at least: their inertia "
            "counts"
        )
    if model.pitch is not None and problem.drive.protocol not in WORM_ALONE:
        cycles = model.pitch * problem.vibrated[1].frequency
        if judged.cycles < 2.5 * cycles:
            notes.append(
                f"means over {judged.cycles / cycles:.2g} of a pitch of the teeth: before one is "
                "over elastic teeth do not repeat; a longer solve.duration takes them all in"
            )
    if problem.actuator is not None and problem.mode == "wheel-axial":
        notes.append("what the actuator takes is not told: the mass of the wheel is not known")
    hidden = []
    if problem.shaft.torsion is None:
        hidden.append("torsion (a soft shaft lets the worm give way as it turns)")
    if problem.shaft.axial is None:
        hidden.append("axial bearing and seat (a soft seat takes an axial vibration over)")
    if problem.shaft.diameter is None or problem.shaft.span is None:
        hidden.append("bending of the worm's shaft (often more than the teeth give)")
    if hidden:
        notes.append(f"rigid: {'; '.join(hidden)}")
    return (*notes, *warmth(problem))


def of_saving(saved: Saving | None, judged: Judgement, longest: float) -> tuple[str, ...]:
    """Return the line about a saving that is less than its error, with what would tell it."""
    if saved is None or saved.told:
        return ()
    found = "drive power saved: none that can be told"
    if not math.isfinite(saved.error):
        return (f"{found}, since the error of the step is not known",)
    advice = saved.would_tell(judged.cycles // 3, longest)
    known = f"{found}, it is known to {saved.error:.2g} W"
    return (f"{known}: {advice} would tell about {abs(saved.power):.1g} W" if advice else known,)


def _of_step(problem: DriveProblem, off: StepError, longest: float) -> str:
    """Return the line about a step that is too long, or a motion that is like no other."""
    if off.elsewhere is not None:
        most = "greater" if off.elsewhere > 1.0 else "less"
        return (
            "in longer steps it came to another state that lasts, whose ratio is "
            f"{100.0 * abs(off.elsewhere - 1.0):.2g} % {most}: which one it is in follows from how "
            "it came there, and step_error is what they are apart"
        )
    found = f"the step makes an error of about {100.0 * off.ratio:.2g} % of the ratio"
    if not math.isfinite(off.ratio):
        found = "steps twice as long leave the finite numbers"
    if problem.solve.step is not None:
        if not math.isfinite(off.ratio):
            return f"{found}: give no solve.step, to have it chosen"
        return f"{found}: {smaller_step(longest, off.ratio / WANTED, order=1.0, sure=False)}"
    return (
        f"{found}, or the motion parts from its like by itself within a block of cycles; its mean "
        "over three of them is what stays"
    )

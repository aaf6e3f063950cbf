"""What a reader of a block's numbers should know."""

import math

from asperity.block.problem import BlockProblem
from asperity.block.solution.stability import Flutter, Stability, flutter_note
from asperity.contact.motion.ledger import ContactLedger
from asperity.contact.motion.steps import Stepper
from asperity.slider.timetable import WindowMeans, march_notes

_MOST_SLIP = 0.5

# Share of friction's power that rounding and the tolerance of the increments may give.
_MOST_GAIN = 1e-6

# Share of friction's power. A block that slides loses some 1e-5 of it to the time integration, and
# up to 1.5e-4 where the vibration has just begun; one that flutters 5e-4 and more.
_MOST_NUMERICAL = 3e-4


GAINS = (
    "asperities keep their deflection (friction.keeps), so that one which is pressed harder pulls "
    "harder without having slipped, and friction gives energy"
)


def block_notes(
    problem: BlockProblem,
    stepper: Stepper,
    powers: ContactLedger,
    window: WindowMeans,
    flutter: Flutter | None,
) -> tuple[str, ...]:
    """Return the notes of a march that came to its end.

    ``powers`` are means over the window; ``flutter`` is what grows as the block slides.
    """
    model, table, block = problem.model, problem.timetable, problem.block
    notes = [] if flutter is None else [flutter_note(problem, flutter)]
    if problem.tips:
        notes.append(
            "without vibration the block tips over before it slides: mu times its height, "
            f"{1e3 * model.friction.mu * block.size[2]:.4g} mm, is more than its length, "
            f"{1e3 * block.size[0]:.4g} mm"
        )
    notes += march_notes(window)
    if abs(powers.numerical) > _MOST_NUMERICAL * abs(powers.friction):
        notes.append(
            f"the time integration takes {powers.numerical:.2g} W, "
            f"{100.0 * powers.numerical / powers.friction:.2g} % of what friction does: something "
            "moves faster than the steps resolve, as a block does that flutters or bounces"
        )
    gain = stepper.sums.friction_gain / stepper.sums.time
    if problem.friction.keeps_deflection and gain > _MOST_GAIN * abs(powers.friction):
        notes.append(
            f"{GAINS}: {gain:.2g} W in the second half of the window, where it takes "
            f"{powers.friction:.2g} W"
        )
    slip = (model.slider.drive_velocity + model.peak_velocity) * table.step
    most = _MOST_SLIP * problem.friction.limit
    if model.friction.model != "coulomb" and slip > most:
        finer = table.step * most / slip
        notes.append(
            f"the slip in a step is up to {slip / problem.friction.limit:.2g} "
            "max_deflection, which blurs reversals of the slip; a solve.step of "
            f"{finer:.2g} s keeps it at {_MOST_SLIP:g}{_unless(problem, finer)}"
        )
    system = problem.system
    if system.impact(table.step) and system.resolving_step:
        finer = system.resolving_step
        notes.append(
            "the step does not resolve how fast the block bounces on its contact, "
            f"{system.bounce / (2e3 * math.pi):.3g} kHz: the time integration takes a beta of "
            f"{system.newmark_beta(table.step):.3g}, for impacts; a solve.step of "
            f"{finer:.2g} s resolves it{_unless(problem, finer)}"
        )
    if stepper.unconverged:
        notes.append(
            f"{stepper.unconverged} increments ended above the tolerance, at a relative "
            f"residual of up to {stepper.residual_max:.2g}, for want of digits: a softer "
            "contact does better"
        )
    if stepper.cuts:
        notes.append(f"{stepper.cuts} increments were not solved at once and were taken in halves")
    return tuple(notes)


def _unless(problem: BlockProblem, step: float) -> str:
    """Say that a step which would be better lets the block flutter."""
    if not Stability(problem).flutters_in_steps(step):
        return ""
    return ", but the block flutters there"

"""When a march takes its means, and what its reader should know of them."""

import functools
import math
from collections.abc import Sequence
from typing import NamedTuple

from asperity.errors import InputError
from asperity.results.settled import Standing
from asperity.slider.fading import still_to_come
from asperity.slider.model import WINDOW_SHARE, Model
from asperity.slider.parameters import in_proportion
from asperity.slider.substeps import CHANGE_BOUND, COULOMB_BOUND, RING_BOUND, SLIP_BOUND

BLOCK = 1024
"""Steps that a march takes at a time."""
_TAIL_CYCLES = 4
_TAIL_RECORDS = 4000
_MOST_STEPS = 1e10
_FEW = 3  # cycles of a window, of which a quarter has none whole
UNSTEADY = 1e-3
_ROUNDING = 1e-9  # of the drive velocity, by which a faster vibration turns nothing back
FAR = 2e-3  # of mu F_N, that a mean may be from where it goes to
NEAR_LIMIT = 0.75 * FAR  # as it is foreseen of asperities, of which up to a fifth more is left
LAGS = 0.02  # of its velocity, that a body may be slower than its drive
SHAKEN = 5e-4  # of the vibration, that the drive of the two-phase scheme adds unannounced
SHORT = 0.999  # of the usual window, one that has had no room for it
WAYS = 5.0  # of the drive over the deflection limit, in which the asperities are taken up


class Timetable:
    """Steps of a march: how many, and where its window and its finely recorded tail begin."""

    @in_proportion()
    def __init__(self, model: Model) -> None:
        # Counted in the steps asked for, so that rows stand at the same times however they are
        # divided.
        asked = model.duration / model.step
        if not asked * model.substeps <= _MOST_STEPS:
            raise InputError(
                f"solve.duration is {model.duration:g} s, {asked * model.substeps:.3g} steps of "
                f"{model.step / model.substeps:.3g} s; a march takes at most {_MOST_STEPS:g}: give "
                "a shorter duration or a larger step, or solve.method 'periodic'"
            )
        whole = round(asked)
        if model.vibrates:
            span = WINDOW_SHARE * max(whole * model.step - model.start, 0.0)
            self.cycles = math.floor(min(model.window, span) * model.frequency + 1e-9)
            if self.cycles < 1:
                raise InputError(
                    f"solve.duration is {model.duration:g} s; with the vibration of "
                    f"{model.frequency:g} Hz from {model.start:g} s on it must be at least "
                    f"{model.start + 1.5 / model.frequency:.7g} s"
                )
            window = round(self.cycles / (model.frequency * model.step))
            tail = round(_TAIL_CYCLES / (model.frequency * model.step))
        else:
            self.cycles = 0
            window = round(min(model.window, WINDOW_SHARE * model.duration) / model.step)
            tail = 0
        if whole < 8 or window < 2:
            raise InputError(
                f"solve.duration is {model.duration:g} s; it must be at least 8 steps of "
                f"{model.step:g} s"
            )
        window = min(window, whole)
        tail = min(tail, window // 2, _TAIL_RECORDS)
        parts = model.substeps
        self.parts = parts
        self.step = model.step / parts
        self.steps = whole * parts
        self.window = window * parts
        self.window_start = self.steps - self.window
        half = window // 2
        if self.cycles > 1 and self.cycles % 2:
            # Half a cycle more or less would tell the halves apart.
            half = round(self.cycles // 2 / (model.frequency * model.step))
        self.middle = self.window_start + half * parts
        self.tail = tail * parts

    @functools.cached_property
    def quarters(self) -> tuple[int, int, int]:
        """Steps at which the first three quarters of the window end, in whole blocks if it can be.

        Of a window that is shorter they are of whole cycles. Parts of cycles tell nothing: where a
        quarter has none whole, it has no span.
        """
        first, middle, third = self.whole_quarters
        few = 0 < self.cycles <= _FEW
        begins, ends = (self.window_start, middle), (first, third)
        lengths = middle - self.window_start, self.steps - middle
        early, late = (
            begin + (length // 2 // BLOCK * BLOCK or (0 if few else end - begin))
            for begin, end, length in zip(begins, ends, lengths, strict=True)
        )
        return early, middle, late

    @property
    def whole_quarters(self) -> tuple[int, int, int]:
        """Steps at which the first three quarters of the window end, of whole cycles if it can be.

        Of a window of three cycles and fewer, or of none at all, they are quarters of its steps.
        """
        parts = self.cycles // 2, self.cycles - self.cycles // 2
        spans = self.middle - self.window_start, self.steps - self.middle
        first, third = (
            round(span * (part // 2) / part) if self.cycles > _FEW else span // 2
            for span, part in zip(spans, parts, strict=True)
        )
        return self.window_start + first, self.middle, self.middle + third


def longest_march(model: Model) -> float:
    """Return the longest duration in s that a march takes in its steps."""
    return _MOST_STEPS * model.step / model.substeps


class WindowMeans(NamedTuple):
    """What a march has come to in its window; forces over mu F_N."""

    model: Model  #: The body, with the duration it was marched for
    table: Timetable  #: Its steps
    change: float  #: Of the mean drive force from the window's first half to its second
    quarters: Sequence[float]  #: Those of its quarters
    broke: bool  #: Whether the drive force has come to mu F_N
    across: float = 0.0  #: What `pull_across` gives
    across_at_most: tuple[float, float] = (0.0, 0.0)  #: Greatest friction across in its halves

    @property
    def residual(self) -> float:
        """How far the mean drive forces of the halves are apart."""
        return abs(self.change)

    @property
    def holds(self) -> bool:
        """Whether a body that nothing shakes still holds: it has not broken away.

        Asperities come ever nearer to their limit, and may never bear all of mu F_N; those whose
        limit falls with the speed bear more before they slide.
        """
        model, friction = self.model, self.model.friction
        if self.broke or model.vibrates or model.slider.rigid:
            return False
        falls = (friction.static_mu or friction.mu) > friction.mu
        return friction.model == "coulomb" or falls or not self.quarters[-1] >= 1.0 - FAR


def in_whose_window(model: Model, grown: float) -> float:
    """Return the duration in s in whose window nothing is from before a time in s."""
    share, start = WINDOW_SHARE, model.start
    return min(grown + model.window, (grown - share * start) / (1.0 - share))


def march_standing(window: WindowMeans) -> Standing:
    """Return whether a march has settled: by the halves of its window, if nothing is missing."""
    model, table, means, across = window.model, window.table, window.quarters, window.across
    residual = window.residual
    missing = []
    if window.holds:
        missing.append("the body has not broken away")
    if bending(model) > 0.0:
        missing.append("the asperities are still being taken up")
    if still_grows(model, table):
        missing.append("the vibration grows into the window of the means")
    if (ring := unseen_ring(model, table)) > 0.0:
        missing.append(
            f"the window of {table.window * table.step:.2g} s is shorter than one ring of the body "
            f"on its drive, {ring:.2g} s"
        )
    if not residual <= UNSTEADY:
        missing.append(f"the halves of the window differ by {residual:.2g} of mu F_N")
    elif (far := still_to_come(means)) > FAR:
        missing.append(f"the mean still goes {far:.2g} of mu F_N on, as it fades")
    if residual <= UNSTEADY and (far := still_to_bend(window)) > NEAR_LIMIT:
        slowly = " ever more slowly" if model.friction.exponent > 1.0 else ""
        missing.append(f"the asperities come to their limit{slowly}, {far:.2g} from it")
    missing += drifts_sideways(across)
    if residual <= UNSTEADY and still_loads(model, table, residual):
        missing.append("the drive is still being stretched: the body lags behind it")
    shown = f"the halves of the window agree to {UNSTEADY:g} of mu F_N"
    return Standing.of(missing, shown)


def bending(model: Model) -> float:
    """Deflection limit of asperities that are still being taken up at the end, m; 0 of none."""
    way = model.slider.drive_velocity * model.duration
    bent = 0.0
    if model.friction.model != "coulomb":
        bent = model.friction.deflection_limit(model.slider.normal_force)
    return bent if way < WAYS * bent else 0.0


def still_to_bend(window: WindowMeans) -> float:
    r"""How far the mean is from where Dahl's asperities come to, over mu F_N.

    Those with an exponent :math:`i` above 1 come to their limit as :math:`t^{-1/(i - 1)}`: what is
    left is :math:`i - 1` times the change in as long a time as has passed. Where nothing shakes
    them, of any exponent, it is what friction lacks, whatever ring there is on the drive.
    """
    model, table = window.model, window.table
    if model.friction.model == "dahl" and not model.vibrates:
        return max(1.0 - sum(window.quarters) / len(window.quarters), 0.0)
    if not bends_ever_more(model):
        return 0.0
    half = 0.5 * table.window * table.step
    change = window.residual * (model.duration - model.start) / half
    return (model.friction.exponent - 1.0) * change


def bends_ever_more(model: Model) -> bool:
    """Whether asperities come to their limit by a power of time: those that are not bent back."""
    friction = model.friction
    return friction.model == "dahl" and friction.exponent > 1.0 and not turns_back(model)


def turns_back(model: Model) -> bool:
    """Whether a vibration that is faster than the drive turns the slip back in every cycle."""
    along, across, _ = model.unit_direction
    flat = math.hypot(along, across) if model.friction.law == "vector" else abs(along)
    faster = flat * model.peak_velocity > (1.0 + _ROUNDING) * model.slider.drive_velocity
    return model.vibrates and faster


def still_loads(model: Model, table: Timetable, residual: float) -> bool:
    """Whether the drive is stretched in the window by more than a share of its way.

    A soft or slow drive gains less than is looked at in a window in which the body hardly moves.
    """
    slider = model.slider
    if slider.drive_stiffness is None:
        return False
    way = 0.5 * table.window * table.step * slider.drive_velocity
    return residual * model.full_friction > LAGS * way * slider.drive_stiffness


def unseen_ring(model: Model, table: Timetable) -> float:
    """Return the period of a ring of the body on its drive that is longer than the window, s.

    The means of less than one ring are those of where the body swings just then. Zero where the
    window has room for one, and where nothing rings.
    """
    slider = model.slider
    if slider.drive_stiffness is None or slider.mass is None:
        return 0.0
    if slider.drive_damping >= 2.0 * math.sqrt(slider.drive_stiffness * slider.mass):
        return 0.0
    return model.ring_period if table.window * table.step < model.ring_period else 0.0


def pull_across(model: Model, mean: float) -> float:
    """Return how far a mean friction across the drive, over mu F_N, is from where it comes to.

    Nothing else pushes a body sideways that is free to yield: in a state that lasts the mean is
    nothing.
    """
    return abs(float(mean)) if model.vibrates and model.slider.free else 0.0


def drifts_sideways(across: float) -> tuple[str, ...]:
    """Return what a body lacks on which friction still pulls sideways, see `pull_across`."""
    if not across > FAR:
        return ()
    return (
        f"the body drifts sideways: friction across, which comes to nothing, is {across:.2g} of "
        "mu F_N in the mean",
    )


def drifts_for(model: Model, across: float) -> float:
    r"""Return the time in which a sideways drift comes to what is steady enough, s.

    A body that is shaken at :math:`v_a` drifts as if friction were viscous, with a time constant of
    about :math:`m v_a/(\mu F_N)`.
    """
    if across <= FAR or model.slider.mass is None:
        return 0.0
    constant = model.slider.mass * model.peak_velocity / model.full_friction
    return constant * math.log(2.0 * across / FAR)


def still_grows(model: Model, table: Timetable) -> bool:
    """Whether the vibration grows into the window."""
    grown = model.start + model.ramp
    return model.vibrates and grown > (table.steps - table.window) * table.step * (1.0 + 1e-9)


def shaken_by_its_drive(model: Model) -> float:
    r"""Return by how much of the vibration the two-phase scheme's drive force shakes the body.

    Its stretch is that of a position relative to the base: :math:`k_d x_b` is in the force, and the
    body yields by :math:`k_d/(m\omega^2)` of it. Nothing of a body that is shaken itself.
    """
    slider = model.slider
    if model.solve.scheme != "two-phase" or model.on_body or not model.vibrates:
        return 0.0
    if slider.drive_stiffness is None or slider.mass is None:
        return 0.0
    turning = 2.0 * math.pi * model.frequency
    return abs(model.unit_direction[0]) * slider.drive_stiffness / (slider.mass * turning**2)


def march_notes(window: WindowMeans) -> tuple[str, ...]:
    """What a reader of a march's numbers should know."""
    model, table = window.model, window.table
    residual, notes = window.residual, []
    span = table.window * table.step
    if model.vibrates and span < SHORT * model.window - 1.0 / model.frequency:
        notes.append(
            f"the means are over {span:.3g} s: solve.duration has no room for the usual "
            f"{model.window:.3g} s"
        )
    if window.holds:
        notes.append("the body has not broken away; give a longer solve.duration")
    if (bent := bending(model)) > 0.0:
        way = model.slider.drive_velocity * model.duration
        notes.append(
            f"the drive goes {way:.2g} m, not {WAYS:g} times the {bent:.2g} m that asperities "
            "bend: the body is still being taken up; give a longer solve.duration"
        )
    if still_grows(model, table):
        notes.append(
            f"the vibration grows until {model.start + model.ramp:.3g} s, into the window of the "
            "means: give a longer solve.duration"
        )
    if residual > UNSTEADY:
        notes.append(
            "not steady: from the first to the second half of the window the mean drive force "
            f"changes by {residual:.2g} of mu F_N"
        )
    if (shaken := shaken_by_its_drive(model)) > SHAKEN:
        notes.append(
            "the two-phase scheme lets its drive pull with the base's motion, which shakes the "
            f"body by {shaken:.2g} of the vibration more; however small the step, the ratio may be "
            "off by as much of itself or some times that: leave solve.scheme out"
        )
    bound = model.substeps // model.finer
    if bound > 1 and model.friction.model == "coulomb":
        notes.append(
            f"each step of {model.step:g} s was divided by {bound}: the vibration's "
            f"velocity must not change by more than {COULOMB_BOUND:g} of the drive velocity in a "
            f"step, nor the step exceed {RING_BOUND:g} over the body's angular frequency"
        )
    elif bound > 1:
        notes.append(
            f"each step of {model.step:g} s was divided by {bound}: the slip in a step "
            f"must not exceed {SLIP_BOUND:g} max_deflection, nor change by more than "
            f"{CHANGE_BOUND:g} of it from step to step, nor the step exceed {RING_BOUND:g} "
            "over the body's angular frequency on its asperities"
        )
    if model.finer > 1:
        notes.append(
            f"each step was divided by {model.finer} more, for the error that it makes in the ratio"
        )
    return tuple(notes)

"""Contacts under a dead load that are damped so little that they ring as their vibration began.

What is damped a little rings for a time that is known beforehand: a window of the means tells
nothing of a ringing that has neither faded when it begins nor fades noticeably while it lasts.
"""

import cmath
import dataclasses
import math

import numpy as np

from asperity.arrays import FloatArray
from asperity.results.settled import Standing
from asperity.slider.model import WINDOW_SHARE, Model
from asperity.slider.result import SlideResult
from asperity.slider.timetable import FAR, UNSTEADY, turns_back

_LEVEL = 1e-9  # part of the vibration normal to the plane, below which it lifts nothing
_SURELY = 0.8  # of what is steady enough, that a ring shall have come down to
_NEAR = 1.01  # times the least duration that does, that may be told in its place
_GONE = -math.log(FAR)  # time constants, in which a ringing has come down to that
# Of a time constant, a window that tells a ringing that fades: its halves are then apart by a fifth
# of what the ringing does to the mean, and their quarters tell the rest.
_TELLS = 0.5
_SPARE = 1.25  # times, that friction may damp a ring less than Coulomb's
_TURNS, _BESIDE = 16384, 0.05  # points of a cycle; of the drive velocity, between which is a slope
FARTHEST = 16.0
"""Times the usual duration, that a march goes on by itself."""
_RINGS = (
    "nothing damps the contact: it rings as the vibration began, and the ratio follows that; "
    "shown is the state from this start, one of many (vibration.ramp has another); give a damping "
    "(normal.damping_ratio)"
)
UNHEARD = (
    "little or nothing damps the contact: it rings as the vibration began, but the ratio does not "
    "follow that: it is the same in the state next to it without a ring"
)
WHEN_SETTLED, WHEN_STEADY = "when it had settled", "when its means were steady"
"""How a note ends on a march that went on by itself; the latter of one that rings."""
OF_MANY = "the state is one of many: nothing damps the contact, and the ratio follows its ringing"


def ringing_time(model: Model) -> float:
    r"""Return the time constant of the contact's ringing, s: :math:`1/(\zeta\omega) = 2m/(cW)`.

    Zero where its vibration wakes none; infinite where nothing damps it.
    """
    normal, mass = model.normal, model.slider.mass
    if normal is None or mass is None or normal.control != "force":
        return 0.0
    if not model.vibrates or abs(model.unit_direction[2]) < _LEVEL:
        return 0.0
    rate = 0.5 * normal.loss(model.slider.normal_force, mass) * model.slider.normal_force / mass
    return 1.0 / rate if rate > 0.0 else math.inf


def rings_on_drive(model: Model) -> bool:
    r"""Whether a ring on the drive that nothing damps may keep the halves of a window apart.

    Friction damps none where the slip keeps its direction, as it does up to a ring's velocity of
    :math:`v_d - v_a`. Halves of a window of length :math:`T` differ by up to
    :math:`8m(v_d - v_a)/T`.
    """
    return model.slider.drive_damping == 0.0 and _ring_on_drive(model) > UNSTEADY * model.window


def _ring_on_drive(model: Model) -> float:
    """Return what a ring that friction does not damp makes halves differ by, times their span, s.

    Over mu F_N; zero where friction damps it.
    """
    slider, friction = model.slider, model.friction
    if slider.drive_stiffness is None or slider.mass is None:
        return 0.0
    damped = (friction.viscous_damping or 0.0) > 0.0 or turns_back(model)
    if damped or model.normal is not None or not model.vibrates:
        return 0.0
    along, across, _ = model.unit_direction
    if abs(across) > _LEVEL:
        return 0.0
    left = slider.drive_velocity - abs(along) * model.peak_velocity
    return max(8.0 * slider.mass * left / model.full_friction, 0.0)


def friction_on_ring(model: Model) -> float:
    r"""Return what friction that is shaken damps a slow motion along the drive by, N s/m.

    The slope of its mean at the drive velocity, of Coulomb's law along the slip: nothing where a
    vibration along the drive is slower than this, :math:`2\mu F_N/(\pi\sqrt{v_a^2 - v_d^2})` where
    it is faster. Asperities that bend by much of the vibration's amplitude damp less.
    """
    velocity, turn = model.slider.drive_velocity, np.linspace(0.0, 2.0 * np.pi, _TURNS + 1)[1:]
    along, across, _ = model.unit_direction
    shaken = model.peak_velocity * np.cos(turn)
    sideways = model.friction.transfer * across * shaken
    early, late = (
        float(np.mean(_along(share * velocity + along * shaken, sideways)))
        for share in (1.0 - _BESIDE, 1.0 + _BESIDE)
    )
    slope = (late - early) / (2.0 * _BESIDE * velocity)
    return model.full_friction * slope + (model.friction.viscous_damping or 0.0)


def _along(flat: FloatArray, sideways: FloatArray) -> FloatArray:
    """Part of Coulomb's friction along the drive, at slips; none where a body rests."""
    slip = np.hypot(flat, sideways)
    return np.divide(flat, slip, out=np.zeros_like(slip), where=slip > 0.0)


def rung_out(model: Model, *, with_friction: bool = False) -> float:
    r"""Return the duration in which a ring on the drive has faded by its damper, s.

    It begins where the body is taken up, and fades by :math:`e^{-ht/2m}`; what phase it has in the
    window is not known. Zero where there is none, or where friction damps it as well if that is
    not asked for.
    """
    slider, makes, damping = model.slider, _ring_on_drive(model), model.slider.drive_damping
    if with_friction and slider.mass is not None and slider.drive_stiffness is not None:
        if model.normal is not None or not model.vibrates:
            return 0.0
        makes = 8.0 * slider.mass * slider.drive_velocity / model.full_friction
        damping += friction_on_ring(model) / _SPARE
    if makes == 0.0 or damping == 0.0 or slider.mass is None:
        return 0.0
    stiffness = slider.drive_stiffness or math.inf
    begins = max(model.start, model.full_friction / (stiffness * slider.drive_velocity))
    rate, whole, least = 0.5 * damping / slider.mass, model.window, _SURELY * UNSTEADY
    if rate * model.ring_period >= 2.0 * math.pi:
        return 0.0

    def fades(duration: float, differ: float, window: float) -> bool:
        return differ * math.exp(-rate * max(duration - window - begins, 0.0)) <= least

    def in_part(duration: float) -> bool:
        window = min(whole, WINDOW_SHARE * (duration - model.start))
        return window > 0.0 and fades(duration, makes / window, window)

    roomy = max(model.start + whole / WINDOW_SHARE, model.duration)
    differ = min(makes * _seen_of_ring(model, rate), makes / whole)
    if not fades(roomy, differ, whole):
        return whole + begins + math.log(differ / least) / rate
    if in_part(model.duration):
        return model.duration
    # Less may do, in a shorter window; the longer it is, the less it shows of a ring.
    early, late = model.duration, roomy
    while late > _NEAR * early:
        middle = math.sqrt(early * late)
        early, late = (early, middle) if in_part(middle) else (middle, late)
    return late


def _seen_of_ring(model: Model, rate: float) -> float:
    r"""Return how far a ring makes the halves of a whole window differ, times their span, 1/s.

    Of a ring that makes them differ by one at most, at the worst phase. Means of :math:`e^{st}`
    with :math:`s = -h/2m + i\omega_d`: whole rings make next to nothing.
    """
    turn = 2.0 * math.pi / model.ring_period
    s = complex(-rate, 0.0) + cmath.sqrt(rate**2 - turn**2)
    cycles = max(math.floor(model.window * model.frequency + 1e-9), 2)
    half, window = cycles // 2 / model.frequency, cycles / model.frequency
    before = (cmath.exp(s * half) - 1.0) / (s * half)
    after = (cmath.exp(s * window) - cmath.exp(s * half)) / (s * (window - half))
    return 0.125 * turn * abs(after - before)


def faded_after(model: Model) -> float:
    """Return the duration of a march in whose window no ringing is left, s."""
    return model.start + model.ramp + _GONE * ringing_time(model) + model.window


def upward(duration: float) -> float:
    """Return a duration in s, rounded up to two digits."""
    digit = 10.0 ** (math.floor(math.log10(duration)) - 1)
    return math.ceil(duration / digit) * digit


def still_rings(model: Model, duration: float) -> bool:
    """Whether the means of a march of a duration in s are of a ringing that they do not show."""
    time = ringing_time(model)
    if time == 0.0 or duration >= faded_after(model) * (1.0 - 1e-9):
        return False
    window = min(model.window, WINDOW_SHARE * (duration - model.start))
    return not (math.isfinite(time) and window >= _TELLS * time)


def rings(model: Model, *, by_itself: bool = False) -> bool:
    """Whether a body's contact goes on ringing as the vibration began, for all that is marched.

    That is ``solve.duration``; left out, or ``by_itself``, as long as a march goes on by itself.
    """
    given = None if by_itself else model.solve.duration
    return still_rings(model, FARTHEST * model.usual_duration if given is None else given)


def heard(standing: Standing, model: Model, duration: float) -> Standing:
    """Return whether a march has settled that goes on until its ringing has faded, if it can."""
    if not standing.settled or model.solve.duration is not None:
        return standing
    if rings(model) or not still_rings(model, duration):
        return standing
    return Standing(False, "the contact still rings as the vibration began")


def lasting_ring(model: Model) -> str:
    """Say why the state of a contact that rings is one of many, and how long it does."""
    if math.isinf(ringing_time(model)):
        return OF_MANY
    return (
        "the state is one of many: so little damps the contact that it rings for "
        f"{_GONE * ringing_time(model):.2g} s, and the ratio follows its ringing"
    )


def ringing_notes(model: Model, *, follows: bool = True) -> tuple[str, ...]:
    """Say of a contact that rings on which of its states is shown, and if the ratio follows."""
    if not rings(model):
        return ()
    if not follows:
        return (UNHEARD,)
    if math.isinf(ringing_time(model)):
        return (_RINGS,)
    return (
        "little damps the contact: it rings as the vibration began, and the ratio follows that; "
        "shown is the state from this start; it has faded to "
        f"{FAR:g} in the means of a solve.duration of {upward(faded_after(model)):.3g} s",
    )


def as_it_rings(answer: SlideResult) -> SlideResult:
    """Return a march's answer; that of a contact that rings on as not settled.

    Its means are steady, but those of another start are others: a periodic search says the same,
    and neither does where the ratio does not follow the ring.
    """
    if not (answer.settled and rings(answer.model)) or UNHEARD in answer.notes:
        return answer
    by = f"{answer.settled_by}, but {lasting_ring(answer.model)}"
    notes = tuple(note.replace(WHEN_SETTLED, WHEN_STEADY) for note in answer.notes)
    return dataclasses.replace(answer, settled=False, settled_by=by, step_error=None, notes=notes)

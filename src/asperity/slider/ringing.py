"""Contacts under a dead load that are damped so little that they ring as their vibration began.

What is damped a little rings for a time that is known beforehand: a window of the means tells
nothing of a ringing that has neither faded when it begins nor fades noticeably while it lasts.
"""

import dataclasses
import math

from asperity.results.settled import Standing
from asperity.slider.model import WINDOW_SHARE, Model
from asperity.slider.result import SlideResult
from asperity.slider.timetable import FAR

_LEVEL = 1e-9  # part of the vibration normal to the plane, below which it lifts nothing
_GONE = -math.log(FAR)  # time constants, in which a ringing has come down to that
# Of a time constant, a window that tells a ringing that fades: its halves are then apart by a fifth
# of what the ringing does to the mean, and their quarters tell the rest.
_TELLS = 0.5
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

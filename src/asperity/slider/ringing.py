"""Contacts under a dead load that nothing damps: they ring as their vibration began, for ever."""

import dataclasses

from asperity.slider.model import Model
from asperity.slider.result import SlideResult

_LEVEL = 1e-9  # part of the vibration normal to the plane, below which it lifts nothing
_RINGS = (
    "nothing damps the contact: it rings as the vibration began, and the ratio follows that; "
    "shown is the state from this start, one of many (vibration.ramp has another); give a damping "
    "(normal.damping_ratio)"
)
OF_MANY = "the state is one of many: nothing damps the contact, and the ratio follows its ringing"


def rings(model: Model) -> bool:
    """Whether a body's contact goes on ringing as the vibration began."""
    normal, mass = model.normal, model.slider.mass
    if normal is None or mass is None or normal.control != "force":
        return False
    if not model.vibrates or abs(model.unit_direction[2]) < _LEVEL:
        return False
    return not normal.loss(model.slider.normal_force, mass) > 0.0


def ringing_notes(model: Model) -> tuple[str, ...]:
    """Say of a contact that rings for ever which of its states is shown."""
    return (_RINGS,) if rings(model) else ()


def as_it_rings(answer: SlideResult) -> SlideResult:
    """Return a march's answer; that of a contact that rings for ever as not settled.

    Its means are steady, but those of another start are others: a periodic search says the same.
    """
    if not (answer.settled and rings(answer.model)):
        return answer
    by = f"{answer.settled_by}, but {OF_MANY}"
    return dataclasses.replace(answer, settled=False, settled_by=by, step_error=None)

"""How long a solution will take, roughly, so that a long one can be announced."""

from asperity.slider.model import Model
from asperity.slider.periodic import cycle_steps
from asperity.slider.timetable import Timetable

# Of one step of one body on one core of a common machine, s; of sixteen springs.
_STEP = {"coulomb": 120e-9, "dahl": 90e-9, "lugre": 500e-9, "springs": 150e-9}
_POWERS = 3.0  # of Dahl's law with an exponent other than 1, which takes roots
_PRESSED = 1.2  # of a body that is pressed, lifts and lands
_CYCLES = 20  # of a periodic state
_TABLE = 120  # periodic states of a homogenised law


def estimate(model: Model) -> float:
    """Return roughly how long a body takes to solve, s.

    Raises
    ------
    InputError
        The case cannot be solved.
    """
    if model.solve.method == "march":
        return _step(model) * Timetable(model).steps
    points = _TABLE if model.solve.method == "homogenised" and model.vibrates else 1
    return time_of_cycles(model, points * _CYCLES)


def time_of_cycles(model: Model, count: int) -> float:
    """Return roughly how long a number of cycles takes, s."""
    return _step(model) * count * cycle_steps(model)


def _step(model: Model) -> float:
    step = _STEP[model.friction.model]
    if model.friction.model == "dahl" and model.friction.exponent != 1.0:
        step *= _POWERS
    return step if model.normal is None else step * _PRESSED

"""How long a solution will take, roughly, so that a long one can be announced."""

from asperity.slider.model import Model
from asperity.slider.periodic import cycle_steps
from asperity.slider.timetable import Timetable

ANNOUNCED = 60.0  # s

# Of one step of one body on one core of a common machine, s.
_STEP = {"coulomb": 120e-9, "dahl": 90e-9, "lugre": 500e-9}
_POWERS = 3.0  # of Dahl's law with an exponent other than 1, which takes roots
_CYCLES = 20  # of a periodic state
_TABLE = 120  # periodic states of a homogenised law


def estimate(model: Model) -> float:
    """Return roughly how long a body takes to solve, s.

    Raises
    ------
    InputError
        The case cannot be solved.
    """
    step = _STEP[model.friction.model]
    if model.friction.model == "dahl" and model.friction.exponent != 1.0:
        step *= _POWERS
    if model.solve.method == "march":
        return step * Timetable(model).steps
    points = _TABLE if model.solve.method == "homogenised" and model.vibrates else 1
    return step * points * _CYCLES * cycle_steps(model)


def announcement(seconds: float, what: str) -> str:
    """Return a line about a long work: ``9e+09 steps take about 15 min``."""
    for unit, size in (("d", 86400.0), ("h", 3600.0), ("min", 60.0)):
        if seconds >= 2.0 * size:
            return f"{what} take about {seconds / size:.0f} {unit}"
    return f"{what} take about {seconds:.0f} s"

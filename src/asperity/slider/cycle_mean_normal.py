"""What a cycle-mean law knows of the normal direction: from a state to its table, and from it."""

from collections.abc import Callable, Mapping
from typing import Any

from asperity.arrays import FloatArray
from asperity.results.ledger import PressedLedger
from asperity.slider.model import Model
from asperity.slider.result import SlideResult
from asperity.slider.space import NormalMotion

_MOST_GAIN = 1e-9  # of the friction power: rounding
_GREATEST = {"normal_max", "penetration_swing", "critical_velocity"}


def told_by(answer: SlideResult) -> dict[str, float]:
    """Return what a state tells of the normal direction, by the names of its fields."""
    if answer.normal is None or not isinstance(answer.ledger, PressedLedger):
        return {}
    told = {name: value for name, value in vars(answer.normal).items() if value is not None}
    told.pop("ratio_mean_load", None)  # follows from the others
    return told | {
        "normal": answer.ledger.normal,
        "contact_damping": answer.ledger.contact_damping,
    }


def remarks_of(answer: SlideResult) -> tuple[str, ...]:
    """Return what a reader should know of the state of a pressed body, but for its heat."""
    if answer.normal is None:
        return ()
    of_wear = () if answer.wear is None else answer.wear.notes
    return tuple(note for note in answer.notes if note not in of_wear)


def mean_motion(
    model: Model,
    told: Mapping[str, FloatArray],
    steady: Mapping[str, FloatArray] | None,
    mean: Callable[[FloatArray], float],
    drive_force: float,
) -> NormalMotion:
    """Return what happens normal to the plane while a body goes at some velocities.

    Parameters
    ----------
    model : Model
        The body.
    told : mapping of str to ndarray
        What the law names at these velocities.
    steady : mapping of str to ndarray, shapes (1,), or None
        The same at the drive velocity, if the body goes at no other.
    mean : callable
        Mean over the velocities.
    drive_force : float
        Mean drive force, N.
    """
    means: dict[str, Any] = dict.fromkeys(("critical_velocity", "contact_frequency"))
    means |= {name: mean(values) for name, values in told.items()}
    means |= {name: float(told[name].max()) for name in _GREATEST & told.keys()}
    means["normal_min"] = float(told["normal_min"].min())
    means["period"] = means["multiplier"] = None
    if steady is not None:
        means["period"] = round(float(steady["period"][0]))
        means["multiplier"] = float(steady["multiplier"][0])
    full = model.friction.mu * means["normal_mean"]
    ratio = drive_force / full if full > 0.0 else None
    return NormalMotion(ratio_mean_load=ratio, **means)


def gain_notes(model: Model, motion: NormalMotion, lost: float) -> tuple[str, ...]:
    """Say what friction gave in the mean, which it can where asperities keep their deflection."""
    if not (model.friction.keeps == "deflection" and motion.friction_gain > _MOST_GAIN * lost):
        return ()
    return (
        f"over the window friction gave {motion.friction_gain:.3g} W, which it can with "
        "friction.keeps 'deflection'; 'stiffness' gains nothing",
    )

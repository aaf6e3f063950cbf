"""The periodic states that a cycle-mean law is tabulated from, by mean velocity."""

import dataclasses
import math
from collections.abc import Iterable
from typing import NamedTuple

from asperity.errors import ConvergenceError, InputError
from asperity.slider.from_rest import SAME
from asperity.slider.model import Model
from asperity.slider.periodic import solve_periodic
from asperity.slider.result import SlideResult

_MOST_MISSING = 0.2
_ELSEWHERE = "a body from rest comes to another state than that of the law"


def states(
    model: Model, velocities: Iterable[float]
) -> tuple[dict[float, SlideResult], list[float]]:
    """Periodic states by mean velocity in m/s, and the velocities without one."""
    velocities = [float(v) for v in velocities]
    drive = model.slider.drive_velocity
    model = _at(model, drive)  # of a given amplitude, which the others share
    found: dict[float, SlideResult] = {}
    missing: list[float] = []
    for velocity in velocities:
        try:
            there = _at(model, velocity)
            found[velocity] = solve_periodic(there, history=False, judged=velocity == drive)
        except (ConvergenceError, InputError) as error:
            # A step can be too coarse at the table's ends; at the drive velocity it is the case's.
            if isinstance(error, InputError) and velocity == drive:
                raise
            missing.append(velocity)
            if len(missing) > _MOST_MISSING * len(velocities):
                raise ConvergenceError(
                    f"no periodic state was found at more than a fifth of {len(velocities)} mean "
                    f"velocities, at {velocity:.4g} m/s: {error}",
                    reached=getattr(error, "reached", None),
                ) from None
    return found, missing


def as_fine_as_asked(model: Model) -> Model:
    """Return the model with the step that the state at the drive velocity asks for."""
    if model.solve.step is not None:
        return model
    try:
        at_drive = solve_periodic(_at(model, model.slider.drive_velocity), history=False)
    except (ConvergenceError, InputError):
        return model
    return dataclasses.replace(model, finer=at_drive.model.finer)


class BesideRest(NamedTuple):
    """What a body from rest does beside a state of a law.

    Attributes
    ----------
    otherwise : str
        What else it comes to; empty where it comes to the state.
    ratio : float or None
        That it settles at, where that is another.
    remarks : tuple of str
        What else a reader should know.
    """

    otherwise: str = ""
    ratio: float | None = None
    remarks: tuple[str, ...] = ()


def beside_rest(state: SlideResult | None) -> BesideRest:
    """Return what a body from rest does beside a state of a law, if there is one that stays.

    The others are sought as this one is, and next to it: where a body from rest comes to another,
    the law is of a motion that it is not in.
    """
    if state is None or not state.settled:
        return BesideRest()
    try:
        rested = solve_periodic(state.model, history=False, judged=False, rested=True)
    except ConvergenceError as error:
        return BesideRest(f"what a body from rest comes to was not found: {error}")
    if not rested.settled:
        return BesideRest(f"{_ELSEWHERE}: {rested.settled_by}")
    if abs(rested.ratio - state.ratio) <= SAME:
        return BesideRest(remarks=tuple(note for note in rested.notes if note not in state.notes))
    return BesideRest(f"{_ELSEWHERE}, with the ratio {rested.ratio:.5g}", rested.ratio)


def _at(model: Model, velocity: float) -> Model:
    """Return the model with a mean velocity; backwards its vibration is turned by half a turn."""
    if model.vibration is None:
        raise InputError("nothing vibrates")
    slider = model.slider.model_copy(update={"drive_velocity": abs(velocity)}, units="SI")
    if velocity > 0.0 and model.vibration.displacement_amplitude is not None:
        return dataclasses.replace(model, slider=slider)
    vibration = model.vibration.model_copy(
        update={
            "velocity_ratio": None,
            "velocity_amplitude": None,
            "displacement_amplitude": model.amplitude,
            "direction": model.direction + (math.pi if velocity < 0.0 else 0.0),
        },
        units="SI",
    )
    return dataclasses.replace(model, slider=slider, vibration=vibration)

"""What a rating starts from; power or torque of the worm may be given in place of the wheel's."""

import math
from collections.abc import Sequence

from asperity.errors import InputError
from asperity.gearset.parameters import Gearset
from asperity.rating.inputs import Inputs, inputs
from asperity.rating.iso14521.calculation import film_parameter_of, rated_efficiency
from asperity.rating.iso14521.film_failure import FilmParameterError
from asperity.rating.load_steps import LOADS
from asperity.rating.parameters import Operation, RatingOptions


def driven(
    gearset: Gearset, operation: Operation, options: RatingOptions | None = None
) -> Operation:
    """Return an operation with the rated torque of the wheel, as it is where that is given.

    The losses of ISO/TR 14521 are a constant and a share of the torque of the wheel, so that
    power and torque of the worm give it without a search.

    Raises
    ------
    InputError
        What drives does not even turn the gearbox without load, or the standard has no answer.
    """
    return _steps_driven(gearset, _driven(gearset, operation, options), options)


def given_of(
    gearset: Gearset, operation: Operation, options: RatingOptions, wanted: Sequence[str]
) -> Inputs:
    """Return what a rating starts from, refused where the gearset's numbers do not go together."""
    given = inputs(gearset, driven(gearset, operation, options), options)
    _require_consistent(given, "iso14521" in wanted)
    return given


def _driven(gearset: Gearset, operation: Operation, options: RatingOptions | None) -> Operation:
    key = operation.driven_by
    if not key:
        return operation
    power = operation.input_power or operation.worm_speed * (operation.input_torque or 0.0)
    idle, share = _put_in(gearset, operation, options, operation.worm_speed)
    _require_more(
        f"operation.{key}", key, getattr(operation, key), idle, operation.worm_speed, power
    )
    found = (power - idle) / share
    assert math.isfinite(found)
    return operation.model_copy(update={"output_torque": found}, units="SI")


def _steps_driven(
    gearset: Gearset, operation: Operation, options: RatingOptions | None
) -> Operation:
    """Return the operation with the torque of the wheel in each of its steps."""
    steps = operation.steps or ()
    if all(step.output_torque for step in steps):
        return operation
    name = "spectrum.step" if operation.spectrum is not None else "operation.duty_cycle"
    found, known = [], {}
    for step in steps:
        key = next((key for key in LOADS if getattr(step, key) is not None), LOADS[0])
        if key == "output_torque":
            found.append(step)
            continue
        speed = step.worm_speed or operation.worm_speed
        if speed not in known:
            known[speed] = _put_in(gearset, operation, options, speed)
        idle, share = known[speed]
        given = getattr(step, key)
        power = given if key == "input_power" else given * speed
        _require_more(f"{name}.{key}", key, given, idle, speed, power)
        torque = {"output_torque": (power - idle) / share}
        found.append(step.model_copy(update=torque, units="SI"))
    return operation.with_steps(tuple(found))


def _put_in(
    gearset: Gearset, operation: Operation, options: RatingOptions | None, speed: float
) -> tuple[float, float]:
    """Return the power of the worm without load, W, and that for each N m of the wheel."""
    put_in = []
    for torque in (1.0, 2.0):
        update = {"output_torque": torque, "worm_speed": speed, **_WITHOUT}
        run = operation.model_copy(update=update, units="SI")
        given = inputs(gearset, run, options or RatingOptions())
        put_in.append(float(rated_efficiency(given)["input_power_W"]))
    share = put_in[1] - put_in[0]
    return put_in[0] - share, share


def _require_more(
    name: str, key: str, value: float, idle: float, speed: float, power: float
) -> None:
    if power > idle:
        return
    unit, least = ("W", idle) if key == "input_power" else ("N m", idle / speed)
    raise InputError(
        f"{name} is {value:.4g} {unit}; without load the gearbox takes "
        f"{least:.4g} {unit} by ISO/TR 14521: give more, or {name.rpartition('.')[0]}.output_torque"
    )


_WITHOUT = {"through_travel_torque": None, "duty_cycle": None, "spectrum": None}


def torque_notes(operation: Operation, driven_by: Operation) -> tuple[str, ...]:
    """Return what is to be said of a torque that follows."""
    key = operation.driven_by
    followed = f"T_R = {driven_by.output_torque:.4g} N m follows from operation.{key}"
    return (f"{followed}, by the losses of ISO/TR 14521",) if key else ()


def _require_consistent(inputs: Inputs, by_iso: bool) -> None:
    """Raise InputError where the gearset's numbers do not belong together."""
    try:
        inputs.gearset.require_consistent()
    except InputError as error:
        # The end of h* tells more about a ratio or module that is too large.
        try:
            if by_iso:
                film_parameter_of(inputs)
        except FilmParameterError as film:
            raise FilmParameterError(
                f"{film}; {error}", film.value, film.driver, film.limits
            ) from None
        raise

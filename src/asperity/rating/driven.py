"""The torque of the wheel where power or torque of the worm is given in its place."""

import math

from asperity.errors import InputError
from asperity.gearset.parameters import Gearset
from asperity.rating.inputs import inputs
from asperity.rating.iso14521.calculation import rated_efficiency
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
    key = operation.driven_by
    if not key:
        return operation
    power = operation.input_power or operation.worm_speed * (operation.input_torque or 0.0)
    put_in = []
    for torque in (1.0, 2.0):
        run = operation.model_copy(update={"output_torque": torque, **_WITHOUT}, units="SI")
        given = inputs(gearset, run, options or RatingOptions())
        put_in.append(float(rated_efficiency(given)["input_power_W"]))
    share = put_in[1] - put_in[0]
    idle = put_in[0] - share
    if not power > idle:
        value, unit = getattr(operation, key), "W" if key == "input_power" else "N m"
        least = idle if key == "input_power" else idle / operation.worm_speed
        raise InputError(
            f"operation.{key} is {value:.4g} {unit}; without load the gearbox takes "
            f"{least:.4g} {unit} by ISO/TR 14521: give more, or operation.output_torque"
        )
    found = (power - idle) / share
    assert math.isfinite(found)
    return operation.model_copy(update={"output_torque": found}, units="SI")


_WITHOUT = {"through_travel_torque": None, "duty_cycle": None}


def told_of(operation: Operation, driven_by: Operation) -> tuple[str, ...]:
    """Return what is to be said of a torque that follows."""
    key = operation.driven_by
    followed = f"T_R = {driven_by.output_torque:.4g} N m follows from operation.{key}"
    return (f"{followed}, by the losses of ISO/TR 14521",) if key else ()

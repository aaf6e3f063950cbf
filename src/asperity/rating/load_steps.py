"""A step of a load: what the gearset carries for a part of its life."""

from collections.abc import Mapping
from typing import Annotated, Any, ClassVar, Literal

from asperity.casefile import Table
from asperity.errors import InputError, shown
from asperity.units import Quantity

Torque = Annotated[float, Quantity("N m", what="a torque", example="366 N m", gt=0)]
Power = Annotated[float, Quantity("W", what="a power", example="0.25 kW", gt=0)]
Time = Annotated[float, Quantity("s", what="a time", example="25000 h", gt=0)]
Speed = Annotated[float, Quantity("rad/s", what="a speed of rotation", example="1440 rpm", gt=0)]
Turns = Annotated[float, Quantity("", what="a number of turns", example="500000", gt=0)]
Starts = Annotated[float, Quantity("", what="a number", example="30", ge=0)]

LOADS = ("output_torque", "input_power", "input_torque")
"""The forms of a load; exactly one is given."""


class LoadStep(Table):
    """A part of a duty cycle.

    Parameters
    ----------
    duration : float or str
        s ("10 h" in a file), of the whole life; or ``turns``.
    turns : float, optional
        Turns of the wheel in place of the duration.
    output_torque : float or str
        Wheel torque, N m, at most the rated one; or ``input_power`` or ``input_torque``.
    input_power, input_torque : float or str, optional
        Power, W, or torque, N m, of the worm in its place; the wheel's torque follows by the losses
        of ISO/TR 14521.
    worm_speed : float or str, optional
        rad/s; that of the operation if left out.
    rotation : {'both', 'clockwise', 'anticlockwise'}
        Of the worm, seen from the end it is driven at.
    drives : {'worm', 'load'}
        Whether the worm drives, or the load does while it is let down.
    starts_per_hour : float, optional
        Those of the operation if left out.
    """

    table: ClassVar[str] = "operation.duty_cycle"
    required_alternatives: ClassVar[tuple[tuple[str, ...], ...]] = (("duration", "turns"), LOADS)

    duration: Annotated[float, Quantity("s", what="a time", example="10 h", gt=0)] | None = None
    turns: Turns | None = None
    output_torque: Torque | None = None
    input_power: Power | None = None
    input_torque: Torque | None = None
    worm_speed: Speed | None = None
    rotation: Literal["both", "clockwise", "anticlockwise"] = "both"
    drives: Literal["worm", "load"] = "worm"
    starts_per_hour: Starts | None = None

    @property
    def torque(self) -> float:
        """Torque of the wheel, N m; it is known once what drives has been turned into it."""
        assert self.output_torque is not None
        return self.output_torque


class SpectrumStep(LoadStep):
    """A step of a load spectrum.

    Parameters
    ----------
    duration, turns, share : float or str
        s, of the whole life; or turns of the wheel in its place; or a share of ``spectrum.life``,
        0 to 1.
    output_torque, input_power, input_torque : float or str
        As in a duty cycle, exactly one of them.
    worm_speed, rotation, drives, starts_per_hour : float or str
        As in a duty cycle.
    """

    table: ClassVar[str] = "spectrum.step"
    required_alternatives: ClassVar[tuple[tuple[str, ...], ...]] = (
        ("duration", "turns", "share"),
        LOADS,
    )

    share: Annotated[float, Quantity("", what="a share", example="0.1", gt=0, le=1)] | None = None


def steps_of(
    value: Any, context: Any, key: str, kind: type[LoadStep] = LoadStep
) -> tuple[LoadStep, ...]:
    """Return the steps of a list of tables; raises InputError for what is none."""
    listed = isinstance(value, list | tuple) and len(value) > 0
    if not listed or not all(isinstance(step, Mapping | LoadStep) for step in value):
        raise InputError(
            f"{key} is {shown(value)}; it must be a list of tables with "
            "'duration', 'output_torque' and perhaps 'worm_speed'"
        )
    return tuple(
        step if isinstance(step, LoadStep) else kind.model_validate(step, context=context)
        for step in value
    )

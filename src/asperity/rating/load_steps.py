"""A step of a load: what the gearset carries for a part of its life."""

import functools
from collections.abc import Mapping
from typing import Annotated, Any, ClassVar, Literal

from asperity.casefile import Table
from asperity.errors import InputError, shown
from asperity.units import Quantity, quantity_of, split_unit

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
    """Return the steps of a list of tables or of a text; raises InputError for what is none."""
    if isinstance(value, str):
        value = [_written(text, key, kind) for text in value.strip("; \n").split(";")]
    listed = isinstance(value, list | tuple) and len(value) > 0
    if not listed or not all(isinstance(step, Mapping | LoadStep) for step in value):
        raise InputError(
            f"{key} is {shown(value)}; it must be a list of tables with "
            f"'duration', 'output_torque' and perhaps 'worm_speed', or as {_EXAMPLE!r}"
        )
    return kind.each_of(value, context, key)


_EXAMPLE = "250 N m, 1400 rpm, 500 h; 60 N m, 700 rpm, 3000 h"
_BY_UNIT = ("duration", "output_torque", "worm_speed", "input_power")
_WORDS = {
    "clockwise": ("rotation", "clockwise"),
    "anticlockwise": ("rotation", "anticlockwise"),
    "load drives": ("drives", "load"),
}


def _written(text: str, key: str, kind: type[LoadStep]) -> dict[str, str]:
    """Return the keys of a step that is written as "250 N m, 1400 rpm, 500 h"."""
    step: dict[str, str] = {}
    for part in text.split(","):
        name, equals, value = (each.strip() for each in part.partition("="))
        if not equals:
            value = " ".join(name.split())
            named = _WORDS.get(value)
            name, value = named or (_named_by_unit(value, kind), value.removesuffix(" turns"))
        if name in step:
            raise InputError(f"{key} is {shown(text.strip())}, which says {name} twice")
        if name not in kind.model_fields:
            share = " or share" if "share" in kind.model_fields else ""
            raise InputError(
                f"{key} is {shown(text.strip())}; {shown(part.strip())} is no torque, time, speed, "
                f"power, number of turns{share}, nor {', '.join(_WORDS)} or key=value: write it "
                f"as {_EXAMPLE!r}"
            )
        step[name] = value
    return step


def _named_by_unit(text: str, kind: type[LoadStep]) -> str:
    number, unit = split_unit(text) or ("", "")
    return _key_of(unit, kind) if number and unit else ""


@functools.lru_cache(maxsize=256)
def _key_of(unit: str, kind: type[LoadStep]) -> str:
    """Return which key of a step has such a unit, "" where none has."""
    if unit in ("turns", "%"):
        return "turns" if unit == "turns" else "share"
    for key in _BY_UNIT:
        quantity = quantity_of(kind, key)
        assert quantity is not None
        try:
            quantity.check(f"1 {unit}")
        except InputError:
            continue
        return key
    return ""

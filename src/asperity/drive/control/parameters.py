"""The `[control]` table: what turns the vibration on where a stroke needs it, and off again."""

from typing import Annotated, Any, ClassVar, Literal

from pydantic import Field, field_validator, model_validator

from asperity.casefile import Table
from asperity.errors import InputError, choices, shown
from asperity.units import Quantity

ELECTRONIC = ("dead", "latched", "broken", "full", "frozen", "frozen-seat")
CLUTCH = ("dead", "latched")
FAILURES = {
    "dead": "the vibration never comes",
    "latched": "once on, it is not let go",
    "broken": "from half the stroke on the sensor reads nothing",
    "full": "from half the stroke on it reads its full scale",
    "frozen": "from half the stroke on it keeps its last reading",
    "frozen-seat": "from half the first seat on it keeps its last reading",
}
"""What fails, and how; a clutch has no sensor."""

_Torque = Annotated[float, Quantity("N m", what="a torque", example="2.2 N m", gt=0, le=1e9)]
_Time = Annotated[float, Quantity("s", what="a time", example="1 ms", ge=0, le=1e3)]


class Control(Table):
    r"""What turns the vibration on where a stroke needs it, and off again.

    Parameters
    ----------
    kind : {'electronic', 'clutch'}
        A controller with a sensor; or a cam on the worm (``vibration.frequency = "12 per turn"``)
        behind a clutch that the worm's thrust closes against a spring. Of a cam the motor gives
        the power.
    sensor : {'motor', 'thrust'}
        What is read: the torque of the worm's shaft, or the worm's thrust, told as the torque of
        the wheel that it belongs to. A clutch goes by the thrust.
    on, off : float or str
        Reading from which on the vibration comes, and down to which it goes again, N m; ``off`` is
        below ``on``.
    filter : {'lowpass', 'cycles', 'none'}
        Before the sampling: equal low passes of first order one after the other; the mean over
        whole cycles of the vibration; nothing.
    cutoff : float or str
        Where the low passes together leave :math:`1/\sqrt 2`, Hz.
    order : int
        How many they are, 1 to 8.
    cycles : int
        Of the vibration, that the mean is over, 1 to 10000.
    sample_rate : float or str
        Readings a second, Hz.
    noise : float or str
        Standard deviation of a reading, N m.
    delay : float or str
        From a reading to what it switches, s.
    rise : float or str, optional
        Time in which the amplitude comes to :math:`1 - 1/e`, and goes to :math:`1/e`, s. Left out:
        that of the ``[actuator]``'s resonance, :math:`Q/(\pi f)`; at once where there is none, and
        of a clutch.
    begins_on : bool
        Whether a stroke begins shaken: a stroke begins at a seat, and what waits for a reading
        comes after the torque. Of a clutch: never.
    interlock : bool
        Whether the vibration is cut with the motor, whatever the controller says. A cam stands
        with the worm.
    cut_ahead : float or str
        Time before the motor's stop at which the vibration is cut, s: what still swings when the
        motor stops sets the load free.
    seat_edge : float or str
        Turn of the wheel over which the seat's torque falls, and rises again, rad.
    dogs : int
        Places in a turn of the worm where a clutch can close or open, 1 to 1000.
    full_scale : float or str, optional
        Of the sensor, N m. Left out: twice what it reads at the seat without vibration.
    frozen_after : float or str, optional
        Time without any change of a reading after which the sensor is taken for frozen, s; it
        takes a ``noise``. Left out: it is not watched.
    longest_on : float or str, optional
        Time that a vibration may last, s; longer is taken for a fault. Left out: any.
    motor_torque : float or str, optional
        The greatest that the motor gives, N m.
    peak_time : float or str
        Time over which the motor's greatest torque is a mean, s: shorter ones its inertia takes.
    failures : list of str
        Which are tried beside the stroke without: ``dead``, ``latched``, ``broken``, ``full``,
        ``frozen``, ``frozen-seat``; of a clutch the first two. Left out: all.
    seed : int
        Of the noise.
    """

    table: ClassVar[str] = "control"

    kind: Literal["electronic", "clutch"] = "electronic"
    sensor: Literal["motor", "thrust"] = "thrust"
    on: _Torque
    off: _Torque
    filter: Literal["lowpass", "cycles", "none"] = "lowpass"
    cutoff: Annotated[float, Quantity("Hz", what="a frequency", example="200 Hz", gt=0, le=1e7)] = (
        200.0
    )
    order: Annotated[int, Field(strict=True, ge=1, le=8)] = 2
    cycles: Annotated[int, Field(strict=True, ge=1, le=10000)] = 20
    sample_rate: Annotated[float, Quantity("Hz", what="a rate", example="1 kHz", gt=0, le=1e5)] = (
        1000.0
    )
    noise: Annotated[float, Quantity("N m", what="a torque", example="0.01 N m", ge=0, le=1e9)] = (
        0.0
    )
    delay: _Time = 1e-3
    rise: _Time | None = None
    begins_on: bool = True
    interlock: bool = True
    cut_ahead: _Time = 0.0
    seat_edge: Annotated[float, Quantity("rad", what="an angle", example="1 deg", ge=0, le=1e6)] = (
        0.017453292519943295
    )
    dogs: Annotated[int, Field(strict=True, ge=1, le=1000)] = 1
    full_scale: _Torque | None = None
    frozen_after: _Time | None = None
    longest_on: _Time | None = None
    motor_torque: _Torque | None = None
    peak_time: Annotated[float, Quantity("s", what="a time", example="10 ms", gt=0, le=10)] = 10e-3
    failures: tuple[str, ...] | None = None
    seed: Annotated[int, Field(strict=True, ge=0, le=2**32 - 1)] = 1

    @field_validator("failures", mode="before")
    @classmethod
    def _listed(cls, value: Any) -> Any:
        if isinstance(value, str):
            value = [each.strip() for each in value.split(",") if each.strip()]
        for each in value or ():
            if each not in FAILURES:
                raise InputError(
                    f"control.failures has {shown(each)}; it must be of {choices(tuple(FAILURES))}"
                )
        return value

    @model_validator(mode="after")
    def _consistent(self) -> "Control":
        if not self.off < self.on:
            raise InputError(
                f"control.off is {self.off:g} N m and control.on {self.on:g} N m; off must be "
                "below on, or every reading between would switch"
            )
        if self.frozen_after is not None and self.noise == 0.0:
            raise InputError(
                "control.frozen_after is given, but control.noise is 0: without noise a good "
                "reading stands still as well; give the sensor's noise, or leave it out"
            )
        if self.kind == "clutch":
            if "sensor" in self.model_fields_set and self.sensor != "thrust":
                raise InputError(
                    "control.sensor is 'motor', but a clutch is closed by the worm's thrust: leave "
                    "it out"
                )
            wrong = [each for each in self.failures or () if each not in CLUTCH]
            if wrong:
                raise InputError(
                    f"control.failures has '{wrong[0]}', of a sensor; a clutch has none: it must "
                    f"be of {choices(CLUTCH)}"
                )
        return self

    @property
    def tried(self) -> tuple[str, ...]:
        """The failures that are tried, in their order."""
        if self.failures is not None:
            return tuple(dict.fromkeys(self.failures))
        return CLUTCH if self.kind == "clutch" else ELECTRONIC

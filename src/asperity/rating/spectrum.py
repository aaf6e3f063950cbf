"""The `[spectrum]` table: what a gearset carries over its life, step by step.

The duty classes are those of part-turn electric actuators, EN 15714-2 and EN ISO 22153. A cycle of
class A or B is a stroke there and back at a mean of 30 % of the rated torque, with all of it for
5 % of the travel at each end; a start of class C or D is a stroke at 30 %.
"""

import functools
import math
import re
from collections.abc import Mapping
from types import MappingProxyType
from typing import Annotated, Any, ClassVar, Literal, NamedTuple

from pydantic import Field, ValidationInfo, field_validator, model_validator

from asperity.casefile import Table
from asperity.errors import InputError, one_of, shown
from asperity.rating.load_steps import LoadStep, SpectrumStep, Time, steps_of
from asperity.sources import Source
from asperity.units import Quantity, to_si

VALVES = Source("EN 15714-2, EN ISO 22153:2021", "one source", "by makers' tables")

_MEAN, _ENDS = 0.30, 0.10
_CLASS = re.compile(r"EN 15714-2 ([A-D])")
# By the rated torque up to which they hold, N m: cycles of A and B, starts of C and D.
_TORQUES = (125.0, 1000.0, 4000.0, 32000.0)
_ENDURANCE = {
    "A": (10000, 10000, 5000, 5000),
    "B": (10000, 10000, 5000, 5000),
    "C": (1.8e6, 1.2e6, 5e5, 2.5e5),
    "D": (1e7, 1e7, 5e6, None),
}
# Cycles of A, starts of the others, an hour; for D none is public.
_AN_HOUR = {"A": (15, 10, 5), "B": (120, 60, 30), "C": (1200, 600, 300)}
_STROKE = {"A": math.pi / 2.0, "B": math.pi / 2.0, "C": math.radians(1.0), "D": math.radians(1.0)}

Shock = Literal["uniform", "moderate", "heavy"]
_HOURS = (0.5, 2.0, 10.0, 24.0)
_FACTORS = {
    "uniform": (0.8, 1.0, 1.0, 1.25),
    "moderate": (0.8, 1.0, 1.25, 1.5),
    "heavy": (1.0, 1.25, 1.5, 1.75),
}
_FACTORS_OF_STARTS = {
    "uniform": (0.8, 1.0, 1.25, 1.5),
    "moderate": (1.0, 1.25, 1.5, 1.75),
    "heavy": (1.25, 1.5, 1.75, 2.0),
}
_MANY_STARTS = 10.0

_DUTY = re.compile(r"S1|S2 +(?P<time>\S.*)|S3 +(?P<share>[0-9.]+) *%")


class Duty(NamedTuple):
    """How a gearbox is run in the terms of IEC 60034-1.

    Attributes
    ----------
    kind : {'S1', 'S2', 'S3'}
        All the time; once for a time; in equal cycles of load and rest.
    time : float
        Of S2, s.
    share : float
        Of S3, how much of a cycle is under load.
    """

    kind: str
    time: float = math.inf
    share: float = 1.0

    @classmethod
    def of(cls, text: str) -> "Duty":
        """Return what a text such as ``"S3 15 %"`` says; raises InputError."""
        found = _DUTY.fullmatch(" ".join(text.split()))
        said = f"spectrum.duty is {shown(text)}; it must be 'S1', 'S2 15 min' or 'S3 15 %'"
        if found is None:
            raise InputError(said)
        if found["time"]:
            try:
                time = to_si(found["time"], "s")
            except InputError:
                raise InputError(said) from None
            if not 0.0 < time < math.inf:
                raise InputError(said)
            return cls("S2", time=time)
        if found["share"]:
            try:
                share = float(found["share"]) / 100.0
            except ValueError:
                raise InputError(said) from None
            if not 0.0 < share <= 1.0:
                raise InputError(f"{said}, with more than 0 and at most 100 %")
            return cls("S3", share=share)
        return cls("S1")


class Spectrum(Table):
    """How a worm gearset is loaded over its life.

    Parameters
    ----------
    step : list of table, or str
        Steps of the whole life, in any order, also as "250 N m, 1400 rpm, 500 h; 60 N m, 700 rpm,
        3000 h". Give them or ``duty_class``.
    duty_class : str
        Of a valve's actuator, "EN 15714-2 A" to "EN 15714-2 D": its steps follow from the rated
        torque, ``stroke`` and ``cycles``.
    life : float or str, optional
        s; what the shares of steps are of. Shares that do not come to 1 leave the gearset at rest.
    stroke : float or str, optional
        Turn of the wheel in half a cycle (A, B) or at a start (C, D), rad; 90 deg or 1 deg if left
        out.
    cycles : float, optional
        Cycles (A, B) or starts (C, D) of the whole life; the endurance of the class if left out.
    duty : str
        "S1", "S2 15 min" or "S3 15 %" of IEC 60034-1: how warm the housing gets. S1 if left out.
    cycle : float or str
        Of S3, s; 10 min if left out.
    hours_per_day : float, optional
        For the service factor of AGMA 6034, which takes the place of
        ``operation.application_factor`` there.
    shock : {'uniform', 'moderate', 'heavy'}
        Of the load, likewise.
    oil_temperature : {'each', 'mean'}
        Whether the sump settles in each step, or the oil has the mean of all steps, for loads that
        change faster than a housing warms. Left out: the mean where they come and go in the cycles
        of S3, else each.
    """

    table: ClassVar[str] = "spectrum"
    required_alternatives: ClassVar[tuple[tuple[str, ...], ...]] = (("step", "duty_class"),)

    step: Annotated[tuple[LoadStep, ...], Field(min_length=1)] | None = None
    duty_class: str | None = None
    life: Time | None = None
    stroke: (
        Annotated[float, Quantity("rad", what="an angle", example="90 deg", gt=0, le=1e4)] | None
    ) = None
    cycles: Annotated[float, Quantity("", what="a number", example="10000", gt=0)] | None = None
    duty: str = "S1"
    cycle: Annotated[float, Quantity("s", what="a time", example="10 min", gt=0)] = 600.0
    hours_per_day: (
        Annotated[float, Quantity("", what="a number", example="12", gt=0, le=24)] | None
    ) = None
    shock: Shock = "uniform"
    oil_temperature: Literal["each", "mean"] | None = None

    @model_validator(mode="before")
    @classmethod
    def _steps(cls, data: Any, info: ValidationInfo[Any]) -> Any:
        if isinstance(data, Mapping) and data.get("step") is not None:
            steps = steps_of(data["step"], info.context, "spectrum.step", SpectrumStep)
            return {**data, "step": steps}
        return data

    @field_validator("duty")
    @classmethod
    def _known_duty(cls, value: str) -> str:
        Duty.of(value)
        return value

    @field_validator("duty_class")
    @classmethod
    def _known_class(cls, value: str | None) -> str | None:
        known = [f"EN 15714-2 {letter}" for letter in "ABCD"]
        if value is not None and not _CLASS.fullmatch(value):
            raise InputError(f"spectrum.duty_class is {shown(value)}; {one_of(known, value)}")
        return value

    @model_validator(mode="after")
    def _consistent(self) -> "Spectrum":
        of_class = [key for key in ("stroke", "cycles") if getattr(self, key) is not None]
        if of_class and self.duty_class is None:
            raise InputError(
                f"spectrum.{of_class[0]} is given without spectrum.duty_class, which it belongs "
                "to; leave it out"
            )
        shares = [step.share for step in self.step or () if getattr(step, "share", None)]  # type: ignore[attr-defined]
        if shares and self.life is None:
            raise InputError(
                "spectrum.life is missing; give it, as '5000 h': steps are shares of it"
            )
        if self.life is not None and not shares:
            raise InputError(
                "spectrum.life is given, but no step is a share of it; leave it out, or give "
                "spectrum.step.share in place of duration"
            )
        if math.fsum(shares) > 1.0 + 1e-9:
            raise InputError(
                f"spectrum.step.share is {math.fsum(shares):.6g} in all; steps may come to at "
                "most 1"
            )
        return self

    @functools.cached_property
    def _duty(self) -> Duty:
        return Duty.of(self.duty)

    @property
    def how(self) -> Duty:
        """How it is run."""
        return self._duty

    @property
    def oil(self) -> Literal["each", "mean"]:
        """Whether the oil has the temperature of each step, or the mean of all."""
        return self.oil_temperature or ("mean" if self.how.kind == "S3" else "each")

    @property
    def assumed(self) -> Mapping[str, str]:
        """Which keys were left out, and what was assumed for them."""
        left_out = {"oil_temperature": "each: the sump settles in each step"}
        if self.oil == "mean":
            left_out["oil_temperature"] = "mean of all steps, which come and go in cycles"
        if self.duty_class is not None:
            left_out["stroke"] = "90 deg, or 1 deg at each start of classes C and D"
            left_out["cycles"] = "the endurance of the class"
        if self.how.kind == "S3":
            left_out["cycle"] = "10 min"
        return MappingProxyType(
            {key: said for key, said in left_out.items() if key not in self.model_fields_set}
        )

    def require_beside(self, oil_temperature: float | None) -> None:
        """Refuse the mean of the sump's temperatures beside that temperature; raises InputError.

        Parameters
        ----------
        oil_temperature : float or None
            Of the operation, K.
        """
        if oil_temperature is not None and self.oil_temperature == "mean":
            raise InputError(
                "spectrum.oil_temperature is 'mean', and "
                f"operation.oil_temperature {oil_temperature - 273.15:.4g} degC, which is that of "
                "all steps; keep one of them"
            )

    def steps(self, rated_torque: float | None) -> tuple[LoadStep, ...]:
        """Return the steps, those of a class by the rated torque of the wheel, N m.

        Parameters
        ----------
        rated_torque : float or None
            Of the wheel, N m, of which a duty class has shares.

        Returns
        -------
        tuple of LoadStep
            In the order of the table; times in s, torques in N m.

        Raises
        ------
        InputError
            A duty class without a rated torque.
        """
        if self.step is not None:
            return self.step if self.life is None else tuple(map(self._timed, self.step))
        assert self.duty_class is not None
        if rated_torque is None:
            raise InputError(
                "spectrum.duty_class needs operation.output_torque, the rated torque of the valve; "
                "give it in place of operation.input_power or input_torque"
            )
        return _of_class(self.duty_class[-1], rated_torque, self.stroke, self.cycles)

    def _timed(self, step: Any) -> LoadStep:
        if step.share is None:
            timed: LoadStep = step
            return timed
        assert self.life is not None
        copy: LoadStep = step.model_copy(update={"duration": step.share * self.life}, units="SI")
        return copy

    def service_factor(self, starts_per_hour: float) -> float | None:
        """Return AGMA's, by the hours a day, shocks and starts; None where no hours are given.

        Parameters
        ----------
        starts_per_hour : float
            Of the operation.

        Returns
        -------
        float or None
            AGMA 6034-A87, by NORD's catalogue (one source).
        """
        if self.hours_per_day is None:
            return None
        row = next(place for place, most in enumerate(_HOURS) if self.hours_per_day <= most)
        factors = _FACTORS_OF_STARTS if starts_per_hour > _MANY_STARTS else _FACTORS
        return factors[self.shock][row]


def _of_class(
    letter: str, torque: float, stroke: float | None, cycles: float | None
) -> tuple[LoadStep, ...]:
    if torque > _TORQUES[-1]:
        raise InputError(
            f"operation.output_torque is {torque:g} N m; the classes of EN 15714-2 end at "
            f"{_TORQUES[-1]:g} N m: give spectrum.step"
        )
    size = next(place for place, most in enumerate(_TORQUES) if torque <= most)
    count = cycles if cycles is not None else _ENDURANCE[letter][size]
    if count is None:
        raise InputError(
            f"spectrum.cycles is missing; the endurance of class {letter} at {torque:g} N m is in "
            "no open source: give it"
        )
    an_hour = _AN_HOUR["C" if letter == "D" else letter]
    # Above 4000 N m none is public: those of the size before.
    starts = float(an_hour[min(size, len(an_hour) - 1)]) * (2.0 if letter == "A" else 1.0)
    angle = _STROKE[letter] if stroke is None else stroke
    if letter in "CD":
        return (_turned(count * angle / (2.0 * math.pi), _MEAN * torque, starts),)
    turns = 2.0 * count * angle / (2.0 * math.pi)
    rest = (_MEAN - _ENDS) / (1.0 - _ENDS) * torque
    return (
        _turned(_ENDS * turns, torque, starts),
        _turned((1.0 - _ENDS) * turns, rest, starts),
    )


def _turned(turns: float, torque: float, starts: float) -> LoadStep:
    values = {"turns": turns, "output_torque": torque, "starts_per_hour": starts}
    return LoadStep.model_validate(values)

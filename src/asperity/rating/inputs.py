"""What the formulas of the standards start from, in their units: mm, rad, rpm, N m, degC, um.

This is the one place where SI becomes the units of the standards. Numbers are plain floats, or
arrays of one shape where variants of a gearset are rated.
"""

import dataclasses
import functools
import itertools
import math
from collections.abc import Iterable, Sequence
from typing import Any, NamedTuple

import numpy as np

from asperity.arrays import Real, smaller
from asperity.formulas import once
from asperity.gearset import relations
from asperity.gearset.parameters import Gearset
from asperity.rating.load_steps import LoadStep
from asperity.rating.parameters import DEFAULT_LIFE, Operation, RatingOptions
from asperity.rating.spectrum import Duty
from asperity.units.standards import FROM_SI, RPM

Values = dict[str, Real]
"""What a standard's calculation found, by the keys of a rating; NaN where there is no answer."""

_HOUR = 3600.0
_ZERO_CELSIUS = 273.15
_SPAN = 1.5
_STRENGTH_SHARE = 0.1

GEOMETRY = (
    "starts",
    "wheel_teeth",
    "gear_ratio",
    "centre_distance",
    "axial_module",
    "diameter_factor",
    "profile_shift",
    "lead_angle",
    "pressure_angle",
    "axial_pitch",
    "worm_pitch_diameter",
    "worm_tip_diameter",
    "worm_root_diameter",
    "wheel_reference_diameter",
    "wheel_mean_diameter",
    "wheel_root_diameter",
    "wheel_face_width",
    "rim_width",
    "rim_thickness",
)
"""What the formulas need of a `asperity.gearset.Geometry`."""


def scaled(value: float, factor: float) -> float:
    """Return a number in another unit, to 15 digits: 1440 rpm come back as 1440 from rad/s."""
    return float(f"{value * factor:.15g}")


@once
def times(value: Real, factor: Real) -> Real:
    """Return a product, of the same arrays the same array: what follows from it is known again."""
    return value * factor


MANY = 16
"""Steps above which those of one gearset go through the formulas together, as arrays."""


class Part(NamedTuple):
    """A part of a duty cycle: its running time in h, torque of the wheel in N m, worm in rpm.

    ``starts`` are those an hour, ``back`` is true where the load drives.
    """

    hours: Real
    torque: Real
    speed: Real
    starts: Real
    back: Any = False


@dataclasses.dataclass(frozen=True, kw_only=True)
class Inputs:
    """A gearset and how it is run, in the units of the standards.

    Lengths are in mm (roughness in um), angles in rad, speeds in rpm, torques in N m; names are
    those of `asperity.gearset.Geometry` and of the tables of a case file. ``hours`` is the running
    time of a part of a duty cycle, see `parted`.
    """

    gearset: Gearset
    operation: Operation
    options: RatingOptions

    starts: Real
    wheel_teeth: Real
    gear_ratio: Real
    centre_distance: Real
    axial_module: Real
    diameter_factor: Real
    profile_shift: Real
    lead_angle: Real
    pressure_angle: Real
    axial_pitch: Real
    worm_pitch_diameter: Real
    worm_tip_diameter: Real
    worm_root_diameter: Real
    wheel_reference_diameter: Real
    wheel_mean_diameter: Real
    wheel_root_diameter: Real
    wheel_face_width: Real
    effective_face_width: Real
    rim_width: Real
    rim_thickness: Real

    worm_roughness: Real
    worm_speed: Real
    output_torque: Real
    through_travel_torque: Real
    base_friction: Real | None
    friction: Real | None
    friction_factor: Real
    hours: Real | None = None
    part_starts: Real | None = None
    load_drives: Any = False
    sump: Real | None = None

    @functools.cached_property
    def duty(self) -> tuple[Part, ...]:
        """The parts of the duty cycle; none without one, or where this is one of them."""
        if self.hours is not None:
            return ()
        return tuple(map(self._part, itertools.count(1), self.operation.steps or ()))

    def _part(self, number: int, step: LoadStep) -> Part:
        speed: Real = self.worm_speed
        if step.worm_speed is not None:
            speed = self._of_step(number, "worm_speed", scaled(step.worm_speed, RPM), "rpm")
        if step.duration is not None:
            hours = self._of_step(number, "hours", scaled(step.duration, 1.0 / _HOUR), "h")
        else:
            assert step.turns is not None
            turns = self._of_step(number, "turns", step.turns)
            hours = turns / (60.0 * (speed / self.gear_ratio))
        torque = self._of_step(number, "output_torque", step.torque, "N m")
        starts: Real = self.operation.starts_per_hour
        if step.starts_per_hour is not None:
            starts = self._of_step(number, "starts_per_hour", step.starts_per_hour)
        return Part(hours, torque, speed, starts, step.drives == "load")

    def _of_step(self, number: int, name: str, value: float, unit: str = "") -> Real:
        """Return what a step of the duty cycle is given, the first of them number 1."""
        return value

    @functools.cached_property
    def loads(self) -> tuple[Part, ...]:
        """The parts of the duty cycle; many of one gearset are one part, of arrays."""
        if not self.together:
            return self.duty
        hours, torque, speed, starts, back = map(np.asarray, zip(*self.duty, strict=True))
        return (Part(hours, torque, speed, starts, back),)

    @property
    def together(self) -> bool:
        """Whether the parts of the duty cycle go through the formulas together, as arrays."""
        return len(self.duty) > MANY and not self.is_varied

    @functools.cached_property
    def is_varied(self) -> bool:
        """Whether it is many variants of a gearset or of its load, as arrays."""
        return any(np.ndim(getattr(self, field.name)) for field in dataclasses.fields(self))

    @property
    def speeds(self) -> tuple[Real, ...]:
        """The worm's speeds of all parts of one gearset, each once, rpm."""
        return tuple(dict.fromkeys(part.speed for part in self.duty)) or (self.worm_speed,)

    def parted(self) -> "tuple[Inputs, ...]":
        """Return what the formulas start from in each of the `loads`."""
        return tuple(map(self._loaded, self.loads))

    def at_once(self) -> "Inputs":
        """Return the same of all parts of the duty cycle, in rows what they differ in."""
        return self._loaded(Part(*map(_column, zip(*self.duty, strict=True))))

    def each(self) -> "tuple[Inputs, ...]":
        """Return the same for each part of the duty cycle by itself, however many there are."""
        return tuple(map(self._loaded, self.duty))

    def _loaded(self, part: Part) -> "Inputs":
        return dataclasses.replace(
            self,
            hours=part.hours,
            worm_speed=part.speed,
            output_torque=part.torque,
            through_travel_torque=part.torque,
            part_starts=part.starts,
            load_drives=part.back,
        )

    def total(self, values: Iterable[Real]) -> Real:
        """Return the sum over all parts of what the `loads` have."""
        return self._over(np.add, values)

    def greatest(self, values: Iterable[Real]) -> Real:
        """Return the greatest over all parts of what the `loads` have."""
        return self._over(np.maximum, values)

    def least(self, values: Iterable[Real]) -> Real:
        """Return the least over all parts of what the `loads` have."""
        return self._over(np.minimum, values)

    def _over(self, joined: Any, values: Iterable[Real]) -> Real:
        if self.together:
            (value,) = values
            every = np.broadcast_to(value, (len(self.duty),))
            # A sum in order would gather rounding over thousands of steps.
            found: Real = math.fsum(every) if joined is np.add else float(joined.reduce(every))
            return found
        return functools.reduce(joined, values)

    def most_of_hardest(self, values: Sequence[Real]) -> Real:
        """Return the greatest of the parts' values, of those with the greatest torque."""
        most = self.greatest(part.torque for part in self.loads)
        return self.greatest(
            np.where(part.torque >= most, value, 0.0)
            for part, value in zip(self.loads, values, strict=True)
        )

    @property
    def measured_at(self) -> Real:
        """Speed of the worm at which losses of the housing were measured, rpm."""
        housing = self.operation.housing
        if housing is None or housing.measured_at is None:
            return scaled(self.operation.worm_speed, RPM)
        return scaled(housing.measured_at, RPM)

    @property
    def how(self) -> Duty:
        """How it is run in the terms of IEC 60034-1: S1 where no spectrum says otherwise."""
        spectrum = self.operation.spectrum
        return Duty("S1") if spectrum is None else spectrum.how

    @property
    def cycle(self) -> float:
        """Cycle of load and rest, s."""
        spectrum = self.operation.spectrum
        return 0.0 if spectrum is None else spectrum.cycle

    @property
    def starts_per_hour(self) -> Real:
        """Those of the part of a duty cycle, or of the operation."""
        return self.operation.starts_per_hour if self.part_starts is None else self.part_starts

    @property
    def hardest_speed(self) -> Real:
        """The worm's with the greatest torque of the duty cycle (the fastest such part), rpm."""
        if not self.duty:
            return self.worm_speed
        return self.most_of_hardest([part.speed for part in self.loads])

    @property
    def wheel_speed(self) -> Real:
        """Speed of the wheel, rpm."""
        return self.worm_speed / self.gear_ratio

    @property
    def bearing_span(self) -> Real:
        """Distance between the worm's bearings, mm."""
        given = self.operation.bearing_span
        return _SPAN * self.centre_distance if given is None else scaled(given, FROM_SI["mm"])

    @property
    def ambient_temperature(self) -> float:
        """In degC."""
        return _celsius(self.operation.ambient_temperature)

    @property
    def oil_temperature(self) -> float | None:
        """Temperature of the sump in degC, if it is given."""
        given = self.operation.oil_temperature
        return None if given is None else _celsius(given)

    @property
    def sump_limit(self) -> float:
        """Temperature that the oil bears, degC."""
        return _celsius(self.operation.lubricant.base.sump_limit)

    @property
    def density_15(self) -> float:
        """Density of the oil at 15 degC, kg/m3."""
        lubricant = self.operation.lubricant
        return lubricant.base.density_15 if lubricant.density_15 is None else lubricant.density_15

    @property
    def life(self) -> Real:
        """Required running time in hours at the worm's speed; of a duty cycle, by its turns."""
        if self.hours is not None:
            return self.hours
        if self.duty:
            return self._equivalent_hours(0, 1.0, self.worm_speed)
        if self.operation.wheel_revolutions is not None:
            return self.operation.wheel_revolutions / (60.0 * self.wheel_speed)
        return scaled(self.operation.life or DEFAULT_LIFE, 1.0 / _HOUR)

    @property
    def wear_hours(self) -> Real:
        """Running time in hours for which BS 721 judges wear, at the through-travel torque."""
        if self.duty:
            return self._equivalent_hours(3, self.through_travel_torque, self.hardest_speed)
        return self.life

    @property
    def strength_hours(self) -> Real:
        """Running time in hours for which BS 721 judges strength, at the rated torque."""
        if self.duty:
            return self._equivalent_hours(7, self.output_torque, self.hardest_speed)
        return self.life * _STRENGTH_SHARE if self.operation.service == "valve" else self.life

    def _equivalent_hours(self, exponent: int, torque: Real, speed: Real) -> Real:
        # asperity.rating.bs721.equivalent_hours, for arrays of speeds and torques.
        return self.total(
            part.hours * (part.speed / speed) * (part.torque / torque) ** exponent
            for part in self.loads
        )


def _column(values: tuple[Any, ...]) -> Any:
    """Return what all parts have, or a row for each part, for arrays of variants to go beside."""
    first = values[0]
    if all(
        one is first or (np.ndim(one) == np.ndim(first) == 0 and one == first) for one in values
    ):
        return first
    rows = np.stack(np.broadcast_arrays(*values))
    return rows if rows.ndim > 1 else rows[:, None]


def face_width_that_carries(
    gearset: Gearset, options: RatingOptions, axial_module: Real, diameter_factor: Real
) -> Real:
    """Return b_2H by the rule that is asked for, mm; at most a given width of the wheel."""
    chord = {"tip_chord": relations.widest_contact, "reference_chord": relations.reference_chord}
    widest = chord[options.iso14521_face_width](axial_module, diameter_factor)
    given = gearset.wheel_face_width
    return widest if given is None else smaller(gearset.geometry.wheel_face_width, widest)


def inputs(gearset: Gearset, operation: Operation, options: RatingOptions) -> Inputs:
    """Return what the formulas need for one gearset, as floats."""
    g = gearset.geometry
    return Inputs(
        gearset=gearset,
        operation=operation,
        options=options,
        **{name: getattr(g, name) for name in GEOMETRY},
        effective_face_width=face_width_that_carries(
            gearset, options, g.axial_module, g.diameter_factor
        ),
        worm_roughness=scaled(gearset.worm_roughness, FROM_SI["um"]),
        worm_speed=scaled(operation.worm_speed, RPM),
        output_torque=operation.output_torque,
        through_travel_torque=operation.travel_torque,
        base_friction=options.base_friction,
        friction=options.friction,
        friction_factor=options.friction_factor,
    )


def _celsius(temperature: float) -> float:
    return float(f"{temperature - _ZERO_CELSIUS:.12g}")

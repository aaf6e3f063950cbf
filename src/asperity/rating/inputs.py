"""What the formulas of the standards start from, in their units: mm, rad, rpm, N m, degC, um.

This is the one place where SI becomes the units of the standards. Numbers are plain floats, or
arrays of one shape where variants of a gearset are rated.
"""

import dataclasses
import math

from asperity.arrays import Real, smaller
from asperity.gearset import relations
from asperity.gearset.parameters import Gearset
from asperity.rating.parameters import DEFAULT_LIFE, THROUGH_TRAVEL, Operation, RatingOptions

Values = dict[str, Real]
"""What a standard's calculation found, by the keys of a rating; NaN where there is no answer."""

_HOUR = 3600.0
_ZERO_CELSIUS = 273.15
RPM = 60.0 / (2.0 * math.pi)
"""Turns a minute in a radian a second."""

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


@dataclasses.dataclass(frozen=True, kw_only=True)
class Inputs:
    """A gearset and how it is run, in the units of the standards.

    Lengths are in mm (roughness in um), angles in rad, speeds in rpm, torques in N m; names are
    those of `asperity.gearset.Geometry` and of the tables of a case file.
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

    @property
    def wheel_speed(self) -> Real:
        """Speed of the wheel, rpm."""
        return self.worm_speed / self.gear_ratio

    @property
    def bearing_span(self) -> Real:
        """Distance between the worm's bearings, mm."""
        given = self.operation.bearing_span
        return _SPAN * self.centre_distance if given is None else scaled(given, 1e3)

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
        if self.operation.duty_cycle is not None:
            return self._equivalent_hours(0, 1.0)
        if self.operation.wheel_revolutions is not None:
            return self.operation.wheel_revolutions / (60.0 * self.wheel_speed)
        return scaled(self.operation.life or DEFAULT_LIFE, 1.0 / _HOUR)

    @property
    def wear_hours(self) -> Real:
        """Running time in hours for which BS 721 judges wear, at the through-travel torque."""
        if self.operation.duty_cycle is not None:
            return self._equivalent_hours(3, self.through_travel_torque)
        return self.life

    @property
    def strength_hours(self) -> Real:
        """Running time in hours for which BS 721 judges strength, at the rated torque."""
        if self.operation.duty_cycle is not None:
            return self._equivalent_hours(7, self.output_torque)
        return _STRENGTH_SHARE * self.life

    def _equivalent_hours(self, exponent: int, torque: Real) -> Real:
        # asperity.rating.bs721.equivalent_hours, for arrays of speeds and torques.
        total: Real = 0.0
        for step in self.operation.duty_cycle or ():
            speed = 1.0 if step.worm_speed is None else step.worm_speed * RPM / self.worm_speed
            total += step.duration / _HOUR * speed * (step.output_torque / torque) ** exponent
        return total


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
    torque = operation.output_torque
    through = operation.through_travel_torque
    return Inputs(
        gearset=gearset,
        operation=operation,
        options=options,
        **{name: getattr(g, name) for name in GEOMETRY},
        effective_face_width=face_width_that_carries(
            gearset, options, g.axial_module, g.diameter_factor
        ),
        worm_roughness=scaled(gearset.worm_roughness, 1e6),
        worm_speed=scaled(operation.worm_speed, RPM),
        output_torque=torque,
        through_travel_torque=THROUGH_TRAVEL * torque if through is None else through,
        base_friction=options.base_friction,
        friction=options.friction,
        friction_factor=options.friction_factor,
    )


def _celsius(temperature: float) -> float:
    return float(f"{temperature - _ZERO_CELSIUS:.12g}")

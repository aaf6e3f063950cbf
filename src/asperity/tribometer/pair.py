"""The pair of discs of a configuration: its contact, and what speeds and torques mean in it."""

import dataclasses
import functools

from asperity.arrays import Real
from asperity.casefile import Case
from asperity.errors import InputError
from asperity.tribometer import discs
from asperity.tribometer.parameters import (
    AXIAL,
    LONGITUDINAL,
    TRANSVERSE,
    BronzeDisc,
    Drives,
    Lubricant,
    Rig,
    SteelDisc,
)

BOUNDARY = 1.0
"""Film over roughness below which the lubrication is called boundary lubrication."""


@dataclasses.dataclass(frozen=True)
class Pair:
    """Two discs under their load, each with its gear; speeds are those of the motors."""

    rig: Rig
    steel: SteelDisc
    bronze: BronzeDisc
    drives: Drives

    @classmethod
    def from_case(cls, case: Case) -> "Pair":
        """Gather the tables of discs."""
        steel, bronze = case.require(SteelDisc), case.require(BronzeDisc)
        if case.require(Rig).mode == AXIAL:
            raise InputError(
                f"rig.mode is '{AXIAL}', along a worm's axis; discs are shaken '{TRANSVERSE}' or "
                f"'{LONGITUDINAL}'"
            )
        return Pair(case.require(Rig), steel, bronze, case.require(Drives))

    @property
    def geared(self) -> bool:
        """Whether it is a worm and its wheel."""
        return False

    def named(self, text: str) -> str:
        """Return a sentence of the two discs with what stands for them here."""
        return text

    @property
    def load(self) -> float:
        """Force between the two, N."""
        return self.rig.load

    def wheel_speed(self, worm_motor: float) -> float:
        """Return what the wheel's encoder sees of a speed at the worm's motor, rad/s."""
        raise NotImplementedError

    @property
    def tied(self) -> float:
        """Speed of the bronze side's encoder over that of the steel side where teeth tie them."""
        return 1.0

    @property
    def torque_share(self) -> float:
        """Torque of the steel side over that of the bronze side, about."""
        return self.steel.radius / self.bronze.radius

    @property
    def length(self) -> float:
        """Length of the contact line, m."""
        return min(self.steel.thickness, self.bronze.thickness)

    @functools.cached_property
    def half_width(self) -> float:
        """Half the width of the contact, m."""
        return float(
            discs.contact_half_width(
                self.load, self.length, self.steel.diameter, self.bronze.diameter,
                self.steel.young_modulus, self.bronze.young_modulus,
                self.steel.poisson_ratio, self.bronze.poisson_ratio,
            )
        )  # fmt: skip

    @property
    def pressure(self) -> float:
        """Largest pressure of the contact, Pa."""
        return float(discs.contact_pressure(self.load, self.half_width, self.length))

    def film(self, oil: Lubricant, rolling: float) -> float | None:
        """Return film over roughness at a rolling velocity; None where something is not known."""
        given = oil.viscosity, oil.pressure_viscosity, self.steel.roughness, self.bronze.roughness
        if any(one is None for one in given) or rolling <= 0.0:
            return None
        viscosity, pressure_viscosity, *roughness = given
        modulus = discs.reduced_modulus(
            self.steel.young_modulus, self.bronze.young_modulus,
            self.steel.poisson_ratio, self.bronze.poisson_ratio,
        )  # fmt: skip
        radius = 0.5 / (1.0 / self.steel.diameter + 1.0 / self.bronze.diameter)
        film = discs.film_thickness(
            viscosity, pressure_viscosity, rolling, modulus, radius, self.load, self.length
        )
        return float(discs.film_parameter(film, *roughness))

    def rims(self, steel_motor: Real, bronze_motor: Real) -> tuple[Real, Real]:
        """Return the velocities of both rims, m/s, of the motors' speeds in rad/s."""
        return (
            discs.peripheral_velocity(self.steel.diameter, steel_motor / self.drives.gear_ratio),
            discs.peripheral_velocity(
                self.bronze.diameter, bronze_motor / self.drives.bronze_gear_ratio
            ),
        )

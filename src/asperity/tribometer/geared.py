"""A worm and its wheel in place of two discs: a gear rig (thesis 8.2 i).

The worm stands for the steel disc, the wheel for the bronze one: ``torque_steel`` is the torque of
the worm's shaft, ``speed_steel`` the speed of its motor, ``torque_bronze`` what the brake holds the
wheel with, below zero, ``speed_bronze`` the speed of the wheel. Sliding is that at the reference
circle along the thread.
"""

import dataclasses
import functools
import math

from asperity.arrays import Real
from asperity.casefile import Case
from asperity.errors import InputError
from asperity.friction import Friction
from asperity.gearset import Gearset, Geometry
from asperity.tribometer.pair import Pair
from asperity.tribometer.parameters import (
    AXIAL,
    BronzeDisc,
    Drives,
    Lubricant,
    Rig,
    SteelDisc,
)

_NAMED = {
    "steel disc": "worm", "bronze disc": "wheel", "bronze one": "wheel", "discs": "worm and wheel",
}  # fmt: skip
_USUAL_FRICTION = 0.08
"""For what torque a worm takes about, where [friction] does not tell."""


@dataclasses.dataclass(frozen=True)
class GearPair(Pair):
    """A worm and its wheel under the torque of a brake; speeds are those of motor and encoder.

    Attributes
    ----------
    gearset : Gearset
        Its teeth.
    friction : float
        Coefficient of friction, for about what torque the worm takes.
    """

    gearset: Gearset = dataclasses.field(kw_only=True)
    friction: float = _USUAL_FRICTION

    @classmethod
    def of(cls, case: Case) -> "GearPair":
        """Gather the tables.

        Raises
        ------
        InputError
            There is no brake, discs are described beside the gearset, or the vibration is not
            along the worm's axis.
        """
        rig, gearset = case.require(Rig), case.require(Gearset)
        for table in (SteelDisc.table, BronzeDisc.table):
            if table in case:
                raise InputError(
                    f"[{table}] stands beside [{Gearset.table}]; a rig has discs or a gearset: "
                    "leave one of them out"
                )
        if rig.brake_torque is None:
            raise InputError("rig.brake_torque is missing; give the torque of the wheel's brake")
        if rig.mode != AXIAL:
            raise InputError(
                f"rig.mode is '{rig.mode}'; the worm of a gear rig is shaken along its axis: give "
                f"'{AXIAL}'"
            )
        own = gearset.geometry
        worm, wheel = gearset.worm_material, gearset.wheel_material
        steel = SteelDisc.model_validate({
            "material": worm.name, "diameter": 1e-3 * own.worm_pitch_diameter,
            "thickness": 1e-3 * own.worm_face_width, "young_modulus": worm.youngs_modulus,
        })  # fmt: skip
        bronze = BronzeDisc.model_validate({
            "material": wheel.name, "diameter": 1e-3 * own.wheel_reference_diameter,
            "thickness": 1e-3 * own.wheel_face_width, "young_modulus": wheel.youngs_modulus,
        })  # fmt: skip
        told = case.get(Friction)
        mu = told.mu if told is not None and told.mu is not None else _USUAL_FRICTION
        return cls(rig, steel, bronze, case.require(Drives), gearset=gearset, friction=float(mu))

    @property
    def geared(self) -> bool:
        """Whether it is a worm and its wheel."""
        return True

    def named(self, text: str) -> str:
        """Return a sentence of the two discs with worm and wheel in it."""
        for disc, own in _NAMED.items():
            text = text.replace(disc, own)
        return text

    @functools.cached_property
    def geometry(self) -> Geometry:
        """Of the gearset, mm and rad."""
        return self.gearset.geometry

    @property
    def sliding_radius(self) -> float:
        """Sliding velocity at the reference circle over the worm's speed, m."""
        return self.steel.radius / math.cos(self.geometry.lead_angle)

    @property
    def tied(self) -> float:
        """What the wheel's encoder sees over what the worm's motor does."""
        return self.drives.bronze_gear_ratio / (self.drives.gear_ratio * self.geometry.gear_ratio)

    @property
    def brake_torque(self) -> float:
        """Of the wheel's brake, N m."""
        assert self.rig.brake_torque is not None
        return self.rig.brake_torque

    @property
    def torque_share(self) -> float:
        """Torque of the worm over that of the wheel, about."""
        lead = self.geometry.lead_angle
        angle = math.atan(self.friction / math.cos(self.geometry.pressure_angle))
        return math.tan(lead + angle) / (math.tan(lead) * self.geometry.gear_ratio)

    @property
    def load(self) -> float:
        """Normal force between the flanks without friction, N."""
        arm = self.bronze.radius * math.cos(self.geometry.pressure_angle)
        return self.brake_torque / (arm * math.cos(self.geometry.lead_angle))

    def wheel_speed(self, worm_motor: float) -> float:
        """Return what the wheel's encoder sees of a speed at the worm's motor, rad/s."""
        return self.tied * worm_motor

    def rims(self, steel_motor: Real, bronze_motor: Real) -> tuple[Real, Real]:
        """Return the velocities of worm and wheel along the thread, m/s; they run apart."""
        lead = self.geometry.lead_angle
        worm, wheel = super().rims(steel_motor, bronze_motor)
        return worm * math.cos(lead), -wheel * math.sin(lead)

    def film(self, oil: Lubricant, rolling: float) -> float | None:
        """Return nothing: the film between flanks is what ``asperity flank`` tells."""
        return None

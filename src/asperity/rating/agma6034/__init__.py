"""Efficiency and load capacity by ANSI/AGMA 6034-B92, one function for each formula.

Every formula is written once, in the standard's inches, pounds and feet a minute. With
``units="si"``, the default, arguments and results are in mm, m/s, N, N m, W and MPa and are
converted exactly; with ``units="inch"`` they are taken as the standard has them. Angles are in
radians, speeds in rpm, see `asperity.formulas`.
"""

from asperity.rating.agma6034.capacity import (
    Casting,
    allowable_tangential_load,
    effective_face_width,
    materials_factor,
    ratio_correction_factor,
    velocity_factor,
    wheel_torque,
)
from asperity.rating.agma6034.forces import (
    bending_stress,
    friction_force,
    lewis_form_factor,
    worm_tangential_load,
)
from asperity.rating.agma6034.limits import VALIDITY
from asperity.rating.agma6034.mesh import (
    friction,
    maximum_lead_angle,
    sliding_velocity,
    wheel_driving_efficiency,
    worm_driving_efficiency,
)
from asperity.rating.agma6034.thermal import (
    friction_power,
    heat_transfer_coefficient,
    minimum_housing_area,
    sump_temperature,
)

__all__ = [
    "VALIDITY",
    "Casting",
    "allowable_tangential_load",
    "bending_stress",
    "effective_face_width",
    "friction",
    "friction_force",
    "friction_power",
    "heat_transfer_coefficient",
    "lewis_form_factor",
    "materials_factor",
    "maximum_lead_angle",
    "minimum_housing_area",
    "ratio_correction_factor",
    "sliding_velocity",
    "sump_temperature",
    "velocity_factor",
    "wheel_driving_efficiency",
    "wheel_torque",
    "worm_driving_efficiency",
    "worm_tangential_load",
]

"""Efficiency and load capacity by ANSI/AGMA 6034-B92, one function for each formula.

Every formula is written once, in the standard's inches, pounds and feet a minute. With
``units="si"``, the default, arguments and results are in mm, m/s, N, N m, W and MPa and are
converted exactly; with ``units="inch"`` they are taken as the standard has them. Angles are in
radians, speeds in rpm. Numbers give a number, arrays an array; a number that is not allowed raises
`InputError`, and so does an array unless ``on_invalid="mask"`` asks for
`asperity.rating.formula.Masked`.
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
    wheel_load_from_power,
    worm_tangential_load,
)
from asperity.rating.agma6034.limits import LIFE_HOURS, SOURCES, VALIDITY, jumps
from asperity.rating.agma6034.mesh import (
    friction,
    maximum_lead_angle,
    pitch_line_velocity,
    sliding_velocity,
    wheel_driving_efficiency,
    worm_driving_efficiency,
)
from asperity.rating.agma6034.thermal import (
    friction_power,
    heat_transfer_coefficient,
    input_power,
    minimum_housing_area,
    output_power,
    sump_temperature,
)
from asperity.rating.agma6034.units import Units
from asperity.rating.jump import Jump

__all__ = [
    "LIFE_HOURS",
    "SOURCES",
    "VALIDITY",
    "Casting",
    "Jump",
    "Units",
    "allowable_tangential_load",
    "bending_stress",
    "effective_face_width",
    "friction",
    "friction_force",
    "friction_power",
    "heat_transfer_coefficient",
    "input_power",
    "jumps",
    "lewis_form_factor",
    "materials_factor",
    "maximum_lead_angle",
    "minimum_housing_area",
    "output_power",
    "pitch_line_velocity",
    "ratio_correction_factor",
    "sliding_velocity",
    "sump_temperature",
    "velocity_factor",
    "wheel_driving_efficiency",
    "wheel_load_from_power",
    "wheel_torque",
    "worm_driving_efficiency",
    "worm_tangential_load",
]

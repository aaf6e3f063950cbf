"""Efficiency and load capacity by ISO/TR 14521 (DIN 3996), one function for each formula.

Arguments and results are in the standard's units, named with each: mm, um, N, N m, rpm, m/s, W,
MPa, degC; angles are in radians, see `asperity.formulas`. `film_parameter` raises
`FilmParameterError` where the standard ends. ``edition`` chooses between the families of 1998 and
2010. `asperity.rating.variants` goes all the way from geometries to efficiencies.
"""

from asperity.rating.iso14521.contact import (
    contact_parameter,
    contact_stress,
    load_cycles,
    path_parameter,
    reduced_modulus,
    sliding_path,
)
from asperity.rating.iso14521.efficiency import (
    back_driving_total_efficiency,
    total_efficiency,
    wheel_driving_efficiency,
    worm_driving_efficiency,
)
from asperity.rating.iso14521.film import film_parameter, film_thickness
from asperity.rating.iso14521.film_failure import FilmParameterError
from asperity.rating.iso14521.forces import (
    separating_force,
    wheel_tangential_force,
    worm_tangential_force,
)
from asperity.rating.iso14521.friction import (
    base_friction,
    geometry_factor,
    mean_friction,
    roughness_factor,
    size_factor,
    sliding_velocity,
)
from asperity.rating.iso14521.limits import MINIMUM_SAFETIES, VALIDITY, violations
from asperity.rating.iso14521.losses import (
    back_driving_meshing_loss,
    bearing_loss,
    idle_loss,
    meshing_loss,
    output_power,
    seal_loss,
)
from asperity.rating.iso14521.pitting import (
    pitting_life_factor,
    pitting_limit,
    pitting_ratio_factor,
    pitting_size_factor,
    pitting_velocity_factor,
)
from asperity.rating.iso14521.strength import (
    STEEL,
    deflection_limit,
    form_factor,
    rim_factor,
    root_shear_limit,
    root_shear_stress,
    root_thickness,
    safety,
    worm_deflection,
)
from asperity.rating.iso14521.tables import (
    EDITIONS,
    FrictionConstants,
    WearConstants,
    friction_constants,
    wear_constants,
)
from asperity.rating.iso14521.thermal import (
    bulk_temperature,
    cooling_area,
    heat_transfer_coefficient,
    sump_temperature,
)
from asperity.rating.iso14521.wear import (
    flank_wear,
    lubricant_structure_factor,
    pressure_factor,
    reference_wear_intensity,
    start_factor,
    wear_intensity,
    wear_limit,
    wear_parameter,
)

__all__ = [
    "EDITIONS",
    "MINIMUM_SAFETIES",
    "STEEL",
    "VALIDITY",
    "FilmParameterError",
    "FrictionConstants",
    "WearConstants",
    "back_driving_meshing_loss",
    "back_driving_total_efficiency",
    "base_friction",
    "bearing_loss",
    "bulk_temperature",
    "contact_parameter",
    "contact_stress",
    "cooling_area",
    "deflection_limit",
    "film_parameter",
    "film_thickness",
    "flank_wear",
    "form_factor",
    "friction_constants",
    "geometry_factor",
    "heat_transfer_coefficient",
    "idle_loss",
    "load_cycles",
    "lubricant_structure_factor",
    "mean_friction",
    "meshing_loss",
    "output_power",
    "path_parameter",
    "pitting_life_factor",
    "pitting_limit",
    "pitting_ratio_factor",
    "pitting_size_factor",
    "pitting_velocity_factor",
    "pressure_factor",
    "reduced_modulus",
    "reference_wear_intensity",
    "rim_factor",
    "root_shear_limit",
    "root_shear_stress",
    "root_thickness",
    "roughness_factor",
    "safety",
    "seal_loss",
    "separating_force",
    "size_factor",
    "sliding_path",
    "sliding_velocity",
    "start_factor",
    "sump_temperature",
    "total_efficiency",
    "violations",
    "wear_constants",
    "wear_intensity",
    "wear_limit",
    "wear_parameter",
    "wheel_driving_efficiency",
    "wheel_tangential_force",
    "worm_deflection",
    "worm_driving_efficiency",
    "worm_tangential_force",
]

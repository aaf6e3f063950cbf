"""Worm gearsets that tests make up."""

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.gearset import Gearset

# What a rating asks for at least, of the gearset and of its operation.
MINIMAL = {
    "starts": 2,
    "wheel_teeth": 40,
    "centre_distance": "100 mm",
    "axial_module": "4 mm",
    "diameter_factor": 10,
    "worm_material": "case-hardened steel",
    "wheel_material": "CuSn12-C-GZ",
}
RUN = {"worm_speed": "1500 rpm", "output_torque": "300 N m", "lubricant": "ISO VG 220 mineral"}


def of_module_2(
    starts, wheel_teeth, diameter_factor, pressure_angle="20 deg", profile_shift=0.0, **changed
):
    """Return a gearset of axial module 2 mm, of the materials of gearset 3."""
    given = read_case("gearset-3b", case_tables(), ()).require(Gearset)
    return Gearset(
        axial_module="2 mm",
        worm_material=given.worm_material,
        wheel_material=given.wheel_material,
        starts=starts,
        wheel_teeth=wheel_teeth,
        diameter_factor=diameter_factor,
        pressure_angle=pressure_angle,
        profile_shift=profile_shift,
        **changed,
        units="SI",
    )

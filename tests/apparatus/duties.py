"""A gearset of 100 mm under three loads, which several tests rate."""

from asperity.gearset import Gearset
from asperity.rating import Operation, rate

A100 = Gearset(
    starts=1,
    wheel_teeth=50,
    centre_distance="100 mm",
    axial_module="3.15 mm",
    diameter_factor=12.5,
    worm_material="case-hardened steel",
    wheel_material="CuSn12Ni2-C-GZ",
)
RUN = {
    "lubricant": "ISO VG 220 polyglycol", "output_torque": "250 N m", "worm_speed": "1400 rpm",
}  # fmt: skip
BINS = ((250, 1400, 500), (150, 1400, 1500), (60, 700, 3000))


def steps(*bins):
    return [
        {"duration": f"{hours!r} h", "output_torque": f"{torque!r} N m", "worm_speed": f"{n!r} rpm"}
        for torque, n, hours in bins
    ]


def rated(gearset=A100, run=RUN, **more):
    return rate(gearset, Operation(**{**run, **more}))


def safeties(found):
    return {safety.demand.path: safety.value for safety in found.verdict.safeties}

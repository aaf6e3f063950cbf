"""Worm gearsets of others, rated by the three standards.

Sources: a catalogue of worm gearboxes of the NMRV kind (rated torques and efficiencies at 1400
rpm; its starts and teeth, and a worm of 0.43 centre distances, are from memory); the table of
DKM Power Transmission's program that selects worm gearboxes (DKM025 to DKM150, of the same kind,
with 4-pole motors, as of 20 August 2026); R. Mott, Machine Elements in Mechanical Design, 4th
edition, examples 10-7 and 10-8 (pages 343, 437; only the latter is compared); U. C. Jindal,
Machine Design, example 28-2.
"""

import math
from typing import NamedTuple

import asperity.rating
from asperity.gearset import Gearset
from asperity.rating import Operation, rate

STARTS = {7.5: 4, 15: 2, 30: 1, 40: 1, 50: 1, 60: 1, 80: 1, 100: 1}
"""By ratio, from memory."""

# Centre distance in mm, ratio, rated torque in N m and efficiency of the gearbox in percent.
CATALOGUE = (
    (63, 7.5, 129, 88.0), (63, 15, 139, 82.1), (63, 30, 164, 72.9), (63, 40, 141, None),
    (63, 50, None, 65.0), (63, 60, 126, 62.2), (63, 80, None, 56.0), (63, 100, 113, 51.1),
    (30, 60, 13, None),
)  # fmt: skip
# Where the torque is not at hand, one between its neighbours.
_BETWEEN = {50: 133.0, 80: 119.0}

# Centre distance in mm, ratio, power of the motor in kW, the torque that it gives in N m, and the
# service factor: how many times that torque the gearbox may have.
SELECTION = (
    (30, 7.5, 0.18, 7.7, 2.3), (30, 15, 0.18, 14, 1.3), (30, 30, 0.12, 16, 1.3),
    (30, 60, 0.06, 13, 1.3),
    (40, 7.5, 0.25, 11, 3.6), (40, 15, 0.25, 20, 2.0), (40, 30, 0.18, 25, 1.8),
    (40, 60, 0.09, 21, 1.7), (40, 100, 0.09, 29, 1.0),
    (50, 15, 0.37, 31, 2.4), (50, 30, 0.25, 36, 2.3), (50, 60, 0.18, 43, 1.6),
    (50, 100, 0.18, 59, 0.9),
    (63, 15, 0.55, 47, 3.0), (63, 30, 0.37, 55, 2.9), (63, 60, 0.25, 63, 2.0),
    (63, 100, 0.25, 87, 1.4),
    (75, 15, 0.75, 65, 3.2), (75, 30, 0.55, 86, 2.7), (75, 60, 0.37, 97, 2.1),
    (75, 100, 0.37, 139, 1.3),
    (90, 30, 0.75, 120, 3.5), (90, 60, 0.55, 155, 2.0), (90, 100, 0.55, 221, 1.2),
    (110, 60, 0.75, 221, 2.8), (110, 100, 0.75, 322, 1.5),
)  # fmt: skip
_MOTOR = 1400.0  # rpm


class Position(NamedTuple):
    """A position of a catalogue and what the standards have for it; None without an answer."""

    centre_distance: float
    ratio: float
    torque: float | None
    efficiency: float | None
    bs_wear: float | None
    agma_torque: float | None
    bs_teeth: float | None
    iso_gearbox: float | None


def catalogue():
    """Yield each position with the torque that BS 721 and AGMA 6034 permit for 12,000 h."""
    for distance, ratio, torque, efficiency in CATALOGUE:
        yield _position(distance, ratio, torque, efficiency)


def selection():
    """Yield each position of the table that selects, as `catalogue` does.

    The torque is that of the motor times the service factor, the efficiency the power of that
    torque over the motor's.
    """
    for distance, ratio, power, torque, service in SELECTION:
        out = torque * _MOTOR / ratio * math.pi / 30.0
        yield _position(distance, ratio, service * torque, 0.1 * out / power)


def _position(distance, ratio, torque, efficiency):
    found = rated(distance, ratio, torque or _BETWEEN[ratio])
    return Position(
        distance,
        ratio,
        torque,
        efficiency,
        _number(found.bs721, "M_w_Nm"),
        _number(found.agma6034, "allowable_torque_Nm"),
        _number(found.bs721, "eta", 100.0),
        _number(found.iso14521, "eta_ges", 100.0),
    )


def rated(distance, ratio, torque):
    """Return the rating of a gearbox of that centre distance, mm, ratio and torque, N m."""
    worm = 0.43 * distance
    teeth = round(STARTS[ratio] * ratio)
    module = (2.0 * distance - worm) / teeth
    gearset = Gearset(
        starts=STARTS[ratio], wheel_teeth=teeth, centre_distance=f"{distance} mm",
        axial_module=f"{module} mm", diameter_factor=worm / module,
        worm_material="case-hardened steel", wheel_material="CuSn12-C-GZ",
    )  # fmt: skip
    operation = Operation(
        worm_speed=f"{_MOTOR} rpm", output_torque=f"{torque} N m", life="12000 h",
        lubricant="ISO VG 320 polyglycol",
    )  # fmt: skip
    return rate(gearset, operation)


def _number(rating, key, times=1.0):
    return None if rating is None or key not in rating else times * float(rating[key])


def mott():
    """Yield Mott's example of rating, as the book has it and as AGMA 6034 here."""
    inch, capacity = {"units": "inch"}, asperity.rating.agma6034.capacity
    wheel, worm = 8.667, 2.0
    lead = math.atan(3 / 6.0 / worm)
    sliding = asperity.rating.agma6034.mesh.sliding_velocity(worm, lead, 1750.0, **inch)
    found = (
        capacity.materials_factor(0.5 * (wheel + worm), wheel, "sand", **inch),
        capacity.ratio_correction_factor(52 / 3),
        capacity.velocity_factor(sliding, **inch),
    )
    load = capacity.allowable_tangential_load(found[0], wheel, 1.25, *found[1:], **inch)
    names = "materials factor C_s", "ratio factor C_m", "velocity factor C_v", "rated load, lbf"
    yield from zip(names, (740.0, 0.814, 0.265, 1123.0), (*found, load), strict=True)

"""BS 721: permissible torques for wear and strength at a life of 26000 h, and their factors.

``member`` is whose speed is given, and what a message calls it. ``tables`` take the place of those
that ship.
"""

from typing import Literal

import numpy as np

from asperity.arrays import Real
from asperity.formulas import formula
from asperity.rating.bs721 import symbols as s
from asperity.rating.bs721.tables import Tables, read_tables

Member = Literal["wheel", "worm"]


@formula(symbol="mu", equation="table at v_s", source=s.FROM_MEMORY)
def friction(sliding_velocity: s.v_s, *, tables: Tables | None = None) -> Real:
    """Coefficient of friction of phosphor bronze on a case-hardened worm.

    The last value of the table holds above 20 m/s.

    Examples
    --------
    >>> round(friction(1.5), 6)
    0.038
    """
    return (tables or read_tables()).friction("sliding_velocity", sliding_velocity, "m/s")


@formula(symbol="X_c", equation="K_V(v_s) K_R(n)", source=s.JGMA)
def wear_speed_factor(
    sliding_velocity: s.v_s, speed: s.n, *, member: Member = "wheel", tables: Tables | None = None
) -> Real:
    """Speed factor for wear of the member that is rated, up to 30 m/s and from 0.5 to 600 rpm."""
    known = tables or read_tables()
    sliding = known.sliding_speed_factor("sliding_velocity", sliding_velocity, "m/s")
    return sliding * known.rotation_speed_factor(f"{member}_speed", speed, "rpm")


@formula(symbol="Z", equation="Z_0(z_1, q) min(b/(2 m sqrt(q + 1)), 1.15)", source=s.VERIFIED)
def zone_factor(
    starts: s.z_1,
    diameter_factor: s.q,
    face_width: s.b,
    axial_module: s.m,
    *,
    tables: Tables | None = None,
) -> Real:
    """Zone factor, for 1 to 4 starts and a diameter factor from 6 to 20; the table is from memory.

    Above 2.3 m sqrt(q + 1) a face width does not count.

    Examples
    --------
    >>> round(zone_factor(1, 10, 2 * 10 * 11**0.5, 10), 3)
    1.143
    """
    basic = (tables or read_tables()).zone_factor(starts, diameter_factor)
    share = face_width / (2.0 * axial_module * np.sqrt(diameter_factor + 1.0))
    return basic * np.minimum(share, 0.5 * 2.3)


@formula(symbol="M_c", unit="N m", equation="0.00191 X_c S_c Z d_2^1.8 m", source=s.VERIFIED)
def wear_torque(
    wear_speed_factor: s.X_c,
    surface_stress_factor: s.S_c,
    zone_factor: s.Z,
    wheel_diameter: s.d_2,
    axial_module: s.m,
) -> Real:
    """Torque of the wheel permitted by wear; speed and stress factor are those of one member.

    IS 7443 has 18.64 for kgf/mm2 and N mm, which is 0.00190.
    """
    factors = 0.00191 * wear_speed_factor * surface_stress_factor * zone_factor
    return factors * wheel_diameter**1.8 * axial_module


@formula(symbol="X_b", equation="table at n", source=s.FROM_MEMORY)
def strength_speed_factor(
    speed: s.n, *, member: Member = "wheel", tables: Tables | None = None
) -> Real:
    """Speed factor for strength of the member that is rated, from 1 to 1200 rpm; within 0.03."""
    return (tables or read_tables()).strength_speed_factor(f"{member}_speed", speed, "rpm")


@formula(
    symbol="l_r",
    unit="mm",
    equation="(d_a1 + 0.4 m cos(gamma)) asin(min(b, 2 m sqrt(q + 1))/(d_a1 + 0.4 m cos(gamma)))",
    source=s.FROM_MEMORY,
    because="the face width is above the worm's tip diameter; make it smaller",
)
def root_arc(
    face_width: s.b,
    worm_tip_diameter: s.d_a1,
    axial_module: s.m,
    diameter_factor: s.q,
    lead_angle: s.gamma,
) -> Real:
    """Length of the root of the wheel's teeth, with a clearance of 0.2 m cos(gamma)."""
    diameter = worm_tip_diameter + 0.4 * axial_module * np.cos(lead_angle)
    width = np.minimum(face_width, 2.0 * axial_module * np.sqrt(diameter_factor + 1.0))
    return diameter * np.arcsin(width / diameter)


@formula(
    symbol="M_b", unit="N m", equation="0.0018 X_b S_b m l_r d_2 cos(gamma)", source=s.FROM_MEMORY
)
def strength_torque(
    strength_speed_factor: s.X_b,
    bending_stress_factor: s.S_b,
    axial_module: s.m,
    root_arc: s.l_r,
    wheel_diameter: s.d_2,
    lead_angle: s.gamma,
) -> Real:
    """Torque of the wheel permitted by strength; speed and stress factor are of one member."""
    factors = 0.0018 * strength_speed_factor * bending_stress_factor * axial_module
    return factors * root_arc * wheel_diameter * np.cos(lead_angle)

"""Permissible torques by BS 721-2:1983, one function for each formula.

In mm, m/s, rpm, N m and MPa; angles are in radians, see `asperity.formulas`. The tables are data,
almost all of it from memory: a user's own file takes their place, see `read_tables`. Where one
ends, `TableRangeError` is raised.
"""

from asperity.rating.bs721.life import strength_life_factor, wear_life_factor
from asperity.rating.bs721.limits import VALIDITY
from asperity.rating.bs721.tables import TableRangeError, Tables, read_tables
from asperity.rating.bs721.torque import (
    friction,
    root_arc,
    strength_speed_factor,
    strength_torque,
    wear_speed_factor,
    wear_torque,
    zone_factor,
)

__all__ = [
    "VALIDITY",
    "TableRangeError",
    "Tables",
    "friction",
    "read_tables",
    "root_arc",
    "strength_life_factor",
    "strength_speed_factor",
    "strength_torque",
    "wear_life_factor",
    "wear_speed_factor",
    "wear_torque",
    "zone_factor",
]

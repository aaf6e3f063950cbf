"""Permissible torques by BS 721-2:1983, one function for each formula.

In mm, m/s, rpm, N m and MPa; angles are in radians. The tables are data, almost all of it from
memory: a user's own file takes their place, see `read_tables`. Numbers give a number, arrays an
array; a number that is not allowed raises `InputError` (`TableRangeError` where a table ends), and
so does an array unless ``on_invalid="mask"`` asks for `asperity.rating.formula.Masked`.
"""

from asperity.rating.bs721.life import (
    LIFE_HOURS,
    equivalent_hours,
    running_hours,
    strength_life_factor,
    wear_life_factor,
)
from asperity.rating.bs721.limits import SOURCES, VALIDITY
from asperity.rating.bs721.permissible import Limit, Permissible, permissible_torques
from asperity.rating.bs721.tables import TableRangeError, Tables, read_tables
from asperity.rating.bs721.torque import (
    friction,
    root_arc,
    strength_speed_factor,
    strength_speed_factor_from_velocity,
    strength_torque,
    wear_speed_factor,
    wear_torque,
    zone_factor,
)

__all__ = [
    "LIFE_HOURS",
    "SOURCES",
    "VALIDITY",
    "Limit",
    "Permissible",
    "TableRangeError",
    "Tables",
    "equivalent_hours",
    "friction",
    "permissible_torques",
    "read_tables",
    "root_arc",
    "running_hours",
    "strength_life_factor",
    "strength_speed_factor",
    "strength_speed_factor_from_velocity",
    "strength_torque",
    "wear_life_factor",
    "wear_speed_factor",
    "wear_torque",
    "zone_factor",
]

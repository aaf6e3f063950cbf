"""Where BS 721 is valid, and how far each formula can be trusted."""

from collections.abc import Mapping

from asperity.sources import Range, Source

_VERIFIED = Source("BS 721-2:1983", "verified")
_FROM_MEMORY = Source("BS 721-2:1983", "from memory")
_JGMA = Source("JGMA 405-01", "one source")

SOURCES: Mapping[str, Source] = {
    "zone_factor": _VERIFIED,
    "wear_torque": _VERIFIED,
    "wear_speed_factor": _FROM_MEMORY,
    "strength_speed_factor": _FROM_MEMORY,
    "strength_speed_factor_from_velocity": _FROM_MEMORY,
    "root_arc": _FROM_MEMORY,
    "strength_torque": _FROM_MEMORY,
    "friction": _FROM_MEMORY,
    "wear_life_factor": _FROM_MEMORY,
    "strength_life_factor": _FROM_MEMORY,
    "equivalent_hours": _FROM_MEMORY,
    "LIFE_HOURS": _FROM_MEMORY,
}
"""Who says so, for each formula by its name; the tables have sources of their own."""

VALIDITY: Mapping[str, Range] = {
    "axial_module": Range("axial module m", 1.0, 25.0, "mm", _JGMA),
    "wheel_diameter": Range("pitch diameter of the wheel d_2", 0.0, 900.0, "mm", _JGMA),
    "sliding_velocity": Range("sliding velocity v_s", 0.0, 30.0, "m/s", _JGMA),
    "wheel_speed": Range("wheel speed n_2", 0.0, 600.0, "rpm", _JGMA),
}
"""Where the standard's Japanese relative is valid, by the parameter."""

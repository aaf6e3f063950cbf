"""Where BS 721 is valid."""

from collections.abc import Mapping

from asperity.sources import Range, Source

_JGMA = Source("JGMA 405-01", "one source")

VALIDITY: Mapping[str, Range] = {
    "axial_module": Range("axial module m", 1.0, 25.0, "mm", _JGMA),
    "wheel_diameter": Range("pitch diameter of the wheel d_2", 0.0, 900.0, "mm", _JGMA),
    "sliding_velocity": Range("sliding velocity v_s", 0.0, 30.0, "m/s", _JGMA),
    "wheel_speed": Range("wheel speed n_2", 0.0, 600.0, "rpm", _JGMA),
}
"""Where the standard's Japanese relative is valid, by the parameter."""

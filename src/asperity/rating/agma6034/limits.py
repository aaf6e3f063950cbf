"""Where AGMA 6034-B92 is valid; see also `asperity.rating.agma6034.mesh.maximum_lead_angle`."""

from collections.abc import Mapping

from asperity.rating.agma6034.symbols import (
    LARGEST_RATIO,
    METRE_A_SECOND,
    SCOPE,
    VERIFIED,
)
from asperity.sources import Range

VALIDITY: Mapping[str, Range] = {
    "sliding_velocity": Range(
        "sliding velocity V_s", 0.0, 6000.0 * METRE_A_SECOND.size, "m/s", SCOPE
    ),
    "worm_speed": Range("worm speed n_W", 0.0, 3600.0, "rpm", SCOPE),
    "gear_ratio": Range("gear ratio m_G", 3.0, LARGEST_RATIO, "", VERIFIED),
    "pressure_angle": Range("pressure angle", 14.5, 30.0, "deg", VERIFIED),
}
"""Where the standard is valid, by the parameter."""

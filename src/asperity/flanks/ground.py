"""The profile of every flank type by its name."""

from asperity.errors import InputError
from asperity.flanks import ruled
from asperity.flanks.parameters import Disc
from asperity.flanks.profiles import AxialProfile


def profile(
    flank: str,
    pitch_radius: float,
    lead_angle: float,
    pressure_angle: float,
    half_space: float,
    reach: tuple[float, float],
    disc: Disc | None = None,
) -> AxialProfile:
    """Return the axial section of a flank."""
    match flank:
        case "ZI":
            return ruled.involute(pitch_radius, lead_angle, pressure_angle)
        case "ZA":
            return ruled.archimedean(pitch_radius, lead_angle, pressure_angle)
        case "ZN":
            return ruled.convolute(pitch_radius, lead_angle, pressure_angle, half_space)
    raise InputError(f"gearset.flank is {flank!r}; it must be one of 'ZI', 'ZA', 'ZN'")

"""The axial section of every type of flank, by the type's name."""

import math

from asperity.errors import InputError, one_of
from asperity.flanks.parameters import DISC_PROFILE_RADIUS, Disc
from asperity.flanks.worm import ruled
from asperity.flanks.worm.ground import fit, ground
from asperity.flanks.worm.profiles import AxialProfile

_MILLIMETRES = 1e3

TYPES = ("ZI", "ZA", "ZN", "ZK", "ZC")


def profile(
    flank: str,
    *,
    pitch_radius: float,
    lead_angle: float,
    pressure_angle: float,
    half_space: float,
    reach: tuple[float, float, float],
    module: float,
    disc: Disc | None = None,
) -> AxialProfile:
    """Return the axial section of a flank, in mm and rad.

    ``half_space`` is half the axial width of the thread space at the pitch radius; ``reach`` the
    radii of the root, down to which the flank is needed, and of the tip; the disc that grinds ZK
    and ZC has its profile radius in axial modules where that is left out.
    """
    match flank:
        case "ZI":
            return ruled.involute(pitch_radius, lead_angle, pressure_angle)
        case "ZA":
            return ruled.archimedean(pitch_radius, lead_angle, pressure_angle)
        case "ZN":
            return ruled.convolute(pitch_radius, lead_angle, pressure_angle, half_space)
        case "ZK" | "ZC":
            given = disc or Disc()
            arc = math.inf
            if flank == "ZC":
                radius = given.profile_radius
                arc = DISC_PROFILE_RADIUS * module if radius is None else radius * _MILLIMETRES
            made = fit(
                pitch_radius,
                lead_angle,
                pressure_angle,
                half_space,
                given.diameter * _MILLIMETRES / 2.0,
                arc,
            )
            return ground(flank, made, *reach)
    raise InputError(f"gearset.flank is {flank!r}; {one_of(TYPES, flank)}")

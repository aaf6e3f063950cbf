r"""Flanks that a straight line sweeps out: involute ZI, Archimedean ZA, convolute ZN.

The line touches a cylinder about the axis (radius :math:`|h|`) and rises by :math:`\tan\delta`
along its way. Names of the types as in ISO/TR 10828; lengths in mm, angles in rad.
"""

import math

from asperity.errors import ConvergenceError
from asperity.flanks.worm.profiles import SECTION, AxialProfile, record
from asperity.gearset import relations


def _line(
    flank: str,
    reduced_lead: float,
    offset: float,
    slope: float,
    excess: float,
    base_radius: float | None = None,
) -> AxialProfile:
    line = record(SECTION, reduced_lead=reduced_lead, offset=offset, slope=slope, excess=excess)
    return AxialProfile(flank, line, base_radius=base_radius)


def involute(pitch_radius: float, lead_angle: float, pressure_angle: float) -> AxialProfile:
    r"""Profile of ZI: the line touches the base helix.

    :math:`\cos\gamma_b = \cos\gamma\cos\alpha_n`, :math:`h = r_b = p/\tan\gamma_b`,
    :math:`\delta = \gamma_b`. Below :math:`r_b` the flank goes on radially.
    """
    p = pitch_radius * math.tan(lead_angle)
    base_lead = relations.base_lead_angle(pressure_angle, lead_angle)
    radius = p / math.tan(base_lead)
    return _line("ZI", p, radius, math.tan(base_lead), 0.0, radius)


def archimedean(pitch_radius: float, lead_angle: float, pressure_angle: float) -> AxialProfile:
    r"""Profile of ZA: the line meets the axis, :math:`f = \rho\tan\alpha_n/\cos\gamma`."""
    p = pitch_radius * math.tan(lead_angle)
    return _line("ZA", p, 0.0, math.tan(pressure_angle) / math.cos(lead_angle), -p)


def convolute(
    pitch_radius: float, lead_angle: float, pressure_angle: float, half_space: float
) -> AxialProfile:
    r"""Profile of ZN: the line is the edge of a blade in the normal section of the thread space.

    The blade's plane holds the radius through the middle of the space and the normal to the thread
    at the pitch radius. Its two edges enclose :math:`2\alpha_n` and would meet at the radius
    :math:`r_v`, which follows from the width of the space at the pitch radius. With
    :math:`L^2 = 1 + \sin^2\gamma\tan^2\alpha_n`, :math:`h = -r_v\sin\gamma\tan\alpha_n/L` and
    :math:`\tan\delta = \cos\gamma\tan\alpha_n/L`.

    Parameters
    ----------
    pitch_radius, lead_angle, pressure_angle : float
        :math:`r_1`, :math:`\gamma`, :math:`\alpha_n`.
    half_space : float
        Half the axial width of the thread space at the pitch radius.
    """
    r, sine, cosine = pitch_radius, math.sin(lead_angle), math.cos(lead_angle)
    p = r * math.tan(lead_angle)
    # The edge meets the pitch cylinder at the angle -psi, where the space is half_space wide.
    psi = half_space * sine * cosine / r
    for _ in range(50):
        rest = r * cosine / sine * math.sin(psi) + p * psi - half_space
        step = rest / (r * cosine / sine * math.cos(psi) + p)
        psi -= step
        if abs(step) <= 1e-15 * psi:
            break
    else:
        raise ConvergenceError("the blade of the ZN flank was not found", reached={"mm": rest})
    vertex = r * math.cos(psi) - r * math.sin(psi) / (sine * math.tan(pressure_angle))
    length = math.hypot(1.0, sine * math.tan(pressure_angle))
    offset = -vertex * sine * math.tan(pressure_angle) / length
    slope = cosine * math.tan(pressure_angle) / length
    return _line("ZN", p, offset, slope, offset * slope - p)

"""The relations between the numbers of a worm gearset.

Lengths go in and come out in one unit of your choice, angles in radians. Every function takes
numbers or arrays, see `asperity.formulas`. The symbols are those of ISO/TR 14521; the shaft angle
is 90 deg.
"""

import numpy as np

from asperity.arrays import Real
from asperity.formulas import formula
from asperity.gearset.symbols import (
    a,
    alpha_n,
    d_a1,
    d_e2,
    d_m1,
    gamma_b,
    gamma_m1,
    m_x1,
    p,
    q_1,
    x_2,
    z_1,
    z_2,
)


@formula(symbol="gamma_m1", unit="rad", equation="atan(z_1/q_1)")
def lead_angle(starts: z_1, diameter_factor: q_1) -> Real:
    """Lead angle of the worm on its reference cylinder, rad.

    Examples
    --------
    >>> round(lead_angle(4, 8.4), 6)
    0.444419
    """
    return np.arctan2(starts, diameter_factor)


@formula(symbol="u", equation="z_2/z_1")
def gear_ratio(starts: z_1, wheel_teeth: z_2) -> Real:
    """Ratio of the speeds of worm and wheel."""
    return wheel_teeth / starts


@formula(symbol="d_m1", equation="q_1 m_x1")
def worm_pitch_diameter(axial_module: m_x1, diameter_factor: q_1) -> Real:
    """Reference diameter of the worm."""
    return diameter_factor * axial_module


@formula(symbol="d_m2", equation="2 a - d_m1")
def wheel_mean_diameter(centre_distance: a, worm_pitch_diameter: d_m1) -> Real:
    """Mean diameter of the wheel."""
    return 2.0 * centre_distance - worm_pitch_diameter


@formula(symbol="d_2", equation="z_2 m_x1")
def wheel_reference_diameter(axial_module: m_x1, wheel_teeth: z_2) -> Real:
    """Diameter on which the wheel's pitch is the worm's."""
    return wheel_teeth * axial_module


@formula(symbol="a", equation="m_x1 (q_1 + z_2 + 2 x_2)/2")
def centre_distance(
    axial_module: m_x1, diameter_factor: q_1, wheel_teeth: z_2, profile_shift: x_2 = 0.0
) -> Real:
    """Centre distance.

    Examples
    --------
    >>> round(centre_distance(2.1538, 8.4, 60), 3)
    73.66
    """
    return axial_module * (diameter_factor + wheel_teeth + 2.0 * profile_shift) / 2.0


@formula(symbol="x_2", equation="a/m_x1 - (q_1 + z_2)/2")
def profile_shift(
    centre_distance: a, axial_module: m_x1, diameter_factor: q_1, wheel_teeth: z_2
) -> Real:
    """Profile shift factor of the wheel.

    Examples
    --------
    >>> round(profile_shift(74.93, 2.1962, 8.2, 60), 3)
    0.018
    """
    return centre_distance / axial_module - (diameter_factor + wheel_teeth) / 2.0


@formula(symbol="m_x1", equation="2 a/(q_1 + z_2 + 2 x_2)")
def axial_module(
    centre_distance: a, diameter_factor: q_1, wheel_teeth: z_2, profile_shift: x_2 = 0.0
) -> Real:
    """Axial module of the worm."""
    return 2.0 * centre_distance / (diameter_factor + wheel_teeth + 2.0 * profile_shift)


@formula(symbol="q_1", equation="2 a/m_x1 - z_2 - 2 x_2")
def diameter_factor(
    centre_distance: a, axial_module: m_x1, wheel_teeth: z_2, profile_shift: x_2 = 0.0
) -> Real:
    """Diameter factor of the worm.

    It is negative where the wheel alone is too large for the centre distance.
    """
    return 2.0 * centre_distance / axial_module - wheel_teeth - 2.0 * profile_shift


@formula(symbol="m_n", equation="m_x1 cos(gamma_m1)")
def normal_module(axial_module: m_x1, lead_angle: gamma_m1) -> Real:
    """Module in the normal section."""
    return axial_module * np.cos(lead_angle)


@formula(symbol="p", equation="z_1 m_x1/2")
def reduced_lead(axial_module: m_x1, starts: z_1) -> Real:
    """Advance of the thread per radian, length/rad."""
    return starts * axial_module / 2.0


@formula(symbol="alpha_x", unit="rad", equation="atan(tan(alpha_n)/cos(gamma_m1))")
def axial_pressure_angle(pressure_angle: alpha_n, lead_angle: gamma_m1) -> Real:
    """Pressure angle in the worm's axial section.

    This is the wheel's transverse section.
    """
    return np.arctan(np.tan(pressure_angle) / np.cos(lead_angle))


@formula(symbol="alpha_t", unit="rad", equation="atan(tan(alpha_n)/sin(gamma_m1))")
def transverse_pressure_angle(pressure_angle: alpha_n, lead_angle: gamma_m1) -> Real:
    """Pressure angle square to the worm's axis."""
    return np.arctan(np.tan(pressure_angle) / np.sin(lead_angle))


@formula(symbol="gamma_b", unit="rad", equation="acos(cos(gamma_m1) cos(alpha_n))")
def base_lead_angle(pressure_angle: alpha_n, lead_angle: gamma_m1) -> Real:
    """Lead angle on the base cylinder of a ZI worm.

    Examples
    --------
    >>> round(base_lead_angle(0.349066, 0.444419), 5)
    0.55782
    """
    return np.arccos(np.cos(lead_angle) * np.cos(pressure_angle))


@formula(symbol="r_b1", equation="p/tan(gamma_b)")
def base_radius(reduced_lead: p, base_lead_angle: gamma_b) -> Real:
    """Radius of the base cylinder of a ZI worm.

    Examples
    --------
    >>> round(base_radius(4.3076, 0.55782), 3)
    6.904
    """
    return reduced_lead / np.tan(base_lead_angle)


@formula(symbol="b_2max", equation="2 m_x1 sqrt(q_1 + 1)")
def widest_contact(axial_module: m_x1, diameter_factor: q_1) -> Real:
    """Face width of the wheel that the worm can reach.

    It is the chord that the tip cylinder of a worm of addendum :math:`m_{x1}` cuts from the plane
    that touches its reference cylinder; BS 721 rates no more than this.
    """
    return 2.0 * axial_module * np.sqrt(diameter_factor + 1.0)


@formula(symbol="b_2max", equation="m_x1 sqrt(6 q_1 - 9)")
def reference_chord(axial_module: m_x1, diameter_factor: q_1) -> Real:
    """Face width between the flanks of the worm, by a commercial program's report.

    It is the chord that the reference cylinder of the worm cuts from a plane 1.5 modules deeper,
    and some 5 % more than `widest_contact`.

    Examples
    --------
    >>> round(reference_chord(6.4999, 8.5), 2)
    42.12
    """
    return axial_module * np.sqrt(6.0 * diameter_factor - 9.0)


@formula(symbol="b_1", equation="2 sqrt((d_e2/2)^2 - (a - d_a1/2)^2)")
def worm_reach(wheel_outside_diameter: d_e2, centre_distance: a, worm_tip_diameter: d_a1) -> Real:
    r"""Length of worm that the wheel can touch, zero where they do not meet.

    :math:`2 \sqrt{(d_{e2}/2)^2 - (a - d_{a1}/2)^2}`, the chord that the worm's tip line cuts from
    the wheel's outside circle.
    """
    reach = wheel_outside_diameter / 2.0
    gap = centre_distance - worm_tip_diameter / 2.0
    return 2.0 * np.sqrt(np.maximum(reach**2 - gap**2, 0.0))

r"""The relations between the numbers of a worm gearset.

Lengths go in and come out in one unit of your choice, angles in radians. Every function takes
numbers or arrays, and gives a float where it was given numbers; an argument that is not positive
(or not finite, for a profile shift) raises InputError. The symbols are those of ISO/TR 14521; the
shaft angle is 90 deg.
"""

from typing import Any

import numpy as np

from asperity.gearset.arrays import Real, relation


@relation
def lead_angle(starts: Real, diameter_factor: Real) -> Any:
    r"""Lead angle of the worm on its reference cylinder, :math:`\gamma = \arctan(z_1/q_1)`, rad.

    Examples
    --------
    >>> round(lead_angle(4, 8.4), 6)
    0.444419
    """
    return np.arctan2(starts, diameter_factor)


@relation
def gear_ratio(starts: Real, wheel_teeth: Real) -> Any:
    """Ratio of the speeds of worm and wheel, :math:`u = z_2/z_1`."""
    return wheel_teeth / starts


@relation
def worm_pitch_diameter(axial_module: Real, diameter_factor: Real) -> Any:
    r"""Reference diameter of the worm, :math:`d_{m1} = q_1 m_{x1}`."""
    return diameter_factor * axial_module


@relation
def wheel_mean_diameter(centre_distance: Real, worm_pitch_diameter: Real) -> Any:
    r"""Mean diameter of the wheel, :math:`d_{m2} = 2a - d_{m1}`."""
    return 2.0 * centre_distance - worm_pitch_diameter


@relation
def wheel_reference_diameter(axial_module: Real, wheel_teeth: Real) -> Any:
    r"""Diameter on which the wheel's pitch is the worm's, :math:`d_2 = z_2 m_{x1}`."""
    return wheel_teeth * axial_module


@relation
def centre_distance(
    axial_module: Real, diameter_factor: Real, wheel_teeth: Real, profile_shift: Real = 0.0
) -> Any:
    r"""Centre distance, :math:`a = m_{x1} (q_1 + z_2 + 2 x_2)/2`.

    Examples
    --------
    >>> round(centre_distance(2.1538, 8.4, 60), 3)
    73.66
    """
    return axial_module * (diameter_factor + wheel_teeth + 2.0 * profile_shift) / 2.0


@relation
def profile_shift(
    centre_distance: Real, axial_module: Real, diameter_factor: Real, wheel_teeth: Real
) -> Any:
    r"""Profile shift factor of the wheel, :math:`x_2 = a/m_{x1} - (q_1 + z_2)/2`.

    Examples
    --------
    >>> round(profile_shift(74.93, 2.1962, 8.2, 60), 3)
    0.018
    """
    return centre_distance / axial_module - (diameter_factor + wheel_teeth) / 2.0


@relation
def axial_module(
    centre_distance: Real, diameter_factor: Real, wheel_teeth: Real, profile_shift: Real = 0.0
) -> Any:
    r"""Axial module of the worm, :math:`m_{x1} = 2a/(q_1 + z_2 + 2 x_2)`."""
    return 2.0 * centre_distance / (diameter_factor + wheel_teeth + 2.0 * profile_shift)


@relation
def diameter_factor(
    centre_distance: Real, axial_module: Real, wheel_teeth: Real, profile_shift: Real = 0.0
) -> Any:
    r"""Diameter factor of the worm, :math:`q_1 = 2a/m_{x1} - z_2 - 2 x_2`.

    It is negative where the wheel alone is too large for the centre distance.
    """
    return 2.0 * centre_distance / axial_module - wheel_teeth - 2.0 * profile_shift


@relation
def normal_module(axial_module: Real, lead_angle: Real) -> Any:
    r"""Module in the normal section, :math:`m_n = m_{x1} \cos\gamma`."""
    return axial_module * np.cos(lead_angle)


@relation
def reduced_lead(axial_module: Real, starts: Real) -> Any:
    r"""Advance of the thread per radian, :math:`p = z_1 m_{x1}/2`, length/rad."""
    return starts * axial_module / 2.0


@relation
def axial_pressure_angle(pressure_angle: Real, lead_angle: Real) -> Any:
    r"""Pressure angle in the worm's axial section, :math:`\tan\alpha_x = \tan\alpha_n/\cos\gamma`.

    This is the wheel's transverse section.
    """
    return np.arctan(np.tan(pressure_angle) / np.cos(lead_angle))


@relation
def transverse_pressure_angle(pressure_angle: Real, lead_angle: Real) -> Any:
    r"""Pressure angle square to the worm's axis, :math:`\tan\alpha_t = \tan\alpha_n/\sin\gamma`."""
    return np.arctan(np.tan(pressure_angle) / np.sin(lead_angle))


@relation
def base_lead_angle(pressure_angle: Real, lead_angle: Real) -> Any:
    r"""Lead angle on the base cylinder of a ZI worm, :math:`\cos\gamma_b = \cos\gamma\cos\alpha_n`.

    Examples
    --------
    >>> round(base_lead_angle(0.349066, 0.444419), 5)
    0.55782
    """
    return np.arccos(np.cos(lead_angle) * np.cos(pressure_angle))


@relation
def base_radius(reduced_lead: Real, base_lead_angle: Real) -> Any:
    r"""Radius of the base cylinder of a ZI worm, :math:`r_b = p/\tan\gamma_b`.

    Examples
    --------
    >>> round(base_radius(4.3076, 0.55782), 3)
    6.904
    """
    return reduced_lead / np.tan(base_lead_angle)


@relation
def widest_contact(axial_module: Real, diameter_factor: Real) -> Any:
    r"""Face width of the wheel that the worm can reach, :math:`2 m_{x1} \sqrt{q_1 + 1}`.

    It is the chord that the tip cylinder of a worm of addendum :math:`m_{x1}` cuts from the plane
    that touches its reference cylinder; BS 721 rates no more than this.
    """
    return 2.0 * axial_module * np.sqrt(diameter_factor + 1.0)


@relation
def worm_reach(wheel_outside_diameter: Real, centre_distance: Real, worm_tip_diameter: Real) -> Any:
    r"""Length of worm that the wheel can touch, zero where they do not meet.

    :math:`2 \sqrt{(d_{e2}/2)^2 - (a - d_{a1}/2)^2}`, the chord that the worm's tip line cuts from
    the wheel's outside circle.
    """
    reach = wheel_outside_diameter / 2.0
    gap = centre_distance - worm_tip_diameter / 2.0
    return 2.0 * np.sqrt(np.maximum(reach**2 - gap**2, 0.0))

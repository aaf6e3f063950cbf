"""Forces at the teeth and bending stress, as Shigley's book has them beside AGMA 6034-B92."""

import numpy as np

from asperity.arrays import Real
from asperity.formulas import formula, not_negative
from asperity.rating.agma6034 import symbols as s

_LEWIS_FORM_FACTORS = (0.100, 0.125, 0.150, 0.175)
_CANNOT_DRIVE = "with this friction and lead angle the worm cannot drive"


@formula(
    symbol="W_W",
    unit=s.NEWTON,
    equation="W_G (cos(phi_n) sin(lambda) + f cos(lambda))/(cos(phi_n) cos(lambda) - f "
    "sin(lambda))",
    source=s.SHIGLEY,
    result=not_negative,
    because=_CANNOT_DRIVE,
)
def worm_tangential_load(
    wheel_load: s.W_G, friction: s.f, lead_angle: s.lambda_, pressure_angle: s.phi_n
) -> Real:
    """Tangential load on the worm."""
    cos, sin = np.cos(lead_angle), np.sin(lead_angle)
    normal = np.cos(pressure_angle)
    return wheel_load * (normal * sin + friction * cos) / (normal * cos - friction * sin)


@formula(
    symbol="W_f",
    unit=s.NEWTON,
    equation="f W_G/(cos(phi_n) cos(lambda) - f sin(lambda))",
    source=s.SHIGLEY,
    result=not_negative,
    because=_CANNOT_DRIVE,
)
def friction_force(
    wheel_load: s.W_G, friction: s.f, lead_angle: s.lambda_, pressure_angle: s.phi_n
) -> Real:
    """Friction force along the worm's thread.

    Shigley's form, printed there with the opposite sign: the normal force balances the load
    together with the friction, which closes the balance of power. AGMA's own has that of a
    frictionless tooth, without the term f sin(lambda).
    """
    normal = np.cos(pressure_angle) * np.cos(lead_angle) - friction * np.sin(lead_angle)
    return friction * wheel_load / normal


@formula(symbol="y", equation="table, linear over phi_n", source=s.SHIGLEY)
def lewis_form_factor(pressure_angle: s.phi_n_tabulated) -> Real:
    """Lewis form factor of the wheel's teeth, to be used with a circular pitch.

    0.100, 0.125, 0.150 and 0.175 for 14.5, 20, 25 and 30 degrees.
    """
    return np.interp(pressure_angle, s.PRESSURE_ANGLES, _LEWIS_FORM_FACTORS)


@formula(
    symbol="sigma_a", unit=s.MEGAPASCAL, equation="W_G/(p_x cos(lambda) F_e y)", source=s.SHIGLEY
)
def bending_stress(
    wheel_load: s.W_G,
    axial_pitch: s.p_x,
    lead_angle: s.lambda_,
    effective_face_width: s.F_e,
    form_factor: s.y,
) -> Real:
    """Bending stress of the wheel's teeth: Buckingham's adaption of Lewis."""
    return wheel_load / (axial_pitch * np.cos(lead_angle) * effective_face_width * form_factor)

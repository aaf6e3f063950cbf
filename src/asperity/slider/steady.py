r"""Steady sliding without vibration: whether a body stays in it, or sticks and slips.

Friction is constant there but for LuGre's, whose limit :math:`g` falls with the speed. With the
drive's stretch :math:`e`, the body's velocity :math:`v` and the deflection :math:`z`,

.. math::
    \dot e = v_d - v,\quad
    m\dot v = k_d e + h_d(v_d - v) - k_t z - h_t\dot z - h_v v,\quad
    \dot z = v - \frac{k_t v}{g(v)}z

is linear about :math:`v = v_d`, :math:`z = g(v_d)/k_t`.
"""

import math

import numpy as np

from asperity.slider.model import Model

_NONE = 1e-9  # of the drive's own angular frequency: rounding


def growth_rate(model: Model) -> float:
    """Return the rate at which a disturbance of steady sliding grows, 1/s; 0 where none does."""
    slider, friction = model.slider, model.friction
    if slider.mass is None or slider.drive_stiffness is None or friction.model != "lugre":
        return 0.0
    if not friction.stribeck_velocity > 0.0:
        return 0.0
    v, mass, stiffness = slider.drive_velocity, slider.mass, slider.drive_stiffness
    full, asperities = model.full_friction, friction.stiffness(slider.normal_force)
    x = v / friction.stribeck_velocity
    falling = full * ((friction.static_mu or friction.mu) / friction.mu - 1.0) * math.exp(-x * x)
    held = full + falling
    follows = -2.0 * x * x * falling / held  # v g'/g
    relaxes = asperities * v / held
    contact = friction.contact_damping
    damping = slider.drive_damping + friction.viscous_damping + contact * follows
    matrix = [
        [0.0, -1.0, 0.0],
        [stiffness / mass, -damping / mass, -(asperities - contact * relaxes) / mass],
        [0.0, follows, -relaxes],
    ]
    with np.errstate(all="ignore"):
        if not np.all(np.isfinite(matrix)):
            return 0.0
        growth = float(np.linalg.eigvals(np.array(matrix)).real.max())
    return growth if growth > _NONE * math.sqrt(stiffness / mass) else 0.0


def sticks_and_slips(growth: float) -> str:
    """Say that steady sliding is unstable."""
    return (
        f"steady sliding is unstable, a disturbance grows by {growth:.3g}/s: the body sticks and "
        "slips"
    )

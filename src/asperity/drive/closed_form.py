r"""The screw's closed form: worm torque under a vibration that slides in the thread.

Shaken so that it turns and shifts by its own lead, a worm moves nothing along the normal, and at
every point of the flanks the vibration's velocity is the same share :math:`k` of the sliding's.
Friction then has its mean :math:`S\mu N`, :math:`S = 1` for :math:`k \le 1` and
:math:`(2/\pi)\arcsin(1/k)` above, and the ratio is :math:`T_B(S\mu)/T_B(\mu)`. It holds far above
the resonances of wheel and worm, so that the normal force does not swing, for amplitudes far above
the elastic slip of teeth and asperities (s_eff/u below 0.01), and for k of 1.05 or more.
"""

import numpy as np
import numpy.typing as npt

from asperity.arrays import FloatArray
from asperity.drive.point import MeshPoint
from asperity.slider.closed_forms import longitudinal_ratio


def screw_ratio(point: MeshPoint, friction: float, velocity_ratio: npt.ArrayLike) -> FloatArray:
    """Return the worm's mean torque over that without vibration.

    Parameters
    ----------
    point : MeshPoint
        Where worm and wheel touch.
    friction : float
        Coefficient of friction without vibration.
    velocity_ratio : array_like
        Peak velocity of the vibration over the sliding velocity, 0 or more.
    """
    share = np.asarray(longitudinal_ratio(np.asarray(velocity_ratio, float)))
    still = point.worm_torque(1.0, friction)
    torques = [point.worm_torque(1.0, s * friction) for s in share.ravel()]
    return np.asarray(torques).reshape(share.shape) / still


def frictionless_ratio(point: MeshPoint, friction: float) -> float:
    """Return the ratio without any friction, which no vibration of the flanks alone passes."""
    return point.worm_torque(1.0, 0.0) / point.worm_torque(1.0, friction)

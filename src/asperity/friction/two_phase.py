r"""The thesis's explicit two-phase update of the asperity, as printed.

Kept to reproduce the thesis and the finite element runs published with it. Its defects, none of
which the exponential update shares:

- explicit: linearly unstable for :math:`|v|\,\Delta t / s_{max} > 2`, first order in the step (3 %
  of the ratio at 33 steps a cycle, 0.03 % at 3333);
- the direction is forced to the drive axis up to the start of the vibration, so friction is
  one-sided there and a backward drive runs away;
- exponent 0 never saturates (:math:`1 - [..]^0` is 0), exponents below 1 overshoot the limit; the
  root of a negative number that the printed formula asks for there is taken as 0;
- the result depends on how the motion is divided into phases, hence on the axes chosen.
"""

import math

from asperity.kernels.compiled import kernel


@kernel
def _along(size, reach, exponent):
    """Deflection after its end moved from ``size`` to ``reach``: (44), (33), (79), (86)."""
    change = reach - size
    sign = 1.0 if change >= 0.0 else -1.0
    left = 1.0 - size * sign
    if exponent == 1.0:
        return size + change * left
    return size + change * max(left, 0.0) ** exponent


@kernel
def phases(size, ax, ay, d1x, d1y, d2x, d2y, exponent, one_sided):
    r"""Both phases of one time step, in units of ``s_max``.

    Parameters
    ----------
    size : float
        Deflection :math:`s_1` of the last step (signed as the thesis's scheme signs it).
    ax, ay : float
        Its direction, :math:`(\cos\beta, \sin\beta)`.
    d1x, d1y : float
        Slip of the first phase: the body's motion with the base's x motion in it
        (base vibrated, 4.5.1), or the x motion alone (body vibrated, 7.3.1).
    d2x, d2y : float
        Slip of the second phase: the transferred y motion of the base (4.5.2), or the
        transferred y motion of the body (7.3.2).
    exponent : float
        Dahl's exponent.
    one_sided : bool
        Before the start of the vibration the direction is the drive axis: (47)-(48), (58)-(59).

    Returns
    -------
    size, cos_beta, sin_beta : float
        New deflection and its direction.
    """
    rx = size * ax + d1x
    ry = size * ay + d1y
    reach = math.sqrt(rx * rx + ry * ry)
    middle = _along(size, reach, exponent)
    ca = 1.0
    sa = 0.0
    if not one_sided and reach > 0.0:
        ca = rx / reach
        sa = ry / reach
    rx = middle * ca + d2x
    ry = middle * sa + d2y
    reach = math.sqrt(rx * rx + ry * ry)
    last = _along(middle, reach, exponent)
    if one_sided or reach == 0.0:
        return last, 1.0, 0.0
    return last, rx / reach, ry / reach

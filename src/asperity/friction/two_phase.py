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
    """Deflection after its end moved from ``size`` to ``reach``: (44), (33), (79), (86).

    Also its slopes by the reach and by the size.
    """
    change = reach - size
    sign = 1.0 if change >= 0.0 else -1.0
    left = 1.0 - size * sign
    if exponent == 1.0:
        return size + change * left, left, 1.0 - left - sign * change
    # Beyond the limit a power of a negative number has no value.
    left = max(left, 0.0)
    power = left**exponent
    slope = exponent * left ** (exponent - 1.0) if left > 0.0 else 0.0
    return size + change * power, power, 1.0 - power - sign * change * slope


@kernel
def _phase(rx, ry, size, exponent, one_sided):
    """One of the two phases: the deflection's end moved to (rx, ry), in units of the limit.

    Returns the new signed size and its direction; how far the end reached, and the size's slopes
    by that and by the size before.
    """
    reach = math.sqrt(rx * rx + ry * ry)
    new, slope, keep = _along(size, reach, exponent)
    if one_sided or reach == 0.0:
        return new, 1.0, 0.0, reach, slope, keep
    return new, rx / reach, ry / reach, reach, slope, keep


@kernel
def _phase_slope(rx, ry, one_sided, phase):
    """Derivative of the deflection of a `_phase` by its end; and the end's direction.

    It is slope e f^T + size/reach (I - f f^T) with the directions e of the size and f of the end.
    """
    new, ex, ey, reach, slope, _ = phase
    fx = rx / reach if reach > 0.0 else 1.0
    fy = ry / reach if reach > 0.0 else 0.0
    turn = new / reach if not one_sided and reach > 0.0 else 0.0
    derivative = (
        slope * ex * fx + turn * (1.0 - fx * fx),
        slope * ex * fy - turn * fx * fy,
        slope * ey * fx - turn * fx * fy,
        slope * ey * fy + turn * (1.0 - fy * fy),
    )
    return derivative, fx, fy


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
    middle, ca, sa, _, _, _ = _phase(size * ax + d1x, size * ay + d1y, size, exponent, one_sided)
    last, ca, sa, _, _, _ = _phase(
        middle * ca + d2x, middle * sa + d2y, middle, exponent, one_sided
    )
    return last, ca, sa


@kernel
def phases_and_tangent(sx, sy, size, d1x, d1y, d2x, d2y, exponent, one_sided):
    """Both phases of one time step with their derivatives, in units of the limit.

    Parameters
    ----------
    sx, sy, size : float
        Committed deflection and its signed size.
    d1x, d1y, d2x, d2y : float
        Slip of the two phases, as in `phases`.
    exponent : float
        Dahl's exponent.
    one_sided : bool
        Before the start of the vibration.

    Returns
    -------
    size, cos_beta, sin_beta : float
        New signed size and direction.
    tangent_1, tangent_2 : tuple of 4 floats
        Derivative of the deflection by the slip of each phase, by rows.
    """
    rx = sx + d1x
    ry = sy + d1y
    phase = _phase(rx, ry, size, exponent, one_sided)
    first, fx, fy = _phase_slope(rx, ry, one_sided, phase)
    middle, ex, ey, _, slope, _ = phase
    rx = middle * ex + d2x
    ry = middle * ey + d2y
    phase = _phase(rx, ry, middle, exponent, one_sided)
    second, _, _ = _phase_slope(rx, ry, one_sided, phase)
    last, ca, sa, _, _, keep = phase
    axx, axy, ayx, ayy = first
    bxx, bxy, byx, byy = second
    # The middle enters twice: through the reach, and as the size the second phase starts from.
    mx = keep * slope * fx
    my = keep * slope * fy
    txx = bxx * axx + bxy * ayx + ca * mx
    txy = bxx * axy + bxy * ayy + ca * my
    tyx = byx * axx + byy * ayx + sa * mx
    tyy = byx * axy + byy * ayy + sa * my
    return last, ca, sa, (txx, txy, tyx, tyy), second

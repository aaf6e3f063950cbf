r"""The thesis's two-phase update of `asperity.friction.two_phase` with its derivatives."""

import math

from asperity.kernels.compiled import kernel


@kernel
def _along(size, reach, exponent):
    """Deflection after its end moved to ``reach``, and its slopes; thesis (44), (79).

    As `asperity.friction.two_phase`, which has no derivatives.
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

    Returns the new signed size and its direction; the direction of the end, the size's slopes by
    the end's reach and by the size before; and the derivative of the deflection by the end,
    slope e f^T + size/reach (I - f f^T) with the directions e and f.
    """
    reach = math.sqrt(rx * rx + ry * ry)
    new, slope, keep = _along(size, reach, exponent)
    fx = rx / reach if reach > 0.0 else 1.0
    fy = ry / reach if reach > 0.0 else 0.0
    ex = 1.0
    ey = 0.0
    turn = 0.0
    if not one_sided and reach > 0.0:
        ex = fx
        ey = fy
        turn = new / reach
    derivative = (
        slope * ex * fx + turn * (1.0 - fx * fx),
        slope * ex * fy - turn * fx * fy,
        slope * ey * fx - turn * fx * fy,
        slope * ey * fy + turn * (1.0 - fy * fy),
    )
    return new, ex, ey, fx, fy, slope, keep, derivative


@kernel
def phases_and_tangent(sx, sy, size, d1x, d1y, d2x, d2y, exponent, one_sided):
    """Both phases of one time step with their derivatives, in units of the limit.

    Parameters
    ----------
    sx, sy, size : float
        Committed deflection and its signed size.
    d1x, d1y, d2x, d2y : float
        Slip of the two phases, as in `asperity.friction.two_phase.phases`.
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
    middle, ex, ey, fx, fy, slope, _, first = _phase(sx + d1x, sy + d1y, size, exponent, one_sided)
    last, ca, sa, _, _, _, keep, second = _phase(
        middle * ex + d2x, middle * ey + d2y, middle, exponent, one_sided
    )
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

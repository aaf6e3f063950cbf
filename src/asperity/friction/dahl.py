r"""Dahl's asperity deflection in two dimensions: one update, three relaxation laws.

An asperity of the contact is a bristle with the deflection :math:`s`. It follows the slip
:math:`v = v_1 + v_2` and relaxes on the way,

.. math:: \dot s = v - \frac{a}{s_{max}}\, s ,

and the friction force is :math:`\mu F_N\, s / s_{max}` (stress: :math:`\mu p\, s / s_{max}`).
The laws differ in the relaxation rate :math:`a` alone (:math:`e = s/|s|`, exponent :math:`i`):

- ``vector``: :math:`a = |v|` for :math:`i = 1`, in general
  :math:`\dot w = -|w|^{i-1}|v|\,w/s_{max}` for the distance :math:`w = n - s/s_{max}` to the
  steady deflection in the slip direction :math:`n`. It does not depend on the frame.
- ``unsplit``: :math:`a = c_i(e \cdot v)\,|e \cdot v|`, Dahl's one-dimensional law along the
  asperity.
- ``split``: :math:`a = \sum_j c_i(e \cdot v_j)\,|e \cdot v_j|`, the limit of the thesis's two
  explicit phases (4.5.1, 4.5.2) as the time step goes to zero.

with :math:`c_i(u) = \mathrm{sgn}(u)\,\{1 - [1 - (|s|/s_{max})\,\mathrm{sgn}(u)]^i\}\,s_{max}/|s|`,
which is 1 for :math:`i = 1`. In one dimension the three coincide.

Deflections and slips of the kernels here are in units of :math:`s_{max}` unless said.
"""

import math

from asperity.kernels.compiled import kernel

SPLIT = 0
UNSPLIT = 1
VECTOR = 2
LAWS = {"split": SPLIT, "unsplit": UNSPLIT, "vector": VECTOR}

TINY = 1e-150


# (1 - exp(-h))/h = sum of (-h)^k/(k+1)!, exact to rounding up to h = 1/4.
_C1, _C2, _C3, _C4, _C5, _C6, _C7, _C8, _C9, _C10, _C11 = (
    (-1.0) ** k / math.factorial(k + 1) for k in range(1, 12)
)
SERIES_BOUND = 0.5


@kernel(inline="always")
def relaxation_gain(decay):
    """``(1 - exp(-A))/A`` for ``0 <= A <= SERIES_BOUND``: a series at A/2, doubled.

    No branch and no call of exp, so that a loop over cases becomes vector instructions; above the
    bound the error grows slowly (4e-14 at 1, 2e-10 at 2).
    """
    h = 0.5 * decay
    # In pairs: a march waits for this, and by Horner's rule it would wait twice as long.
    h2 = h * h
    h4 = h2 * h2
    low = (1.0 + h * _C1) + h2 * (_C2 + h * _C3)
    middle = (_C4 + h * _C5) + h2 * (_C6 + h * _C7)
    high = (_C8 + h * _C9) + h2 * (_C10 + h * _C11)
    half = low + h4 * (middle + h4 * high)
    return half - 0.5 * h * half * half


@kernel
def relaxation(decay):
    """``(exp(-A), (1 - exp(-A))/A)`` for a relaxation ``A >= 0``, exact to rounding at any size."""
    if decay <= SERIES_BOUND:
        gain = relaxation_gain(decay)
        return 1.0 - decay * gain, gain
    gain = -math.expm1(-decay) / decay
    return math.exp(-decay), gain


@kernel
def saturation(share, slip, exponent):
    """Dahl's factor ``c_i``: how fast a deflection ``share = |s|/s_max`` relaxes under ``slip``.

    Returns ``(c, dc/dshare)``; ``slip`` is the slip along the asperity, its sign alone counts.
    """
    if exponent == 1.0:
        return 1.0, 0.0
    sign = 1.0 if slip >= 0.0 else -1.0
    if share < 1e-9:
        return exponent, -0.5 * exponent * (exponent - 1.0) * sign
    left = 1.0 - sign * share
    if left <= 0.0:
        # At the limit [..]^i is 0 for every exponent, i = 0 among them only by projection.
        if exponent == 0.0:
            return 0.0, 0.0
        return 1.0 / share, -1.0 / (share * share)
    c = -sign * math.expm1(exponent * math.log1p(-sign * share)) / share
    return c, (exponent * left ** (exponent - 1.0) - c) / share


@kernel(inline="always")
def inverse_root(over):
    """``1/sqrt(1 + x)`` for a small overshoot ``0 <= x <= OVERSHOOT_BOUND``, to 1e-12, by a series.

    A midpoint step passes the limit by no more than about 1 %.
    """
    x = over
    return 1.0 + x * (
        -1 / 2 + x * (3 / 8 + x * (-5 / 16 + x * (35 / 128 + x * (-63 / 256 + x * (231 / 1024)))))
    )


OVERSHOOT_BOUND = 0.02
# Deflections between which the step of `unsplit` with an exponent above 1 becomes `along_law`.
NEAR_LIMIT = 0.5
NEARER_LIMIT = 0.6
# Of an exponent from 1, which it counts as: a power of one more has no digits there.
NEXT_TO_ONE = 1e-7


@kernel
def rate_along(ex, ey, share, d1x, d1y, d2x, d2y, exponent, law):
    """Relaxation over a step, ``a dt/s_max``, of an asperity along the unit vector ``e``."""
    if law == SPLIT:
        u1 = ex * d1x + ey * d1y
        u2 = ex * d2x + ey * d2y
        c1, _ = saturation(share, u1, exponent)
        c2, _ = saturation(share, u2, exponent)
        return c1 * abs(u1) + c2 * abs(u2)
    u = ex * (d1x + d2x) + ey * (d1y + d2y)
    c, _ = saturation(share, u, exponent)
    return c * abs(u)


@kernel
def half_way(sx, sy, d1x, d1y, d2x, d2y, exponent, law):
    """Size of the deflection before a step; deflection half-way, and what divides its length.

    Half-way is, to second order, ``(s + D/2)/(1 + rate/2)``: the direction needs no exponential,
    and a huge slip points it the right way.
    """
    size = math.sqrt(sx * sx + sy * sy)
    rate = 0.0
    # The size half-way matters only where the exponent makes the rate depend on it.
    if exponent != 1.0 and size > TINY:
        rate = rate_along(sx / size, sy / size, min(size, 1.0), d1x, d1y, d2x, d2y, exponent, law)
    return size, sx + 0.5 * (d1x + d2x), sy + 0.5 * (d1y + d2y), 1.0 + 0.5 * rate


@kernel
def step_rate(size, hx, hy, scale, sx, sy, d1x, d1y, d2x, d2y, exponent, law):
    """Relaxation over a step of ``split`` and ``unsplit``, taken `half_way` through it."""
    half = math.sqrt(hx * hx + hy * hy)
    if half > TINY:
        share = min(half / scale, 1.0)
        return rate_along(hx / half, hy / half, share, d1x, d1y, d2x, d2y, exponent, law)
    if size > TINY:
        # Half-way the asperity passes through zero, on the line it stands on.
        return rate_along(sx / size, sy / size, 0.0, d1x, d1y, d2x, d2y, exponent, law)
    return 0.0


@kernel
def near_limit(size, hx, hy, dx, dy, exponent, law):
    """How much of a step is `along_law`, and its slope by the size of the deflection before.

    Nothing far from the limit or where the slip bends back, all near it; without a corner, for
    Newton's method to go across.
    """
    if law != UNSPLIT or exponent <= 1.0 + NEXT_TO_ONE or not NEAR_LIMIT < size <= 1.0:
        return 0.0, 0.0
    if hx * dx + hy * dy <= 0.0:
        return 0.0, 0.0
    x = (size - NEAR_LIMIT) / (NEARER_LIMIT - NEAR_LIMIT)
    if x >= 1.0:
        return 1.0, 0.0
    return x * x * (3.0 - 2.0 * x), 6.0 * x * (1.0 - x) / (NEARER_LIMIT - NEAR_LIMIT)


@kernel
def along_law(sx, sy, size, hx, hy, dx, dy, exponent):
    """Step of ``unsplit`` near the limit: the size by the law along the asperity, exact for that.

    By a slip across, `by_rate` misses the size by more than an asperity near its limit still
    bends, which is a power of what is left.
    """
    along = (hx * dx + hy * dy) / math.sqrt(hx * hx + hy * hy)
    size1 = 1.0 - remaining_distance(1.0 - size, along, exponent)
    # What the size does not grow by is relaxed.
    decay, gain = relaxation(2.0 * (along + size - size1) / (size + size1))
    wx = sx * decay + dx * gain
    wy = sy * decay + dy * gain
    back = size1 / math.sqrt(wx * wx + wy * wy)
    return wx * back, wy * back


@kernel
def by_rate(sx, sy, d1x, d1y, d2x, d2y, exponent, law):
    """Step with the relaxation half-way, away from `near_limit`."""
    step = (sx, sy, d1x, d1y, d2x, d2y, exponent, law)
    size, hx, hy, scale = half_way(*step)
    decay, gain = relaxation(step_rate(size, hx, hy, scale, *step))
    sx1 = sx * decay + (d1x + d2x) * gain
    sy1 = sy * decay + (d1y + d2y) * gain
    # A coarse step can overshoot the limit by up to 0.6 %; LuGre's limit can fall below s.
    most = max(1.0, size)
    over = sx1 * sx1 + sy1 * sy1 - most * most
    if over > 0.0:
        if over <= OVERSHOOT_BOUND and most == 1.0:
            back = inverse_root(over)
        else:
            back = most / math.sqrt(over + most * most)
        sx1 *= back
        sy1 *= back
    return sx1, sy1


@kernel
def midpoint(sx, sy, d1x, d1y, d2x, d2y, exponent, law):
    """Exponential midpoint step of ``split`` and ``unsplit``; stays inside the limit."""
    if law == UNSPLIT and exponent > 1.0:
        dx = d1x + d2x
        dy = d1y + d2y
        hx = sx + 0.5 * dx
        hy = sy + 0.5 * dy
        size = math.sqrt(sx * sx + sy * sy)
        part, _ = near_limit(size, hx, hy, dx, dy, exponent, law)
        if part > 0.0:
            wx, wy = along_law(sx, sy, size, hx, hy, dx, dy, exponent)
            if part < 1.0:
                mx, my = by_rate(sx, sy, d1x, d1y, d2x, d2y, exponent, law)
                wx = mx + part * (wx - mx)
                wy = my + part * (wy - my)
            return wx, wy
    return by_rate(sx, sy, d1x, d1y, d2x, d2y, exponent, law)


@kernel
def to_steady(sx, sy, dx, dy, length):
    """Direction of a slip, the way from a deflection to the steady one there, and its length."""
    nx = dx / length
    ny = dy / length
    wx = nx - sx
    wy = ny - sy
    return nx, ny, wx, wy, math.sqrt(wx * wx + wy * wy)


@kernel
def closed_form(sx, sy, dx, dy, exponent):
    """Exact step of ``vector`` for a slip of constant direction, any exponent."""
    length = math.sqrt(dx * dx + dy * dy)
    if length <= TINY:
        return sx + dx, sy + dy
    if abs(exponent - 1.0) < NEXT_TO_ONE:
        decay, gain = relaxation(length)
        return sx * decay + dx * gain, sy * decay + dy * gain
    nx, ny, wx, wy, rho = to_steady(sx, sy, dx, dy, length)
    if rho <= TINY:
        return nx, ny
    left = remaining_distance(rho, length, exponent) / rho
    return nx - left * wx, ny - left * wy


@kernel
def remaining_distance(rho, length, exponent):
    """Distance to the steady deflection after slipping ``length`` from the distance ``rho``."""
    if abs(exponent - 1.0) < NEXT_TO_ONE:
        return rho * math.exp(-length)
    order = 1.0 - exponent
    base = 1.0 - order * length * rho ** (-order)
    if base <= 0.0:
        return 0.0
    return rho * base ** (1.0 / order)


@kernel
def advance(sx, sy, d1x, d1y, d2x, d2y, exponent, law):
    """Deflection after the slip ``D1 + D2``; all in units of ``s_max``, nothing stored."""
    if law == VECTOR:
        return closed_form(sx, sy, d1x + d2x, d1y + d2y, exponent)
    return midpoint(sx, sy, d1x, d1y, d2x, d2y, exponent, law)

"""Dahl's asperities of many bodies side by side: steps that become vector instructions.

As `asperity.friction.dahl` and `asperity.friction.loaded` have them for exponent 1, in their units,
without a branch that depends on a body and without a call: the exponential and the return to the
limit are polynomials.
"""

import math

from asperity.friction.dahl import (
    SERIES_BOUND,
    SPLIT,
    TINY,
    VECTOR,
    inverse_root,
    relaxation_gain,
)
from asperity.kernels.compiled import kernel

_TINY = 1e-300


@kernel(inline="always")
def relaxed(sx, sy, dx, dy, slip_1, slip_2, law):
    """Deflection as `dahl.advance` has it, after no more than about the limit of slip.

    ``slip_1`` and ``slip_2`` are the parts of ``dy``; all of ``dx`` is of the first. The loop that
    calls is compiled for one ``law``.
    """
    if law == VECTOR:
        rate = math.sqrt(dx * dx + dy * dy)
    else:
        hx = sx + 0.5 * dx
        hy = sy + 0.5 * dy
        if law == SPLIT:
            rate = abs(hx * dx + hy * slip_1) + abs(hy * slip_2)
        else:
            rate = abs(hx * dx + hy * dy)
        rate = rate / math.sqrt(hx * hx + hy * hy + _TINY)
    gain = relaxation_gain(rate)
    decay = 1.0 - rate * gain
    wx = sx * decay + dx * gain
    wy = sy * decay + dy * gain
    if law != VECTOR:
        over = wx * wx + wy * wy - 1.0
        back = inverse_root(over if over > 0.0 else 0.0)
        wx *= back
        wy *= back
    return wx, wy


@kernel(inline="always")
def relaxed_to_limit(sx, sy, dx, dy, limit_0, limit_1):
    """Deflection as `loaded.advance_loaded` has it: law `VECTOR`, exponent 1, `STIFFNESS`."""
    limit = 0.5 * (limit_0 + limit_1)
    length = math.sqrt(dx * dx + dy * dy)
    # One division for the relaxation and its reciprocal.
    both = 1.0 / (length * limit + 1e-280)
    decay = length * length * both
    least = decay if decay < SERIES_BOUND else SERIES_BOUND
    gain = relaxation_gain(least)
    left = 1.0 - least * gain
    # Beyond the series its root of order 64, which at the bound is below rounding's reach of one.
    part = (decay if decay < 64.0 * SERIES_BOUND else 64.0 * SERIES_BOUND) * (1.0 / 64.0)
    root = 1.0 - part * relaxation_gain(part)
    root *= root
    root *= root
    root *= root
    root *= root
    root *= root
    root *= root
    left = left if decay < SERIES_BOUND else root
    gain = gain if decay < SERIES_BOUND else (1.0 - root) * limit * limit * both
    wx = sx * left + dx * gain
    wy = sy * left + dy * gain
    # As `loaded.slip_back`, of a deflection that was not above its limit.
    size = math.sqrt(wx * wx + wy * wy)
    over = size - limit_1 if limit_1 < limit_0 else 0.0
    over = over if over > 0.0 else 0.0
    turn = 0.5 * over * length * both
    tx = wx + turn * dx
    ty = wy + turn * dy
    back = limit_1 / math.sqrt(tx * tx + ty * ty + 1e-280)
    back = back if over > 0.0 else 1.0
    back = back if limit_1 > TINY else 0.0
    return tx * back, ty * back

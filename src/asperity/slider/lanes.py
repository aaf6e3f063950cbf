r"""Thirty-two bodies marched side by side: Dahl friction, exponent 1, drives without damping.

Same equations and units as `asperity.slider.kernels`, laid out for vector instructions. Why it
looks the way it does: all numbers of a batch stand in ONE buffer at offsets known to the compiler
(separate arrays cost three times as much, for their pointers), the inner loop runs over the lanes
and has neither a call nor a branch that depends on a lane, the exponential and
the return to the limit are polynomials.
"""

import math
from typing import Any

from asperity.compiled import kernel
from asperity.friction.dahl import SPLIT, UNSPLIT, VECTOR, inverse_root, relaxation_gain
from asperity.vibration import fill_increments

LANES = 32

# Rows of the buffer.
(
    STRETCH, WX, WY, SX, SY,
    DRIVE, KAPPA, GIVE_X, GIVE_Y, BASE_X, BASE_Y,
    SUM_FREE, SUM_FX, SUM_FY, SUM_VX, SUM_VY, SUM_SLIP,
    MAX_FX, MIN_FX, MAX_FY, MIN_FY, WAITING, WAITED,
    ROWS,
) = range(24)  # fmt: skip

BLOCK = 64  # steps whose increments are made at a time: 16 kB, they stay in the first cache

_FAST = {"contract", "nsz", "arcp"}
_TINY = 1e-300


# Before the window; in it with bodies that have not broken away; in it without.
_STAGES = ((False, True), (True, True), (True, False))


@kernel(fastmath=_FAST)
def _fill(waves, tables, shared, increments, steps):
    """Increments of every lane's unit vibration for the coming steps; ``waves`` walks on.

    Rows of ``waves``: waveform, rise, cycles done, cycles a step, the sine's rotation a step (cos,
    sin), its phasor (cos, sin). With ``shared`` all lanes have the wave of the first.
    """
    turning = not shared
    for lane in range(LANES):
        turning = turning and waves[0, lane] == 0.0 and waves[2, lane] > 0.0
    if turning:
        # The phasors are set anew every block so that rounding cannot gather.
        for lane in range(LANES):
            phase = 2.0 * math.pi * (waves[2, lane] - math.floor(waves[2, lane]))
            waves[6, lane] = math.cos(phase)
            waves[7, lane] = math.sin(phase)
        for n in range(steps):
            for lane in range(LANES):
                c = waves[6, lane]
                s = waves[7, lane]
                s1 = s * waves[4, lane] + c * waves[5, lane]
                waves[6, lane] = c * waves[4, lane] - s * waves[5, lane]
                waves[7, lane] = s1
                increments[n * LANES + lane] = s1 - s
    else:
        for lane in range(1 if shared else LANES):
            room = increments[lane::LANES][:steps]
            fill_increments(
                int(waves[0, lane]), waves[1, lane], tables[lane], waves[2, lane],
                waves[3, lane], room,
            )  # fmt: skip
    if shared:
        for n in range(steps):
            first = increments[n * LANES]
            for lane in range(1, LANES):
                increments[n * LANES + lane] = first
    for lane in range(LANES):
        waves[2, lane] += steps * waves[3, lane]


def _make_block(law: int, window: bool, wait: bool) -> Any:
    """Compile the loop for one law: sums of the window, wait for the breakaway, or both.

    A factory, since the vectoriser turns a branch on an argument into masked work on both sides.
    """

    @kernel(fastmath=_FAST)
    def block(b, increments, steps, own_1, own_2):
        own = own_1 + own_2
        for n in range(steps):
            for j in range(LANES):
                u = increments[n * LANES + j]
                ux = b[BASE_X * LANES + j] * u
                uy = b[BASE_Y * LANES + j] * u
                wx = b[WX * LANES + j]
                wy = b[WY * LANES + j]
                sx = b[SX * LANES + j]
                sy = b[SY * LANES + j]
                stretch = b[STRETCH * LANES + j] + b[DRIVE * LANES + j] - wx
                dx = wx - ux
                dy = own * wy - uy
                if law == VECTOR:
                    rate = math.sqrt(dx * dx + dy * dy)
                else:
                    dy1 = own_1 * wy
                    dy2 = own_2 * wy - uy
                    hx = sx + 0.5 * dx
                    hy = sy + 0.5 * dy
                    if law == SPLIT:
                        rate = abs(hx * dx + hy * dy1) + abs(hy * dy2)
                    else:
                        rate = abs(hx * dx + hy * dy)
                    rate = rate / math.sqrt(hx * hx + hy * hy + _TINY)
                gain = relaxation_gain(rate)
                decay = 1.0 - rate * gain
                sx1 = sx * decay + dx * gain
                sy1 = sy * decay + dy * gain
                if law != VECTOR:
                    over = sx1 * sx1 + sy1 * sy1 - 1.0
                    back = inverse_root(over if over > 0.0 else 0.0)
                    sx1 *= back
                    sy1 *= back
                free = b[KAPPA * LANES + j] * stretch
                b[WX * LANES + j] = wx + b[GIVE_X * LANES + j] * (free - sx1)
                b[WY * LANES + j] = wy - b[GIVE_Y * LANES + j] * sy1
                b[STRETCH * LANES + j] = stretch
                b[SX * LANES + j] = sx1
                b[SY * LANES + j] = sy1
                if window:
                    mx = sx + sx1
                    my = sy + sy1
                    b[SUM_FREE * LANES + j] += free
                    b[SUM_FX * LANES + j] += mx
                    b[SUM_FY * LANES + j] += my
                    b[SUM_VX * LANES + j] += mx * u
                    b[SUM_VY * LANES + j] += my * u
                    b[SUM_SLIP * LANES + j] += mx * dx + my * dy
                    top = b[MAX_FX * LANES + j]
                    b[MAX_FX * LANES + j] = top if top > sx1 else sx1
                    low = b[MIN_FX * LANES + j]
                    b[MIN_FX * LANES + j] = low if low < sx1 else sx1
                    top = b[MAX_FY * LANES + j]
                    b[MAX_FY * LANES + j] = top if top > sy1 else sy1
                    low = b[MIN_FY * LANES + j]
                    b[MIN_FY * LANES + j] = low if low < sy1 else sy1
                if wait:
                    waiting = b[WAITING * LANES + j]
                    b[WAITED * LANES + j] += waiting
                    b[WAITING * LANES + j] = waiting if free < 1.0 else 0.0

    return block


_VECTOR_WAIT, _VECTOR_BOTH, _VECTOR_WINDOW = (
    _make_block(VECTOR, window, wait) for window, wait in _STAGES
)
_SPLIT_WAIT, _SPLIT_BOTH, _SPLIT_WINDOW = (
    _make_block(SPLIT, window, wait) for window, wait in _STAGES
)
_UNSPLIT_WAIT, _UNSPLIT_BOTH, _UNSPLIT_WINDOW = (
    _make_block(UNSPLIT, window, wait) for window, wait in _STAGES
)


@kernel
def march_lanes(
    buffer, waves, tables, shared, increments, steps, own_1, own_2, law, window, waiting, stop
):  # fmt: skip
    """March a batch ``steps`` steps; gives up between blocks once ``stop[0]`` is not zero.

    With ``window`` the sums are taken; without it, or while any is ``waiting``, the breakaway is
    waited for.
    """
    left = steps
    while left > 0 and stop[0] == 0:
        count = min(left, BLOCK)
        _fill(waves, tables, shared, increments, count)
        if law == VECTOR:
            if not window:
                _VECTOR_WAIT(buffer, increments, count, own_1, own_2)
            elif waiting:
                _VECTOR_BOTH(buffer, increments, count, own_1, own_2)
            else:
                _VECTOR_WINDOW(buffer, increments, count, own_1, own_2)
        elif law == SPLIT:
            if not window:
                _SPLIT_WAIT(buffer, increments, count, own_1, own_2)
            elif waiting:
                _SPLIT_BOTH(buffer, increments, count, own_1, own_2)
            else:
                _SPLIT_WINDOW(buffer, increments, count, own_1, own_2)
        else:
            if not window:
                _UNSPLIT_WAIT(buffer, increments, count, own_1, own_2)
            elif waiting:
                _UNSPLIT_BOTH(buffer, increments, count, own_1, own_2)
            else:
                _UNSPLIT_WINDOW(buffer, increments, count, own_1, own_2)
        left -= count

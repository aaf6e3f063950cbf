r"""Thirty-two bodies marched side by side: Dahl friction, exponent 1, drives without damping.

Same equations and units as `asperity.slider.kernels` and, of bodies that are pressed,
`asperity.slider.pressed`, laid out for vector instructions. Why it looks the way it does: all
numbers of a batch stand in ONE buffer at offsets known to the compiler (separate arrays cost three
times as much, for their pointers), the inner loop runs over the bodies and has neither a call nor a
branch that depends on one, the exponential and the return to the limit are polynomials.
"""

import math
from typing import Any

from asperity.friction.dahl import SPLIT, UNSPLIT, VECTOR
from asperity.friction.lanes import relaxed
from asperity.kernels.compiled import kernel
from asperity.slider import batch_rows as row
from asperity.slider.batch_rows import WIDTH
from asperity.vibration.waveform import Wave, fill_increments

BLOCK = 64  # steps whose increments are made at a time: 16 kB, they stay in the first cache

FAST = {"contract", "nsz", "arcp"}


# Before the window; in it with bodies that have not broken away; in it without.
STAGES = ((False, True), (True, True), (True, False))


@kernel(fastmath=FAST)
def fill_batch(waves, tables, shared, increments, steps, ahead):
    """Increments of every body's unit vibration for the coming steps; ``waves`` walks on.

    Rows of ``waves``: waveform, rise, cycles done, cycles a step, the sine's rotation a step (cos,
    sin), its phasor (cos, sin), the ramp, the lead. With ``shared`` all bodies have the wave of the
    first. Increments of ``ahead`` steps more are made, over which it does not walk.
    """
    turning = not shared
    for body in range(WIDTH):
        turning = turning and waves[0, body] == 0.0 and waves[2, body] > waves[8, body]
    if turning:
        # The phasors are set anew every block so that rounding cannot gather.
        for body in range(WIDTH):
            cycles = waves[2, body] + waves[9, body]
            phase = 2.0 * math.pi * (cycles - math.floor(cycles))
            waves[6, body] = math.cos(phase)
            waves[7, body] = math.sin(phase)
        for n in range(steps + ahead):
            for body in range(WIDTH):
                c = waves[6, body]
                s = waves[7, body]
                s1 = s * waves[4, body] + c * waves[5, body]
                waves[6, body] = c * waves[4, body] - s * waves[5, body]
                waves[7, body] = s1
                increments[n * WIDTH + body] = s1 - s
    else:
        for body in range(1 if shared else WIDTH):
            room = increments[body::WIDTH][: steps + ahead]
            wave = Wave(
                int(waves[0, body]), waves[1, body], tables[body], waves[8, body], waves[9, body]
            )
            fill_increments(wave, waves[2, body], waves[3, body], room)
    if shared:
        for n in range(steps + ahead):
            first = increments[n * WIDTH]
            for body in range(1, WIDTH):
                increments[n * WIDTH + body] = first
    for body in range(WIDTH):
        waves[2, body] += steps * waves[3, body]


def _make_block(law: int, window: bool, wait: bool) -> Any:
    """Compile the loop for one law: sums of the window, wait for the breakaway, or both.

    A factory, since the vectoriser turns a branch on an argument into masked work on both sides.
    """

    @kernel(fastmath=FAST)
    def block(b, increments, steps, own_1, own_2):
        own = own_1 + own_2
        for n in range(steps):
            for j in range(WIDTH):
                u = increments[n * WIDTH + j]
                ux = b[row.BASE_X * WIDTH + j] * u
                uy = b[row.BASE_Y * WIDTH + j] * u
                wx = b[row.WX * WIDTH + j]
                wy = b[row.WY * WIDTH + j]
                sx = b[row.SX * WIDTH + j]
                sy = b[row.SY * WIDTH + j]
                stretch = b[row.STRETCH * WIDTH + j] + b[row.DRIVE * WIDTH + j] - wx
                dx = wx - ux
                dy = own * wy - uy
                sx1, sy1 = relaxed(sx, sy, dx, dy, own_1 * wy, own_2 * wy - uy, law)
                free = b[row.STIFFNESS * WIDTH + j] * stretch
                b[row.WX * WIDTH + j] = wx + b[row.MOBILITY_X * WIDTH + j] * (free - sx1)
                b[row.WY * WIDTH + j] = wy - b[row.MOBILITY_Y * WIDTH + j] * sy1
                b[row.STRETCH * WIDTH + j] = stretch
                b[row.SX * WIDTH + j] = sx1
                b[row.SY * WIDTH + j] = sy1
                if window:
                    mx = sx + sx1
                    my = sy + sy1
                    b[row.SUM_FREE * WIDTH + j] += free
                    b[row.SUM_FX * WIDTH + j] += mx
                    b[row.SUM_FY * WIDTH + j] += my
                    b[row.SUM_VX * WIDTH + j] += mx * u
                    b[row.SUM_VY * WIDTH + j] += my * u
                    b[row.SUM_SLIP * WIDTH + j] += mx * dx + my * dy
                    top = b[row.MAX_FX * WIDTH + j]
                    b[row.MAX_FX * WIDTH + j] = top if top > sx1 else sx1
                    low = b[row.MIN_FX * WIDTH + j]
                    b[row.MIN_FX * WIDTH + j] = low if low < sx1 else sx1
                    top = b[row.MAX_FY * WIDTH + j]
                    b[row.MAX_FY * WIDTH + j] = top if top > sy1 else sy1
                    low = b[row.MIN_FY * WIDTH + j]
                    b[row.MIN_FY * WIDTH + j] = low if low < sy1 else sy1
                if wait:
                    waiting = b[row.WAITING * WIDTH + j]
                    b[row.WAITED * WIDTH + j] += waiting
                    b[row.WAITING * WIDTH + j] = waiting if free < 1.0 else 0.0

    return block


_VECTOR_WAIT, _VECTOR_BOTH, _VECTOR_WINDOW = (
    _make_block(VECTOR, window, wait) for window, wait in STAGES
)
_SPLIT_WAIT, _SPLIT_BOTH, _SPLIT_WINDOW = (
    _make_block(SPLIT, window, wait) for window, wait in STAGES
)
_UNSPLIT_WAIT, _UNSPLIT_BOTH, _UNSPLIT_WINDOW = (
    _make_block(UNSPLIT, window, wait) for window, wait in STAGES
)


@kernel
def march_batch(
    buffer, waves, tables, shared, increments, steps, own_1, own_2, law, window, waiting, stop
):  # fmt: skip
    """March a batch ``steps`` steps; gives up between blocks once ``stop[0]`` is not zero.

    With ``window`` the sums are taken; without it, or while any is ``waiting``, the breakaway is
    waited for.
    """
    left = steps
    while left > 0 and stop[0] == 0:
        count = min(left, BLOCK)
        fill_batch(waves, tables, shared, increments, count, 0)
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

r"""Thirty-two pressed bodies side by side: `asperity.slider.pressed` in vector instructions.

As `asperity.slider.batch_kernels`, for the law `VECTOR` and a force that is linear in the
penetration or goes with its power 3/2. A step is several loops over the bodies: in one, the next
bodies would wait for the long chain of roots and divisions of the first.
"""

import math
from typing import Any

from asperity.friction.lanes import relaxed_to_limit
from asperity.kernels.compiled import kernel
from asperity.slider import batch_rows as row
from asperity.slider.batch_kernels import BLOCK, FAST, STAGES, fill_batch
from asperity.slider.batch_rows import WIDTH
from asperity.slider.pressed import ROUNDING


def _make_block(window: bool, wait: bool) -> Any:
    """Compile the loop: sums of the window, wait for the breakaway, or both."""

    @kernel(fastmath=FAST)
    def block(b, increments, rises, steps, own):
        for n in range(steps):
            for j in range(WIDTH):
                height = b[row.BASE_Z * WIDTH + j] * rises[n * WIDTH + j]
                ahead = b[row.BASE_Z * WIDTH + j] * rises[(n + 1) * WIDTH + j]
                rise = b[row.RISE * WIDTH + j]
                d = b[row.PENETRATION * WIDTH + j] + height - rise
                over = d if d > 0.0 else 0.0
                root = b[row.ROOT * WIDTH + j] * math.sqrt(over)
                elastic = over * (b[row.LINEAR * WIDTH + j] + root)
                lost = elastic * b[row.LOSS * WIDTH + j]
                half = 0.5 * b[row.MOBILITY_Z * WIDTH + j]
                load = elastic + lost * (0.5 * (height + ahead) - rise + half)
                load = (load if load > 0.0 else 0.0) / (1.0 + lost * half)
                b[row.RISE * WIDTH + j] = rise + 2.0 * half * (load - 1.0)
                b[row.HEIGHT * WIDTH + j] += rise
                b[row.APPROACH * WIDTH + j] = height - rise
                b[row.PENETRATION * WIDTH + j] = d
                b[row.LAST_LOAD * WIDTH + j] = b[row.LOAD * WIDTH + j]
                b[row.LOAD * WIDTH + j] = load
                b[row.LAST_ELASTIC * WIDTH + j] = b[row.ELASTIC * WIDTH + j]
                b[row.ELASTIC * WIDTH + j] = elastic
            for j in range(WIDTH):
                u = increments[n * WIDTH + j]
                wx = b[row.WX * WIDTH + j]
                wy = b[row.WY * WIDTH + j]
                sx = b[row.SX * WIDTH + j]
                sy = b[row.SY * WIDTH + j]
                dx = wx - b[row.BASE_X * WIDTH + j] * u
                dy = own * wy - b[row.BASE_Y * WIDTH + j] * u
                sx1, sy1 = relaxed_to_limit(
                    sx, sy, dx, dy, b[row.LAST_LOAD * WIDTH + j], b[row.LOAD * WIDTH + j]
                )
                b[row.LAST_SX * WIDTH + j] = sx
                b[row.LAST_SY * WIDTH + j] = sy
                b[row.SX * WIDTH + j] = sx1
                b[row.SY * WIDTH + j] = sy1
                b[row.DX * WIDTH + j] = dx
                b[row.DY * WIDTH + j] = dy
            for j in range(WIDTH):
                wx = b[row.WX * WIDTH + j]
                stretch = b[row.STRETCH * WIDTH + j] + b[row.DRIVE * WIDTH + j] - wx
                free = b[row.STIFFNESS * WIDTH + j] * stretch
                b[row.WX * WIDTH + j] = wx + b[row.MOBILITY_X * WIDTH + j] * (
                    free - b[row.SX * WIDTH + j]
                )
                b[row.WY * WIDTH + j] -= b[row.MOBILITY_Y * WIDTH + j] * b[row.SY * WIDTH + j]
                b[row.STRETCH * WIDTH + j] = stretch
                b[row.FREE * WIDTH + j] = free
                if wait:
                    waiting = b[row.WAITING * WIDTH + j]
                    b[row.WAITED * WIDTH + j] += waiting
                    b[row.WAITING * WIDTH + j] = waiting if free < 1.0 else 0.0
            if window:
                for j in range(WIDTH):
                    u = increments[n * WIDTH + j]
                    sx = b[row.LAST_SX * WIDTH + j]
                    sy = b[row.LAST_SY * WIDTH + j]
                    sx1 = b[row.SX * WIDTH + j]
                    sy1 = b[row.SY * WIDTH + j]
                    dx = b[row.DX * WIDTH + j]
                    dy = b[row.DY * WIDTH + j]
                    mx = sx + sx1
                    my = sy + sy1
                    b[row.SUM_FREE * WIDTH + j] += b[row.FREE * WIDTH + j]
                    b[row.SUM_FX * WIDTH + j] += mx
                    b[row.SUM_FY * WIDTH + j] += my
                    b[row.SUM_VX * WIDTH + j] += mx * u
                    b[row.SUM_VY * WIDTH + j] += my * u
                    b[row.SUM_SLIP * WIDTH + j] += mx * dx + my * dy
                    b[row.MAX_FX * WIDTH + j] = max(b[row.MAX_FX * WIDTH + j], sx1)
                    b[row.MIN_FX * WIDTH + j] = min(b[row.MIN_FX * WIDTH + j], sx1)
                    b[row.MAX_FY * WIDTH + j] = max(b[row.MAX_FY * WIDTH + j], sy1)
                    b[row.MIN_FY * WIDTH + j] = min(b[row.MIN_FY * WIDTH + j], sy1)
                    jx = sx1 - sx
                    jy = sy1 - sy
                    vx = dx - jx
                    vy = dy - jy
                    gain = -(sx1 * vx + sy1 * vy + 0.5 * (jx * jx + jy * jy))
                    mean = 0.5 * (b[row.LAST_LOAD * WIDTH + j] + b[row.LOAD * WIDTH + j])
                    size = sx * sx + sy * sy + sx1 * sx1 + sy1 * sy1
                    size += abs(sx1 * dx) + abs(sy1 * dy)
                    b[row.SUM_GAIN * WIDTH + j] += gain if gain > ROUNDING * size else 0.0
                    b[row.SUM_WEAR * WIDTH + j] += mean * math.sqrt(vx * vx + vy * vy)
                for j in range(WIDTH):
                    height = b[row.BASE_Z * WIDTH + j] * rises[n * WIDTH + j]
                    load = b[row.LOAD * WIDTH + j]
                    last = b[row.LAST_LOAD * WIDTH + j]
                    mean = 0.5 * (load + last)
                    d = b[row.PENETRATION * WIDTH + j]
                    approach = b[row.APPROACH * WIDTH + j]
                    elastic = b[row.ELASTIC * WIDTH + j] + b[row.LAST_ELASTIC * WIDTH + j]
                    touches = 1.0 if load > 0.0 else 0.0
                    b[row.SUM_LOAD * WIDTH + j] += mean
                    b[row.SUM_PENETRATION * WIDTH + j] += d - 0.5 * approach
                    b[row.SUM_OPEN * WIDTH + j] += 1.0 - touches
                    b[row.SUM_LANDINGS * WIDTH + j] += 0.0 if last > 0.0 else touches
                    b[row.SUM_RISE * WIDTH + j] += mean * height
                    b[row.SUM_LOSS * WIDTH + j] += (mean - 0.5 * elastic) * approach
                    b[row.MAX_LOAD * WIDTH + j] = max(b[row.MAX_LOAD * WIDTH + j], load)
                    b[row.MIN_LOAD * WIDTH + j] = min(b[row.MIN_LOAD * WIDTH + j], load)
                    b[row.MAX_PENETRATION * WIDTH + j] = max(b[row.MAX_PENETRATION * WIDTH + j], d)
                    b[row.MIN_PENETRATION * WIDTH + j] = min(b[row.MIN_PENETRATION * WIDTH + j], d)
                    b[row.MAX_APPROACH * WIDTH + j] = max(b[row.MAX_APPROACH * WIDTH + j], approach)

    return block


_WAIT, _BOTH, _WINDOW = (_make_block(window, wait) for window, wait in STAGES)


@kernel
def march_pressed_batch(
    buffer, waves, normal_waves, tables, shared, increments, rises, steps, own, window, waiting,
    stop,
):  # fmt: skip
    """March a batch of pressed bodies, as `asperity.slider.batch_kernels.march_batch`."""
    left = steps
    while left > 0 and stop[0] == 0:
        count = min(left, BLOCK)
        fill_batch(waves, tables, shared, increments, count, 0)
        fill_batch(normal_waves, tables, shared, rises, count, 1)
        if not window:
            _WAIT(buffer, increments, rises, count, own)
        elif waiting:
            _BOTH(buffer, increments, rises, count, own)
        else:
            _WINDOW(buffer, increments, rises, count, own)
        left -= count

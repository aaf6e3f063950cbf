"""The least value of a function between three places, of which the middle one is lowest."""

import math
from typing import Any

from asperity.kernels.compiled import Kernel, kernel

_GOLDEN = 0.381966011250105


@kernel
def next_place(a, fa, b, fb, c, fc, narrow, slow):
    """Where to look next between ``a <= b <= c``, of which ``b`` is the lowest.

    The vertex of a parabola, at least ``narrow`` from ``b``; the golden section where there is none
    and where the bracket was ``slow`` to shrink: parabolas creep along a function that bends
    sharply at one end.
    """
    left, right = b - a, c - b
    if left > 0.0 and right > 0.0 and not slow:
        down, up = (fa - fb) / left, (fc - fb) / right
        t = b + 0.5 * (down * right - up * left) / (down + up)
        if a < t < c:
            if abs(t - b) < narrow:
                return b + narrow if right > left else b - narrow
            return t
    return b + _GOLDEN * right if right > left else b - _GOLDEN * left


@kernel
def narrowed(a, fa, b, fb, c, fc, t, ft):
    """The bracket with one more place ``t``."""
    if ft <= fb:
        if t > b:
            return b, fb, t, ft, c, fc
        return a, fa, t, ft, b, fb
    if t > b:
        return a, fa, b, fb, t, ft
    return t, ft, b, fb, c, fc


def minimum(
    function: Kernel,
    given: tuple[Any, ...],
    a: float,
    fa: float,
    b: float,
    fb: float,
    c: float,
    fc: float,
    narrow: float,
    steps: int,
    even: float,
) -> tuple[float, float]:
    """``(place, value)`` of the least value of a function of a place and what is ``given``.

    It is found to ``narrow``, or until all three values are ``even``: as alike as that, relative to
    1 and to themselves; -inf to look on regardless.
    """
    older = old = math.inf
    for _ in range(steps):
        if c - a <= 2.5 * narrow or fa + fc - 2.0 * fb <= even * (1.0 + abs(fb)):
            break
        t = next_place(a, fa, b, fb, c, fc, narrow, c - a > 0.5 * older)
        older, old = old, c - a
        a, fa, b, fb, c, fc = narrowed(a, fa, b, fb, c, fc, t, function(t, *given))
    return b, fb


# Inlined, since a kernel that is given another is otherwise compiled anew in every process.
compiled_minimum = kernel(inline="always")(minimum)
"""`minimum` for kernels."""

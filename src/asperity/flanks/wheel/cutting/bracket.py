"""Where to look next for a least value between three places, of which the middle one is lowest."""

from asperity.compiled import kernel

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

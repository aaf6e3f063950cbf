"""Coulomb friction as an implicit projection: stick and slip by one formula."""

import math

from asperity.kernels.compiled import kernel

_SLIPS = 1.0 - 1e-9  # square of the share from which the contact slips
# Steps in which friction stops a slip that is resolved in so many parts of one; from one step less
# on they alone count.
_SLOW, _PARTS = 4.0, 16


@kernel
def project(free_x, free_y, mobility_x, mobility_y, last_x, last_y):
    r"""Friction share that stops, or failing that opposes, a slip.

    Finds :math:`\sigma` in the unit disc with slip :math:`D = f - \mathrm{diag}(b)\,\sigma` such
    that :math:`D = 0` (stick) or :math:`\sigma = D/|D|` (slip): the implicit (backward) step of
    :math:`m\dot v = F - \mu F_N v/|v|`, unique for any mass.

    Parameters
    ----------
    free_x, free_y : float
        Slip :math:`f` over the step if there were no friction.
    mobility_x, mobility_y : float
        How much a full friction force takes off it (:math:`b \ge 0`; 0: prescribed slip).
    last_x, last_y : float
        Share to keep where neither slip nor force decides (no slip, nothing gives).

    Returns
    -------
    tuple of 2 floats
        Friction force over :math:`\mu F_N`, by component, in the direction of the slip.
    """
    size = math.sqrt(free_x * free_x + free_y * free_y)
    if size == 0.0:
        if mobility_x > 0.0 or mobility_y > 0.0:
            return 0.0, 0.0
        return last_x, last_y
    stuck_x = free_x / mobility_x if mobility_x > 0.0 else 0.0
    stuck_y = free_y / mobility_y if mobility_y > 0.0 else 0.0
    can_stick = (mobility_x > 0.0 or free_x == 0.0) and (mobility_y > 0.0 or free_y == 0.0)
    if can_stick and stuck_x * stuck_x + stuck_y * stuck_y <= 1.0:
        return stuck_x, stuck_y
    # Slip: |f/(|D| + b)| = 1 for |D|. 1/|.| is nearly linear in |D|, so Newton takes few steps;
    # from below, where the norm is at least 1, it cannot overshoot.
    slip = max(
        size - max(mobility_x, mobility_y), abs(free_x) - mobility_x, abs(free_y) - mobility_y, 0.0
    )
    for _ in range(50):
        x = free_x / (slip + mobility_x) if slip + mobility_x > 0.0 else 0.0
        y = free_y / (slip + mobility_y) if slip + mobility_y > 0.0 else 0.0
        norm = math.sqrt(x * x + y * y)
        if norm == 0.0:
            break
        bend = 0.0
        if slip + mobility_x > 0.0:
            bend += x * x / (slip + mobility_x)
        if slip + mobility_y > 0.0:
            bend += y * y / (slip + mobility_y)
        change = (norm - 1.0) * norm * norm / bend
        slip = max(slip + change, 0.0)
        if abs(change) <= 1e-15 * (slip + size):
            break
    x = free_x / (slip + mobility_x) if slip + mobility_x > 0.0 else 0.0
    y = free_y / (slip + mobility_y) if slip + mobility_y > 0.0 else 0.0
    norm = math.sqrt(x * x + y * y)
    return x / norm, y / norm


@kernel
def _reversal(before, free, mobility):
    """Mean share along a line while a steady push slows, stops, holds or turns the slip.

    Continuous in every argument, which a share taken at the end of the step is not.
    """
    sign = 1.0 if before >= 0.0 else -1.0
    start = abs(before)
    push = sign * free - start
    after = start + push - mobility
    if after >= 0.0:
        return sign
    if push >= -mobility:
        return sign * (start + push) / mobility
    stop = start / (mobility - push)
    return sign * (2.0 * stop - 1.0)


@kernel
def _damped(share_x, share_y, mean_x, mean_y, after, mobility):
    """Mean share, or the share at the end where friction takes more than the slip that is left.

    There the mean would throw the slip about.
    """
    part = after / (after + mobility)
    return share_x + part * (mean_x - share_x), share_y + part * (mean_y - share_y)


@kernel
def _through_rest(x, y, push_x, push_y, mobility_x, mobility_y, last_x, last_y):
    """Mean share in the plane while a steady push turns, stops or sets off a slip, part by part."""
    mobility_x /= _PARTS
    mobility_y /= _PARTS
    mobility = max(mobility_x, mobility_y)
    sum_x = 0.0
    sum_y = 0.0
    for _ in range(_PARTS):
        free_x = x + push_x / _PARTS
        free_y = y + push_y / _PARTS
        share_x, share_y = project(free_x, free_y, mobility_x, mobility_y, last_x, last_y)
        before = math.sqrt(x * x + y * y)
        x1 = free_x - mobility_x * share_x
        y1 = free_y - mobility_y * share_y
        after = math.sqrt(x1 * x1 + y1 * y1)
        slips = share_x * share_x + share_y * share_y >= _SLIPS
        if slips and before > 0.0 and after > 0.0:
            mean_x = (x + x1) / (before + after)
            mean_y = (y + y1) / (before + after)
            share_x, share_y = _damped(share_x, share_y, mean_x, mean_y, after, mobility)
        x = free_x - mobility_x * share_x
        y = free_y - mobility_y * share_y
        sum_x += share_x
        sum_y += share_y
    return sum_x / _PARTS, sum_y / _PARTS


@kernel
def mean_share(
    before_x, before_y, free_x, free_y, mobility_x, mobility_y, smooth, last_x, last_y
):  # fmt: skip
    r"""Mean friction share around a time node, from the slip of the steps on both sides of it.

    `project` decides whether the body sticks; a share taken at the node alone would place a
    reversal of the slip, and a turn of its direction, only to within a step.

    Parameters
    ----------
    before_x, before_y : float
        Slip of the step before the node.
    free_x, free_y, mobility_x, mobility_y, last_x, last_y : float
        The step after it, as in `project`.
    smooth : bool
        Whether the slip velocity changes steadily, or jumps at the node.

    Returns
    -------
    tuple of 2 floats
        Friction force over :math:`\mu F_N`, by component, in the direction of the slip.
    """
    if smooth and before_x != 0.0 and before_y == 0.0 and free_y == 0.0:
        return _reversal(before_x, free_x, mobility_x), 0.0
    share_x, share_y = project(free_x, free_y, mobility_x, mobility_y, last_x, last_y)
    if share_x * share_x + share_y * share_y < _SLIPS:
        return share_x, share_y
    after_x = free_x - mobility_x * share_x
    after_y = free_y - mobility_y * share_y
    before = math.sqrt(before_x * before_x + before_y * before_y)
    after = math.sqrt(after_x * after_x + after_y * after_y)
    if before == 0.0 or after == 0.0:
        return share_x, share_y
    mobility = max(mobility_x, mobility_y)
    if not smooth:
        mean_x = 0.5 * (before_x / before + after_x / after)
        mean_y = 0.5 * (before_y / before + after_y / after)
        return _damped(share_x, share_y, mean_x, mean_y, after, mobility)
    mean_x = (before_x + after_x) / (before + after)
    mean_y = (before_y + after_y) / (before + after)
    mean_x, mean_y = _damped(share_x, share_y, mean_x, mean_y, after, mobility)
    # Slower than friction can make it in some steps, a slip turns and stops within one.
    slow = _SLOW - min(before, after) / mobility if mobility > 0.0 else 0.0
    if slow <= 0.0:
        return mean_x, mean_y
    x, y = _through_rest(
        before_x, before_y, free_x - before_x, free_y - before_y, mobility_x, mobility_y,
        last_x, last_y,
    )  # fmt: skip
    part = min(slow, 1.0)
    return mean_x + part * (x - mean_x), mean_y + part * (y - mean_y)

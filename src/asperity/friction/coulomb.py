"""Coulomb friction as an implicit projection: stick and slip by one formula."""

import math

from asperity.kernels.compiled import kernel

_SLIPS = 1.0 - 1e-9  # square of the share from which the contact slips
# Steps in which friction stops a slip that is resolved in so many parts of one; from one step less
# on they alone count.
_SLOW, _PARTS = 4.0, 16
_AT_REST = 1e-9  # of the slips around a corner, below which the first is rounding of none
_JUMPS = 0.1  # of the increments around a node, above which the wave has a corner there
_ROUNDING = 1e-12  # of an increment of the unit wave


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
def _part(x, y, push_x, push_y, mobility_x, mobility_y, last_x, last_y):
    """Mean share over a part of a step in the plane, and the slip after it."""
    free_x = x + push_x
    free_y = y + push_y
    share_x, share_y = project(free_x, free_y, mobility_x, mobility_y, last_x, last_y)
    before = math.sqrt(x * x + y * y)
    x1 = free_x - mobility_x * share_x
    y1 = free_y - mobility_y * share_y
    after = math.sqrt(x1 * x1 + y1 * y1)
    slips = share_x * share_x + share_y * share_y >= _SLIPS
    if slips and before > 0.0 and after > 0.0:
        mean_x = (x + x1) / (before + after)
        mean_y = (y + y1) / (before + after)
        mobility = max(mobility_x, mobility_y)
        share_x, share_y = _damped(share_x, share_y, mean_x, mean_y, after, mobility)
    return share_x, share_y, free_x - mobility_x * share_x, free_y - mobility_y * share_y


@kernel
def _through_rest(x, y, push_x, push_y, mobility_x, mobility_y, last_x, last_y):
    """Mean share in the plane while a steady push turns, stops or sets off a slip, part by part."""
    sum_x = 0.0
    sum_y = 0.0
    for _ in range(_PARTS):
        share_x, share_y, x, y = _part(
            x, y, push_x / _PARTS, push_y / _PARTS, mobility_x / _PARTS, mobility_y / _PARTS,
            last_x, last_y,
        )  # fmt: skip
        sum_x += share_x
        sum_y += share_y
    return sum_x / _PARTS, sum_y / _PARTS


@kernel
def jump_between(base, increment, ahead, smooth):
    """How much a base's increment jumps at the node between two steps; 0 but at a corner.

    ``increment`` and ``ahead`` are those of the unit wave before and after the node, ``smooth``
    says that the wave has no corners.
    """
    if smooth or abs(ahead - increment) <= _JUMPS * (abs(ahead) + abs(increment)) + _ROUNDING:
        return 0.0
    return base * (ahead - increment)


@kernel
def _at_corner(
    before_x, before_y, start_x, start_y, push_x, push_y, mobility_x, mobility_y, last_x, last_y
):  # fmt: skip
    """Mean share around a corner, part by part after it, for the way of the step to be right.

    ``start`` is the slip before it seen from the base after it. What stuck before the corner was
    held by what it was held with, not by all of its friction.
    """
    before = math.sqrt(before_x * before_x + before_y * before_y)
    first_x = last_x
    first_y = last_y
    if before > _AT_REST * (before + math.sqrt(start_x * start_x + start_y * start_y)):
        first_x = before_x / before
        first_y = before_y / before
    x = start_x + 0.5 * (push_x - mobility_x * first_x)
    y = start_y + 0.5 * (push_y - mobility_y * first_y)
    sum_x = 0.5 * first_x
    sum_y = 0.5 * first_y
    for n in range(_PARTS):
        share_x, share_y, x, y = _part(
            x, y, push_x / _PARTS, push_y / _PARTS, mobility_x / _PARTS, mobility_y / _PARTS,
            last_x, last_y,
        )  # fmt: skip
        weight = (1.0 - (n + 0.5) / _PARTS) / _PARTS
        sum_x += weight * share_x
        sum_y += weight * share_y
    return sum_x, sum_y


@kernel
def mean_share(
    before_x, before_y, free_x, free_y, mobility_x, mobility_y, jump_x, jump_y, last_x, last_y
):  # fmt: skip
    r"""Mean friction share around a time node, from the slip of the steps on both sides of it.

    `project` decides whether the body sticks; a share taken at the node alone would place a
    reversal of the slip, and a turn of its direction, only to within a step.

    Parameters
    ----------
    before_x, before_y : float
        Slip of the step before the node.
    free_x, free_y, mobility_x, mobility_y : float
        The step after it, as in `project`.
    jump_x, jump_y : float
        What the base's increment jumps by at the node, see `jump_between`.
    last_x, last_y : float
        The share at the node before.

    Returns
    -------
    tuple of 2 floats
        Friction force over :math:`\mu F_N`, by component, in the direction of the slip.
    """
    if jump_x != 0.0 or jump_y != 0.0:
        start_x = before_x - jump_x
        start_y = before_y - jump_y
        return _at_corner(
            before_x, before_y, start_x, start_y, free_x - start_x, free_y - start_y,
            mobility_x, mobility_y, last_x, last_y,
        )  # fmt: skip
    if before_x != 0.0 and before_y == 0.0 and free_y == 0.0:
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

"""Coulomb friction as an implicit projection: stick and slip by one formula."""

import math

from asperity.compiled import kernel


@kernel
def project(free_x, free_y, give_x, give_y, last_x, last_y):
    r"""Friction share that stops, or failing that opposes, a slip.

    Finds :math:`\sigma` in the unit disc with slip :math:`D = f - \mathrm{diag}(b)\,\sigma` such
    that :math:`D = 0` (stick) or :math:`\sigma = D/|D|` (slip): the implicit (backward) step of
    :math:`m\dot v = F - \mu F_N v/|v|`, unique for any mass.

    Parameters
    ----------
    free_x, free_y : float
        Slip :math:`f` over the step if there were no friction.
    give_x, give_y : float
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
        if give_x > 0.0 or give_y > 0.0:
            return 0.0, 0.0
        return last_x, last_y
    stuck_x = free_x / give_x if give_x > 0.0 else 0.0
    stuck_y = free_y / give_y if give_y > 0.0 else 0.0
    can_stick = (give_x > 0.0 or free_x == 0.0) and (give_y > 0.0 or free_y == 0.0)
    if can_stick and stuck_x * stuck_x + stuck_y * stuck_y <= 1.0:
        return stuck_x, stuck_y
    # Slip: |f/(|D| + b)| = 1 for |D|. 1/|.| is nearly linear in |D|, so Newton takes few steps;
    # from below, where the norm is at least 1, it cannot overshoot.
    slip = max(size - max(give_x, give_y), abs(free_x) - give_x, abs(free_y) - give_y, 0.0)
    for _ in range(50):
        x = free_x / (slip + give_x) if slip + give_x > 0.0 else 0.0
        y = free_y / (slip + give_y) if slip + give_y > 0.0 else 0.0
        norm = math.sqrt(x * x + y * y)
        if norm == 0.0:
            break
        bend = 0.0
        if slip + give_x > 0.0:
            bend += x * x / (slip + give_x)
        if slip + give_y > 0.0:
            bend += y * y / (slip + give_y)
        change = (norm - 1.0) * norm * norm / bend
        slip = max(slip + change, 0.0)
        if abs(change) <= 1e-15 * (slip + size):
            break
    x = free_x / (slip + give_x) if slip + give_x > 0.0 else 0.0
    y = free_y / (slip + give_y) if slip + give_y > 0.0 else 0.0
    norm = math.sqrt(x * x + y * y)
    return x / norm, y / norm


@kernel
def mean_share(before_x, before_y, after_x, after_y, smooth, last_x, last_y):
    r"""Mean friction share around a time node for a prescribed slip.

    A sign taken at the node would place a reversal only to within a step.

    Parameters
    ----------
    before_x, before_y, after_x, after_y : float
        Slip of the steps before and after the node.
    smooth : bool
        Whether the velocity goes straight from one to the other, or jumps at the node.
    last_x, last_y : float
        Share to keep where nothing slips.

    Returns
    -------
    tuple of 2 floats
        Friction force over :math:`\mu F_N`, by component, in the direction of the slip.
    """
    before = math.sqrt(before_x * before_x + before_y * before_y)
    after = math.sqrt(after_x * after_x + after_y * after_y)
    if before == 0.0 and after == 0.0:
        return last_x, last_y
    if smooth or before == 0.0 or after == 0.0:
        return (before_x + after_x) / (before + after), (before_y + after_y) / (before + after)
    return (
        0.5 * (before_x / before + after_x / after),
        0.5 * (before_y / before + after_y / after),
    )

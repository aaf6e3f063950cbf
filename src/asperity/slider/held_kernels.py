"""The compiled loop behind a body under a constant pull."""

import numpy as np

from asperity.kernels.compiled import kernel
from asperity.slider.shooting import run_cycle


@kernel
def carry(state, springs, p, q, increments, rises, sums, shares):
    """March a cycle for each share of the vibration in the plane; sums are those of the last."""
    shaken = np.empty_like(increments)
    for share in shares:
        for n in range(increments.size):
            shaken[n] = share * increments[n]
        run_cycle(state, springs, p, q, shaken, rises, sums)

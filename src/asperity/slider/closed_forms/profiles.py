"""Profiles of a contact: how its load follows its approach, and what a swing does to its mean."""

from typing import Annotated, Any, Literal

import numpy as np

from asperity.arrays import FloatArray, Real
from asperity.formulas import Symbol, not_negative, positive

Profile = Literal["flat", "hertz", "rough"]
"""Load over approach: linear, of the power 3/2, exponential."""

a = Annotated[Real, Symbol("a", "", not_negative)]
"""Amplitude of the approach over the approach, or over the length of a rough contact."""

s_max = Annotated[Real, Symbol("s_max", "m", positive)]
"""Limit mu N_0/k_x of the deflection, as in [friction]."""

HERTZ = 1.5
DEPTH = {"flat": 1.0, "hertz": HERTZ, "rough": 1.0}
"""What a swing is over, in N_0/k_z; so also the deflection at full slip (rough: e) over s_max."""
_NODES = 48


def share(change: Real, profile: Profile) -> Any:
    """Load over that at rest, after a change of the approach over what `a` is over."""
    if profile == "rough":
        return np.exp(change)
    pressed = np.maximum(1.0 + change, 0.0)
    return pressed if profile == "flat" else pressed**HERTZ


def mean_share(swing: Real, profile: Profile) -> Any:
    """Mean of `share` over a cycle."""
    from scipy.special import i0

    if profile == "rough":
        return i0(swing)
    if profile == "hertz":
        return np.where(np.asarray(swing) <= 1.0, mean_power(np.minimum(swing, 1.0), HERTZ),
                        _mean_hertz_open(np.asarray(np.maximum(swing, 1.0))))  # fmt: skip
    wide = np.maximum(swing, 1.0)
    return (np.arccos(-1.0 / wide) + np.sqrt((wide - 1.0) * (wide + 1.0))) / np.pi


def mean_power(swing: Real, exponent: Real) -> Any:
    r"""Mean of :math:`(1 + a\cos p)^n` for a up to 1, a Legendre function as Gauss's series."""
    from scipy.special import hyp2f1

    return hyp2f1(-0.5 * exponent, 0.5 * (1.0 - exponent), 1.0, np.square(swing))


def _mean_hertz_open(swing: FloatArray) -> Any:
    from scipy.special import roots_gegenbauer

    # Contact is lost at both ends of the phase, where the load falls to zero with its own power.
    nodes, weights = roots_gegenbauer(_NODES, HERTZ + 0.5)
    end = np.arccos(-1.0 / swing)[..., None]
    load = np.maximum(1.0 + swing[..., None] * np.cos(end * nodes), 0.0) / (1.0 - nodes * nodes)
    return end[..., 0] / (2.0 * np.pi) * (load**HERTZ @ weights)

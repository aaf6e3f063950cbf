r"""Power of rigid Coulomb friction under sine vibration, and the vibration's part in it.

Of drive and vibration together, over :math:`\mu F_N v_d`.
"""

from typing import Any

import numpy as np

from asperity.arrays import Real
from asperity.formulas import Bounds, formula
from asperity.slider.closed_forms.ratios import (
    CARLSON,
    RIGID,
    directed_sine,
    factors,
    k,
    longitudinal_sine,
    theta,
)


@formula(symbol="P/(mu F_N v_d)", source=RIGID)
def longitudinal_power(k: k) -> Real:
    r"""Power of friction under longitudinal sine vibration.

    .. math:: \frac{P}{\mu F_N v_d} = \begin{cases} 1 & k \le 1 \\ \frac{2}{\pi}
       \left(\arcsin\frac{1}{k} + \sqrt{k^2-1}\right) & k > 1 \end{cases}

    Phase mean of the slip speed.

    Examples
    --------
    >>> round(longitudinal_power(6.0), 4)
    3.8729
    """
    return longitudinal_sine(k) + power_given(k, 0.0)


@formula(symbol="P/(mu F_N v_d)", source=RIGID)
def transverse_power(k: k) -> Real:
    r"""Power of friction under transverse sine vibration; eta_y k where the transfer is partial.

    .. math:: \frac{P}{\mu F_N v_d} = \frac{2}{\pi}\sqrt{1+k^2}\,E(m), \qquad m = \frac{k^2}{1+k^2}

    Phase mean of the slip speed; E is the complete elliptic integral of the second kind.

    Examples
    --------
    >>> round(transverse_power(6.0), 4)
    4.0144
    """
    from scipy.special import ellipe

    return 2.0 / np.pi * np.hypot(1.0, k) * ellipe(k * k / (1.0 + k * k))


@formula(symbol="P/(mu F_N v_d)", source=CARLSON)
def directed_power(k: k, theta: theta) -> Real:
    r"""Power of friction under sine vibration in any direction of the plane.

    .. math:: \frac{P}{\mu F_N v_d} = \left\langle
       \sqrt{1 - 2k\cos\theta\cos p + k^2\cos^2 p}\, \right\rangle_p

    Computed as `directed_ratio` plus `vibration_power`, both positive.

    Examples
    --------
    >>> round(directed_power(6.0, np.pi / 4), 5)
    3.95327
    """
    return directed_sine(k, theta) + power_given(k, theta)


@formula(symbol="P_vib/(mu F_N v_d)", source=CARLSON, result=Bounds(0.0))
def vibration_power(k: k, theta: theta) -> Real:
    r"""Power a sine vibration must supply.

    .. math:: \frac{P_{vib}}{\mu F_N v_d} = \frac{P}{\mu F_N v_d} - \frac{F_d}{\mu F_N}
       = \frac{2}{3\pi}\, k^2\sin^2\theta\; R_D(0, D, y)

    with D and y as in `directed_ratio`: `directed_power` less `directed_ratio`, without the
    cancellation; the integrals of the third kind in the two are the same. R_D is Carlson's elliptic
    integral. Along the drive it becomes :math:`\frac{2}{\pi}\sqrt{k^2-1}` above k = 1 and 0 below.

    Examples
    --------
    >>> round(vibration_power(2.0, 0.0), 10)
    1.1026577908
    """
    return power_given(k, theta)


def power_given(k: Real, theta: Real) -> Any:
    """Power of the vibration, arguments checked."""
    from scipy.special import elliprd

    d, _, y, off = factors(k, theta)
    across = 2.0 / (3.0 * np.pi) * np.square(k * np.sin(theta)) * elliprd(0.0, d, y)
    return np.where(off, across, 2.0 / np.pi * np.sqrt(np.maximum((k - 1.0) * (k + 1.0), 0.0)))

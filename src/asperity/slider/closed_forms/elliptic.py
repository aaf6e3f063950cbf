r"""Elliptic vibration: in the plane and out of it at once, on rigid Coulomb friction."""

from typing import Annotated

import numpy as np

from asperity.arrays import Real
from asperity.formulas import Bounds, Symbol, formula
from asperity.slider.closed_forms.powers import power_given
from asperity.slider.closed_forms.ratios import directed_sine, factors, k, theta
from asperity.sources import Source

ELLIPSE = Source("rigid Coulomb friction over a phase", "verified", "derived; DLMF 19.21(iii)")


@formula(symbol="F_d/(mu N_0)", source=ELLIPSE)
def elliptic_ratio(
    k: k,
    theta: theta,
    swing: Annotated[Real, Symbol("a", "", Bounds(0.0, 1.0), "above 1 contact is lost")],
    phase: Annotated[Real, Symbol("psi", "rad")],
) -> Real:
    r"""Drive force under vibration in the plane and a load that swings, which can push.

    The base moves as :math:`u\sin p` in a direction :math:`\theta` of the plane, the load of a flat
    contact under displacement control as :math:`N_0(1 + a\sin(p + \psi))`:

    .. math:: \frac{F_d}{\mu N_0} = \left\langle (1 + a\sin(p+\psi))\, e_x \right\rangle_p
       = \left\langle e_x \right\rangle + a\sin\psi\,\left\langle\cos p\; e_x\right\rangle, \qquad
       \left\langle\cos p\; e_x\right\rangle = \frac{2}{3\pi}\,k\cos\theta\sin^2\theta\,
       R_J(0, y, D, r) - \frac{\cos\theta}{k}\,\frac{P_{vib}}{\mu F_N v_d}

    with D, r and y as in `directed_ratio`, the first term, and the power of `vibration_power`.
    Along the drive, k > 1, it is :math:`\frac{2}{\pi}[\arcsin\frac{1}{k} - a\sin\psi
    \sqrt{1 - 1/k^2}]`. Asperities come near it only as the root of their limit over the amplitude.

    Examples
    --------
    >>> round(elliptic_ratio(6.0, 0.0, 0.8, np.pi / 2), 4)
    -0.3956
    """
    from scipy.special import elliprj

    d, r, y, off = factors(k, theta)
    cos, across = np.cos(theta), np.square(np.sin(theta))
    turned = np.where(off, 2.0 / (3.0 * np.pi) * k * cos * across * elliprj(0.0, y, d, r), 0.0)
    pushed = np.where(k > 0.0, cos / np.where(k > 0.0, k, 1.0) * power_given(k, theta), 0.0)
    return directed_sine(k, theta) + swing * np.sin(phase) * (turned - pushed)

r"""Power of rigid Coulomb friction under sine vibration, and the vibration's part in it."""

from typing import Any

import numpy as np
import numpy.typing as npt

from asperity.arrays import FloatArray
from asperity.slider.closed_forms.evaluate import Invalid, evaluate
from asperity.slider.closed_forms.ratios import (
    directed_sine,
    factors,
    longitudinal_sine,
    off_axis,
)


def longitudinal_power(k: npt.ArrayLike, *, on_invalid: Invalid = "raise") -> Any:
    r"""Power of friction under longitudinal sine vibration.

    .. math:: \frac{P}{\mu F_N v_d} = \begin{cases} 1 & k \le 1 \\ \frac{2}{\pi}
       \left(\arcsin\frac{1}{k} + \sqrt{k^2-1}\right) & k > 1 \end{cases}

    Parameters
    ----------
    k : array_like
        Velocity ratio v_a/v_d >= 0, [-].
    on_invalid : {'raise', 'mask'}
        What to do with elements outside the range.

    Returns
    -------
    float or ndarray
        Mean power lost to friction, of drive and vibration together, over mu F_N v_d, [-], >= 1.

    Notes
    -----
    Phase mean of the slip speed.

    Examples
    --------
    >>> round(longitudinal_power(6.0), 4)
    3.8729
    """
    return evaluate(lambda k: longitudinal_sine(k) + _given(k, 0.0 * k), on_invalid, k=(k, 0.0))


def transverse_power(k: npt.ArrayLike, *, on_invalid: Invalid = "raise") -> Any:
    r"""Power of friction under transverse sine vibration.

    .. math:: \frac{P}{\mu F_N v_d} = \frac{2}{\pi}\sqrt{1+k^2}\,E(m), \qquad m = \frac{k^2}{1+k^2}

    Parameters
    ----------
    k : array_like
        Velocity ratio v_a/v_d >= 0, [-]; eta_y v_a/v_d where the transfer is partial.
    on_invalid : {'raise', 'mask'}
        What to do with elements outside the range.

    Returns
    -------
    float or ndarray
        Mean power lost to friction, of drive and vibration together, over mu F_N v_d, [-], >= 1.

    Notes
    -----
    Phase mean of the slip speed; E is the complete elliptic integral of the second kind.

    Examples
    --------
    >>> round(transverse_power(6.0), 4)
    4.0144
    """
    return evaluate(_transverse_total, on_invalid, k=(k, 0.0))


def directed_power(k: npt.ArrayLike, theta: npt.ArrayLike, *, on_invalid: Invalid = "raise") -> Any:
    r"""Power of friction under sine vibration in any direction of the plane.

    .. math:: \frac{P}{\mu F_N v_d} = \left\langle
       \sqrt{1 - 2k\cos\theta\cos p + k^2\cos^2 p}\, \right\rangle_p

    Parameters
    ----------
    k : array_like
        Velocity ratio v_a/v_d >= 0, [-].
    theta : array_like
        Direction of the vibration from that of the drive, any finite angle, [rad].
    on_invalid : {'raise', 'mask'}
        What to do with elements outside the range.

    Returns
    -------
    float or ndarray
        Mean power lost to friction, of drive and vibration together, over mu F_N v_d, [-], >= 1.

    Notes
    -----
    Computed as `directed_ratio` plus `vibration_power`, both positive.

    Examples
    --------
    >>> round(directed_power(6.0, np.pi / 4), 5)
    3.95327
    """
    return evaluate(
        lambda k, theta: directed_sine(k, theta) + _given(k, theta),
        on_invalid,
        k=(k, 0.0),
        theta=(theta, -np.inf),
    )


def vibration_power(
    k: npt.ArrayLike, theta: npt.ArrayLike, *, on_invalid: Invalid = "raise"
) -> Any:
    r"""Power a sine vibration must supply.

    .. math:: \frac{P_{vib}}{\mu F_N v_d} = \frac{P}{\mu F_N v_d} - \frac{F_d}{\mu F_N}
       = \frac{2}{3\pi}\, k^2\sin^2\theta\; R_D(0, D, y)

    with D and y as in `directed_ratio`.

    Parameters
    ----------
    k : array_like
        Velocity ratio v_a/v_d >= 0, [-].
    theta : array_like
        Direction of the vibration from that of the drive, any finite angle, [rad].
    on_invalid : {'raise', 'mask'}
        What to do with elements outside the range.

    Returns
    -------
    float or ndarray
        Mean power of the vibration over mu F_N v_d, [-], >= 0.

    Notes
    -----
    `directed_power` less `directed_ratio`, without the cancellation; the integrals of the third
    kind in the two are the same. R_D is Carlson's elliptic integral. Along the drive it becomes
    :math:`\frac{2}{\pi}\sqrt{k^2-1}` above k = 1 and 0 below.

    Examples
    --------
    >>> round(vibration_power(2.0, 0.0), 10)
    1.1026577908
    """
    return evaluate(_given, on_invalid, k=(k, 0.0), theta=(theta, -np.inf))


def _transverse_total(k: FloatArray) -> FloatArray:
    from scipy.special import ellipe

    return np.asarray(2.0 / np.pi * np.hypot(1.0, k) * ellipe(k * k / (1.0 + k * k)))


def _given(k: FloatArray, theta: FloatArray) -> FloatArray:
    from scipy.special import elliprd

    d, _, y = factors(k, theta)
    power = 2.0 / np.pi * np.sqrt(np.maximum((k - 1.0) * (k + 1.0), 0.0))
    off = off_axis(d, y)
    across = np.square(k[off] * np.sin(theta[off]))
    power[off] = 2.0 / (3.0 * np.pi) * across * elliprd(0.0, d[off], y[off])
    return power

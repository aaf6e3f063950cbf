r"""Drive force of a guided body on a rigid drive under rigid Coulomb friction: ratios."""

from typing import Any

import numpy as np
import numpy.typing as npt

from asperity.arrays import FloatArray
from asperity.slider.closed_forms.evaluate import Invalid, evaluate

# Source of the elliptic forms: a Moebius map of cos(p) makes both quadratic factors under the root
# even, and Carlson's symmetric integrals follow (DLMF 19.14, 19.25); the two forms of the third
# kind in DLMF 19.21(iii) leave only positive terms.


def longitudinal_ratio(k: npt.ArrayLike, *, on_invalid: Invalid = "raise") -> Any:
    r"""Drive force under longitudinal sine vibration.

    .. math:: \frac{F_d}{\mu F_N} = \begin{cases} 1 & k \le 1 \\
       \frac{2}{\pi}\arcsin\frac{1}{k} & k > 1 \end{cases}

    Parameters
    ----------
    k : array_like
        Velocity ratio v_a/v_d >= 0, [-].
    on_invalid : {'raise', 'mask'}
        What to do with elements outside the range.

    Returns
    -------
    float or ndarray
        Mean drive force over mu F_N, [-], in (0, 1].

    Notes
    -----
    Share of the cycle in which the body outruns the base, less the share in which it does not;
    thesis 2.7 and (13).

    Examples
    --------
    >>> round(longitudinal_ratio(2.0), 10)
    0.3333333333
    """
    return evaluate(longitudinal_sine, on_invalid, k=(k, 0.0))


def transverse_ratio(k: npt.ArrayLike, *, on_invalid: Invalid = "raise") -> Any:
    r"""Drive force under transverse sine vibration.

    .. math:: \frac{F_d}{\mu F_N} = \frac{2}{\pi}\,\frac{K(m)}{\sqrt{1+k^2}},
       \qquad m = \frac{k^2}{1+k^2}

    Parameters
    ----------
    k : array_like
        Velocity ratio v_a/v_d >= 0, [-]; eta_y v_a/v_d where the transfer is partial.
    on_invalid : {'raise', 'mask'}
        What to do with elements outside the range.

    Returns
    -------
    float or ndarray
        Mean drive force over mu F_N, [-], in (0, 1].

    Notes
    -----
    Phase mean of the cosine between slip and drive; K is the complete elliptic integral of the
    first kind of the parameter m.

    Examples
    --------
    >>> round(transverse_ratio(1.0), 5)
    0.83463
    """
    return evaluate(_transverse, on_invalid, k=(k, 0.0))


def directed_ratio(k: npt.ArrayLike, theta: npt.ArrayLike, *, on_invalid: Invalid = "raise") -> Any:
    r"""Drive force under sine vibration in any direction of the plane.

    .. math:: \frac{F_d}{\mu F_N} = \left\langle \frac{1 - k\cos\theta\cos p}
       {\sqrt{1 - 2k\cos\theta\cos p + k^2\cos^2 p}} \right\rangle_p
       = \frac{2}{\pi}\left[ y\,R_F(0, y, D)
       + \frac{q\,y D}{3 r}\, R_J\!\left(0, y, D, \frac{y D}{r}\right) \right]

    with :math:`D^2 = (1-k^2)^2 + 4k^2\sin^2\theta`, :math:`r = (1+k^2+D)/2`,
    :math:`q = k^2\cos^2\theta/r`, :math:`y = 1 - q`.

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
        Mean drive force over mu F_N, [-], in (0, 1].

    Notes
    -----
    R_F and R_J are Carlson's elliptic integrals. Every term is positive, so that nothing is lost
    to cancellation, also where :math:`\theta \to 0` and :math:`k \to 1`.

    Examples
    --------
    >>> round(directed_ratio(6.0, np.pi / 4), 5)
    0.24099
    """
    return evaluate(directed_sine, on_invalid, k=(k, 0.0), theta=(theta, -np.inf))


def triangle_longitudinal_ratio(k: npt.ArrayLike, *, on_invalid: Invalid = "raise") -> Any:
    r"""Drive force under longitudinal triangle vibration, :math:`v_a = 4 f u_a`.

    .. math:: \frac{F_d}{\mu F_N} = \frac{1 + \mathrm{sgn}(1 - k)}{2}

    Parameters
    ----------
    k : array_like
        Velocity ratio v_a/v_d >= 0, [-].
    on_invalid : {'raise', 'mask'}
        What to do with elements outside the range.

    Returns
    -------
    float or ndarray
        Mean drive force over mu F_N, [-]: 1 below k = 1 and 0 above. At k = 1 the body rests on
        the base for half the cycle and its friction there is not determined; 1/2 is the limit from
        other directions.

    Notes
    -----
    The base moves at +v_a for one half of the cycle and at -v_a for the other; thesis (13).

    Examples
    --------
    >>> triangle_longitudinal_ratio([0.5, 2.0]).tolist()
    [1.0, 0.0]
    """
    return evaluate(lambda k: _triangle(k, 0.0 * k), on_invalid, k=(k, 0.0))


def triangle_transverse_ratio(k: npt.ArrayLike, *, on_invalid: Invalid = "raise") -> Any:
    r"""Drive force under transverse triangle vibration, :math:`v_a = 4 f u_a`.

    .. math:: \frac{F_d}{\mu F_N} = \frac{1}{\sqrt{1 + k^2}}

    Parameters
    ----------
    k : array_like
        Velocity ratio v_a/v_d >= 0, [-].
    on_invalid : {'raise', 'mask'}
        What to do with elements outside the range.

    Returns
    -------
    float or ndarray
        Mean drive force over mu F_N, [-], in (0, 1].

    Notes
    -----
    The slip has the same angle to the drive, on either side of it, all the time.

    Examples
    --------
    >>> round(triangle_transverse_ratio(2.0), 10)
    0.4472135955
    """
    return evaluate(lambda k: 1.0 / np.hypot(1.0, k), on_invalid, k=(k, 0.0))


def triangle_directed_ratio(
    k: npt.ArrayLike, theta: npt.ArrayLike, *, on_invalid: Invalid = "raise"
) -> Any:
    r"""Drive force under triangle vibration in any direction, :math:`v_a = 4 f u_a`.

    .. math:: \frac{F_d}{\mu F_N} = \frac12 \sum_{\pm} \frac{1 \pm k\cos\theta}
       {\sqrt{(1 \pm k\cos\theta)^2 + k^2\sin^2\theta}}

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
        Mean drive force over mu F_N, [-], in [0, 1].

    Notes
    -----
    Mean of the two half cycles, in each of which the slip velocity is constant.

    Examples
    --------
    >>> round(triangle_directed_ratio(2.0, np.pi / 4), 10)
    0.2908857859
    """
    return evaluate(_triangle, on_invalid, k=(k, 0.0), theta=(theta, -np.inf))


def longitudinal_sine(k: FloatArray) -> FloatArray:
    """Ratio along the drive, arguments checked."""
    return 2.0 / np.pi * np.arcsin(1.0 / np.maximum(k, 1.0))


def _transverse(k: FloatArray) -> FloatArray:
    from scipy.special import ellipkm1

    return np.asarray(2.0 / np.pi * ellipkm1(1.0 / (1.0 + k * k)) / np.hypot(1.0, k))


def factors(k: FloatArray, theta: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return D, r and y of `directed_ratio`, each to rounding."""
    across = k * np.sin(theta)
    excess = (1.0 - k) * (1.0 + k)
    d = np.hypot(excess, 2.0 * across)
    half_sum = 0.5 * (np.abs(excess) + d)
    with np.errstate(divide="ignore", invalid="ignore"):
        y = np.where(excess >= 0.0, half_sum, across * across / half_sum)
    return d, 0.5 * (1.0 + k * k + d), y


# Below this share of D the drive lies along the vibration as far as floats can tell.
_ALONG = 1e-200


def off_axis(d: FloatArray, y: FloatArray) -> npt.NDArray[np.bool_]:
    """Where the elliptic forms hold; elsewhere those along the drive do."""
    result: npt.NDArray[np.bool_] = (d > 0.0) & (y > _ALONG * d)
    return result


def directed_sine(k: FloatArray, theta: FloatArray) -> FloatArray:
    """Ratio in any direction, arguments checked."""
    from scipy.special import elliprf, elliprj

    d, r, y = factors(k, theta)
    ratio = longitudinal_sine(k)
    off = off_axis(d, y)
    d, r, y = d[off], r[off], y[off]
    q = np.square(k[off] * np.cos(theta[off])) / r
    share = y * d / r
    ratio[off] = (
        2.0 / np.pi * (y * elliprf(0.0, y, d) + q * share / 3.0 * elliprj(0.0, y, d, share))
    )
    return ratio


def _triangle(k: FloatArray, theta: FloatArray) -> FloatArray:
    along, across = k * np.cos(theta), k * np.sin(theta)
    total = np.zeros_like(k)
    for slip in (1.0 - along, 1.0 + along):
        speed = np.hypot(slip, across)
        total += np.divide(slip, speed, out=np.zeros_like(k), where=speed > 0.0)
    return 0.5 * total

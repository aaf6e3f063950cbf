r"""Drive force of a guided body on a rigid drive under rigid Coulomb friction: ratios."""

from typing import Annotated, Any

import numpy as np

from asperity.arrays import BoolArray, Real
from asperity.formulas import Bounds, Symbol, formula
from asperity.sources import Source

RIGID = Source("rigid Coulomb friction over a phase", "verified", "derived; thesis 2.7 and (13)")
CARLSON = Source("DLMF 19.14, 19.21(iii), 19.25", "verified", "phase mean as Carlson's integrals")

# The formulas hold fourth powers of a velocity ratio, which are to stay among the floats.
_RANGE = Bounds(0.0, 1e50, words="zero or positive, and at most 1e+50")
k = Annotated[Real, Symbol("k", "", _RANGE)]
theta = Annotated[Real, Symbol("theta", "rad")]

# A Moebius map of cos(p) makes both quadratic factors under the root even, and Carlson's symmetric
# integrals follow; of the two forms of the third kind one leaves only positive terms.


@formula(symbol="F_d/(mu F_N)", source=RIGID)
def longitudinal_ratio(k: k) -> Real:
    r"""Drive force under longitudinal sine vibration.

    .. math:: \frac{F_d}{\mu F_N} = \begin{cases} 1 & k \le 1 \\
       \frac{2}{\pi}\arcsin\frac{1}{k} & k > 1 \end{cases}

    Share of the cycle in which the body outruns the base, less the share in which it does not.

    Examples
    --------
    >>> round(longitudinal_ratio(2.0), 10)
    0.3333333333
    """
    return longitudinal_sine(k)


@formula(symbol="F_d/(mu F_N)", source=RIGID)
def transverse_ratio(k: k) -> Real:
    r"""Drive force under transverse sine vibration; eta_y k counts where the transfer is partial.

    .. math:: \frac{F_d}{\mu F_N} = \frac{2}{\pi}\,\frac{K(m)}{\sqrt{1+k^2}},
       \qquad m = \frac{k^2}{1+k^2}

    Phase mean of the cosine between slip and drive; K is the complete elliptic integral of the
    first kind of the parameter m.

    Examples
    --------
    >>> round(transverse_ratio(1.0), 5)
    0.83463
    """
    from scipy.special import ellipkm1

    return 2.0 / np.pi * ellipkm1(1.0 / (1.0 + k * k)) / np.hypot(1.0, k)


@formula(symbol="F_d/(mu F_N)", source=CARLSON)
def directed_ratio(k: k, theta: theta) -> Real:
    r"""Drive force under sine vibration in any direction of the plane.

    .. math:: \frac{F_d}{\mu F_N} = \left\langle \frac{1 - k\cos\theta\cos p}
       {\sqrt{1 - 2k\cos\theta\cos p + k^2\cos^2 p}} \right\rangle_p
       = \frac{2}{\pi}\left[ y\,R_F(0, y, D)
       + \frac{q\,y D}{3 r}\, R_J\!\left(0, y, D, \frac{y D}{r}\right) \right]

    with :math:`D^2 = (1-k^2)^2 + 4k^2\sin^2\theta`, :math:`r = (1+k^2+D)/2`,
    :math:`q = k^2\cos^2\theta/r`, :math:`y = 1 - q`.

    R_F and R_J are Carlson's elliptic integrals. Every term is positive, so that nothing is lost
    to cancellation, also where :math:`\theta \to 0` and :math:`k \to 1`.

    Examples
    --------
    >>> round(directed_ratio(6.0, np.pi / 4), 5)
    0.24099
    """
    return directed_sine(k, theta)


@formula(symbol="F_d/(mu F_N)", source=RIGID)
def triangle_longitudinal_ratio(k: k) -> Real:
    r"""Drive force under longitudinal triangle vibration, :math:`v_a = 4 f u_a`.

    .. math:: \frac{F_d}{\mu F_N} = \frac{1 + \mathrm{sgn}(1 - k)}{2}

    The base moves at +v_a for one half of the cycle and at -v_a for the other. At k = 1 the body
    rests on the base for half the cycle and its friction there is not determined; 1/2 is the limit
    from other directions.

    Examples
    --------
    >>> triangle_longitudinal_ratio([0.5, 2.0]).tolist()
    [1.0, 0.0]
    """
    return _triangle(k, 0.0)


@formula(symbol="F_d/(mu F_N)", source=RIGID)
def triangle_transverse_ratio(k: k) -> Real:
    r"""Drive force under transverse triangle vibration, :math:`v_a = 4 f u_a`.

    .. math:: \frac{F_d}{\mu F_N} = \frac{1}{\sqrt{1 + k^2}}

    The slip has the same angle to the drive, on either side of it, all the time.

    Examples
    --------
    >>> round(triangle_transverse_ratio(2.0), 10)
    0.4472135955
    """
    return 1.0 / np.hypot(1.0, k)


@formula(symbol="F_d/(mu F_N)", source=RIGID)
def triangle_directed_ratio(k: k, theta: theta) -> Real:
    r"""Drive force under triangle vibration in any direction, :math:`v_a = 4 f u_a`.

    .. math:: \frac{F_d}{\mu F_N} = \frac12 \sum_{\pm} \frac{1 \pm k\cos\theta}
       {\sqrt{(1 \pm k\cos\theta)^2 + k^2\sin^2\theta}}

    Mean of the two half cycles, in each of which the slip velocity is constant.

    Examples
    --------
    >>> round(triangle_directed_ratio(2.0, np.pi / 4), 10)
    0.2908857859
    """
    return _triangle(k, theta)


def longitudinal_sine(k: Real) -> Any:
    """Ratio along the drive, arguments checked."""
    return 2.0 / np.pi * np.arcsin(1.0 / np.maximum(k, 1.0))


# Below this share of D the drive lies along the vibration as far as floats can tell.
_ALONG = 1e-200


def factors(k: Real, theta: Real) -> tuple[Any, Any, Any, BoolArray]:
    """Return D, r and y of `directed_ratio`, each to rounding, and where the elliptic forms hold.

    Elsewhere those along the drive do; D and y are 1 there.
    """
    across = k * np.sin(theta)
    excess = (1.0 - k) * (1.0 + k)
    d = np.hypot(excess, 2.0 * across)
    half_sum = 0.5 * (np.abs(excess) + d)
    with np.errstate(divide="ignore", invalid="ignore"):
        y = np.where(excess >= 0.0, half_sum, across * across / half_sum)
    off: BoolArray = np.asarray((d > 0.0) & (y > _ALONG * d))
    return np.where(off, d, 1.0), 0.5 * (1.0 + k * k + d), np.where(off, y, 1.0), off


def directed_sine(k: Real, theta: Real) -> Any:
    """Ratio in any direction, arguments checked."""
    from scipy.special import elliprf, elliprj

    d, r, y, off = factors(k, theta)
    q = np.square(k * np.cos(theta)) / r
    share = y * d / r
    elliptic = y * elliprf(0.0, y, d) + q * share / 3.0 * elliprj(0.0, y, d, share)
    return np.where(off, 2.0 / np.pi * elliptic, longitudinal_sine(k))


def _triangle(k: Real, theta: Real) -> Any:
    along, across = k * np.cos(theta), k * np.sin(theta)
    total: Any = 0.0
    for slip in (1.0 - along, 1.0 + along):
        speed = np.hypot(slip, across)
        total += np.where(speed > 0.0, slip / np.where(speed > 0.0, speed, 1.0), 0.0)
    return 0.5 * total

r"""Normal contact without friction: the forces of patches by Polonsky and Keer's conjugate gradients.

Patches with forces :math:`f \ge 0` sink by :math:`K f`, :math:`K` symmetric; the bodies come
together by :math:`\theta`, each patch by :math:`h\,\theta`. What is sought is

.. math:: g = g_0 + K f - h\,\theta \ge 0, \qquad f g = 0, \qquad \sum h f = M .

Where a patch bears no more than its area times a cap, as a body does that flows plastically, the
gap may stay below zero at the cap: what is left is the depth by which it was pressed in.

I. A. Polonsky and L. M. Keer, Wear 231 (1999), 206; with a cap: A. Almqvist, F. Sahlin, R. Larsson
and S. Glavatskih, Tribol. Int. 40 (2007), 574. Here :math:`h` may differ from patch to patch.
"""

import dataclasses
from collections.abc import Callable

import numpy as np

from asperity.arrays import BoolArray, FloatArray
from asperity.errors import ConvergenceError

_MOST = 2000
# Of the gaps of patches that bear, over the approach.
TOLERANCE = 1e-5


@dataclasses.dataclass(frozen=True, eq=False)
class Bearing:
    """What was found."""

    force: FloatArray  #: (n,): N
    approach: float  #: :math:`\\theta`
    gap: FloatArray  #: (n,): m; below zero where a patch is at its cap
    iterations: int
    residual: float  #: Root mean square of the gaps where patches bear, over the approach


def bear(
    gap: FloatArray,
    deflection: Callable[[FloatArray], FloatArray],
    arm: FloatArray,
    moment: float,
    *,
    most: FloatArray | None = None,
    start: FloatArray | None = None,
    tolerance: float = TOLERANCE,
) -> Bearing:
    """Return the forces of patches that together bear a load.

    Parameters
    ----------
    gap : ndarray, shape (n,)
        Of the undeformed patches where the approach is 0, m.
    deflection : callable
        Takes forces, N, and returns what the patches sink, m: linear and symmetric.
    arm : ndarray, shape (n,)
        :math:`h`, above 0: 1 for a force, a lever in m for a moment.
    moment : float
        :math:`M`, above 0, N or N m.
    most : ndarray, shape (n,), optional
        Largest forces, N; none if left out.
    start : ndarray, shape (n,), optional
        Forces to begin with, N.
    tolerance : float
        Gap left where patches bear, root mean square, over the approach of the bodies.

    Raises
    ------
    ConvergenceError
        All patches at their caps do not bear the load, or it was not found.
    """
    if most is not None and not float(arm @ most) > moment:
        raise ConvergenceError(
            "the load is more than the patches bear at the pressure of plastic flow",
            reached={"load": float(arm @ most)},
        )
    force = np.full(gap.shape, 1.0) if start is None else np.maximum(start, 0.0)
    if not float(arm @ force) > 0.0:
        force = np.ones(gap.shape)
    force = _loaded(force, arm, moment, most)
    way = np.zeros(gap.shape)
    before, last = np.inf, np.zeros(gap.shape)
    residual = np.inf
    for iteration in range(1, _MOST + 1):
        free = _between(force, most)
        left = gap + deflection(force)
        theta = _level(left, arm, free)
        left -= arm * theta
        square = float(left[free] @ left[free])
        size = max(float(np.abs(gap + arm * -theta).max(where=free, initial=0.0)), 1e-15)
        residual = np.sqrt(square / max(1, int(free.sum()))) / size
        wrong = _wrong(force, left, most, tolerance * size)
        if residual <= tolerance and not wrong.any():
            return Bearing(force, theta, left, iteration, residual)
        # Polak and Ribiere's: where patches come and go it begins anew by itself.
        going_on = max(0.0, (square - float(left[free] @ last[free])) / before)
        way = np.where(free, left + going_on * way, 0.0)
        before, last = square or 1e-300, left
        sunk = deflection(way)
        sunk -= arm * _level(sunk, arm, free)
        curvature = float(sunk[free] @ way[free])
        step = float(left[free] @ way[free]) / curvature if curvature > 0.0 else 0.0
        trial = force - step * way
        clipped = np.maximum(trial, 0.0) if most is None else np.clip(trial, 0.0, most)
        # Patches that overlap bear again, patches at the cap that part bear less: from anew.
        back = _wrong(clipped, left, most, 0.0) & ~free
        size_step = abs(step) if step else 1.0 / max(float(np.abs(sunk).max()), 1e-300)
        clipped[back] -= size_step * left[back]
        if most is not None:
            clipped = np.clip(clipped, 0.0, most)
        force = _loaded(clipped, arm, moment, most)
    raise ConvergenceError(
        "the pressures of the contact were not found", reached={"residual": residual}
    )


def _between(force: FloatArray, most: FloatArray | None) -> BoolArray:
    some = force > 0.0
    return some if most is None else some & (force < most)


def _wrong(force: FloatArray, gap: FloatArray, most: FloatArray | None, slack: float) -> BoolArray:
    """Patches that should bear more than nothing, or less than the most."""
    wrong = (force <= 0.0) & (gap < -slack)
    if most is not None:
        wrong |= (force >= most) & (gap > slack)
    return wrong


def _level(values: FloatArray, arm: FloatArray, free: BoolArray) -> float:
    chosen = arm[free]
    return float(values[free] @ chosen) / max(float(chosen @ chosen), 1e-300)


def _loaded(
    force: FloatArray, arm: FloatArray, moment: float, most: FloatArray | None
) -> FloatArray:
    """Forces scaled to the load, those at the cap left there."""
    for _ in range(50):
        if most is None:
            return force * (moment / max(float(arm @ force), 1e-300))
        capped = force >= most
        rest = moment - float(arm[capped] @ most[capped])
        own = float(arm[~capped] @ force[~capped])
        if rest <= 0.0 or own <= 0.0:
            # Too much at the cap, or nothing else: all alike.
            force = np.minimum(force * moment / float(arm @ force), 0.999 * most) + 1e-6 * most
            continue
        force = np.where(capped, most, np.minimum(force * (rest / own), most))
        if abs(float(arm @ force) - moment) <= 1e-12 * moment:
            break
    return force

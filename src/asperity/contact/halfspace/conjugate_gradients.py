r"""Normal contact without friction: forces of patches by Polonsky and Keer's conjugate gradients.

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
# Of the projected gradients: powers for the steepest way and what is added, iterations between
# looks at what is left, and halvings of the approach.
_POWERS, _ABOVE, _LOOKS, _HALVINGS = 20, 1.1, 10, 60
_SCALINGS, _ROUNDING = 50, 1e-12
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
        Largest forces, N, 0 where there is no patch; none if left out.
    start : ndarray, shape (n,), optional
        Forces to begin with, N.
    tolerance : float
        Gap left where patches bear, root mean square, over the approach of the bodies.

    Raises
    ------
    ConvergenceError
        All patches at their caps do not bear the load, or it was not found.
    """
    limit = np.full(gap.shape, np.inf) if most is None else most
    whole = _dot(arm, limit)
    if not whole > moment:
        raise ConvergenceError(
            "the load is more than the patches bear at the pressure of plastic flow",
            reached={"load": whole},
        )
    force = np.minimum(np.ones(gap.shape) if start is None else np.maximum(start, 0.0), limit)
    force = _loaded(force, arm, moment, limit)
    way = np.zeros(gap.shape)
    before, last = np.inf, np.zeros(gap.shape)
    residual = np.inf
    for iteration in range(1, _MOST + 1):
        free = (force > 0.0) & (force < limit)
        # Taking by number costs a third of taking by mask.
        on = np.flatnonzero(free)
        levers = arm[on]
        left = gap + deflection(force)
        theta = _level(left[on], levers)
        left -= arm * theta
        own = left[on]
        square = _dot(own, own)
        size = max(float(np.abs(gap[on] - levers * theta).max(initial=0.0)), 1e-15)
        residual = np.sqrt(square / max(1, on.size)) / size
        if residual <= tolerance and not _wrong(force, left, limit, tolerance * size).any():
            return Bearing(force, theta, left, iteration, residual)
        # Polak and Ribiere's: where patches come and go it begins anew by itself.
        beta = max(0.0, (square - _dot(own, last[on])) / before)
        along = own + beta * way[on]
        way = np.zeros(gap.shape)
        way[on] = along
        before, last = square or 1e-300, left
        sunk = deflection(way)
        level = _level(sunk[on], levers)
        curvature = _dot(sunk[on] - levers * level, along)
        step = _dot(own, along) / curvature if curvature > 0.0 else 0.0
        clipped = np.clip(force - step * way, 0.0, limit)
        # Patches that overlap bear again, patches at the cap that part bear less: from anew.
        back = _wrong(clipped, left, limit, 0.0) & ~free
        if back.any():
            largest = float(np.abs(sunk - arm * level).max())
            size_step = abs(step) if step else 1.0 / max(largest, 1e-300)
            clipped[back] = np.clip(clipped[back] - size_step * left[back], 0.0, limit[back])
        force = _loaded(clipped, arm, moment, limit)
    return _by_projection(gap, deflection, arm, moment, limit, force, tolerance)


def _by_projection(
    gap: FloatArray,
    deflection: Callable[[FloatArray], FloatArray],
    arm: FloatArray,
    moment: float,
    limit: FloatArray,
    force: FloatArray,
    tolerance: float,
) -> Bearing:
    """Return what `bear` does, by Nesterov's gradients projected on forces that bear the load.

    Slower and certain: where nearly all that bears is at its cap, conjugate steps go to and fro
    between two sets of free patches.
    """
    sunk = deflection(force)
    steepness = 0.0
    for _ in range(_POWERS):
        steepness = float(np.linalg.norm(sunk))
        sunk = deflection(sunk / steepness)
    rate = 1.0 / (_ABOVE * steepness)
    ahead, momentum, residual = force, 1.0, np.inf
    for iteration in range(1, _MOST + 1):
        wanted = ahead - rate * (gap + deflection(ahead))
        new = _borne(wanted, rate * arm, arm, moment, limit)
        # Where it goes uphill, momentum begins anew.
        if _dot(ahead - new, new - force) > 0.0:
            momentum = 1.0
        more = 0.5 * (1.0 + np.sqrt(1.0 + 4.0 * momentum**2))
        ahead = new + (momentum - 1.0) / more * (new - force)
        force, momentum = new, more
        if iteration % _LOOKS:
            continue
        left = gap + deflection(force)
        on = np.flatnonzero((force > 0.0) & (force < limit))
        theta = _level(left[on], arm[on])
        left -= arm * theta
        size = max(float(np.abs(gap[on] - arm[on] * theta).max(initial=0.0)), 1e-15)
        residual = np.sqrt(_dot(left[on], left[on]) / max(1, on.size)) / size
        if residual <= tolerance and not _wrong(force, left, limit, tolerance * size).any():
            return Bearing(force, theta, left, _MOST + iteration, residual)
    raise ConvergenceError(
        "the pressures of the contact were not found", reached={"residual": float(residual)}
    )


def _borne(
    wanted: FloatArray, by: FloatArray, arm: FloatArray, moment: float, limit: FloatArray
) -> FloatArray:
    """Return the forces nearest to some that are wanted, within their limits, that bear a load."""
    some = limit > 0.0
    ends = [-float((wanted / by)[some].max())]
    reach = 1.0 / float(by[some].max())
    # Wide enough to bear it: each doubling presses more patches, and those harder.
    while True:
        ends.append(ends[0] + reach)
        if _dot(arm, np.clip(wanted + ends[-1] * by, 0.0, limit)) >= moment:
            break
        reach *= 2.0
        ends.pop()
    low, high = ends
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        if _dot(arm, np.clip(wanted + middle * by, 0.0, limit)) < moment:
            low = middle
        else:
            high = middle
    return np.clip(wanted + high * by, 0.0, limit)


def _dot(one: FloatArray, other: FloatArray) -> float:
    # Threads of BLAS cost more than they save on vectors of this length.
    return float(np.einsum("i,i->", one, other))


def _wrong(force: FloatArray, gap: FloatArray, limit: FloatArray, slack: float) -> BoolArray:
    """Patches that should bear more than nothing, or less than the most."""
    more = (force <= 0.0) & (gap < -slack)
    less = (force >= limit) & (gap > slack)
    return np.asarray((more | less) & (limit > 0.0))


def _level(values: FloatArray, arm: FloatArray) -> float:
    return _dot(values, arm) / max(_dot(arm, arm), 1e-300)


def _loaded(force: FloatArray, arm: FloatArray, moment: float, limit: FloatArray) -> FloatArray:
    """Forces scaled to the load, those at their limit left there."""
    for _ in range(_SCALINGS):
        capped = force >= limit
        rest = moment - _dot(arm[capped], limit[capped])
        own = _dot(arm[~capped], force[~capped])
        if rest <= 0.0:
            # More than the load at the limit: all less.
            force = force * (moment / _dot(arm, force))
            break
        if own <= 0.0:
            # Nothing else bears: all patches alike, below their limits.
            most = np.minimum(limit, moment)
            force = most * (moment / _dot(arm, most))
            break
        force = np.where(capped, limit, np.minimum(force * (rest / own), limit))
        if abs(_dot(arm, force) - moment) <= _ROUNDING * moment:
            break
    return force

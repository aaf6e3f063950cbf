r"""An array of springs: ideally plastic asperities of different heights under one indentation.

Each spring is Coulomb friction on an elastic bristle, pressed by how far it is indented beyond its
height :math:`h_j`: its limit is :math:`d - h_j` while it touches. There are as many of each height
as the contact's normal law :math:`N(d)` has curvature, :math:`w_j \sim N''(h_j)`, so that together
they carry :math:`N`, and pulled from rest at a constant force they give

.. math:: F = \mu\,[N(d) - N(d - s)] ,

which is Dahl's law of exponent 0 for a flat contact (linear law, one spring), 1/3 for Hertz's and 1
for a rough one (exponential law). Unlike Dahl's law they remember which part of the contact was
loaded when: a force below :math:`\mu N_{min}` never creeps, and no path of indentation and slip
gains energy. A reversed slip follows the first loading at twice its scale (Masing), which Dahl's
law does not, so in the plane of contact the two differ.

Indentations are over :math:`N_{ref}/k`, :math:`k` the normal law's slope at the reference load;
slips and deflections over :math:`s_{max} = \mu N_{ref}/k_t`; friction over :math:`\mu N_{ref}`.
Source: R. D. Mindlin and H. Deresiewicz 1953, and the reduction of any axisymmetric or rough
contact to independent springs, L. Popov and M. Hess 2015; checked here against Dahl's closed forms.
"""

from __future__ import annotations

import itertools
import math

import numpy as np
from numpy.typing import NDArray

from asperity.errors import InputError
from asperity.kernels.compiled import kernel
from asperity.roots import root_between

#: Indentation at the reference load by normal law, over N_ref/k: N/N' of that law.
REFERENCE_INDENTATION = {"linear": 1.0, "hertz": 1.5, "rough": 0.0}

_PARTS = np.linspace(0.0, 0.99, 12)

# Only the sum may be taken in another order, so that the loop becomes vector instructions.
_REORDER = {"reassoc"}


def load_and_slope(
    law: str, indentation: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Normal force over the reference load and its derivative by the indentation.

    Parameters
    ----------
    law : {'linear', 'hertz', 'rough'}
        Normal law, as of `asperity.normal`.
    indentation : ndarray, shape (n,)
        Over N_ref/k.

    Returns
    -------
    load, slope : ndarray, shape (n,)
        Normal force over N_ref, 0 out of contact but for ``rough``, and its derivative.
    """
    if law == "rough":
        force = np.exp(indentation)
        return force, force
    depth = np.maximum(indentation, 0.0)
    if law == "hertz":
        slope = np.sqrt(depth / 1.5)
        return slope**3, slope
    return depth, (indentation > 0.0).astype(np.float64)


def spring_profile(
    law: str, count: int, deepest: float
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    r"""Heights and weights of springs that together carry a normal law.

    Parameters
    ----------
    law : {'linear', 'hertz', 'rough'}
        Normal law of the contact; ``linear`` is one spring whatever the count.
    count : int
        Number of springs, 1 or more. With 16 a Hertz contact's force is right to 7e-4.
    deepest : float
        Largest indentation to come; beyond it the springs carry less than the law. Over N_ref/k;
        positive, but for the rough law, whose reference indentation is 0.

    Returns
    -------
    heights, weights : ndarray, shape (count,)
        Indentation at which each begins to touch, over N_ref/k, and share of the stiffness.

    Raises
    ------
    InputError
        Unknown law, no spring, or nothing to indent.

    Notes
    -----
    Each spring stands for an interval of heights, with its curvature and first moment. The
    intervals are equal in :math:`\int\sqrt{N''}`, which makes the polygon that the springs carry
    miss the law by equally much everywhere, on one side; the lowest spring is lowered until it
    misses it by nothing on average. They reach so much deeper than they must, by less than an
    interval, that the reference load is carried as it is.
    """
    if law not in REFERENCE_INDENTATION:
        known = ", ".join(REFERENCE_INDENTATION)
        raise InputError(f"springs follow the normal laws {known}; '{law}' is none of them")
    if count < 1:
        raise InputError(f"the number of springs is {count}; give 1 or more")
    if not math.isfinite(deepest) or (deepest <= 0.0 and law != "rough"):
        raise InputError(f"the deepest indentation is {deepest:g}; it must be positive")
    if law == "linear":
        return np.zeros(1), np.ones(1)
    return _profile(law, count, _level(law, count, deepest))


def _profile(
    law: str, count: int, deepest: float
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    part = np.arange(count + 1) / count
    if law == "hertz":
        edges = deepest * part ** (4.0 / 3.0)
        bend = 4.0 / 3.0 * (deepest / 1.5) ** 1.5
    else:
        edges = np.append(-np.inf, deepest + 2.0 * np.log(part[1:]))
        bend = 4.0 * math.exp(deepest)
    force, slope = load_and_slope(law, edges)
    moment = np.where(slope > 0.0, edges, 0.0) * slope - force
    weights = np.diff(slope)
    heights = np.diff(moment) / weights
    heights[0] -= bend / (24.0 * count * count * weights[0])
    return heights, weights


def _level(law: str, count: int, deepest: float) -> float:
    """Return how deep springs reach that carry the reference load, no deeper than they must.

    What they miss of the law comes and goes from interval to interval.
    """
    reference = REFERENCE_INDENTATION[law]
    # The place of the reference among the intervals, which springs a little deeper move by one.
    if law == "hertz":
        place = count * (reference / deepest) ** 0.75
    else:
        place = count * math.exp(0.5 * (reference - deepest))
    if not 1.0 < place <= count * (1.0 + 1e-12):
        return deepest
    share = count / (place - _PARTS)
    depths = reference * share ** (4.0 / 3.0) if law == "hertz" else reference + 2.0 * np.log(share)

    def missed(depth: float) -> float:
        heights, weights = _profile(law, count, depth)
        return float(weights @ np.maximum(reference - heights, 0.0)) - 1.0

    found = [missed(depth) for depth in depths]
    for n, (low, high) in enumerate(itertools.pairwise(found)):
        if low * high <= 0.0:
            return root_between(missed, float(depths[n]), float(depths[n + 1]), within=1e-15)
    return deepest


@kernel(fastmath=_REORDER)
def advance_springs(sx, sy, dx, dy, indentation_0, indentation_1, heights, weights):
    """Friction after the slip ``D`` while the indentation goes from one value to another.

    One loop without a branch or a call, for vector instructions. Motion along a line of springs
    that stand along it has a shorter way, `advance_springs_along`.

    Parameters
    ----------
    sx, sy : ndarray, shape (n,)
        Deflections; written. All are straight at the start, over s_max.
    dx, dy : float
        Slip, over s_max.
    indentation_0, indentation_1 : float
        Before and after, over N_ref/k; finite.
    heights, weights : ndarray, shape (n,)
        As from `spring_profile`.

    Returns
    -------
    share_x, share_y : float
        Friction force over mu N_ref.
    stored : float
        Elastic energy at the end, over mu N_ref s_max.

    Notes
    -----
    Elastic to the limit and brought back to it, as in `asperity.friction.loaded.slip_back`; a
    spring that begins to touch within the step slips for the rest of it only. Order two in the
    step, along a line without an error where slip and indentation change evenly.
    """
    rise = 1.0 / max(indentation_1 - indentation_0, 1e-200)
    share_x = 0.0
    share_y = 0.0
    stored = 0.0
    for j in range(heights.size):
        limit_0 = max(indentation_0 - heights[j], 0.0)
        limit_1 = max(indentation_1 - heights[j], 0.0)
        part = 1.0 if limit_0 > 0.0 else min(limit_1 * rise, 1.0)
        ax = part * dx
        ay = part * dy
        wx = sx[j] + ax
        wy = sy[j] + ay
        size = math.sqrt(wx * wx + wy * wy)
        turn = max(size - limit_1, 0.0) / max(limit_0 + limit_1, 1e-200)
        wx += turn * ax
        wy += turn * ay
        size = math.sqrt(wx * wx + wy * wy)
        back = min(limit_1 / max(size, 1e-200), 1.0)
        wx *= back
        wy *= back
        sx[j] = wx
        sy[j] = wy
        share_x += weights[j] * wx
        share_y += weights[j] * wy
        stored += weights[j] * (wx * wx + wy * wy)
    return share_x, share_y, 0.5 * stored


@kernel(fastmath=_REORDER)
def advance_springs_along(s, slip, indentation_0, indentation_1, heights, weights):
    """`advance_springs` where neither the springs nor the slip leave a line, four times as fast.

    Parameters
    ----------
    s : ndarray, shape (n,)
        Deflections along the line, over s_max; written.
    slip : float
        Along the line, over s_max.
    indentation_0, indentation_1 : float
        Before and after, over N_ref/k; finite.
    heights, weights : ndarray, shape (n,)
        As of `advance_springs`.

    Returns
    -------
    share, stored : float
        Friction force over mu N_ref, and elastic energy over mu N_ref s_max.
    """
    rise = 1.0 / max(indentation_1 - indentation_0, 1e-200)
    share = 0.0
    stored = 0.0
    for j in range(heights.size):
        limit = max(indentation_1 - heights[j], 0.0)
        part = 1.0 if indentation_0 > heights[j] else min(limit * rise, 1.0)
        w = min(max(s[j] + part * slip, -limit), limit)
        s[j] = w
        share += weights[j] * w
        stored += weights[j] * w * w
    return share, 0.5 * stored


@kernel(fastmath=_REORDER)
def stored_in_springs(sx, sy, weights):
    """Elastic energy of the springs, over mu N_ref s_max.

    Parameters
    ----------
    sx, sy : ndarray, shape (n,)
        Deflections, over s_max.
    weights : ndarray, shape (n,)
        As from `spring_profile`.

    Returns
    -------
    float
        Half the sum of weight times deflection squared.
    """
    stored = 0.0
    for j in range(weights.size):
        stored += weights[j] * (sx[j] * sx[j] + sy[j] * sy[j])
    return 0.5 * stored

"""Asperities next to their limit, of which the law tells what no multiplier does.

Where the slip keeps its direction two deflections only come nearer, of any exponent: the one that
is behind bends faster. With an exponent above 1 they do so by a power of the time, the more slowly
the nearer they are to their limit, too slowly to be followed where it is large; but where they come
to is told by the limit itself, which is that of the least to the greatest load in a cycle.
"""

import math
from typing import Any

import numpy as np
import numpy.typing as npt

from asperity.arrays import FloatArray
from asperity.slider.model import Model
from asperity.slider.timetable import FAR, bends_ever_more
from asperity.slider.unknowns import most_unknowns, read_unknowns

_NEAR = 1e-3  # of the limit
# Of the most in a mode: differences leave 3e-5 where nothing rings, and where something does it has
# all.
_HAS_NONE = 1e-2


def comes_to_its_limit(model: Model, sums: np.void) -> bool:
    """Whether friction in a cycle is where asperities come to by a power of the time.

    Parameters
    ----------
    model : Model
        The body.
    sums : np.void
        Over a cycle of its state.
    """
    if not bends_ever_more(model):
        return False
    names = sums.dtype.names or ()
    least = most = 1.0
    if "load_min" in names:
        least, most = float(sums["load_min"]), float(sums["load_max"])
    lowest, highest = float(sums["friction_x_min"]), float(sums["friction_x_max"])
    return max(most, highest) - min(least, lowest) <= FAR


def slowly_at_limit(model: Model, sums: np.void) -> float | None:
    r"""Return the time in s in which asperities come to 1e-3 of a limit that friction is at.

    None where it is not, or that is less than a march usually lasts. By Dahl's law what is left of
    the limit is :math:`[1 + (i - 1)\, v t/s_{max}]^{-1/(i - 1)}` at a slip velocity :math:`v`.

    Parameters
    ----------
    model, sums
        As `comes_to_its_limit` takes them.
    """
    if not comes_to_its_limit(model, sums):
        return None
    slider, slower = model.slider, model.friction.exponent - 1.0
    bent = model.friction.deflection_limit(slider.normal_force)
    slid = bent * math.expm1(slower * math.log(1.0 / _NEAR)) / slower
    after = slid / slider.drive_velocity
    return after if after > model.usual_duration else None


def bends_only(
    mode: npt.NDArray[np.complex128],
    state: np.void,
    springs: FloatArray,
    p: Any,
    q: Any,
) -> bool:
    """Whether of a disturbance, its most being 1, nothing rings: neither drive nor contact.

    Parameters
    ----------
    mode : (n,) complex array
        By the scaled unknowns of `read_unknowns`.
    state, springs, p, q
        As that takes them.
    """
    marks = np.zeros(1, state.dtype)
    marks["velocity_x"] = 1.0
    if q is not None:
        marks["penetration"], marks["rise"] = 1.0, 1.0
    rings = np.zeros(most_unknowns(springs))
    count = read_unknowns(marks[0], np.ones_like(springs), p, q, rings)
    return bool(np.abs(mode[rings[:count] != 0.0]).max(initial=0.0) <= _HAS_NONE)

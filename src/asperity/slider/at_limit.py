"""Asperities next to their limit, of which the law tells what no multiplier does.

Where the slip keeps its direction two deflections only come nearer, of any exponent: the one that
is behind bends faster. With an exponent above 1 they do so by a power of the time, the more slowly
the nearer they are to their limit, too slowly to be followed where it is large; but where they come
to is told by the limit itself, which is that of the least to the greatest load in a cycle. Under
law ``unsplit`` it is that of the size of a deflection, of whatever direction.
"""

import math
from typing import Any

import numpy as np
import numpy.typing as npt

from asperity.arrays import FloatArray
from asperity.friction.dahl import UNSPLIT
from asperity.slider.integrators import Integrator
from asperity.slider.model import Model
from asperity.slider.timetable import FAR, bends_ever_more
from asperity.slider.unknowns import most_unknowns, read_unknowns

_NEAR = 1e-3  # of the limit
_THERE = 1e-9  # of the limit, that asperities are not next to which bend back in every cycle
# Of the most in a mode: differences leave 3e-5 where nothing rings, and where something does it has
# all.
_HAS_NONE = 1e-2


def bends_aside(model: Model) -> bool:
    """Whether asperities come to their limit by a power of time wherever the slip goes.

    Of law ``unsplit``, whose size grows with the slip along them whatever their direction does: a
    vibration across turns friction aside, and its mean along the drive is below the limit. Under a
    load that swings the limit does too.
    """
    loads_alike = model.normal is None or model.elevation == 0.0
    return bends_ever_more(model) and model.friction.law == "unsplit" and loads_alike


def comes_to_its_limit(model: Model, sums: np.void, state: np.void) -> bool:
    """Whether friction in a cycle is where asperities come to by a power of the time.

    Parameters
    ----------
    model : Model
        The body.
    sums : np.void
        Over a cycle of its state.
    state : np.void
        At the end of it.
    """
    if not bends_ever_more(model):
        return False
    if bends_aside(model) and abs(size_of(state) - 1.0) <= _THERE:
        return True
    names = sums.dtype.names or ()
    least = most = 1.0
    if "load_min" in names:
        least, most = float(sums["load_min"]), float(sums["load_max"])
    lowest, highest = float(sums["friction_x_min"]), float(sums["friction_x_max"])
    return max(most, highest) - min(least, lowest) <= FAR


def size_of(state: np.void) -> float:
    """Return the size of a deflection, over its limit."""
    return math.hypot(float(state["deflection_x"]), float(state["deflection_y"]))


def slowly_at_limit(body: Integrator) -> float | None:
    r"""Return the time in s in which asperities come to 1e-3 of a limit that friction is at.

    None where it is not, or that is less than a march usually lasts. By Dahl's law what is left of
    the limit is :math:`[1 + (i - 1)\, v t/s_{max}]^{-1/(i - 1)}` at a slip velocity :math:`v`.

    Where a vibration turns friction aside it is the slip along the asperities, of which friction
    tells as what is lost by it.

    Parameters
    ----------
    body : Integrator
        In the state.
    """
    model, sums = body.model, body.sums
    if not comes_to_its_limit(model, sums, body.state):
        return None
    slider, slower = model.slider, model.friction.exponent - 1.0
    speed = slider.drive_velocity
    if bends_aside(model):
        speed *= float(sums["slip_work"] / sums["steps"]) / body.p.drive
    bent = model.friction.deflection_limit(slider.normal_force)
    slid = bent * math.expm1(slower * math.log(1.0 / _NEAR)) / slower
    after = slid / speed
    return after if after > model.usual_duration else None


def bends_only(
    mode: npt.NDArray[np.complex128],
    state: np.void,
    springs: FloatArray,
    p: Any,
    q: Any,
) -> bool:
    """Whether of a disturbance, its most being 1, nothing rings: neither drive nor contact.

    What law ``unsplit`` has of the body's to and fro, in a real mode, is no ring.

    Parameters
    ----------
    mode : (n,) complex array
        By the scaled unknowns of `read_unknowns`.
    state, springs, p, q
        As that takes them.
    """
    if q is None and p.law == UNSPLIT and not mode.imag.any():
        # The body goes to and fro with friction that a vibration turns aside; a ring turns round.
        return True
    marks = np.zeros(1, state.dtype)
    marks["velocity_x"] = 1.0
    if q is not None:
        marks["penetration"], marks["rise"] = 1.0, 1.0
    rings = np.zeros(most_unknowns(springs))
    count = read_unknowns(marks[0], np.ones_like(springs), p, q, rings)
    return bool(np.abs(mode[rings[:count] != 0.0]).max(initial=0.0) <= _HAS_NONE)

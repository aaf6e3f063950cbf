r"""When asperities are taken up, whose slip keeps its direction: how near friction is to its limit.

With :math:`w` what friction lacks of :math:`\mu F_N`, a drive that is stretched by :math:`L` under
all of that, and Dahl's exponent :math:`i`,

.. math::
    \dot w = -\frac{v_d w^i}{s_{max} + L w^i},\quad
    v_d t = s_{max}\frac{w^{1 - i} - 1}{i - 1} + L(1 - w)

from rest: a vibration that is slower than the drive adds nothing in the mean. LuGre's, with
:math:`i = 1`, come to no more than static friction. Springs under heights that fall off
exponentially have :math:`i = 1` too, and are at their limit sooner under others.
"""

import functools

import numpy as np
import numpy.typing as npt

from asperity.arrays import FloatArray
from asperity.slider.ladder import first_that_does
from asperity.slider.model import WINDOW_SHARE, Model
from asperity.slider.timetable import FAR, UNSTEADY, turns_back

_LEFT, _LEFT_ABOUT = 0.8, 0.5  # of what is steady enough, that is let be
_LACKS = np.geomspace(1.0, 1e-7, 4001)  # of the limit
_LOGARITHMS = np.log(_LACKS)
_SPARE = 1.02
_NEXT, _MOST_TIMES = 1.001, 1e3  # times a duration: the next that is tried; the usual one
_COARSE = 64  # in which one is tried at first: friction only comes nearer to its limit


def taken_up_after(model: Model) -> float | None:
    """Return the duration in s in whose window friction is at its limit.

    None beyond 1000 usual durations; no time where nothing bends, or is bent back by a vibration.
    """
    friction = model.friction
    if friction.model == "coulomb" or turns_back(model):
        return 0.0
    longest = _MOST_TIMES * max(model.usual_duration, model.duration)
    is_near = functools.partial(_is_near, model)
    first = first_that_does(is_near, model.duration, longest, _NEXT, _COARSE)
    return first if first is None or first == model.duration else first * _SPARE


def bent_after(model: Model, lacks: float) -> float:
    """Return the time from rest in s, after which friction lacks so much of its limit, over it."""
    way, _ = _ways(model)
    return float(np.interp(-lacks, -_LACKS, way)) / model.slider.drive_velocity


def _is_near(model: Model, durations: FloatArray) -> npt.NDArray[np.bool_]:
    """Whether friction is at its limit in the window of durations in s."""
    windows = np.minimum(model.window, WINDOW_SHARE * (durations - model.start))
    begin = durations - windows
    early, late = _means(model, np.array([begin, durations - 0.5 * windows, durations]))
    # Of springs, and under a load that changes, the equation is not the law.
    exact = model.friction.model != "springs" and model.normal is None
    left = _LEFT if exact else _LEFT_ABOUT
    near: npt.NDArray[np.bool_] = (0.5 * (early + late) <= left * FAR) & (
        early - late <= left * UNSTEADY
    )
    return near


def _means(model: Model, ends: FloatArray) -> FloatArray:
    """Return what friction lacks of its limit, in the mean between rows of times in s.

    Over mu F_N.
    """
    slider, most = model.slider, _most(model)
    way, summed = _ways(model)
    at = np.interp(ends * slider.drive_velocity, way, summed)
    means: FloatArray = most * np.diff(at, axis=0) / np.diff(ends * slider.drive_velocity, axis=0)
    return means


def _most(model: Model) -> float:
    return (model.friction.static_mu or model.friction.mu) / model.friction.mu


def _ways(model: Model) -> tuple[FloatArray, FloatArray]:
    """Return the way of the drive in m until friction lacks `_LACKS`, and what it lacks, summed."""
    slider, friction, w = model.slider, model.friction, _LACKS
    most = _most(model)
    power = friction.exponent if friction.model == "dahl" else 1.0
    bends = most * friction.deflection_limit(slider.normal_force)
    stiffness = slider.drive_stiffness
    stretch = 0.0 if stiffness is None else most * model.full_friction / stiffness
    way = bends * _powers(1.0 - power) + stretch * (1.0 - w)
    summed = bends * _powers(2.0 - power) + 0.5 * stretch * (1.0 - w * w)
    return way, summed


def _powers(power: float) -> FloatArray:
    r"""Return :math:`\int_w^1 u^{p - 1}\,du` of what friction lacks."""
    found: FloatArray = -np.expm1(power * _LOGARITHMS) / power if power else -_LOGARITHMS
    return found

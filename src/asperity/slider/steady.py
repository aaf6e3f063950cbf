r"""Steady sliding without vibration: whether a body stays in it, or sticks and slips.

Friction is constant there but for LuGre's, whose limit :math:`g` falls with the speed. With the
drive's stretch :math:`e`, the body's velocity :math:`v` and the deflection :math:`z`,

.. math::
    \dot e = v_d - v,\quad
    m\dot v = k_d e + h_d(v_d - v) - k_t z - h_t\dot z - h_v v,\quad
    \dot z = v - \frac{k_t v}{g(v)}z

is linear about :math:`v = v_d`, :math:`z = g(v_d)/k_t`.
"""

import dataclasses
import math

import numpy as np
import numpy.typing as npt

from asperity.slider.model import Model
from asperity.slider.timetable import FAR

_NONE = 1e-9  # of the drive's own angular frequency: rounding
_STICKS = 0.5  # of what static friction is above the other, that friction swings by who sticks
_SEEN, _STILL = 0.1, 0.5  # growth in half a window that is seen, and of it that counts as such
_MOST = 30.0  # times that what grows does so e-fold
_MOST_DAMPED, _CLOSE = 100.0, 1e-2
_LEAST = 1e-12  # swing, of which the rest is rounding


def growth_rate(model: Model) -> float:
    """Return the rate at which a disturbance of steady sliding grows, 1/s; 0 where none does."""
    slider, rate = model.slider, _slowest(model)
    if rate is None or slider.mass is None or slider.drive_stiffness is None:
        return 0.0
    return rate if rate > _NONE * math.sqrt(slider.drive_stiffness / slider.mass) else 0.0


def fading_rate(model: Model) -> float | None:
    """Return the least rate at which disturbances of steady sliding fade, 1/s.

    None where some grow, and where a body from rest can do nothing but come to steady sliding:
    friction does not fall with the speed, or the drive is rigid.
    """
    rate = _slowest(model)
    falls = (model.friction.static_mu or 0.0) > model.friction.mu
    return -rate if falls and rate is not None and rate < 0.0 else None


def steadying(model: Model) -> float | None:
    """Return the drive's damping in N s/m with which steady sliding is stable; None where none is.

    A hundredth more than the least, up to 100 times what is critical.
    """
    slider = model.slider
    if slider.mass is None or slider.drive_stiffness is None:
        return None
    critical = 2.0 * math.sqrt(slider.drive_stiffness * slider.mass)

    def grows(damping: float) -> bool:
        damped = slider.model_copy(update={"drive_damping": damping}, units="SI")
        return growth_rate(dataclasses.replace(model, slider=damped)) > 0.0

    least, most = slider.drive_damping, _MOST_DAMPED * critical
    if grows(most):
        return None
    while most - least > _CLOSE * most:
        middle = 0.5 * (least + most)
        least, most = (middle, most) if grows(middle) else (least, middle)
    return (1.0 + _CLOSE) * most


def ring_rate(model: Model) -> float:
    """Return the rate at which the ring of a steadily sliding body on its drive fades, 1/s."""
    slider, rates = model.slider, _rates(model)
    if slider.mass is None:
        return math.inf
    if rates is None:
        return 0.5 * (slider.drive_damping + (model.friction.viscous_damping or 0.0)) / slider.mass
    rings = rates[rates.imag != 0.0]
    return float(-(rings if rings.size else rates).real.max())


def _slowest(model: Model) -> float | None:
    """Largest real part of the rates of steady sliding, 1/s; None where friction is constant."""
    rates = _rates(model)
    return None if rates is None else float(rates.real.max())


def _rates(model: Model) -> npt.NDArray[np.complex128] | None:
    """Rates of steady sliding, 1/s; None where friction is constant."""
    slider, friction = model.slider, model.friction
    if slider.mass is None or slider.drive_stiffness is None or friction.model != "lugre":
        return None
    if not friction.stribeck_velocity > 0.0:
        return None
    v, mass, stiffness = slider.drive_velocity, slider.mass, slider.drive_stiffness
    falling, slope = _falling(model)
    asperities = friction.stiffness(slider.normal_force)
    held = model.full_friction + falling
    follows = slope / held  # v g'/g
    relaxes = asperities * v / held
    contact = friction.contact_damping
    damping = slider.drive_damping + friction.viscous_damping + contact * follows
    matrix = [
        [0.0, -1.0, 0.0],
        [stiffness / mass, -damping / mass, -(asperities - contact * relaxes) / mass],
        [0.0, follows, -relaxes],
    ]
    with np.errstate(all="ignore"):
        if not np.all(np.isfinite(matrix)):
            return None
        found: npt.NDArray[np.complex128] = np.linalg.eigvals(np.array(matrix)).astype(complex)
        return found


def _falling(model: Model) -> tuple[float, float]:
    """What LuGre's limit is above that of fast sliding, N, and its slope times the velocity."""
    friction = model.friction
    x = model.slider.drive_velocity / friction.stribeck_velocity
    above = model.full_friction * ((friction.static_mu or friction.mu) / friction.mu - 1.0)
    falling = above * math.exp(-x * x)
    return falling, -2.0 * x * x * falling


def still_leaves(model: Model, half: float, swings: tuple[float, float], time: float = 0.0) -> str:
    r"""Return what a march from unstable steady sliding lacks; empty where it lacks nothing.

    Nothing lacks where friction swings as a body that sticks and slips has it swing, where the
    swing grows no more, or where rounding itself has had time to grow to it.

    Parameters
    ----------
    model : Model
        A body that nothing shakes.
    half : float
        Half the window of the march, s.
    swings : tuple of 2 floats
        Of friction over :math:`\mu F_N` in either half.
    time : float
        That it has been marched for, s.
    """
    rate = growth_rate(model)
    first, second = swings
    above = (model.friction.static_mu or model.friction.mu) / model.friction.mu - 1.0
    if rate == 0.0 or second >= _STICKS * above or rate * time >= math.log(above / _LEAST):
        return ""
    grown = math.expm1(min(rate * half, _MOST))
    if grown > _SEEN and second <= (1.0 + _STILL * grown) * first:
        return ""
    return (
        f"steady sliding is unstable, a disturbance grows by {rate:.3g}/s, and the body has not "
        "come to stick and slip"
    )


def until_it_sticks(model: Model, swing: float) -> float:
    """Return the time in which a swing of friction grows to that of a body that sticks, s."""
    above = (model.friction.static_mu or model.friction.mu) / model.friction.mu - 1.0
    return math.log(max(above / max(swing, _LEAST), 1.0)) / growth_rate(model)


def steady_ratio(model: Model) -> float:
    """Return the drive force of steady sliding, over mu F_N."""
    friction = model.friction
    steady = model.full_friction
    if (friction.static_mu or friction.mu) > friction.mu:
        steady += _falling(model)[0]
    steady += (friction.viscous_damping or 0.0) * model.slider.drive_velocity
    return steady / model.full_friction


def off_steady(model: Model, ratio: float) -> str:
    """Return what a body lacks that nothing shakes, whose mean is not that of steady sliding.

    Empty where it is, and of friction that falls with the speed: it may stick and slip.
    """
    friction = model.friction
    if model.vibrates or (friction.static_mu or friction.mu) > friction.mu:
        return ""
    off = ratio - steady_ratio(model)
    if not abs(off) > FAR:
        return ""
    return f"the mean is {off:.2g} of mu F_N from that of steady sliding: parts of a ring are in it"


def parts_of_slips(model: Model, sums: np.void) -> str:
    r"""Return what a body lacks that sticks and slips, in whose window parts of slips may be seen.

    Empty where they put the mean off by no more than it may be. From one slip to the next friction
    swings by :math:`S`, in the time :math:`T` in which the drive is stretched as far and half a
    ring goes by: parts of it in a window :math:`W` put the mean off by up to :math:`ST/(8W)`.
    """
    slider = model.slider
    if model.vibrates or slider.drive_stiffness is None or growth_rate(model) <= 0.0:
        return ""
    swing = float(sums["friction_x_max"] - sums["friction_x_min"])
    rate = slider.drive_stiffness * slider.drive_velocity / model.full_friction
    slips = model.window / (swing / rate + 0.5 * model.ring_period)
    off = swing / (8.0 * slips)
    if not off > FAR:
        return ""
    return f"of {slips:.3g} slips in the window parts may put the mean {off:.2g} of mu F_N off"


def two_states(model: Model) -> str:
    """Say that a body sticks and slips, and that steady sliding would last as well."""
    return (
        "from rest the body sticks and slips, which is shown; steady sliding, with the ratio "
        f"{steady_ratio(model):.5g}, would last as well: which state a body is in follows "
        "from where it comes from"
    )


def sticks_and_slips(growth: float) -> str:
    """Say that steady sliding is unstable."""
    return (
        f"steady sliding is unstable, a disturbance grows by {growth:.3g}/s: the body sticks and "
        "slips, or rings"
    )

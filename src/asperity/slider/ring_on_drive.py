"""The ring of a body on its drive: how far it swings, how it fades, and when it is heard no more.

A body that breaks away, or that its vibration begins to move, rings on the drive by up to its
velocity. Halves of a window have parts of rings in them; where a window has how many is known, they
make next to nothing of whole ones.
"""

import cmath
import math
from typing import NamedTuple

import numpy as np

from asperity.arrays import FloatArray
from asperity.slider.integrators import Integrator
from asperity.slider.model import WINDOW_SHARE, Model
from asperity.slider.steady import growth_rate, ring_rate
from asperity.slider.timetable import FAR, UNSTEADY, WindowMeans, bending, turns_back

_LEVEL = 1e-9  # part of the vibration across, below which friction sees none
SURELY = 0.8  # of what is steady enough, that a change shall have come down to
_NEAR = 1.01  # times the least duration that does, that may be told in its place
_SPARE = 1.25  # times, that friction may damp a ring less than Coulomb's
_TURNS, _BESIDE = 16384, 0.05  # points of a cycle; of the drive velocity, between which is a slope


class Ring(NamedTuple):
    """A ring of a body on its drive.

    Attributes
    ----------
    swing : float
        Of the drive force, over mu F_N.
    rate : float
        At which it fades, 1/s.
    since : float
        Time at which it swings so far, s.
    """

    swing: float
    rate: float
    since: float


def ring_of(model: Model, *, with_friction: bool = False) -> Ring | None:
    r"""Return the ring that a body may have on its drive; None where there is none.

    Friction damps none where the slip keeps its direction, as it does up to a ring's velocity of
    :math:`v_d - v_a`: the drive's damper does, and what is viscous.

    Parameters
    ----------
    model : Model
        The body.
    with_friction : bool
        Whether a ring is asked for that shaken friction damps as well.
    """
    slider, friction = model.slider, model.friction
    if slider.drive_stiffness is None or slider.mass is None:
        return None
    speed, drop, held = slider.drive_velocity, 0.0, 1.0
    if not model.vibrates:
        if growth_rate(model) > 0.0:
            return None
        rate, held = ring_rate(model), (friction.static_mu or friction.mu) / friction.mu
        drop = held - 1.0
    elif model.normal is not None:
        return None
    elif with_friction:
        rate = 0.5 * (slider.drive_damping + friction_on_ring(model) / _SPARE) / slider.mass
    elif turns_back(model) or abs(model.unit_direction[1]) > _LEVEL:
        return None
    else:
        speed -= abs(model.unit_direction[0]) * model.peak_velocity
        rate = 0.5 * (slider.drive_damping + (friction.viscous_damping or 0.0)) / slider.mass
    if speed <= 0.0 or rate * model.ring_period >= 2.0 * math.pi:
        return None
    stretched = held * model.full_friction / (slider.drive_stiffness * slider.drive_velocity)
    swing = force_of(model, speed) + drop
    return Ring(swing, rate, max(model.start if model.vibrates else 0.0, stretched))


def ring_at_end(window: WindowMeans, body: Integrator) -> Ring | None:
    """Return the ring at the end of a march of a body that nothing shakes; None where none is seen.

    Before it has broken away there is another to come.
    """
    model = window.model
    if model.vibrates or window.holds or bending(model) > 0.0:
        return None
    ring, p, state = ring_of(model), body.p, body.state
    if ring is None:
        return None
    aside = float(p.stiffness * state["stretch"] - state["friction_x"])
    slower = force_of(model, model.slider.drive_velocity) * (1.0 - state["velocity_x"] / p.drive)
    return Ring(math.hypot(aside, float(slower)), ring.rate, model.duration)


def force_of(model: Model, speed: float) -> float:
    """Return the swing of the drive force of a ring of a velocity in m/s, over mu F_N."""
    slider = model.slider
    if slider.drive_stiffness is None or slider.mass is None:
        return 0.0
    return math.sqrt(slider.drive_stiffness * slider.mass) * speed / model.full_friction


def rings_on_drive(model: Model) -> bool:
    """Whether a ring on the drive that nothing damps may keep the halves of a window apart."""
    ring = ring_of(model)
    return ring is not None and ring.rate == 0.0 and math.isinf(rung_out(model, ring))


def friction_on_ring(model: Model) -> float:
    r"""Return what friction that is shaken damps a slow motion along the drive by, N s/m.

    The slope of its mean at the drive velocity, of Coulomb's law along the slip: nothing where a
    vibration along the drive is slower than this, :math:`2\mu F_N/(\pi\sqrt{v_a^2 - v_d^2})` where
    it is faster. Asperities that bend by much of the vibration's amplitude damp less.
    """
    velocity, turn = model.slider.drive_velocity, np.linspace(0.0, 2.0 * np.pi, _TURNS + 1)[1:]
    along, across, _ = model.unit_direction
    shaken = model.peak_velocity * np.cos(turn)
    sideways = model.friction.transfer * across * shaken
    early, late = (
        float(np.mean(_along(share * velocity + along * shaken, sideways)))
        for share in (1.0 - _BESIDE, 1.0 + _BESIDE)
    )
    slope = (late - early) / (2.0 * _BESIDE * velocity)
    return model.full_friction * slope + (model.friction.viscous_damping or 0.0)


def _along(flat: FloatArray, sideways: FloatArray) -> FloatArray:
    """Part of Coulomb's friction along the drive, at slips; none where a body rests."""
    slip = np.hypot(flat, sideways)
    return np.divide(flat, slip, out=np.zeros_like(slip), where=slip > 0.0)


def rung_out(model: Model, ring: Ring) -> float:
    """Return the duration in which a ring on the drive has faded to what a window does not show, s.

    Infinite where it never does. What phase it has in the window is not known.
    """
    whole, start, turn = model.window, model.start, 2.0 * math.pi / model.ring_period

    def wait(window: float, seen: tuple[float, float] = (math.inf, math.inf)) -> float:
        most = 8.0 / (turn * window), 2.0 / (turn * window)
        differ, off = (ring.swing * min(each) for each in zip(most, seen, strict=True))
        fades = max(differ / (SURELY * UNSTEADY), off / (SURELY * FAR), 1.0)
        if fades == 1.0:
            return 0.0
        return ring.since + (math.log(fades) / ring.rate if ring.rate > 0.0 else math.inf)

    def in_part(duration: float) -> bool:
        window = min(whole, WINDOW_SHARE * (duration - start))
        return window > 0.0 and duration - window >= wait(window)

    roomy = max(start + whole / WINDOW_SHARE, model.duration)
    waits = wait(whole, _seen_of_ring(model, ring.rate))
    if roomy - whole < waits:
        return whole + waits
    if in_part(model.duration):
        return model.duration
    # Less may do, in a shorter window; the longer it is, the less it shows of a ring.
    early, late = model.duration, roomy
    while late > _NEAR * early:
        middle = math.sqrt(early * late)
        early, late = (early, middle) if in_part(middle) else (middle, late)
    return late


def _seen_of_ring(model: Model, rate: float) -> tuple[float, float]:
    r"""Return what a ring makes of a whole window at the worst phase: halves apart, its mean.

    Of a ring that swings by one. Means of :math:`e^{st}` with :math:`s = -r + i\omega_d`: whole
    rings make next to nothing.
    """
    turn = 2.0 * math.pi / model.ring_period
    s = complex(-rate, 0.0) + cmath.sqrt(rate**2 - turn**2)
    half, window = 0.5 * model.window, model.window
    if model.vibrates:
        cycles = max(math.floor(model.window * model.frequency + 1e-9), 2)
        half, window = cycles // 2 / model.frequency, cycles / model.frequency
    before = (cmath.exp(s * half) - 1.0) / (s * half)
    after = (cmath.exp(s * window) - cmath.exp(s * half)) / (s * (window - half))
    return abs(after - before), abs((cmath.exp(s * window) - 1.0) / (s * window))

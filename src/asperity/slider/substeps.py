"""Into how many parts a sliding body's time step is divided, for what happens in it to be small."""

import math
from typing import Protocol

from asperity.errors import InputError
from asperity.friction import Friction
from asperity.friction.dahl import VECTOR
from asperity.normal import Normal, elastic_slope
from asperity.slider.parameters import FAR_APART, Slider, Solve
from asperity.slider.scaled import NormalLoading
from asperity.vibration.waveform import SAMPLED, SINE, STEPS_A_TURN, Shape

SLIP_BOUND = 0.5
CHANGE_BOUND = 1.2e-3
RING_BOUND = 0.25
# Part of the penetration's length a body may come nearer in a step.
LANDING_BOUND = 0.05
COULOMB_BOUND = 0.1
_MOST_SWING = 1000.0
_TWO_PHASE_BOUND = 2.0
_DRAG_BOUND = 1e7
_MOST_SUBSTEPS = 1000
# Slip counts for so much more at most, where it turns back at the limit and the exponent is high.
_MOST_RELAXED = 16.0
_FAR_MORE = 1e12


class _Body(Protocol):
    """What of a `Model` its steps follow from."""

    @property
    def slider(self) -> Slider: ...
    @property
    def friction(self) -> Friction: ...
    @property
    def solve(self) -> Solve: ...
    @property
    def shape(self) -> Shape | None: ...
    @property
    def normal(self) -> Normal | None: ...
    @property
    def step(self) -> float: ...
    @property
    def frequency(self) -> float: ...
    @property
    def peak_velocity(self) -> float: ...
    @property
    def amplitude(self) -> float: ...
    @property
    def full_friction(self) -> float: ...
    @property
    def ring_period(self) -> float: ...
    @property
    def normal_length(self) -> float: ...
    @property
    def unit_direction(self) -> tuple[float, float, float]: ...
    def rigid_pressing(self, step: float) -> NormalLoading:
        """Return the numbers of the normal direction without springs."""


def parts_of(model: _Body) -> int:
    """Parts each step is divided into so that `march` stays below its own bounds.

    The bounds: the slip in a part at most half the deflection limit; its change from part to part
    at most 0.12 % of it, for the friction where the slip reverses (coarser, the ratio is wrong by
    up to 0.15 % at high speed ratios); a part at most a quarter of the reciprocal of the body's
    angular frequency on asperities and drive. With an exponent above 1 the slip counts for more
    under ``split`` and ``unsplit``. The two-phase scheme is not divided, but refused where it is
    unstable. Coulomb friction has no deflection: there the vibration's velocity changes by at most
    a tenth of the drive velocity from part to part, unless the slip is prescribed (rigid drive,
    guided body) and keeps to a line.
    """
    slider, friction, step = model.slider, model.friction, model.step
    drag = slider.drive_damping * slider.drive_velocity / model.full_friction
    if drag > _DRAG_BOUND:
        most = slider.drive_damping * _DRAG_BOUND / drag
        raise InputError(
            f"slider.drive_damping is {slider.drive_damping:g} N s/m, which resists the "
            f"drive velocity with {drag:.3g} times the friction force, too much to tell the "
            f"two apart; it must be at most {most:.3g} N s/m (for a rigid drive leave "
            "slider.drive_stiffness out)"
        )
    if friction.model == "coulomb":
        # Nothing elastic in the contact: the drive's own ring bounds the step, and the turn
        # of the slip where the vibration passes the drive velocity.
        ring = 2.0 * math.pi / model.ring_period if model.ring_period > 0.0 else 0.0
        turn = _sharpness(model) * model.peak_velocity / slider.drive_velocity
        if slider.rigid and not slider.free and not _turns(model):
            turn = 0.0
        needed = step * max(ring / RING_BOUND, turn / COULOMB_BOUND)
        return _whole(model, max(needed, _pressed(model)))
    limit = friction.deflection_limit(slider.normal_force)
    slip = (slider.drive_velocity + model.peak_velocity) * step / limit
    if model.solve.scheme == "two-phase":
        if slip > _TWO_PHASE_BOUND:
            raise InputError(
                f"solve.step is {step:g} s; the two-phase scheme is unstable where the "
                f"slip in a step exceeds {_TWO_PHASE_BOUND:g} max_deflection, so it must be at "
                f"most {step * _TWO_PHASE_BOUND / slip:.3g} s here"
            )
        return 1
    if friction.law_code != VECTOR:
        # An asperity at its limit relaxes so much faster when the slip turns back; `vector` goes
        # along a steady slip by its closed form.
        slip *= min(max(1.0, 2.0**friction.exponent - 1.0), _MOST_RELAXED)
    turn = _sharpness(model) * step
    change = model.peak_velocity * step / limit * turn
    needed = max(slip / SLIP_BOUND, math.sqrt(change / CHANGE_BOUND))
    if slider.mass is not None and (not slider.rigid or slider.free):
        stiffness = friction.stiffness(slider.normal_force)
        stiffness *= max(1.0, friction.exponent * 2.0 ** (friction.exponent - 1.0))
        stiffness += slider.drive_stiffness or 0.0
        needed = max(needed, step * math.sqrt(stiffness / slider.mass) / RING_BOUND)
    return _whole(model, max(needed, _pressed(model)))


def _pressed(model: _Body) -> float:
    """Parts of a step that the contact needs: its ring at its stiffest, and a landing."""
    if model.normal is None:
        return 1.0
    up = abs(model.unit_direction[2])
    swing = up * model.amplitude / model.normal_length
    if model.normal.control == "displacement" and swing > _MOST_SWING:
        raise InputError(
            f"the vibration's normal amplitude of {up * model.amplitude:.3g} m is {swing:.3g} "
            f"times the penetration of {model.normal_length:.3g} m: no rigid machine holds that;"
            " reduce the amplitude, or let the body rise with normal.control 'force'"
        )
    q = model.rigid_pressing(model.step)
    ring = math.sqrt(q.mobility * elastic_slope(q.law, q.reference + 2.0 * swing))
    landing = 2.0 * up * model.peak_velocity * model.step / model.normal_length
    return max(ring / RING_BOUND, landing / LANDING_BOUND)


def _turns(model: _Body) -> bool:
    """Whether a prescribed slip changes its direction steadily, and not only its sign."""
    smooth = model.shape is not None and model.shape.code in (SINE, SAMPLED)
    return smooth and model.unit_direction[1] * model.friction.transfer != 0.0


def _sharpness(model: _Body) -> float:
    """Rate at which the vibration's velocity changes, 1/s: 2 pi f for a sine, or more."""
    least = model.shape.least_steps if model.shape is not None else STEPS_A_TURN
    return 2.0 * math.pi * model.frequency * least / STEPS_A_TURN


def _whole(model: _Body, needed: float) -> int:
    if not needed <= _FAR_MORE:
        raise InputError(FAR_APART)
    if not needed <= _MOST_SUBSTEPS:
        raise InputError(
            f"solve.step is {model.step:g} s; the march would have to divide it by "
            f"{needed:.3g}, more than {_MOST_SUBSTEPS}: give a step of at most "
            f"{model.step * _MOST_SUBSTEPS / needed:.3g} s"
        )
    return max(1, math.ceil(needed * (1.0 - 1e-9)))

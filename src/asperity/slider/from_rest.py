"""Where a body from rest comes to, beside a state that was not sought from there.

Friction at its limit repeats itself wherever the slip does not reverse, and is tried first; and a
search ends in whatever state is next to its first guess. A body that is taken up from rest may come
to another: shaken near a resonance on its asperities, which bend the softer the further they bend,
it slides back and forth there or it does not, by where it comes from.
"""

import dataclasses
import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from asperity.arrays import FloatArray
from asperity.slider.at_full_bend import only_bends_further
from asperity.slider.at_limit import bends_aside, comes_to_its_limit, size_of
from asperity.slider.cycle_map import UNSTABLE, Cycle, lasts
from asperity.slider.integrators import LoadedIntegrator
from asperity.slider.model import Model
from asperity.slider.ringing import ringing_time
from asperity.slider.shooting import run
from asperity.slider.steady import fading_rate
from asperity.slider.straight import goes_straight
from asperity.vibration.waveform import fill_increments

SAME = 1e-4
"""Of mu F_N, that the ratios of two states may be apart."""
_COME = 1e-3  # of mu F_N, that the means of a march may be from a state that it has come to
_NEAR = 0.02  # of mu F_N, that a march may be from the state that it comes to
_OFF = 5e-3  # of mu F_N, from which on a march that is next to a state goes on
_THERE = 1e-4  # of mu F_N, that it is from a state whose cycles it repeats already
_NEARER = 0.9  # of how far it was, where a march is on its way
_GONE = 1.0  # time constants of a contact's ringing, from which on a march comes nearer
_TAKEN_UP = 1.2
_LEANS = 1.5  # times a resonance, up to which there may be two states that go back or lift alike
_SLOWLY = 0.5  # of the drive velocity, for what is up to twice as fast on its asperities
_GOES_BACK = -0.9  # of the limit, of friction that has turned round
_LIGHT = 0.5  # of the load, below which a contact is soft enough to bounce in every second cycle
_HALVES = 2.0  # times a resonance, up to which a body may swing there in every second cycle
_PUMPED = 4.0  # times it, up to which it may swing sideways, where friction turns with the slip
_CYCLES = (40, 80, 160, 320, 960)  # after the body is taken up
_MOST_TAKEN_UP = 4000.0
_MOST_GROWN = 20_000  # cycles in which a vibration grows: in 0.5 to 0.8 s, of 250 steps each
_TOLD = 36  # last cycles that are looked at
_PERIODS = (1, 2, 3, 4, 6)  # cycles, after which a state may repeat itself
_ALIKE = 1e-5  # of mu F_N, that cycles of a march are apart which comes to such a state
_REVERSES_NO_MORE = 1e-3  # of mu F_N, that friction may be below its limit
# Of a body that nothing shakes: how often disturbances of steady sliding fade to a third, from one
# slip to the next, and in steps at most; of mu F_N, below which friction is steady; and of how far
# it swings at most, what lasts.
_FADED, _LEAST_TIMES, _MOST_STEPS = 3.0, 4, 5e5
_STEADY, _LASTS = 1e-3, 0.1
_REVERSES = 1e-9  # of the limit, that a deflection goes back in a step


class Elsewhere(NamedTuple):
    """What came of a body from rest: another state, or the ratio it had after so many cycles."""

    state: Cycle | None
    growth: float
    ratio: float
    cycles: int


def ratio_of(cycle: Cycle) -> float:
    """Return the mean drive force over mu F_N in the cycle run last."""
    return float(cycle.body.sums["drive_force"] / cycle.body.sums["steps"])


def may_come_elsewhere(cycle: Cycle) -> bool:
    """Whether a body from rest may come to another state than that of a cycle.

    Where it is thrown and lands; where friction at its limit was found; where friction falls with
    the speed; and up to twice a resonance on contact or asperities, or on the contact up to as many
    times that as the cycles after which the state repeats itself. What moves as it is told has one
    state, for its asperities forget; so has what friction holds to a limit that is told (Coulomb's,
    and springs that are cut off): two motions of it only come nearer.

    What softens rings at its resonance when it is shaken there, or a little below, or at half the
    period: asperities that are bent are soft one way and stiff the other, so that the slip may go
    back in every second cycle only, of a body that is shaken at up to twice their frequency.
    Friction along the slip that comes to its limit at once (vector, an exponent below 1) is pumped
    sideways by a slip that turns round, above that too.
    """
    return _is_thrown(cycle) or _may_swing(cycle)


def _is_thrown(cycle: Cycle) -> bool:
    return cycle.q is not None and float(cycle.body.sums["landings"]) > 0.0


def _may_swing(cycle: Cycle) -> bool:
    """Whether a body may come to another state without being thrown to it."""
    model = cycle.body.model
    slider, friction, normal = model.slider, model.friction, model.normal
    elastic = slider.drive_stiffness is not None
    if not model.vibrates:
        return False
    if cycle.at_the_limit:
        return elastic and friction.model != "coulomb"
    if slider.mass is None:
        return False
    turns = slider.free and friction.law == "vector" and friction.exponent < 1.0
    # The resonance of what softens as it is moved further leans to lower frequencies.
    highest = math.sqrt(1.0 / slider.mass) / (2.0 * math.pi)
    pressed = 0.0
    if normal is not None and normal.control == "force" and model.unit_direction[2] != 0.0:
        pressed = normal.slope(slider.normal_force)
    # What repeats itself after some cycles rings at a part of their frequency.
    sums = cycle.body.sums
    lifts = cycle.q is not None and float(sums["load_min"]) < _LIGHT
    if model.frequency <= (_HALVES if lifts else _LEANS) * cycle.period * highest * math.sqrt(
        pressed
    ):
        return True
    if friction.model in ("coulomb", "springs") or not (elastic or slider.free):
        return False
    if elastic and (friction.static_mu or 0.0) > friction.mu:
        return True
    turning = max(1.0, friction.exponent) * model.full_friction
    stiffness = turning / friction.deflection_limit(slider.normal_force)
    highest *= math.sqrt(stiffness + (slider.drive_stiffness or 0.0))
    # What goes back in every cycle, up to the limit, has no cycle left to leave out; what is shaken
    # more slowly than it is drawn goes back in none.
    flat = math.hypot(*model.unit_direction[:2]) * model.peak_velocity
    goes = flat > _SLOWLY * slider.drive_velocity and float(sums["friction_x_min"]) > _GOES_BACK
    halves = _HALVES if goes else _LEANS
    return model.frequency <= (_PUMPED if turns else halves) * highest


def _is_looked_for(cycle: Cycle) -> bool | None:
    """Whether another state from rest is looked for, or takes too long; None where none may be."""
    return _loading(cycle.body.model) <= _MOST_TAKEN_UP if may_come_elsewhere(cycle) else None


def takes_too_long(cycle: Cycle) -> bool:
    """Whether a body may come to another state, but its drive is so soft that none looks for it."""
    return _is_looked_for(cycle) is False


def may_bounce_otherwise(cycle: Cycle) -> bool:
    """Whether a body is thrown and lands above its resonances, where it flies for long.

    What flies for a cycle and more may land in several ways, by ever so little in where it comes
    from, so that the one from rest tells nothing of the others.
    """
    return _is_thrown(cycle) and not _may_swing(cycle)


def from_rest(cycle: Cycle) -> Elsewhere | None:
    """March a body from rest; None where it comes to the state of a cycle, or is not taken up."""
    if not _is_looked_for(cycle):
        return None
    model, there = cycle.body.model, ratio_of(cycle)
    loading = _loading(model)
    # Nobody's vibration is quite along the way: what is unstable across it is no state to come to.
    askew = dataclasses.replace(model, askew=1.0) if goes_straight(model) else model
    body = Cycle(askew, (len(cycle.increments) - 1) // cycle.period, cycle.step)
    if body.body.p.rigid:
        body.body.state["velocity_x"] = body.body.p.drive
    limit = cycle.at_the_limit or comes_to_its_limit(model, cycle.body.sums, cycle.body.state)
    if _grows(model):
        _grow(body)
    mean, before, fades = 0.0, 0.0, _GONE * ringing_time(model) * model.frequency
    for n, cycles in enumerate(_CYCLES):
        before = mean
        last_cycles, mean, least = _marched(body, cycles + (0 if n else math.ceil(loading)))
        last = float(np.mean(last_cycles))
        if limit and _at_the_limit(body, cycle, least):
            return None
        if not cycle.at_the_limit and max(abs(mean - there), abs(last - there)) <= _COME:
            return None
        found = _repeating(body, last_cycles)
        if found is None:
            continue
        if (growth := found.multiplier()) <= UNSTABLE:
            # What fades by a power of the time repeats itself while it is on its way.
            if abs(ratio_of(found) - there) <= (_COME if lasts(growth) else SAME):
                # It rings still, and may do so for ever; or the state is next to where it is, as
                # one of a cycle is to one of four, and not what it comes to.
                if body.run < fades or abs(last - there) > _OFF:
                    continue
                return None
            found.run = body.run + found.run + cycle.run
            return Elsewhere(found, growth, ratio_of(found), found.run)
    if abs(mean - there) <= _NEARER * abs(before - there):
        return None
    return Elsewhere(None, math.inf, mean, body.run)


def sticks_from_rest(cycle: Cycle) -> bool | None:
    """Whether a body that nothing shakes goes on sticking and slipping from rest.

    Where steady sliding is stable as well. It is marched for three times as long as a disturbance
    of that takes to fade; None where that is too long.
    """
    model = cycle.body.model
    slider, rate = model.slider, fading_rate(model)
    if rate is None or slider.drive_stiffness is None or slider.mass is None:
        return False
    loading = _loading(model) / _TAKEN_UP
    rings = 2.0 * math.pi * math.sqrt(slider.mass / slider.drive_stiffness)
    longest = 2.0 * (loading + rings)  # from one slip to the next
    times = max(_LEAST_TIMES, math.ceil((_TAKEN_UP * loading + _FADED / rate) / longest))
    steps = math.ceil(longest / cycle.step)
    if times * steps > _MOST_STEPS:
        return None
    body = Cycle(model, steps, cycle.step)
    state, sums = body.body.kept["state"][0], body.body.sums
    swings = []
    for n in range(times):
        run(state, body.springs, body.body.p, body.q, body.increments, body.rises, sums)
        swings.append(float(sums["friction_x_max"] - sums["friction_x_min"]))
        # The first has the way from rest in it.
        if n and swings[-1] <= _STEADY:
            return False
    return swings[-1] > max(_STEADY, _LASTS * max(swings[1:]))


def shaken_how(model: Model) -> str:
    """Say what a body from rest is spared here of how the case has its vibration begin."""
    spared = ["vibration.start"] if model.start > 0.0 else []
    if model.ramp > 0.0 and not _grows(model):
        spared.append("vibration.ramp")
    return f", without its {' and '.join(spared)}" if spared else ""


def _grows(model: Model) -> bool:
    """Whether the vibration grows in a march from rest as the case says: in not too many cycles."""
    return 0.0 < model.ramp * model.frequency <= _MOST_GROWN


def _grow(body: Cycle) -> None:
    """March a body from rest while its vibration grows, over whole cycles."""
    integrator, steps = body.body, len(body.increments) - 1
    model, state = integrator.model, integrator.kept["state"][0]
    rises = along = np.empty(steps + 1)
    wave = normal_wave = model.wave(body.step)
    if isinstance(integrator, LoadedIntegrator):
        normal_wave = integrator.normal_wave
        integrator.place(0.0)
    if normal_wave.lead != wave.lead:
        rises = np.empty(steps + 1)
    cycles = math.ceil(wave.ramp)
    for n in range(cycles):
        fill_increments(wave, float(n), 1.0 / steps, along)
        if rises is not along:
            fill_increments(normal_wave, float(n), 1.0 / steps, rises)
        run(state, body.springs, integrator.p, body.q, along, rises, integrator.sums)
    body.run += cycles


def _loading(model: Model) -> float:
    """Cycles in which a body is taken up: its drive stretched, its asperities bent.

    Seconds where nothing shakes it.
    """
    slider, friction = model.slider, model.friction
    way = 0.0
    if slider.drive_stiffness is not None:
        held = (friction.static_mu or friction.mu) * slider.normal_force
        way += held / slider.drive_stiffness
    if friction.model != "coulomb":
        way += friction.deflection_limit(slider.normal_force)
    cycles = model.frequency if model.vibrates else 1.0
    return _TAKEN_UP * way / slider.drive_velocity * cycles


def alike_after(last: FloatArray, period: int) -> bool:
    """Whether the means of a march's last cycles come again after so many."""
    return bool(np.abs(last[period:] - last[:-period]).max() <= _ALIKE)


def period_of(means: Sequence[float], most: int = 12) -> int:
    """Return after how many cycles their means come again, at most so many; 0 where they do not."""
    if not means:
        return 0
    periods = range(1, most + 1)
    return next((each for each in periods if alike_after(np.array(means), each)), 0)


def again_after(period: int) -> str:
    """Say after how many cycles the motion repeats itself."""
    after = "a cycle" if period == 1 else f"{period} cycles"
    return f"the motion repeats itself after {after}"


def _repeating(body: Cycle, last: FloatArray) -> Cycle | None:
    """Return the state next to where a march is, over as many cycles as its last ones repeat."""
    alike = [period for period in _PERIODS if alike_after(last, period)]
    # Beside a state over two cycles to which it has come there may be a stable one over one.
    tried = [(period, _THERE) for period in alike] + [(1, _NEAR)]
    tried += [(period, _NEAR) for period in alike if period > 1]
    for period, near in tried:
        found = body.copied()
        found.repeat(period)
        if found.find(-1) and abs(ratio_of(found) - float(np.mean(last))) <= near:
            return found
    return None


def _marched(body: Cycle, cycles: int) -> tuple[FloatArray, float, FloatArray]:
    """March some cycles; returns the ratios of the last ones, and the mean of their second half.

    And the least friction in each of the last ones.
    """
    means, least = [], []
    state = body.body.kept["state"][0]
    for n in range(cycles):
        run(state, body.springs, body.body.p, body.q, body.increments, body.rises, body.body.sums)
        means.append(ratio_of(body))
        if n >= cycles - _TOLD:
            least.append(float(body.body.sums["friction_x_min"]))
    body.run += cycles
    return np.array(means[-_TOLD:]), float(np.mean(means[cycles // 2 :])), np.array(least)


def _at_the_limit(body: Cycle, cycle: Cycle, least: FloatArray) -> bool:
    """Whether a body is on its way to friction at its limit: its asperities only bend further."""
    if least.min() >= float(cycle.body.sums["friction_x_min"]) - _REVERSES_NO_MORE:
        return True
    if bends_aside(body.body.model) and not cycle.at_the_limit:
        # What is left of the limit is left of the mean.
        mean = ratio_of(body) / size_of(body.body.state)
        return abs(mean - ratio_of(cycle)) <= _NEAR and only_bends_further(body)
    if body.body.model.friction.model != "dahl" or np.diff(least).min() < -_REVERSES:
        return False
    bent = body.record()[:, (body.body.node_type.names or ()).index("deflection_x")]
    return bool(np.diff(bent).min() >= -_REVERSES)

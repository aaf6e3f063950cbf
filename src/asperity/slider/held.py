r"""A body under a constant pull: whether its asperities' feet creep from cycle to cycle.

A stuck body may ring on its asperities for ever, which tells nothing of creep: what creeps is the
foot, the body's position less the deflection. The pull is there from the start, at its deflection;
the vibration in the plane grows slowly, so that the asperities slip as they must and no more.
"""

import dataclasses
import math

import numpy as np

from asperity.arrays import FloatArray
from asperity.errors import ConvergenceError, InputError
from asperity.friction.loaded import STIFFNESS
from asperity.friction.parameters import Friction
from asperity.normal import elastic_force, indentation
from asperity.slider.cycle_map import Cycle
from asperity.slider.held_kernels import carry
from asperity.slider.integrators import LoadedIntegrator
from asperity.slider.model import Model
from asperity.slider.periodic import cycle_steps, settle
from asperity.slider.pressed import friction_limit
from asperity.slider.scaled import COULOMB, SPRINGS, Parameters

# Cycles: of growing, and of the first stretch a creep is taken from; or rings of the asperities.
_GROWING = 48
_FIRST = 16
_RINGS = 4
_MOST_FIRST = 40_000
_DOUBLINGS = 8
STANDING = 1e-6
"""Creep a cycle over the deflection limit, for Coulomb friction over the drive's way in a step,
below which a body stands."""

ROUNDING = 1e-10
"""Creep, in the same, that is no rounding, which leaves some 1e-12 of what stands."""
_STEADY = 0.9
_SETTLED = 1e-3
_KEPT = 0.02
_STRETCH = 2_000_000  # steps in one call of a kernel: then Ctrl-C is heard
_APERIODIC = 64  # cycles that stand for those of a motion that never repeats itself


@dataclasses.dataclass(frozen=True)
class Creep:
    """What a body does under a pull.

    Attributes
    ----------
    velocity : float
        Of the asperities' feet, m/s; 0 where they stand.
    steady : bool
        Whether it has settled; a body pulled too hard runs away.
    """

    velocity: float
    steady: bool


class HeldBody:
    """A body whose drive is a constant force.

    Parameters
    ----------
    model : Model
        The body, with a mass and a vibration; its drive is left out.

    Attributes
    ----------
    step : float
        Time step, s.
    standing : ndarray of a record
        The body without a pull, at the start of a period of the motion normal to the plane.
    sums : record or None
        Over that period of what is normal to the plane; None where the normal force is constant.
    period : int or None
        Cycles after which that motion repeats itself; None where it does not.
    multiplier : float or None
        Of its least stable disturbance.
    notes : tuple of str
        What a reader should know of it.
    """

    def __init__(self, model: Model) -> None:
        self.model = model
        steps = cycle_steps(model)
        self.step = 1.0 / (model.frequency * steps)
        cycle = Cycle(model, steps, self.step)
        self.period: int | None = 1
        self.multiplier: float | None = None
        self.sums: np.void | None = None
        self.notes: tuple[str, ...] = ()
        if isinstance(cycle.body, LoadedIntegrator):
            self._press(cycle, steps)
        self.standing = cycle.body.kept["state"].copy()
        self._cycle = cycle
        self._cycles = cycle.period
        self._p = self._released(cycle)
        if not _RINGS * self.frequency_ratio <= _MOST_FIRST:
            raise InputError(
                f"the body rings on its asperities {self.frequency_ratio:.3g} times as slowly as "
                f"it is shaken; static friction is found up to {_MOST_FIRST / _RINGS:g} times: "
                "look at slider.mass, friction.mu and friction.max_deflection"
            )
        self._first = max(_FIRST, math.ceil(_RINGS * self.frequency_ratio))
        growing = max(_GROWING, self._first) // self._cycles + 1
        self._growing = 0.5 - 0.5 * np.cos(np.pi * np.arange(1, growing + 1) / growing)

    @property
    def cycles(self) -> int:
        """Cycles under a pull, of most cases."""
        return len(self._growing) * self._cycles + 7 * self._first

    @property
    def frequency_ratio(self) -> float:
        """Frequency of the vibration over that of the body on its asperities; 0 on rigid ones."""
        slider, friction = self.model.slider, self.model.friction
        if friction.model == "coulomb" or slider.mass is None:
            return 0.0
        ring = math.sqrt(friction.stiffness(slider.normal_force) / slider.mass)
        return 2.0 * math.pi * self.model.frequency / ring

    def _press(self, cycle: Cycle, steps: int) -> None:
        """Let what is normal to the plane settle, which asks nothing of what is in it."""
        model = self.model
        slider = {"drive_stiffness": None, "drive_damping": 0.0, "lateral": "guided"}
        rigid = Friction.model_validate({"mu": model.friction.mu, "model": "coulomb"})
        alone = dataclasses.replace(
            model,
            slider=model.slider.model_copy(update=slider, units="SI"),
            friction=rigid,
        )
        pressed = Cycle(alone, steps, self.step)
        found, growth, _ = settle(pressed)
        if found:
            self.period, self.multiplier = pressed.period, growth
        else:
            self.period = None
            pressed.disturb()
            pressed.repeat(_APERIODIC // pressed.period)
            body = pressed.body
            carry(
                body.state, pressed.springs, body.p, pressed.q, pressed.increments,
                pressed.rises, body.sums, np.ones(2),
            )  # fmt: skip
            self.notes = (
                f"the motion normal to the plane does not repeat itself: its least load is that of "
                f"{_APERIODIC} cycles",
            )
        self.sums = pressed.body.sums
        cycle.repeat(pressed.period)
        for name in ("rise", "penetration", "load"):
            cycle.body.state[name] = pressed.body.state[name]

    def _released(self, cycle: Cycle) -> Parameters:
        """Return the body's numbers without its drive."""
        model = self.model
        mass = model.slider.mass or math.inf
        mobility = self.step**2 * model.full_friction / (mass * model.length(self.step))
        return cycle.body.p._replace(
            stiffness=0.0, damping=0.0, retained=1.0, mobility_x=mobility, rigid=False
        )

    def creep(self, pull: float, *, settled: bool = False, standing: float = STANDING) -> Creep:
        r"""Return what the body does under a pull, over :math:`\mu W`.

        Parameters
        ----------
        pull : float
            Along the drive, over mu W.
        settled : bool
            Whether to wait until the velocity keeps to 0.1 %, and not only does not fade.
        standing : float
            Creep a cycle over the deflection limit, for Coulomb friction over the drive's way in a
            step, below which the body stands.
        """
        cycle = self._cycle
        state, springs = self.standing.copy(), np.zeros_like(cycle.springs)
        p = self._p._replace(pull=pull)
        self._deflect(state[0], springs, pull)
        sums = cycle.body.no_sums()[0]
        length = len(cycle.increments) - 1
        taken = 0

        def march(shares: FloatArray) -> float:
            nonlocal taken
            for part in np.array_split(shares, math.ceil(len(shares) * length / _STRETCH)):
                carry(state[0], springs, p, cycle.q, cycle.increments, cycle.rises, sums, part)
            taken += len(shares) * length
            if not all(map(math.isfinite, state[0].item())):
                raise ConvergenceError(
                    "the march under a constant pull left the finite numbers: look at the masses, "
                    "stiffnesses and friction of the case, or give a smaller solve.step",
                    reached={"pull": pull},
                )
            position = taken * p.drive - float(state[0]["stretch"])
            return position - self._bent(state[0], springs)

        place = march(self._growing)
        periods = max(1, self._first // self._cycles)
        speeds: list[float] = []
        unit = self.model.length(self.step) / (self.step * length)
        for _ in range(_DOUBLINGS):
            last, place = place, march(np.ones(periods))
            speeds.append((place - last) / periods)
            periods *= 2
            if abs(speeds[-1]) <= standing * self._cycles:
                return Creep(0.0, steady=True)
            if len(speeds) > 2 and _lasts(speeds[-3:], _SETTLED if settled else None):
                return Creep(speeds[-1] * unit, steady=_lasts(speeds[-3:], _KEPT))
        fades = abs(speeds[-1]) < _STEADY * abs(speeds[-2])
        steady = fades or _lasts(speeds[-3:], _KEPT)
        return Creep(0.0 if fades else speeds[-1] * unit, steady=steady)

    def creeps_below(self, pull: float) -> bool:
        """Whether asperities creep steadily under half of a pull, however slowly.

        They do where they yield before they slip, as under vibration in the plane those of Dahl's
        law with an exponent above 0 and of LuGre: no pull is so small that they stand.
        """
        return self.creep(0.5 * pull, settled=True, standing=ROUNDING).velocity > 0.0

    def _deflect(self, state: np.void, springs: FloatArray, pull: float) -> None:
        """Put the asperities where they carry a pull, or as much of it as they can."""
        p, q = self._p, self._cycle.q
        limit = 1.0 if q is None else float(friction_limit(state["load"], q.load_power))
        carried = math.copysign(min(abs(pull), limit), pull)
        if p.model == SPRINGS and q is not None:
            elastic = elastic_force(q.law, state["penetration"])
            depth = indentation(q.law, state["penetration"], elastic, state["load"])
            most = np.maximum(float(depth) - q.heights, 0.0)
            deflections = np.append(0.0, np.sort(most))
            forces = [float(q.weights @ np.minimum(most, each)) for each in deflections]
            way = np.interp(abs(pull), forces, deflections)
            springs[0] = math.copysign(1.0, pull) * np.minimum(most, way)
            carried = float(q.weights @ springs[0])
        share = carried
        if q is not None and p.model != SPRINGS and q.keeps != STIFFNESS:
            share = carried / limit if limit > 0.0 else 0.0
        if p.model != COULOMB:
            state["deflection_x"] = share
        state["friction_x"] = carried
        state["drive_force"] = pull

    def _bent(self, state: np.void, springs: FloatArray) -> float:
        """Deflection of the asperities, of springs in the mean."""
        if self._p.model == SPRINGS and self._cycle.q is not None:
            weights = self._cycle.q.weights
            return float(weights @ springs[0] / weights.sum())
        return float(state["deflection_x"])


def _lasts(speeds: list[float], settled: float | None) -> bool:
    """Whether a creep does not fade over the last stretches; or has settled, or runs away."""
    one, two, three = map(abs, speeds)
    if settled is None:
        return two >= _STEADY * one and three >= _STEADY * two
    return abs(three - two) <= settled * two

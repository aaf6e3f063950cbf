"""The answer normal to the plane of a body that is pressed, lifts and lands."""

import math

import numpy as np

from asperity.errors import ConvergenceError
from asperity.friction.springs import load_and_slope, spring_profile
from asperity.normal import elastic_slope, indentation
from asperity.results import Quantities, quantity
from asperity.slider.model import Model
from asperity.slider.substeps import LANDING_BOUND, RING_BOUND

_MOST_GAIN = 1e-9  # of the friction power: rounding
_WITHIN = 2e-3  # of mu F_N, that springs may be off without a word
MOST_SPRINGS = 256

IN_FLIGHT = "the body does not land in the window of the means"


class NormalMotion(Quantities):
    r"""What happens normal to the plane, in the window.

    Attributes
    ----------
    ratio_mean_load : float or None
        Mean drive force over :math:`\mu` times the mean normal force; None of a body that does not
        land.
    normal_mean, normal_min, normal_max : float
        Normal force, N.
    open_share : float
        Share of the time without contact.
    landings_per_cycle : float
        How often the body comes back into contact in a cycle of the vibration.
    penetration_mean : float
        Mean penetration, below 0 where there is a gap, m.
    penetration_swing : float
        Half of what the penetration changes, m.
    critical_velocity : float or None
        :math:`v^* = \mu (k_z/k_t)\,\omega\,\hat d`, m/s, with the swing :math:`\hat d` of the
        penetration: drive velocity above which elastic asperities keep up with the load, and
        nothing is reduced. None of rigid ones.
    contact_frequency : float or None
        :math:`\sqrt{k_z/m}/2\pi`, Hz; None without a mass.
    period : int or None
        Cycles after which the state repeats itself; None of a march.
    multiplier : float or None
        Of the least stable disturbance over that period, below 1 where it dies out; None of a
        march.
    friction_gain : float
        Power that friction gave in steps in which it lost none, W.
    wear_integral : float
        :math:`\langle N|v - \dot s|\rangle`, load over the slip of the asperities' feet, W.
    """

    ratio_mean_load: float | None = quantity(
        "F_dv/mu N", "", "mean drive force over mu times mean load"
    )
    normal_mean: float = quantity("N", "N", "mean normal force")
    normal_min: float = quantity("N_min", "N", "least normal force")
    normal_max: float = quantity("N_max", "N", "greatest normal force")
    open_share: float = quantity("", "", "share of the time without contact")
    landings_per_cycle: float = quantity("", "", "landings in a cycle")
    penetration_mean: float = quantity("d", "m", "mean penetration")
    penetration_swing: float = quantity("d^", "m", "swing of the penetration")
    critical_velocity: float | None = quantity(
        "v*", "m/s", "velocity above which nothing is reduced", key="critical_velocity_m_s"
    )
    contact_frequency: float | None = quantity("f_0", "Hz", "natural frequency of the contact")
    period: float | None = quantity("", "", "cycles until the state repeats itself")
    multiplier: float | None = quantity("", "", "growth of a disturbance over that period")
    friction_gain: float = quantity("", "W", "power given by friction")
    wear_integral: float = quantity("", "W", "load over the slip of the asperities' feet")

    @property
    def in_flight(self) -> bool:
        """Whether the body does not land in the window."""
        return self.ratio_mean_load is None


def normal_motion(
    model: Model,
    step: float,
    sums: np.void,
    lost: float,
    period: int | None,
    multiplier: float | None,
) -> NormalMotion:
    """Turn the sums over a window into what happened normal to the plane."""
    slider, friction, count = model.slider, model.friction, sums["steps"]
    load, length = slider.normal_force, model.normal_length
    mean = float(sums["load"] / count)
    cycles = count * step * model.frequency
    watts = model.full_friction * model.length(step) / (count * step)
    critical = None
    swing = 0.5 * float(sums["penetration_max"] - sums["penetration_min"])
    if friction.model != "coulomb" and model.vibrates:
        turn = 2.0 * math.pi * model.frequency
        critical = friction.deflection_limit(load) * turn * swing
    frequency = None
    if slider.mass is not None and model.normal is not None:
        frequency = math.sqrt(model.normal.slope(load) / slider.mass) / (2.0 * math.pi)
    wear = float(watts * sums["wear"])
    if friction.model == "springs":
        # Each slips under its full friction: what is lost is the load's work over the slip.
        wear = lost
    return NormalMotion(
        ratio_mean_load=float(sums["drive_force"] / count) / mean if mean else None,
        normal_mean=mean * load,
        normal_min=float(sums["load_min"]) * load,
        normal_max=float(sums["load_max"]) * load,
        open_share=float(sums["open"] / count),
        landings_per_cycle=float(sums["landings"] / cycles) if cycles else 0.0,
        penetration_mean=float(sums["penetration"] / count) * length,
        penetration_swing=swing * length,
        critical_velocity=critical,
        contact_frequency=frequency,
        period=period,
        multiplier=multiplier,
        friction_gain=float(watts * sums["gain"]),
        wear_integral=wear / friction.mu,
    )


def remarks(model: Model, step: float, sums: np.void, motion: NormalMotion) -> tuple[str, ...]:
    """Return what a reader should know of the motion normal to the plane.

    Raises
    ------
    ConvergenceError
        Friction gave energy that it must not have.
    """
    q = model.pressing(step)
    notes = []
    if motion.in_flight:
        notes.append(f"{IN_FLIGHT}; give a longer solve.duration")
    ring = math.sqrt(q.mobility * elastic_slope(q.law, sums["penetration_max"]))
    if ring > 2.0 * RING_BOUND or sums["approach_max"] > 2.0 * LANDING_BOUND:
        finer = max(ring / RING_BOUND, sums["approach_max"] / LANDING_BOUND)
        notes.append(
            f"the contact is met harder than expected: give a solve.step of {step / finer:.2g} s"
        )
    if model.friction.model == "springs":
        notes += too_few_springs(model)
        deepest = float(indentation(q.law, 0.0, math.inf, sums["load_max"]))
        if deepest > model.deepest:
            notes.append(
                "the contact was pressed deeper than its springs reach, by "
                f"{(deepest - model.deepest) * model.normal_length:.2g} m, where they carry less "
                "than they should: the body did not come there from rest"
            )
    power = abs(motion.wear_integral) * model.friction.mu
    gains = motion.friction_gain > _MOST_GAIN * power
    if model.friction.model in ("dahl", "lugre") and model.friction.keeps == "deflection":
        gave = (
            f"friction gave {motion.friction_gain:.3g} W" if gains else "friction can give energy"
        )
        notes.append(
            f"{gave}: with friction.keeps 'deflection' a deflected asperity that is pressed harder "
            "pulls harder without having slipped; 'stiffness' gains nothing"
        )
    elif gains:
        raise ConvergenceError(
            f"friction gave {motion.friction_gain:.3g} W, which it cannot: this is a defect",
            reached={"friction_gain_W": motion.friction_gain},
        )
    return tuple(notes)


def too_few_springs(model: Model) -> tuple[str, ...]:
    """Return a note that a contact's springs may be too few to tell friction by, if they may be."""
    assert model.normal is not None
    count = model.friction.springs
    law, deepest = model.normal.law, model.deepest
    within = missed_limit(law, count, deepest)
    if within <= _WITHIN:
        return ()
    more = {n: missed_limit(law, n, deepest) for n in range(16, MOST_SPRINGS + 1, 16)}
    enough = next((n for n in more if n > count and more[n] <= _WITHIN), MOST_SPRINGS)
    left = max(more[enough], _WITHIN)
    other = f": friction.springs = {enough} tells it to {left:.2g}" if enough > count else ""
    return (
        f"of {count} springs friction is known to within {within:.2g} of mu F_N where the load "
        f"swings as far as this{other}",
    )


def missed_limit(law: str, count: int, deepest: float) -> float:
    """Return the most by which the limit of springs misses that of the law, over the reference.

    Where they reach deep that is little of their load and may be much of the reference.
    """
    if law == "linear":
        return 0.0
    heights, weights = spring_profile(law, count, deepest)
    # A polygon misses most at its corners and half-way between them.
    between = 0.5 * (heights[1:] + heights[:-1])
    depth = np.concatenate([heights, between, [deepest]])
    depth = depth[depth <= deepest]
    carried = np.maximum(depth[:, None] - heights, 0.0) @ weights
    return float(np.abs(carried - load_and_slope(law, depth)[0]).max())

r"""Friction between the discs as a mean over a cycle of vibration, with the package's own law.

The asperity is Dahl's (`asperity.friction.loaded`), whose limit follows the speed of slip:
:math:`\mu(|v|) = \mu_0 [1 - d (1 - e^{-|v|/v_S})]`. Along the vibration the steel disc may answer
by turning a little on its shaft.
"""

import dataclasses
import math
from typing import NamedTuple

import numpy as np

from asperity.arrays import FloatArray
from asperity.errors import ConvergenceError
from asperity.friction import LAWS
from asperity.friction.loaded import STIFFNESS, advance_loaded
from asperity.kernels.compiled import kernel

_SLOWEST, _FASTEST, _SPEEDS, _NEAR = 2e-5, 1.0, 56, 32
_TOLERANCE = 2e-3
_FEW, _MANY = 4, 400


class Rotor(NamedTuple):
    """The steel disc on its shaft as its rim feels it; a mass of 0 is a disc that does not answer.

    Attributes
    ----------
    mass, stiffness, damping : float
        J/r^2 in kg, N/m, N s/m.
    """

    mass: float = 0.0
    stiffness: float = 0.0
    damping: float = 0.0


class Surface(NamedTuple):
    """The contact as kernels take it.

    Attributes
    ----------
    full : float
        mu_0 F_N, N.
    drop, stribeck : float
        d, and v_S in m/s.
    limit : float
        Deflection of the asperities at full friction, m.
    exponent : float
        Dahl's.
    law : int
        How the deflection relaxes in two dimensions.
    """

    full: float
    drop: float
    stribeck: float
    limit: float = 70e-9
    exponent: float = 1.0
    law: int = LAWS["vector"]


@kernel
def share_at(surface, speed):
    """Friction at a speed of slip over that at rest."""
    return 1.0 - surface.drop * (1.0 - math.exp(-speed / surface.stribeck))


@kernel
def cycle_mean(surface, rotor, velocity, shaken, along, across, period, least, most, tolerance):
    """Mean friction along the sliding over a cycle, over mu_0 F_N.

    Parameters
    ----------
    surface, rotor : Surface, Rotor
        The contact, and the disc on its shaft.
    velocity : float
        Mean sliding velocity, m/s.
    shaken : ndarray
        Velocity of the vibration over a cycle, m/s.
    along, across : float
        Its direction.
    period : float
        s.
    least, most : int
        Cycles to march.
    tolerance : float
        Change of the mean from cycle to cycle at which it is taken for periodic.

    Returns
    -------
    mean, change : float
        The mean of the last cycle, and how far it was from that before; where it does not become
        periodic, the mean of the second half of the march.
    """
    step = period / shaken.size
    sx = 0.0
    sy = 0.0
    turned = 0.0
    rim = 0.0
    before = share_at(surface, abs(velocity))
    mean = 2.0
    change = 2.0
    late = 0.0
    for cycle in range(most):
        total = 0.0
        for u in shaken:
            vx = velocity + rim - along * u
            vy = -across * u
            now = share_at(surface, math.sqrt(vx * vx + vy * vy))
            sx, sy, fx, _ = advance_loaded(
                sx, sy, vx * step / surface.limit, vy * step / surface.limit, 0.0, 0.0,
                before, now, surface.exponent, surface.law, STIFFNESS,
            )  # fmt: skip
            before = now
            total += fx
            if rotor.mass > 0.0:
                # Shaft and disc turn about where the mean friction holds them.
                pull = -rotor.stiffness * turned - rotor.damping * rim - surface.full * fx
                rim += step * pull / rotor.mass
                turned += step * rim
        total /= shaken.size
        change = abs(total - mean)
        mean = total
        if cycle + 1 >= least and change <= tolerance * max(abs(mean), 0.02):
            return mean, change
        if 2 * cycle >= most:
            late += total
    return late / (most // 2), change


@dataclasses.dataclass(frozen=True, eq=False)
class MeanFriction:
    """Mean friction over sliding velocity, odd in it.

    Attributes
    ----------
    velocity, force : ndarray
        m/s, from 0 up, and N.
    """

    velocity: FloatArray
    force: FloatArray

    def __call__(self, velocity: float) -> float:
        """Mean friction at a velocity of either sign, N."""
        found = np.interp(abs(velocity), self.velocity, self.force)
        return float(math.copysign(found, velocity)) if velocity else 0.0


def mean_friction(
    surface: Surface,
    rotor: Rotor | None = None,
    *,
    shaken: FloatArray | None = None,
    along: bool = False,
    frequency: float = 0.0,
) -> MeanFriction:
    """Tabulate mean friction over sliding velocity.

    Parameters
    ----------
    surface : Surface
        The contact.
    rotor : Rotor, optional
        The steel disc, where it answers.
    shaken : ndarray, optional
        Velocity of the vibration over a cycle, m/s; None: there is none.
    along : bool
        Whether it goes along the sliding, or across.
    frequency : float
        Of the vibration, Hz.

    Raises
    ------
    ConvergenceError
        The disc on its shaft does not settle.
    """
    speeds = np.geomspace(_SLOWEST, _FASTEST, _SPEEDS)
    if shaken is not None:
        # Friction along a vibration goes as asin(v/v_a) up to its peak.
        near = np.sin(0.5 * np.pi * np.arange(1, _NEAR + 1) / _NEAR)
        speeds = np.union1d(speeds, np.abs(shaken).max() * near)
    speeds = np.concatenate([[0.0], speeds])
    if shaken is None:
        force = surface.full * np.array([share_at(surface, v) for v in speeds])
        # At rest friction is what holds; the table rises to it within the slowest speed.
        force[0] = 0.0
        return MeanFriction(speeds, force)
    moving = rotor if rotor is not None and along else Rotor()
    free = moving.mass > 0.0
    force = np.zeros(speeds.size)
    for place, velocity in enumerate(speeds[1:], start=1):
        mean, change = cycle_mean(
            surface, moving, velocity, shaken, float(along), float(not along), 1.0 / frequency,
            _FEW, _MANY if free else 4 * _FEW, _TOLERANCE,
        )  # fmt: skip
        if not math.isfinite(mean) or (not free and change > 0.1):
            raise ConvergenceError(
                f"friction of the simulated contact does not settle at {velocity:.3g} m/s and "
                f"{frequency:g} Hz",
                reached={"change": change},
            )
        force[place] = surface.full * mean
    return MeanFriction(speeds, force)

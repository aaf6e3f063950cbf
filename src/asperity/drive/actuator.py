r"""What a piezo actuator takes from its amplifier for the vibration it makes: real, and apparent.

An equivalent circuit (Butterworth and Van Dyke; IEEE Std 176-1987) of a capacitor :math:`C_0` and,
beside it, a branch of :math:`L, C_1, R` that stands for the motion: inertia, stiffness, and what
takes power. Its numbers are had from mechanics alone, whatever the actuator's size and voltage:

.. math::
    k^2 = \frac{C_1}{C_0 + C_1}, \qquad d = \omega R C_1 = \frac{P}{\omega W}, \qquad
    x = r^2 - 1

with the effective coupling :math:`k`, the power :math:`P` taken from the motion (the contact's and
the resonator's own), the peak elastic energy :math:`W` of the actuator as a spring, and the
frequency :math:`r` over that of the series resonance. The admittance over :math:`\omega C_1` is
:math:`j(1 - k^2)/k^2 + 1/(d + jx)`, hence

.. math:: S = \omega W \sqrt{d^2 + \left((1/k^2 - 1)(d^2 + x^2) - x\right)^2}

Far below resonance that is :math:`\omega W/k^2`: the elastic energy is swung to and fro, and with
it that of the capacitor. At resonance :math:`S = P\sqrt{1 + (1/k^2 - 1)^2 d^2}`: nearly all of
it is real. Linear: the capacitor's own loss, heating and depolarisation are not in it, and it holds
for one sine.
"""

import dataclasses
import math

from asperity.errors import InputError


@dataclasses.dataclass(frozen=True)
class Demand:
    """What an actuator takes.

    Attributes
    ----------
    own_loss : float
        Mean power lost in its own vibration, W.
    electrical_power : float
        Real power from the mains, W: never below zero, since amplifiers take nothing back.
    apparent_power : float
        That the amplifier must be made for, VA.
    """

    own_loss: float
    electrical_power: float
    apparent_power: float


def elastic_energy(moving_mass: float, velocity: float, frequency_ratio: float) -> float:
    """Return the peak elastic energy of an actuator with a mass on it, J.

    Parameters
    ----------
    moving_mass : float
        kg; for a turn its inertia, kg m2.
    velocity : float
        Peak velocity, m/s or rad/s.
    frequency_ratio : float
        Frequency of the vibration over that of the mass on the actuator, above 0: at 1 elastic
        and kinetic energy are the same.
    """
    return 0.5 * moving_mass * velocity**2 / frequency_ratio**2


def demand(
    mechanical_power: float,
    elastic_energy: float,
    frequency: float,
    *,
    coupling: float,
    quality_factor: float,
    efficiency: float,
    frequency_ratio: float = 1.0,
) -> Demand:
    """Return what an actuator takes for a vibration.

    Parameters
    ----------
    mechanical_power : float
        Mean power that the vibration gives to the gearset, W; negative where the gearset drives it.
    elastic_energy : float
        Peak elastic energy of the actuator, J.
    frequency : float
        Of the vibration, Hz.
    coupling : float
        Effective electromechanical coupling, 0 < k < 1; some 0.2-0.3 for a bolted transducer with
        its horn, 0.6-0.7 for a bare stack (from memory).
    quality_factor : float
        Of the unloaded resonator, mechanical.
    efficiency : float
        Real power at the actuator over that from the mains: the amplifier's, 0 < eta <= 1.
    frequency_ratio : float
        Frequency over that of the series resonance: 1 tuned to it, 0 far below.

    Returns
    -------
    Demand
        Powers, W and VA.

    Raises
    ------
    InputError
        A number outside its range.

    Examples
    --------
    >>> far_below = demand(
    ...     0.0, 1e-3, 100.0, coupling=0.5, quality_factor=1e9, efficiency=1.0, frequency_ratio=0.0
    ... )
    >>> round(far_below.apparent_power / (6.2831853 * 100.0 * 1e-3), 3)
    4.0
    """
    _check("actuator.coupling", coupling, 0.0 < coupling < 1.0, "above 0 and below 1")
    _check("actuator.quality_factor", quality_factor, quality_factor > 0.0, "above 0")
    _check("actuator.efficiency", efficiency, 0.0 < efficiency <= 1.0, "above 0 and at most 1")
    _check("elastic energy", elastic_energy, elastic_energy >= 0.0, "0 or more")
    swung = 2.0 * math.pi * frequency * elastic_energy
    # Of the resonator alone R is 1/(omega_0 C_1 Q), so that d is r/Q.
    own = swung * frequency_ratio / quality_factor
    taken = mechanical_power + own
    capacity = 1.0 / coupling**2 - 1.0
    off = frequency_ratio**2 - 1.0
    if swung == 0.0:
        apparent = abs(taken)
    else:
        loss = taken / swung
        apparent = swung * math.hypot(loss, capacity * (loss**2 + off**2) - off)
    return Demand(
        own_loss=own,
        electrical_power=max(taken, 0.0) / efficiency,
        apparent_power=apparent,
    )


def system_efficiency(load_power: float, drive_power: float, *electrical: float) -> float:
    """Return the load's power over all that is put in, drive and electrical side of the actuators.

    Raises
    ------
    InputError
        Nothing is put in.
    """
    given = drive_power + sum(electrical)
    _check("power put in, W", given, given > 0.0, "above 0")
    return load_power / given


def _check(name: str, value: float, holds: bool, allowed: str) -> None:
    if not holds:
        raise InputError(f"{name} is {value:g}; it must be {allowed}")

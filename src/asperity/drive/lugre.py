r"""LuGre's friction between teeth: of flanks that slide steadily, and where it makes no energy.

Its dampings belong to the normal force :math:`N_0` without vibration and go with the normal force,
so that flanks that are open rub no more. Steadily sliding at a speed :math:`v` the coefficient is

.. math:: \mu_e = \mu\,g(v)/\mu F_N + h_v v/N_0

with Stribeck's share of the first (`asperity.friction.lugre`), and :math:`N_0` follows from it.

The damping of the asperities' rate takes power out of the contact where they spring back from
static to kinetic friction: with :math:`r = F_S/\mu F_N`, they are sheared by :math:`r` times what
they are at rest at, and :math:`h_t \dot s v` is below 0. No step of any length gains by it while
:math:`h_t (r - 1) \le h_v + r \mu N_0/v`.
"""

from asperity.drive.point import MeshPoint
from asperity.errors import InputError
from asperity.friction import Friction
from asperity.friction.lugre import stribeck_share


def static_ratio(friction: Friction) -> float:
    """Return static over kinetic friction."""
    return (friction.static_mu or friction.mu) / friction.mu


def of_speed(friction: Friction) -> bool:
    """Return whether friction is another at another sliding speed."""
    return friction.model == "lugre" and (
        static_ratio(friction) > 1.0 or friction.viscous_damping > 0.0
    )


def steady_friction(
    friction: Friction, mu: float, point: MeshPoint, load: float, speed: float
) -> float:
    """Return the coefficient of friction of flanks that slide steadily.

    Parameters
    ----------
    friction : Friction
        LuGre's numbers, or any other law's.
    mu : float
        Coefficient of kinetic friction at that speed.
    point : MeshPoint
        Where they touch.
    load : float
        Torque of the wheel, N m.
    speed : float
        m/s.
    """
    if friction.model != "lugre":
        return mu
    share = stribeck_share(speed, static_ratio(friction), friction.stribeck_velocity)
    viscous = friction.viscous_damping * speed * point.arm / load
    tilt = point.lead / point.length
    return float((mu * share + viscous * point.normal_z) / (1.0 + viscous * tilt))


def check_passive(friction: Friction, full: float, fastest: float) -> None:
    """Refuse asperities whose damping would give energy.

    Parameters
    ----------
    friction : Friction
        LuGre's numbers.
    full : float
        Kinetic friction without vibration, N.
    fastest : float
        Speed up to which flanks slide, m/s.
    """
    ratio = static_ratio(friction)
    if ratio <= 1.0:
        return
    most = (friction.viscous_damping + ratio * full / fastest) / (ratio - 1.0)
    if friction.contact_damping > most:
        raise InputError(
            f"friction.contact_damping is {friction.contact_damping:g} N s/m; asperities that "
            f"spring back from static friction would give energy by it at {fastest:.3g} m/s: it "
            f"may be at most {most:.4g} N s/m, or more with more friction.viscous_damping"
        )

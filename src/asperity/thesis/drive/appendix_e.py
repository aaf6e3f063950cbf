"""The friction subroutine of the thesis's Appendix E, for reproduction only: it is not sound.

It is the scheme of 7.3 (`asperity.thesis.contact.derivatives`), with a branch that the text does
not mention. Where the scheme's friction would pass mu p, which with Dahl's exponent 1 is where the
slip of one increment passes s_max, friction is set to mu p, and the asperity's root and deflection
are left as they were ("BEHAVIOR IS PLASTIC"). From then on friction points along the whole way slid
since the last elastic increment, however the flanks slide now; and where contact is lost that way
is counted anew from zero while the root stays. A slip that turns finds its friction unturned, and
works are gained: no law to calculate with.
"""

from typing import NamedTuple

import numpy as np

from asperity.arrays import FloatArray
from asperity.friction.dahl import VECTOR
from asperity.friction.loaded import STIFFNESS, advance_loaded
from asperity.kernels.compiled import kernel


class Subroutine(NamedTuple):
    """Its properties: coefficient of friction, deflection at full friction (m), Dahl's exponent."""

    mu: float
    max_deflection: float
    exponent: float


@kernel
def advance(law, state, d_1, d_2, pressure):
    """Friction along both axes after an increment of slip; ``state`` is updated.

    The state holds STATEV(1) to (5): way slid along both axes, root along both, deflection.
    """
    if pressure <= 0.0:
        state[0] = state[1] = 0.0
        return 0.0, 0.0
    limit = law.max_deflection
    g_1, g_2 = state[0] + d_1, state[1] + d_2
    s = state[4]
    x, y = g_1 - state[2], state[1] - state[3]
    reach = np.hypot(x, y)
    if reach == 0.0:
        cos_a, sin_a = 1.0, 0.0
    else:
        cos_a, sin_a = x / reach, y / reach
    s_a = s + (reach - s) * (1.0 - s * np.sign(reach - s) / limit) ** law.exponent
    across = d_2 + s_a * sin_a
    reach = np.hypot(s_a * cos_a, across)
    if reach == 0.0:
        cos_b, sin_b = 1.0, 0.0
    else:
        cos_b, sin_b = s_a * cos_a / reach, across / reach
    slip = reach - s_a
    s_b = s_a + slip * (1.0 - s_a * np.sign(slip) / limit) ** law.exponent
    state[0], state[1] = g_1, g_2
    if abs(s_b) < limit:
        state[2], state[3], state[4] = g_1 - s_b * cos_b, g_2 - s_b * sin_b, s_b
        share = law.mu * pressure * s_b / limit
    else:
        # Appendix E, "BEHAVIOR IS PLASTIC": root and deflection are not written.
        share = law.mu * pressure
    return share * cos_b, share * sin_b


@kernel
def follow_dahl(law, slips, pressure, greatest, friction):
    """Friction of Dahl's law, its stiffness kept, at each increment of a path; from rest.

    The deflection at full friction is the law's at the greatest pressure.
    """
    s_x = s_y = before = 0.0
    size, full = law.max_deflection, law.mu * greatest
    for n in range(slips.shape[0]):
        limit = max(pressure[n], 0.0) / greatest
        s_x, s_y, f_x, f_y = advance_loaded(
            s_x, s_y, slips[n, 0] / size, slips[n, 1] / size, 0.0, 0.0, before, limit,
            law.exponent, VECTOR, STIFFNESS,
        )  # fmt: skip
        before = limit
        friction[n, 0], friction[n, 1] = full * f_x, full * f_y


@kernel
def follow(law, slips, pressure, friction):
    """Friction at each increment of a path, from a state of zeros."""
    state = np.zeros(5)
    for n in range(slips.shape[0]):
        friction[n, 0], friction[n, 1] = advance(law, state, slips[n, 0], slips[n, 1], pressure[n])


def friction_of_path(law: Subroutine, slips: FloatArray, pressure: FloatArray) -> FloatArray:
    """Return friction over a path.

    Parameters
    ----------
    law : Subroutine
        Properties.
    slips : ndarray, shape (n, 2)
        Increments of slip, m.
    pressure : ndarray, shape (n,)
        At the end of each increment, Pa (or a force, N).

    Returns
    -------
    ndarray, shape (n, 2)
        Friction stress (or force), along the slip.
    """
    friction = np.empty_like(slips)
    follow(law, slips, pressure, friction)
    return friction


def dahl_of_path(law: Subroutine, slips: FloatArray, pressure: FloatArray) -> FloatArray:
    """Return the friction of Dahl's law over the same path, sound where the pressure changes."""
    friction = np.empty_like(slips)
    follow_dahl(law, slips, pressure, float(pressure.max()), friction)
    return friction


def coulomb_of_path(mu: float, slips: FloatArray, pressure: FloatArray) -> FloatArray:
    """Return rigid Coulomb friction over the same path."""
    size = np.hypot(*slips.T)
    directions = slips / np.where(size > 0.0, size, 1.0)[:, None]
    return np.asarray(mu * np.maximum(pressure, 0.0)[:, None] * directions)


class Hammered(NamedTuple):
    """Mean friction along the sliding over mu times the mean normal force, by each law."""

    subroutine: float
    dahl: float
    coulomb: float


def hammered(
    law: Subroutine, ratio: float, shares: tuple[float, float], amplitude: float, increments: int
) -> Hammered:
    """Return the mean friction while a worm hammers on a wheel that coasts.

    Axial vibration, a sine, presses the flanks in the half of each cycle in which the worm is
    ahead, by a force that goes with how far it is. The wheel turns on steadily.

    Parameters
    ----------
    law : Subroutine
        Properties.
    ratio : float
        Peak velocity of the vibration over the sliding velocity, k_w.
    shares : tuple of float
        Of the axial motion along the sliding, and across it in the flank.
    amplitude : float
        Of the vibration, m.
    increments : int
        A cycle.
    """
    cycles = 4
    phase = 2.0 * np.pi * np.arange(cycles * increments + 1) / increments
    shift = amplitude * np.sin(phase)
    # Ahead along the axis is back along the sliding.
    along = amplitude / ratio * phase - shares[0] * shift
    slips = np.diff(np.stack([along, shares[1] * shift], axis=-1), axis=0)
    pressure = np.maximum(shift[1:], 0.0)
    last = slice(-increments, None)
    full = law.mu * pressure[last].mean()
    by_laws = (
        friction_of_path(law, slips, pressure),
        dahl_of_path(law, slips, pressure),
        coulomb_of_path(law.mu, slips, pressure),
    )
    return Hammered(*(float(friction[last, 0].mean() / full) for friction in by_laws))

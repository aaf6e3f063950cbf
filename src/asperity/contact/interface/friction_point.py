r"""Friction at one point of a contact: the friction room's update in stress form.

The traction on the body is :math:`-\mu p\,\sigma` with the friction share :math:`\sigma` that the
laws of `asperity.friction` return, which holds for every pressure: at a point the limit of the
deflection is a property of the surfaces and does not depend on the load. Coulomb friction sticks
by an elastic slip: :math:`s = s_0 + D`, brought back to the limit along its own direction, which
is the implicit projection (backward step) of an ideally plastic bristle.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from asperity.compiled import kernel
from asperity.errors import InputError
from asperity.friction import Friction, lugre_update, update
from asperity.friction.dahl import SPLIT, advance

FloatArray = npt.NDArray[np.float64]

COULOMB = 0
DAHL = 1
LUGRE = 2
TWO_PHASE = 3

# Places in the parameter vector.
MODEL = 0
LAW = 1
MU = 2
LIMIT = 3
EXPONENT = 4
STATIC_RATIO = 5
STRIBECK = 6
RATE_DAMPING = 7
SLIP_DAMPING = 8
STEP = 9
PARAMETERS = 10


@kernel
def _project(sx, sy, dx, dy, limit):
    """Ideally plastic bristle: elastic step, brought back to the limit; share and tangent."""
    rx = (sx + dx) / limit
    ry = (sy + dy) / limit
    size = math.sqrt(rx * rx + ry * ry)
    if size <= 1.0:
        return rx, ry, 1.0 / limit, 0.0, 1.0 / limit
    nx = rx / size
    ny = ry / size
    turn = 1.0 / (size * limit)
    return nx, ny, turn * ny * ny, -turn * nx * ny, turn * nx * nx


@kernel
def _along(size, reach, exponent):
    """Deflection after its end moved to ``reach``, and its slopes; thesis (44), (79).

    As `asperity.friction.two_phase`, which has no derivatives.
    """
    change = reach - size
    sign = 1.0 if change >= 0.0 else -1.0
    left = 1.0 - size * sign
    if exponent == 1.0:
        return size + change * left, left, 1.0 - left - sign * change
    # Beyond the limit a power of a negative number has no value.
    left = max(left, 0.0)
    power = left**exponent
    slope = exponent * left ** (exponent - 1.0) if left > 0.0 else 0.0
    return size + change * power, power, 1.0 - power - sign * change * slope


@kernel
def _phase(rx, ry, size, exponent, one_sided):
    """One of the two phases: the deflection's end moved to (rx, ry), in units of the limit.

    Returns the new signed size and its direction; the direction of the end, the size's slopes by
    the end's reach and by the size before; and the derivative of the deflection by the end,
    slope e f^T + size/reach (I - f f^T) with the directions e and f.
    """
    reach = math.sqrt(rx * rx + ry * ry)
    new, slope, keep = _along(size, reach, exponent)
    fx = rx / reach if reach > 0.0 else 1.0
    fy = ry / reach if reach > 0.0 else 0.0
    ex = 1.0
    ey = 0.0
    turn = 0.0
    if not one_sided and reach > 0.0:
        ex = fx
        ey = fy
        turn = new / reach
    derivative = (
        slope * ex * fx + turn * (1.0 - fx * fx),
        slope * ex * fy - turn * fx * fy,
        slope * ey * fx - turn * fx * fy,
        slope * ey * fy + turn * (1.0 - fy * fy),
    )
    return new, ex, ey, fx, fy, slope, keep, derivative


@kernel
def _two_phase(sx, sy, size, d1x, d1y, d2x, d2y, exponent, one_sided):
    """`asperity.friction.two_phase.phases` with its derivatives, in units of the limit.

    Returns the new signed size and direction, and the derivative of the deflection by both parts.
    """
    middle, ex, ey, fx, fy, slope, _, first = _phase(sx + d1x, sy + d1y, size, exponent, one_sided)
    last, ca, sa, _, _, _, keep, second = _phase(
        middle * ex + d2x, middle * ey + d2y, middle, exponent, one_sided
    )
    axx, axy, ayx, ayy = first
    bxx, bxy, byx, byy = second
    # The middle enters twice: through the reach, and as the size the second phase starts from.
    mx = keep * slope * fx
    my = keep * slope * fy
    txx = bxx * axx + bxy * ayx + ca * mx
    txy = bxx * axy + bxy * ayy + ca * my
    tyx = byx * axx + byy * ayx + sa * mx
    tyy = byx * axy + byy * ayy + sa * my
    return last, ca, sa, (txx, txy, tyx, tyy), second


@kernel
def share_of(sx, sy, size, d1x, d1y, d2x, d2y, one_sided, p):
    """Friction share after a slip, without its tangent.

    Parameters and result as `share_and_tangent`, less the tangents.
    """
    model = int(p[MODEL])
    limit = p[LIMIT]
    if model == DAHL:
        wx, wy = advance(
            sx / limit, sy / limit, d1x / limit, d1y / limit, d2x / limit, d2y / limit,
            p[EXPONENT], int(p[LAW]),
        )  # fmt: skip
        return wx * limit, wy * limit, 0.0, wx, wy
    nsx, nsy, nsize, wx, wy, _, _ = share_and_tangent(
        sx, sy, size, d1x, d1y, d2x, d2y, one_sided, p
    )
    return nsx, nsy, nsize, wx, wy


@kernel
def share_and_tangent(sx, sy, size, d1x, d1y, d2x, d2y, one_sided, p):
    """Friction share after a slip, with its tangent.

    Parameters
    ----------
    sx, sy : float
        Committed deflection in the tangent plane, m.
    size : float
        Two-phase scheme: its signed size over the limit.
    d1x, d1y, d2x, d2y : float
        The two parts of the slip of the body on the surface, m.
    one_sided : bool
        Two-phase scheme: before the start of the vibration.
    p : ndarray
        `PointFriction.parameters`.

    Returns
    -------
    sx, sy, size : float
        Trial deflection, m, and signed size.
    share_x, share_y : float
        Friction over mu p, in the direction of the slip.
    tangent_1, tangent_2 : tuple of 4 floats
        Derivative of the share by the slip parts, 1/m.
    """
    model = int(p[MODEL])
    limit = p[LIMIT]
    if model == COULOMB:
        wx, wy, txx, txy, tyy = _project(sx, sy, d1x + d2x, d1y + d2y, limit)
        tangent = (txx, txy, txy, tyy)
        return wx * limit, wy * limit, 0.0, wx, wy, tangent, tangent
    if model == TWO_PHASE:
        last, ca, sa, t1, t2 = _two_phase(
            sx / limit, sy / limit, size, d1x / limit, d1y / limit, d2x / limit, d2y / limit,
            p[EXPONENT], one_sided,
        )  # fmt: skip
        wx = last * ca
        wy = last * sa
        k = 1.0 / limit
        return (
            wx * limit, wy * limit, last, wx, wy,
            (t1[0] * k, t1[1] * k, t1[2] * k, t1[3] * k),
            (t2[0] * k, t2[1] * k, t2[2] * k, t2[3] * k),
        )  # fmt: skip
    if model == LUGRE:
        new, share, tangents = lugre_update(
            (sx, sy), (d1x, d1y), (d2x, d2y), limit, p[STEP], p[STATIC_RATIO], p[STRIBECK],
            p[RATE_DAMPING], p[SLIP_DAMPING], int(p[LAW]),
        )  # fmt: skip
        return new[0], new[1], 0.0, share[0], share[1], tangents[0], tangents[1]
    new, share, tangents = update((sx, sy), (d1x, d1y), (d2x, d2y), limit, p[EXPONENT], int(p[LAW]))
    t1 = tangents[0]
    t2 = tangents[1]
    k = 1.0 / limit
    return (
        new[0], new[1], 0.0, share[0], share[1],
        (t1[0] * k, t1[1] * k, t1[2] * k, t1[3] * k),
        (t2[0] * k, t2[1] * k, t2[2] * k, t2[3] * k),
    )  # fmt: skip


@kernel
def aimed_slip(
    sx, sy, size, d1x, d1y, d2x, d2y, one_sided, p, full, give, aim_x, aim_y
):  # fmt: skip
    """What to add to the first part of the slip so that friction plus ``give`` slip is ``aim``.

    Parameters
    ----------
    sx, sy, size, d1x, d1y, d2x, d2y, one_sided, p
        As in `share_and_tangent`.
    full : float
        Stress of full friction mu p, Pa.
    give : float
        Stiffness, Pa/m.
    aim_x, aim_y : float
        Pa.

    Returns
    -------
    tuple of 2 floats
        m; nothing if it is not found.
    """
    limit = p[LIMIT]
    dx = d1x + d2x
    dy = d1y + d2y
    if int(p[MODEL]) == COULOMB:
        k = full / limit
        ex = (aim_x - k * sx) / (k + give)
        ey = (aim_y - k * sy) / (k + give)
        if (sx + ex) ** 2 + (sy + ey) ** 2 > limit * limit:
            nx = aim_x + give * sx
            ny = aim_y + give * sy
            length = math.sqrt(nx * nx + ny * ny)
            reach = (length - full) / give
            ex = reach * nx / length - sx
            ey = reach * ny / length - sy
        return ex - dx, ey - dy
    best = np.inf
    mx = 0.0
    my = 0.0
    # From the slip itself, or from none.
    for start in range(2):
        ax = d1x if start == 0 else -d2x
        ay = d1y if start == 0 else -d2y
        _, _, _, wx, wy, _, _ = share_and_tangent(sx, sy, size, ax, ay, d2x, d2y, one_sided, p)
        rx = full * wx + give * (ax + d2x) - aim_x
        ry = full * wy + give * (ay + d2y) - aim_y
        miss = rx * rx + ry * ry
        if miss < best:
            best = miss
            mx = ax
            my = ay
    for _ in range(60):
        _, _, _, wx, wy, t, _ = share_and_tangent(sx, sy, size, mx, my, d2x, d2y, one_sided, p)
        rx = full * wx + give * (mx + d2x) - aim_x
        ry = full * wy + give * (my + d2y) - aim_y
        kxx = full * t[0] + give
        kxy = full * t[1]
        kyx = full * t[2]
        kyy = full * t[3] + give
        det = kxx * kyy - kxy * kyx
        if not det > 0.0:
            break
        cx = -(kyy * rx - kxy * ry) / det
        cy = -(kxx * ry - kyx * rx) / det
        step = 1.0
        now = best
        while step > 1e-3:
            ax = mx + step * cx
            ay = my + step * cy
            _, _, _, wx, wy, _, _ = share_and_tangent(sx, sy, size, ax, ay, d2x, d2y, one_sided, p)
            rx = full * wx + give * (ax + d2x) - aim_x
            ry = full * wy + give * (ay + d2y) - aim_y
            miss = rx * rx + ry * ry
            if miss < best:
                best = miss
                mx = ax
                my = ay
                break
            step *= 0.5
        if not best < now or best <= 1e-24 * (full * full + aim_x * aim_x + aim_y * aim_y):
            break
    return mx - d1x, my - d1y


@dataclass(frozen=True)
class PointFriction:
    r"""A friction law made ready for a point of contact.

    Attributes
    ----------
    model : int
        `COULOMB`, `DAHL`, `LUGRE` or `TWO_PHASE` (Dahl's law by the thesis's explicit phases).
    mu : float
        Coefficient of friction; 0 for none.
    limit : float
        Deflection at full friction :math:`s_{max}`, m. Coulomb: the elastic slip, to be chosen
        well below the tangential compliance of what is in contact.
    law : int
        `asperity.friction.LAWS`.
    exponent : float
        Dahl's exponent.
    static_ratio, stribeck_velocity, rate_damping, slip_damping : float
        LuGre's numbers as `asperity.friction.lugre_update` takes them, SI.
    """

    model: int = COULOMB
    mu: float = 0.0
    limit: float = 1e-9
    law: int = 2
    exponent: float = 1.0
    static_ratio: float = 1.0
    stribeck_velocity: float = 0.0
    rate_damping: float = 0.0
    slip_damping: float = 0.0

    def __post_init__(self) -> None:
        if not (math.isfinite(self.mu) and self.mu >= 0.0):
            raise InputError(f"mu is {self.mu:g}; it must be 0 or more")
        if not (math.isfinite(self.limit) and self.limit > 0.0):
            raise InputError(f"the limit of the deflection is {self.limit:g} m; give more than 0")
        if self.model == TWO_PHASE and (self.law != SPLIT or self.exponent < 1.0):
            raise InputError("the two-phase scheme needs law 'split' and an exponent of 1 or more")

    @classmethod
    def of(
        cls,
        friction: Friction,
        normal_force: float,
        *,
        elastic_slip: float = 1e-9,
        two_phase: bool = False,
    ) -> PointFriction:
        """Take the numbers of a `[friction]` table.

        Parameters
        ----------
        friction : Friction
            The table; its forces (stiffness, damping) are those of the whole contact.
        normal_force : float
            Nominal normal force they belong to, N.
        elastic_slip : float
            Coulomb's elastic slip, m.
        two_phase : bool
            Advance Dahl's law by the thesis's explicit phases.
        """
        full = friction.mu * normal_force
        if not full > 0.0:
            raise InputError(f"normal force is {normal_force:g} N; it must be positive")
        if friction.model == "coulomb":
            return cls(COULOMB, friction.mu, elastic_slip)
        limit = friction.deflection_limit(normal_force)
        if friction.model == "dahl":
            model = TWO_PHASE if two_phase else DAHL
            return cls(model, friction.mu, limit, friction.law_code, friction.exponent)
        return cls(
            LUGRE,
            friction.mu,
            limit,
            friction.law_code,
            1.0,
            (friction.static_mu or friction.mu) / friction.mu,
            friction.stribeck_velocity,
            friction.contact_damping / full,
            friction.viscous_damping / full,
        )

    def parameters(self, step: float) -> FloatArray:
        """Numbers as `share_and_tangent` takes them, for a time step in s (LuGre needs it)."""
        if self.model == LUGRE and not step > 0.0:
            raise InputError(f"step is {step:g} s; LuGre friction needs a positive time step")
        p = np.empty(PARAMETERS)
        p[MODEL], p[LAW], p[MU], p[LIMIT] = self.model, self.law, self.mu, self.limit
        p[EXPONENT], p[STATIC_RATIO] = self.exponent, self.static_ratio
        p[STRIBECK], p[RATE_DAMPING] = self.stribeck_velocity, self.rate_damping
        p[SLIP_DAMPING], p[STEP] = self.slip_damping, step
        return p

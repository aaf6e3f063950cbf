r"""Friction at one point of a contact: the friction room's update in stress form.

The traction on the body is :math:`-\mu p\,\sigma` with the friction share :math:`\sigma` that the
laws of `asperity.friction` return. Where a reference pressure is given, the asperities of Dahl and
LuGre keep their stiffness, and the limit of their deflection follows the pressure; else the limit
holds at any pressure, and so it does for Coulomb friction, which sticks by an elastic slip
(`asperity.friction.return_mapping`), and for the two-phase scheme.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from asperity.errors import InputError
from asperity.friction import Friction, lugre_update, update
from asperity.friction.dahl import SPLIT, TINY, advance
from asperity.friction.loaded import STIFFNESS, advance_loaded
from asperity.friction.loaded_tangent import update_loaded
from asperity.friction.lugre import lugre_loaded
from asperity.friction.return_mapping import return_mapping
from asperity.friction.two_phase import phases_and_tangent
from asperity.kernels.compiled import kernel

COULOMB = 0
DAHL = 1
LUGRE = 2
TWO_PHASE = 3


class PointNumbers(NamedTuple):
    """What the kernels know of a `PointFriction`; the attributes are its, but for the step."""

    model: int
    law: int
    mu: float
    limit: float
    exponent: float
    static_ratio: float
    stribeck_velocity: float
    rate_damping: float
    slip_damping: float
    step: float
    reference: float


@kernel
def share_of(sx, sy, size, d1x, d1y, d2x, d2y, one_sided, p, pressure):
    """Friction share after a slip, without its tangent.

    Parameters and result as `share_and_tangent`, less the tangents.
    """
    model = p.model
    limit = p.limit
    if model == DAHL and p.reference > 0.0:
        load = max(pressure / p.reference, TINY)
        nsx, nsy, wx, wy = advance_loaded(
            sx / limit, sy / limit, d1x / limit, d1y / limit, d2x / limit, d2y / limit,
            size, load, p.exponent, p.law, STIFFNESS,
        )  # fmt: skip
        return nsx * limit, nsy * limit, load, wx / load, wy / load
    if model == DAHL:
        wx, wy = advance(
            sx / limit, sy / limit, d1x / limit, d1y / limit, d2x / limit, d2y / limit,
            p.exponent, p.law,
        )  # fmt: skip
        return wx * limit, wy * limit, 0.0, wx, wy
    nsx, nsy, nsize, wx, wy, _, _, _ = share_and_tangent(
        sx, sy, size, d1x, d1y, d2x, d2y, one_sided, p, pressure
    )
    return nsx, nsy, nsize, wx, wy


@kernel
def share_and_tangent(sx, sy, size, d1x, d1y, d2x, d2y, one_sided, p, pressure):
    """Friction share after a slip, with its tangent.

    Parameters
    ----------
    sx, sy : float
        Committed deflection in the tangent plane, m.
    size : float
        Two-phase scheme: its signed size over the limit. Stiffness kept: the pressure there was,
        over the reference.
    d1x, d1y, d2x, d2y : float
        The two parts of the slip of the body on the surface, m.
    one_sided : bool
        Two-phase scheme: before the start of the vibration.
    p : PointNumbers
        The law.
    pressure : float
        At the end, Pa; above 0.

    Returns
    -------
    sx, sy, size : float
        Trial deflection, m, and signed size or pressure over the reference.
    share_x, share_y : float
        Friction over mu p, in the direction of the slip.
    tangent_1, tangent_2 : tuple of 4 floats
        Derivative of the share by the slip parts, 1/m.
    slope : tuple of 2 floats
        Derivative by the pressure of the share times it; the share, where the limit does not
        follow the pressure.
    """
    model = p.model
    limit = p.limit
    if model == COULOMB:
        wx, wy, txx, txy, tyy = return_mapping(sx, sy, d1x + d2x, d1y + d2y, limit)
        tangent = (txx, txy, txy, tyy)
        return wx * limit, wy * limit, 0.0, wx, wy, tangent, tangent, (wx, wy)
    if model == TWO_PHASE:
        last, ca, sa, t1, t2 = phases_and_tangent(
            sx / limit, sy / limit, size, d1x / limit, d1y / limit, d2x / limit, d2y / limit,
            p.exponent, one_sided,
        )  # fmt: skip
        wx = last * ca
        wy = last * sa
        k = 1.0 / limit
        return (
            wx * limit, wy * limit, last, wx, wy,
            (t1[0] * k, t1[1] * k, t1[2] * k, t1[3] * k),
            (t2[0] * k, t2[1] * k, t2[2] * k, t2[3] * k),
            (wx, wy),
        )  # fmt: skip
    kept = p.reference > 0.0
    load = max(pressure / p.reference, TINY) if kept else 0.0
    if model == LUGRE and kept:
        new, share, tangents, slope = lugre_loaded(
            (sx, sy), (d1x, d1y), (d2x, d2y), limit, size, load, p.step, p.static_ratio,
            p.stribeck_velocity, p.rate_damping, p.slip_damping, p.law,
        )  # fmt: skip
        return new[0], new[1], load, share[0], share[1], tangents[0], tangents[1], slope
    if model == LUGRE:
        new, share, tangents = lugre_update(
            (sx, sy), (d1x, d1y), (d2x, d2y), limit, p.step, p.static_ratio, p.stribeck_velocity,
            p.rate_damping, p.slip_damping, p.law,
        )  # fmt: skip
        return new[0], new[1], 0.0, share[0], share[1], tangents[0], tangents[1], share
    if kept:
        new, share, _, tangents, slopes = update_loaded(
            (sx / limit, sy / limit), (d1x / limit, d1y / limit), (d2x / limit, d2y / limit),
            size, load, p.exponent, p.law, STIFFNESS,
        )  # fmt: skip
        new = (new[0] * limit, new[1] * limit)
        share = (share[0] / load, share[1] / load)
        slope = slopes[1]
        k = 1.0 / (limit * load)
    else:
        new, share, tangents = update((sx, sy), (d1x, d1y), (d2x, d2y), limit, p.exponent, p.law)
        slope = share
        k = 1.0 / limit
    t1 = tangents[0]
    t2 = tangents[1]
    return (
        new[0], new[1], load, share[0], share[1],
        (t1[0] * k, t1[1] * k, t1[2] * k, t1[3] * k),
        (t2[0] * k, t2[1] * k, t2[2] * k, t2[3] * k),
        slope,
    )  # fmt: skip


@kernel
def _miss(sx, sy, size, d1x, d1y, d2x, d2y, one_sided, p, full, augmentation, aim_x, aim_y):
    """How far friction plus r times a slip is from ``aim``, squared; all as `augmented_slip`."""
    _, _, _, wx, wy = share_of(sx, sy, size, d1x, d1y, d2x, d2y, one_sided, p, full / p.mu)
    rx = full * wx + augmentation * (d1x + d2x) - aim_x
    ry = full * wy + augmentation * (d1y + d2y) - aim_y
    return rx * rx + ry * ry


@kernel
def augmented_slip(
    sx, sy, size, d1x, d1y, d2x, d2y, one_sided, p, full, augmentation, aim_x, aim_y
):  # fmt: skip
    """What to add to the first part of the slip so that friction plus r times it is ``aim``.

    Parameters
    ----------
    sx, sy, size, d1x, d1y, d2x, d2y, one_sided, p
        As in `share_and_tangent`.
    full : float
        Stress of full friction mu p, Pa.
    augmentation : float
        Alart and Curnier's r, Pa/m.
    aim_x, aim_y : float
        Pa.

    Returns
    -------
    tuple of 2 floats
        m; nothing if it is not found.
    """
    limit = p.limit
    dx = d1x + d2x
    dy = d1y + d2y
    if p.model == COULOMB:
        k = full / limit
        ex = (aim_x - k * sx) / (k + augmentation)
        ey = (aim_y - k * sy) / (k + augmentation)
        if (sx + ex) ** 2 + (sy + ey) ** 2 > limit * limit:
            nx = aim_x + augmentation * sx
            ny = aim_y + augmentation * sy
            length = math.sqrt(nx * nx + ny * ny)
            reach = (length - full) / augmentation
            ex = reach * nx / length - sx
            ey = reach * ny / length - sy
        return ex - dx, ey - dy
    pressure = full / p.mu
    best = np.inf
    mx = 0.0
    my = 0.0
    # From the slip itself, or from none.
    for start in range(2):
        ax = d1x if start == 0 else -d2x
        ay = d1y if start == 0 else -d2y
        miss = _miss(sx, sy, size, ax, ay, d2x, d2y, one_sided, p, full, augmentation, aim_x, aim_y)
        if miss < best:
            best = miss
            mx = ax
            my = ay
    for _ in range(60):
        _, _, _, wx, wy, t, _, _ = share_and_tangent(
            sx, sy, size, mx, my, d2x, d2y, one_sided, p, pressure
        )
        rx = full * wx + augmentation * (mx + d2x) - aim_x
        ry = full * wy + augmentation * (my + d2y) - aim_y
        kxx = full * t[0] + augmentation
        kxy = full * t[1]
        kyx = full * t[2]
        kyy = full * t[3] + augmentation
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
            miss = _miss(
                sx, sy, size, ax, ay, d2x, d2y, one_sided, p, full, augmentation, aim_x, aim_y
            )
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
    reference : float
        Pressure to which Dahl's and LuGre's limit belongs, Pa: their stiffness stays and the limit
        follows the pressure. 0: the limit holds at any pressure, by which friction can gain energy.
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
    reference: float = 0.0

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
        area: float,
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
        area : float
            Over which it is spread, m^2.
        elastic_slip : float
            Coulomb's elastic slip, m.
        two_phase : bool
            Advance Dahl's law by the thesis's explicit phases.
        """
        if friction.model == "springs":
            raise InputError(
                "friction.model is 'springs'; the points of an elastic contact, which have a "
                "pressure each, take 'dahl' of exponent 0 for it"
            )
        if friction.load_exponent != 1.0:
            raise InputError(
                f"friction.load_exponent is {friction.load_exponent:g}; friction at the points of "
                "an elastic contact is proportional to the pressure: leave it out"
            )
        if two_phase and "keeps" in friction.model_fields_set and friction.keeps == "stiffness":
            raise InputError(
                "friction.keeps is 'stiffness'; solve.scheme 'two-phase' keeps the deflection: "
                "give that, or leave the scheme out"
            )
        full = friction.mu * normal_force
        if not full > 0.0:
            raise InputError(f"normal force is {normal_force:g} N; it must be positive")
        if friction.model == "coulomb":
            return cls(COULOMB, friction.mu, elastic_slip)
        limit = friction.deflection_limit(normal_force)
        stays = two_phase or friction.keeps == "deflection"
        reference = 0.0 if stays else normal_force / area
        if friction.model == "dahl":
            model = TWO_PHASE if two_phase else DAHL
            return cls(
                model, friction.mu, limit, friction.law_code, friction.exponent,
                reference=reference,
            )  # fmt: skip
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
            reference,
        )

    @property
    def keeps_deflection(self) -> bool:
        """Whether asperities keep their deflection where the pressure changes, and gain energy."""
        return self.model != COULOMB and self.mu > 0.0 and self.reference == 0.0

    def numbers(self, step: float) -> PointNumbers:
        """The law as kernels take it, for a time step in s (LuGre needs it)."""
        if self.model == LUGRE and not step > 0.0:
            raise InputError(f"step is {step:g} s; LuGre friction needs a positive time step")
        return PointNumbers(
            self.model, self.law, float(self.mu), float(self.limit), float(self.exponent),
            float(self.static_ratio), float(self.stribeck_velocity), float(self.rate_damping),
            float(self.slip_damping), float(step), float(self.reference),
        )  # fmt: skip

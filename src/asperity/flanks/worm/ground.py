r"""Flanks that a disc grinds: ZK by a straight-sided one, ZC by one with a convex arc as profile.

The disc's axis is square to the thread at the pitch radius and lies at the centre distance
:math:`r_1 + R` from the worm's. With :math:`\sigma` along the disc's profile and :math:`\varphi`
about its axis, a point :math:`P` of the disc with the normal :math:`n` touches the flank where the
screw motion leaves it on the disc (names as in ISO/TR 10828),

.. math:: n \cdot v = -y\,n_x + x\,n_y + p\,n_z = 0 .

For each radius :math:`\rho` this and :math:`x^2 + y^2 = \rho^2` give both parameters. Then
:math:`w = z - p \arctan(y/x)`, :math:`w' = -n_\rho/n_z`, and :math:`w''` by differentiating both
equations. Lengths in mm, angles in rad.
"""

import dataclasses
import math
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from asperity.arrays import FloatArray
from asperity.errors import InputError
from asperity.flanks.worm.profiles import AxialProfile, tabulate

_ITERATIONS = 50
_TOLERANCE = 1e-12
_ROUNDING = 1e-13
_FIRST_COUNT = 129
_LAST_COUNT = 4097
_TABLE_ERROR = 1e-12
_BISECTIONS = 30
_ABOVE_LIMIT = 0.1


@dataclasses.dataclass(frozen=True)
class GrindingDisc:
    r"""A disc set to grind the thread space of a worm of so large a pitch radius and lead angle.

    Attributes
    ----------
    radius, half_width, pressure_angle : float
        Of the disc where it touches the pitch cylinder: :math:`R` and half its width, mm, and
        :math:`\alpha_n` of its profile.
    profile_radius : float
        Of its profile's arc, mm; infinite for a cone.
    """

    radius: float
    half_width: float
    pressure_angle: float
    profile_radius: float
    pitch_radius: float
    lead_angle: float

    @property
    def reduced_lead(self) -> float:
        """:math:`p` of the worm, mm."""
        return self.pitch_radius * math.tan(self.lead_angle)

    def profile(self, sigma: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
        """Return radius and half width of the disc, and the angle and curvature of its normal."""
        if math.isinf(self.profile_radius):
            angle = np.full_like(sigma, self.pressure_angle)
            radius = self.radius + sigma * math.cos(self.pressure_angle)
            width = self.half_width - sigma * math.sin(self.pressure_angle)
            return radius, width, angle, np.zeros_like(sigma)
        r, alpha = self.profile_radius, self.pressure_angle
        angle = alpha + sigma / r
        radius = self.radius + r * (np.sin(angle) - math.sin(alpha))
        width = self.half_width + r * (np.cos(angle) - math.cos(alpha))
        return radius, width, angle, np.full_like(sigma, 1.0 / r)

    def _vector(self, radial: FloatArray, axial: FloatArray, phi: FloatArray) -> FloatArray:
        sine, cosine = math.sin(self.lead_angle), math.cos(self.lead_angle)
        across = radial * np.sin(phi)
        return np.stack(
            [
                -radial * np.cos(phi),
                across * cosine - axial * sine,
                across * sine + axial * cosine,
            ]
        )

    def surface(self, sigma: FloatArray, phi: FloatArray) -> "Surface":
        """Return points, normals and their derivatives in the worm's frame, at phase zero."""
        radius, width, angle, curvature = self.profile(sigma)
        zero = np.zeros_like(sigma)
        along = self._vector(np.cos(angle), -np.sin(angle), phi)
        turn = self._vector(np.ones_like(phi), zero, phi + math.pi / 2.0)
        point = self._vector(radius, width, phi)
        point[0] += self.pitch_radius + self.radius
        normal = self._vector(np.sin(angle), np.cos(angle), phi)
        return Surface(point, normal, along, radius * turn, curvature * along, np.sin(angle) * turn)


class Surface(NamedTuple):
    """Points and normals of a disc ``(3, n)`` and their derivatives by sigma and phi."""

    point: FloatArray
    normal: FloatArray
    point_sigma: FloatArray
    point_phi: FloatArray
    normal_sigma: FloatArray
    normal_phi: FloatArray


class Contact(NamedTuple):
    """Where a disc touches the flank: by radius, the axial section and the disc's parameters."""

    w: FloatArray
    w1: FloatArray
    w2: FloatArray
    sigma: FloatArray
    phi: FloatArray


def _meshing(p: float, at: Surface, point: FloatArray, normal: FloatArray) -> FloatArray:
    """Change of ``n . v`` for changes of point and normal."""
    change: FloatArray = (
        -point[1] * at.normal[0]
        - at.point[1] * normal[0]
        + point[0] * at.normal[1]
        + at.point[0] * normal[1]
        + p * normal[2]
    )
    return change


def contact(disc: GrindingDisc, radius: npt.ArrayLike) -> Contact:
    """Return where a disc touches the flank at radii of the worm, mm; InputError if it cannot."""
    rho = np.atleast_1d(np.asarray(radius, dtype=np.float64))
    p = disc.reduced_lead
    sigma = (disc.pitch_radius - rho) / math.cos(disc.pressure_angle)
    phi = np.zeros_like(rho)
    settled = False
    with np.errstate(all="ignore"):
        for _ in range(_ITERATIONS):
            at = disc.surface(sigma, phi)
            (x, y, _), n = at.point, at.normal
            rest_mesh = -y * n[0] + x * n[1] + p * n[2]
            rest_radius = 0.5 * (x * x + y * y - rho * rho)
            mesh_sigma = _meshing(p, at, at.point_sigma, at.normal_sigma)
            mesh_phi = _meshing(p, at, at.point_phi, at.normal_phi)
            radius_sigma = x * at.point_sigma[0] + y * at.point_sigma[1]
            radius_phi = x * at.point_phi[0] + y * at.point_phi[1]
            determinant = mesh_sigma * radius_phi - mesh_phi * radius_sigma
            step_sigma = (mesh_phi * rest_radius - radius_phi * rest_mesh) / determinant
            step_phi = (radius_sigma * rest_mesh - mesh_sigma * rest_radius) / determinant
            if settled:
                break
            small = np.maximum(np.abs(step_sigma), disc.radius * np.abs(step_phi))
            settled = bool(np.all(small <= _TOLERANCE * disc.radius))
            sigma = sigma + step_sigma
            phi = phi + step_phi
        else:
            raise InputError(_unreached(disc, rho[~(small <= _TOLERANCE * disc.radius)]))
    # The normal's component along the radius, times the radius.
    outward = n[0] * x + n[1] * y
    # Beyond the limit of what can be ground the equations have other solutions, or none.
    wrong = (n[2] <= 0.0) | (x <= 0.0) | (outward >= 0.0) | (determinant <= 0.0)
    if wrong.any():
        raise InputError(_unreached(disc, rho[wrong]))
    sigma_rho = -rho * mesh_phi / determinant
    phi_rho = rho * mesh_sigma / determinant
    dx, dy, _ = at.point_sigma * sigma_rho + at.point_phi * phi_rho
    dn = at.normal_sigma * sigma_rho + at.normal_phi * phi_rho
    outward_rho = dn[0] * x + n[0] * dx + dn[1] * y + n[1] * dy
    w1 = -outward / (rho * n[2])
    w2 = -outward_rho / (rho * n[2]) - w1 * (1.0 / rho + dn[2] / n[2])
    return Contact(at.point[2] - p * np.arctan2(y, x), w1, w2, sigma, phi)


def _unreached(disc: GrindingDisc, radii: FloatArray) -> str:
    flank = "ZK" if math.isinf(disc.profile_radius) else "ZC"
    return (
        f"gearset.flank is '{flank}'; its disc of {2.0 * disc.radius:.5g} mm cannot grind the "
        f"worm at a radius of {float(radii[0]):.4g} mm: take a larger pressure angle, a smaller "
        "lead angle or another disc"
    )


def fit(
    pitch_radius: float,
    lead_angle: float,
    pressure_angle: float,
    half_space: float,
    radius: float,
    profile_radius: float = math.inf,
) -> GrindingDisc:
    """Return the disc whose width makes the thread space as wide as wanted, all in mm and rad."""
    disc = GrindingDisc(
        radius,
        half_space * math.cos(lead_angle),
        pressure_angle,
        profile_radius,
        pitch_radius,
        lead_angle,
    )
    for _ in range(_ITERATIONS):
        touch = contact(disc, pitch_radius)
        at = disc.surface(touch.sigma, touch.phi)
        _, _, angle, _ = disc.profile(touch.sigma)
        rest = half_space - float(touch.w[0])
        step = rest * float(at.normal[2, 0]) / math.cos(float(angle[0]))
        disc = dataclasses.replace(disc, half_width=disc.half_width + step)
        if abs(step) <= _ROUNDING * half_space:
            return disc
    raise InputError(_unreached(disc, np.array([pitch_radius])))


def lowest(disc: GrindingDisc, root: float, needed: float) -> float:
    """Return the least radius, from the root on, that a disc grinds, mm.

    InputError where it lies above the radius down to which the flank is needed.
    """

    def reaches(radius: float) -> bool:
        try:
            contact(disc, radius)
        except InputError:
            return False
        return True

    if reaches(root):
        return root
    if not reaches(needed):
        raise InputError(_unreached(disc, np.array([needed])))
    low, high = root, needed
    for _ in range(_BISECTIONS):
        middle = 0.5 * (low + high)
        low, high = (low, middle) if reaches(middle) else (middle, high)
    # At the limit itself the curvature is infinite, and no table could follow it.
    return min(high + _ABOVE_LIMIT * (needed - root), needed)


def ground(
    flank: str, disc: GrindingDisc, root: float, needed: float, outer: float
) -> AxialProfile:
    """Return the profile that a disc grinds, between two radii of the worm in mm.

    The table is refined until it is within 1e-12 mm of the disc half-way between its radii. The
    disc must grind the flank from the radius ``needed`` on; where it does not grind down to the
    root, a straight line goes on.
    """
    inner = lowest(disc, root, needed)
    count = _FIRST_COUNT
    while count <= _LAST_COUNT:
        radii, step = np.linspace(inner, outer, count, retstep=True)
        touch = contact(disc, radii)
        profile = tabulate(flank, inner, float(step), touch.w, touch.w1, touch.w2)
        middle = radii[:-1] + 0.5 * step
        if np.abs(profile(middle) - contact(disc, middle).w).max() <= _TABLE_ERROR:
            return profile
        count = 2 * count - 1
    raise InputError(_unreached(disc, np.array([inner])))

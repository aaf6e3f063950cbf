"""What gives between worm and housing: bending, bearings, torsion and seat, at the mesh and wheel.

The frame is that of the mesh: ``axial`` along the worm's axis, positive where the wheel's tooth is
pushed; ``tangential`` along the wheel's axis, positive as the driving worm's thread moves there;
``radial`` from the worm's axis to the wheel's. Forces are those on the wheel; on the worm they are
opposite. Coordinates of the worm are its turn and these three shifts of the point of contact.
"""

import dataclasses
import math
from collections.abc import Mapping

import numpy as np

from asperity.arrays import FloatArray
from asperity.drive.parameters import STEEL_MODULUS, Shaft
from asperity.drive.point import MeshPoint
from asperity.errors import InputError

COORDINATES = ("turn", "axial", "tangential", "radial")
"""Of the worm, as the rows and columns of a compliance stand: rad, m, m, m."""

_MILLIMETRES = 1e3


@dataclasses.dataclass(frozen=True)
class MeshAction:
    """What a worm does to its wheel where they touch, for a wheel torque of 1 N m.

    Attributes
    ----------
    normal : ndarray, shape (3,)
        Unit normal from worm to wheel: axial, tangential, radial.
    force : ndarray, shape (3,)
        Force on the wheel per wheel torque, 1/m.
    radius : float
        Of the point of contact from the worm's axis, m.
    wheel_radius : float
        Arm of the axial force about the wheel's axis, m.
    """

    normal: FloatArray
    force: FloatArray
    radius: float
    wheel_radius: float

    @classmethod
    def of(cls, point: MeshPoint, friction: float) -> "MeshAction":
        """Return the action at a point of the worm.

        Parameters
        ----------
        point : MeshPoint
            Where they touch.
        friction : float
            Coefficient of friction, worm driving; negative for the wheel driving, 0 for none.

        Raises
        ------
        InputError
            Friction keeps the worm from driving.
        """
        sliding = np.array([-point.lead, point.radius, 0.0]) / point.length
        tangential = point.normal_z * point.lead / point.radius
        normal = np.array([point.normal_z, tangential, point.normal_radial])
        force = point.normal_force(1.0, friction) * (normal + friction * sliding)
        return cls(normal, force, point.radius, point.arm)

    @property
    def worm_torque(self) -> float:
        """Torque of the worm per wheel torque: the inverse of the mechanical advantage."""
        return float(self.radius * self.force[1])

    @property
    def _forces(self) -> FloatArray:
        return np.array([self.worm_torque, *self.force])

    @property
    def _turns(self) -> FloatArray:
        """Turn of the wheel per coordinate of the worm, the flanks kept as close."""
        lever = np.array([self.radius * self.normal[1], *self.normal])
        turns: FloatArray = lever / (self.normal[0] * self.wheel_radius)
        return turns

    def yielded(self, compliance: FloatArray) -> FloatArray:
        """Return how far the worm yields per wheel torque, by its coordinates: rad, m per N m."""
        yielded: FloatArray = compliance @ self._forces
        return yielded

    def at_wheel(self, compliance: FloatArray) -> float:
        """Return the turn that the wheel loses per its torque, rad/(N m).

        With friction the way that forces take in is not the one that the flanks leave, and the
        turn is not the second derivative of an energy.
        """
        return float(self._turns @ self.yielded(compliance))


def beam_with_ends(
    span: float, position: float, stiffness: float, first: float, second: float
) -> FloatArray:
    """Return deflection and slope of a beam under a force and a moment at one place.

    Beam tables (Roark's Formulas for Stress and Strain, simply supported, intermediate load and
    intermediate couple), and the beam as a rigid body on its ends.

    Parameters
    ----------
    span : float
        Between the ends, m.
    position : float
        Distance of the load from the first end, m; 0 < position < span.
    stiffness : float
        Bending stiffness E I, N m2; infinite for a rigid beam.
    first, second : float
        Stiffness of the ends, N/m; infinite for rigid ones.

    Returns
    -------
    ndarray, shape (2, 2)
        Deflection and slope (rows) per force and moment (columns): m/N, rad/N; m/(N m), rad/(N m).
        The moment works along the slope.
    """
    if not 0.0 < position < span:
        raise InputError(
            f"position is {_MILLIMETRES * position:g} mm; it must lie between the bearings, "
            f"{_MILLIMETRES * span:g} mm apart"
        )
    a, b = position, span - position
    bent = np.array([[a**2 * b**2, a * b * (b - a)], [a * b * (b - a), a**2 - a * b + b**2]]) / (
        3.0 * stiffness * span
    )
    rigid = [np.array([b, -1.0]) / span, np.array([a, 1.0]) / span]
    ends = sum(
        np.outer(share, share) / end for share, end in zip(rigid, (first, second), strict=True)
    )
    return np.asarray(bent + ends)


def bending_stiffness(diameter: float, youngs_modulus: float) -> float:
    """Return E I of a round solid shaft, N m2; diameter in m, modulus in Pa."""
    return youngs_modulus * math.pi * diameter**4 / 64.0


def compliances(
    radius: float,
    *,
    span: float | None = None,
    position: float | None = None,
    bending: float | None = None,
    bearing_radial: float | None = None,
    bearing_axial: float | None = None,
    torsion: float | None = None,
    seat: float | None = None,
    housing: float | None = None,
) -> Mapping[str, FloatArray]:
    """Return what each part between worm and housing gives at the point of contact.

    Parameters
    ----------
    radius : float
        Of the point of contact from the worm's axis, m: the axial force bends the shaft by it.
    span : float, optional
        Between the worm's bearings, m. Needed for bending and radial bearings.
    position : float, optional
        Distance of the wheel's middle from the first bearing, m; half the span if left out.
    bending : float, optional
        Bending stiffness E I of the worm's shaft, N m2.
    bearing_radial : float, optional
        Stiffness of each bearing, N/m.
    bearing_axial : float, optional
        Stiffness of the bearing that locates the shaft, N/m.
    torsion : float, optional
        Stiffness of the shaft between worm and motor, N m/rad.
    seat : float, optional
        Stiffness along the axis of what the locating bearing sits in, N/m.
    housing : float, optional
        Stiffness of the housing between worm and wheel along the centre distance, N/m.

    Returns
    -------
    mapping of str to ndarray, shape (4, 4)
        By contributor, of those that are given; what is left out is rigid. Rows and columns as
        `COORDINATES`; symmetric.

    Raises
    ------
    InputError
        A stiffness that is not positive, no span where it is needed, or a place beyond the
        bearings.
    """
    found: dict[str, FloatArray] = {}

    def alone(name: str, at: int, stiffness: float | None) -> None:
        if stiffness is not None:
            found[name] = np.zeros((4, 4))
            found[name][at, at] = 1.0 / _positive(name, stiffness)

    def across(name: str, beam: FloatArray) -> None:
        # A slope in the plane of both axes takes the point of contact along the worm's axis.
        lever = np.array([[0.0, -radius], [0.0, 0.0], [1.0, 0.0]])
        radial = lever @ beam @ lever.T
        found[name] = np.zeros((4, 4))
        found[name][1:, 1:] = radial
        found[name][2, 2] += beam[0, 0]

    if bending is not None or bearing_radial is not None:
        if span is None:
            raise InputError("span is missing; a shaft bends, and bearings yield, over their span")
        at = 0.5 * span if position is None else position
        rigid = math.inf
        if bending is not None:
            stiffness = _positive("bending", bending)
            across("bending", beam_with_ends(span, at, stiffness, rigid, rigid))
        if bearing_radial is not None:
            end = _positive("bearing_radial", bearing_radial)
            across("bearing_radial", beam_with_ends(span, at, rigid, end, end))
    alone("bearing_axial", 1, bearing_axial)
    alone("torsion", 0, torsion)
    alone("seat", 1, seat)
    alone("housing", 3, housing)
    return found


def compliances_of(shaft: Shaft, radius: float) -> Mapping[str, FloatArray]:
    """Return what the parts of a ``[shaft]`` give; as `compliances`.

    The wheel stands in the middle between the bearings, the shaft is of steel, and the stiffness of
    its radial bearings is with their seats.

    Parameters
    ----------
    shaft : Shaft
        Its table; what it leaves out is rigid.
    radius : float
        Of the point of contact from the worm's axis, m.

    Returns
    -------
    mapping of str to ndarray, shape (4, 4)
        By contributor, as of `compliances`.

    Raises
    ------
    InputError
        As of `compliances`.
    """
    thick = None
    if shaft.diameter is not None and shaft.span is not None:
        thick = bending_stiffness(shaft.diameter, STEEL_MODULUS)
    return compliances(
        radius,
        span=shaft.span,
        bending=thick,
        bearing_radial=shaft.bearing_radial,
        bearing_axial=shaft.bearing_axial,
        torsion=shaft.torsion,
        seat=shaft.seat,
        housing=shaft.housing,
    )


@dataclasses.dataclass(frozen=True)
class Bending:
    """Freedoms of a worm on a shaft that bends and on bearings that yield across the axis.

    Attributes
    ----------
    stiffness, mass : ndarray, shape (3,)
        At the point of contact along `COORDINATES` 1 to 3, N/m and kg: axial by the worm's tilt,
        tangential, radial.
    """

    stiffness: FloatArray
    mass: FloatArray


def bends(shaft: Shaft) -> bool:
    """Whether something of a ``[shaft]`` gives across the worm's axis."""
    thick = shaft.diameter is not None and shaft.span is not None
    return thick or shaft.bearing_radial is not None


def bending_of(shaft: Shaft, radius: float, mass: float) -> Bending:
    r"""Return the freedoms of a worm across its axis.

    Each is that of the static deflection under a force or a moment in the middle (Rayleigh's
    quotient): a shaft of evenly spread mass :math:`m`, of which bending gives a part :math:`b` of
    the deflection and the bearings :math:`1 - b`, moves there as
    :math:`m(\frac{17}{35}b^2 + \frac{5}{4}b(1 - b) + (1 - b)^2)`, and turns as
    :math:`m l^2(\frac{1}{210}b^2 + \frac{7}{240}b(1 - b) + \frac{1}{12}(1 - b)^2)`. Stiffness and
    first mode are the shaft's own to 1 %; its tilt swings a quarter too fast.

    Parameters
    ----------
    shaft : Shaft
        Something of it gives across the axis.
    radius : float
        Of the point of contact from the worm's axis, m.
    mass : float
        Of worm and shaft, kg.
    """
    parts = compliances_of(shaft, radius)
    none = np.zeros((4, 4))
    bent = np.diag(parts.get("bending", none))[1:]
    ends = np.diag(parts.get("bearing_radial", none) + parts.get("housing", none))[1:]
    whole = bent + ends
    b = bent / whole
    assert shaft.span is not None
    moved = 17.0 / 35.0 * b**2 + 1.25 * b * (1.0 - b) + (1.0 - b) ** 2
    turned = b**2 / 210.0 + 7.0 / 240.0 * b * (1.0 - b) + (1.0 - b) ** 2 / 12.0
    turned *= (shaft.span / radius) ** 2
    return Bending(1.0 / whole, mass * np.array([turned[0], moved[1], moved[2]]))


def _positive(name: str, stiffness: float) -> float:
    if not stiffness > 0.0:
        raise InputError(f"{name} is {stiffness:g}; a stiffness must be positive")
    return stiffness


def wheel_compliances(action: MeshAction, parts: Mapping[str, FloatArray]) -> Mapping[str, float]:
    """Return the turn that the wheel loses per its torque by each part, rad/(N m).

    Parameters
    ----------
    action : MeshAction
        What the worm does to the wheel.
    parts : mapping of str to ndarray, shape (4, 4)
        As from `compliances`.

    Returns
    -------
    mapping of str to float
        By the same names.
    """
    return {name: action.at_wheel(part) for name, part in parts.items()}

"""A worm with a helical wheel in place of one that envelops it: crossed helical gears.

Two involute helicoids with one base pitch touch at a point, which runs along a straight line that
is tangent to both base cylinders, whatever the centre distance. Its direction leans on each axis by
that gear's base helix angle; where it lies follows from the lever that it has about each axis.
Positions are in mm: x along the worm's axis, y along the wheel's, z from the wheel's axis to the
worm's, which is at z = 0. The axes are at right angles and both gears are right-handed, as a
left-handed pair is their mirror image.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from asperity.errors import InputError
from asperity.gearset.geometry import Geometry

_Vector = NDArray[np.float64]


class Helicoid(NamedTuple):
    """One of both gears.

    Attributes
    ----------
    axis, foot : array of 3
        Its direction, and a point of it.
    base_radius, base_helix : float
        mm, and the angle between generators and axis, rad.
    tip_radius, half_width : float
        mm.
    lever : float
        Of the line of contact about the axis, r_b cos(beta_b) with its sign, mm.
    """

    axis: _Vector
    foot: _Vector
    base_radius: float
    base_helix: float
    tip_radius: float
    half_width: float
    lever: float

    def along(self, point: _Vector) -> float:
        """Position of a point along the axis, mm."""
        return float((point - self.foot) @ self.axis)

    def radius(self, point: _Vector) -> float:
        """Distance of a point from the axis, mm."""
        return float(np.linalg.norm(np.cross(point - self.foot, self.axis)))


class Crossed(NamedTuple):
    """A worm and a helical wheel.

    Attributes
    ----------
    worm, wheel : Helicoid
        Both gears.
    normal : array of 3
        Direction of the line of contact, which is normal to both flanks.
    start : array of 3
        A point of that line, mm.
    normal_module, base_pitch : float
        mm; the pitch along the line of contact.
    pressure_angle : float
        Normal, at work, rad.
    helix : float
        Of the wheel's teeth, rad.
    shift : float
        Of the wheel's profile, in normal modules.
    wheel_diameter : float
        Of its reference cylinder, mm.
    ends : tuple of float
        Where contact begins and ends on the line, mm from `start`.
    ended_by : tuple of str
        What each end is of.
    """

    worm: Helicoid
    wheel: Helicoid
    normal: _Vector
    start: _Vector
    normal_module: float
    base_pitch: float
    pressure_angle: float
    helix: float
    shift: float
    wheel_diameter: float
    ends: tuple[float, float]
    ended_by: tuple[str, str]

    def at(self, way: float) -> _Vector:
        """Return the point of contact so far along the line, mm."""
        point: _Vector = self.start + way * self.normal
        return point

    @property
    def path(self) -> float:
        """Length of the path of contact, mm."""
        return self.ends[1] - self.ends[0]

    @property
    def contact_ratio(self) -> float:
        """Pairs of teeth that touch, on the mean: the path over the base pitch."""
        return self.path / self.base_pitch

    def radii_of_curvature(self, way: float) -> tuple[float, float]:
        """Return those of both flanks across their generators, mm: the way to each base cylinder.

        Parameters
        ----------
        way : float
            Along the line from `start`, mm.
        """
        found = []
        for gear in (self.worm, self.wheel):
            point = self.at(way)
            radius = math.sqrt(max(gear.radius(point) ** 2 - gear.base_radius**2, 0.0))
            found.append(radius / math.cos(gear.base_helix))
        return found[0], found[1]

    @property
    def between_generators(self) -> float:
        """Angle between the generators of both flanks where they touch, rad."""
        ways = [g.axis - (g.axis @ self.normal) * self.normal for g in (self.worm, self.wheel)]
        first, second = (way / np.linalg.norm(way) for way in ways)
        return math.acos(min(abs(float(first @ second)), 1.0))

    def sliding(self, way: float, worm_speed: float) -> _Vector:
        """Return the velocity of the worm's flank over the wheel's at a point of contact, mm/s.

        Parameters
        ----------
        way : float
            Along the line from `start`, mm.
        worm_speed : float
            rad/s.
        """
        point = self.at(way)
        # Both go equally fast along the line.
        other = worm_speed * self.worm.lever / self.wheel.lever
        turns = worm_speed * self.worm.axis, other * self.wheel.axis
        of_worm, of_wheel = (
            np.cross(turn, point - gear.foot)
            for turn, gear in zip(turns, (self.worm, self.wheel), strict=True)
        )
        relative: _Vector = of_worm - of_wheel
        return relative


def crossed(geometry: Geometry) -> Crossed:
    r"""Return the worm of a gearset with a helical wheel of the same teeth, width and tip diameter.

    Parameters
    ----------
    geometry : Geometry
        Of a gearset whose worm is an involute helicoid, ZI.

    Raises
    ------
    InputError
        The worm is no involute helicoid, or no point of the line of contact is on both flanks.

    Notes
    -----
    Both references touch on the normal module :math:`m_n = m_x \cos\gamma`, the wheel's helix angle
    is the worm's lead angle and the axes are at right angles. The normal pressure angle at work is
    then that of the hob at any centre distance, and :math:`a = (d_{m1} + z_2 m_n/\cos\gamma)/2 +
    x_n m_n` leaves no backlash. Own derivation; of The Kinematics of Crossed Helical Gears, Journal
    of Mechanical Design 104 (1982), which has the same theory, the abstract was read.
    """
    g = geometry
    if g.base_radius is None:
        raise InputError(
            "gearset.flank is not ZI; only an involute helicoid meshes with a helical wheel: leave "
            "gearset.flank out, or make it 'ZI'"
        )
    lean, turn = math.sin(g.lead_angle), math.cos(g.lead_angle)
    inner = math.cos(g.pressure_angle)
    reference = 0.5 * g.wheel_teeth * g.normal_module / turn
    # By both base helices along the axes, of right-hand gears; what is left is away from both.
    normal = np.array([turn * inner, -lean * inner, math.sin(g.pressure_angle)])
    mean = 0.5 * g.worm_pitch_diameter
    levers = -mean * inner * lean, reference * inner * turn
    worm = Helicoid(
        np.array([1.0, 0.0, 0.0]), np.zeros(3), g.base_radius, math.asin(turn * inner),
        0.5 * g.worm_tip_diameter, 0.5 * g.worm_face_width, levers[0],
    )  # fmt: skip
    helix_b = math.asin(lean * inner)
    wheel = Helicoid(
        np.array([0.0, 1.0, 0.0]), np.array([0.0, 0.0, -g.centre_distance]),
        reference * inner * turn / math.cos(helix_b), helix_b,
        0.5 * g.wheel_throat_diameter, 0.5 * g.wheel_face_width, levers[1],
    )  # fmt: skip
    # At the height of the worm's reference cylinder.
    high = -mean
    start = np.array(
        [
            ((high + g.centre_distance) * normal[0] - levers[1]) / normal[2],
            (levers[0] + high * normal[1]) / normal[2],
            high,
        ]
    )
    shift = (g.centre_distance - mean - reference) / g.normal_module
    made = Crossed(
        worm, wheel, normal, start, g.normal_module, math.pi * g.normal_module * inner,
        g.pressure_angle, g.lead_angle, shift, 2.0 * reference, (0.0, 0.0), ("", ""),
    )  # fmt: skip
    low, high_end = _ends(made)
    return made._replace(ends=(low[0], high_end[0]), ended_by=(low[1], high_end[1]))


def _ends(pair: Crossed) -> tuple[tuple[float, str], tuple[float, str]]:
    """Return where contact begins and ends, and by what; raises InputError."""
    low, high = (-math.inf, ""), (math.inf, "")
    for name, gear in (("worm", pair.worm), ("wheel", pair.wheel)):
        across = pair.normal - (pair.normal @ gear.axis) * gear.axis
        away = pair.start - gear.foot
        away = away - (away @ gear.axis) * gear.axis
        square, touch = float(across @ across), -float(away @ across) / float(across @ across)
        reach = math.sqrt(max(gear.tip_radius**2 - gear.base_radius**2, 0.0) / square)
        # From where it touches the base cylinder to the tip: the worm below its axis, the wheel
        # above its own.
        spans = [
            ((touch - reach, f"tip of the {name}"), (touch, f"base cylinder of the {name}"))
            if gear is pair.worm
            else ((touch, f"base cylinder of the {name}"), (touch + reach, f"tip of the {name}"))
        ]
        lean = float(pair.normal @ gear.axis)
        middle = -gear.along(pair.start) / lean
        half = gear.half_width / abs(lean)
        spans.append(((middle - half, f"end of the {name}"), (middle + half, f"end of the {name}")))
        for first, last in spans:
            low, high = max(low, first), min(high, last)
    if not low[0] < high[0]:
        raise InputError(
            "gearset: the worm and a helical wheel of its numbers never touch: the line of contact "
            f"leaves them between the {low[1]} and the {high[1]}; take more teeth, a greater "
            "pressure angle or wider gears"
        )
    return low, high

r"""Load, Hertzian pressure and oil film along the contact lines for a torque of the wheel.

The wheel turns by an angle :math:`\vartheta` under the load. With the lever :math:`h` of the normal
about the wheel's axis and the gap :math:`g` along the contact lines, a piece of line carries

.. math:: w = c\,(h\,\vartheta - g) \quad \text{where positive}, \qquad T_2 = \int w\,h\,dl,

with one stiffness :math:`c` per length of contact line for tooth and contact. Pressure and film are
those of a line contact of the local radius :math:`\rho = 1/\kappa`,

.. math::
    p = \sqrt{\frac{w E^*}{\pi \rho}}, \qquad
    h_{min} = 1.6\, \alpha^{0.6} (\eta u)^{0.7} E_{red}^{0.03} \rho^{0.43} w^{-0.13},

with :math:`u` the mean velocity of both surfaces across the line; the film is Dowson and
Higginson's, which ISO/TR 14521's mean over the mesh comes from. Friction does not bear on the load.
"""

import dataclasses
from typing import Self

import numpy as np

from asperity.arrays import BoolArray, FloatArray
from asperity.errors import InputError
from asperity.flanks.meshing.contact_lines import ContactLines
from asperity.flanks.meshing.kinematics import Kinematics, kinematics
from asperity.flanks.meshing.transmission import Transmission
from asperity.gearset import Gearset
from asperity.rating import Operation
from asperity.rating.iso14521 import hertz
from asperity.results import Quantities, quantity
from asperity.sources import Source

SOURCES = {
    "film": Source("Dowson and Higginson, by a program of cam and tappet", "one source"),
    "stiffness": Source(
        "finite elements of gearset 3's tooth against a rigid worm",
        "one source",
        "half the contact modulus; Hertz's line contact alone is about as stiff",
    ),
}
"""Where film and stiffness come from."""

_STIFFNESS = 0.5
"""Of a length of contact line, in contact moduli."""
_MPA = 1e-6


@dataclasses.dataclass(frozen=True, kw_only=True)
class NormalLoading:
    r"""What presses worm and wheel together.

    Attributes
    ----------
    wheel_torque, worm_speed : float
        :math:`T_2`, N m; :math:`\omega_1`, rad/s.
    contact_modulus, line_stiffness : float
        :math:`E^* = E_{red}/2`, MPa; :math:`c`, N/mm per mm of contact line.
    """

    wheel_torque: float
    worm_speed: float
    contact_modulus: float
    line_stiffness: float

    def __post_init__(self) -> None:
        for field in dataclasses.fields(self):
            value = getattr(self, field.name)
            if not 0.0 < value < np.inf:
                raise InputError(f"{field.name} is {value:g}; it must be positive and finite")

    @classmethod
    def by(cls, gearset: Gearset, operation: Operation, **fields: float) -> Self:
        """Return what presses a gearset in operation, with what else the class has."""
        worm, wheel = gearset.worm_material, gearset.wheel_material
        modulus = hertz.contact_modulus(
            worm.youngs_modulus * _MPA,
            worm.poisson_ratio,
            wheel.youngs_modulus * _MPA,
            wheel.poisson_ratio,
        )
        return cls(
            wheel_torque=operation.output_torque,
            worm_speed=operation.worm_speed,
            contact_modulus=modulus,
            line_stiffness=_STIFFNESS * modulus,
            **fields,
        )

    def line_load(self, motion: Kinematics, twist: FloatArray | float) -> FloatArray:
        r"""Return :math:`w` where the wheel has yielded by :math:`\vartheta` (rad), N/mm.

        0 where the worm does not touch, or from within.
        """
        lever = _lever(motion)
        some = motion.on_flank & (lever > 0.0)
        closed = np.maximum(lever * twist - motion.gap, 0.0)
        return np.where(some, self.line_stiffness * closed, 0.0)


@dataclasses.dataclass(frozen=True, kw_only=True)
class Load(NormalLoading):
    r"""What the mesh runs under: what presses it, and the oil.

    Attributes
    ----------
    dynamic_viscosity, pressure_viscosity : float
        :math:`\eta`, Pa s; :math:`\alpha`, m²/N.
    """

    dynamic_viscosity: float
    pressure_viscosity: float

    @classmethod
    def of(cls, gearset: Gearset, operation: Operation, oil_temperature: float) -> Self:
        """Return the load of a gearset in operation, its oil at a temperature in K."""
        oil = operation.lubricant
        return cls.by(
            gearset, operation,
            dynamic_viscosity=float(oil.dynamic_viscosity(oil_temperature)),
            pressure_viscosity=oil.base.pressure_viscosity,
        )  # fmt: skip


class LoadedNumbers(Quantities):
    """What holds of all contact lines under load at one angle of the worm."""

    worm_angle: float = quantity("phi_1", "deg", "angle of the worm")
    loaded_teeth: int = quantity("", "", "teeth that carry")
    loaded_length: float = quantity("", "mm", "length of line that carries")
    loaded_twist: float = quantity("theta", "rad", "angle by which the wheel yields")
    normal_force: float = quantity("F_N", "N", "sum of the normal forces")
    line_load_max: float = quantity("w", "N/mm", "line load, greatest")
    hertz_pressure_max: float = quantity("p", "MPa", "Hertzian pressure, greatest")
    hertz_pressure_mean: float = quantity("p_m", "MPa", "Hertzian pressure, mean")
    film_mean: float = quantity("h_m", "um", "oil film, mean")
    film_min: float = quantity("h_min", "um", "oil film, least")
    sliding_speed_mean: float = quantity("v_g", "mm/s", "sliding speed, mean")
    entrainment_mean: float = quantity("u", "mm/s", "entrainment, mean")


@dataclasses.dataclass(frozen=True, eq=False)
class LoadedLines:
    r"""Contact lines under load; arrays hold a number for each piece of line.

    Attributes
    ----------
    twist : float
        :math:`\vartheta`, by which the wheel yields, rad.
    load, pressure, film : ndarray
        :math:`w`, N/mm; Hertzian pressure, MPa; least thickness of the oil film, um. 0 where the
        load does not close the gap.
    sliding_speed, entrainment : ndarray
        mm/s.
    """

    lines: ContactLines
    twist: float
    load: FloatArray
    pressure: FloatArray
    film: FloatArray
    sliding_speed: FloatArray
    entrainment: FloatArray

    @property
    def carrying(self) -> BoolArray:
        """Which pieces carry."""
        return self.load > 0.0

    @property
    def teeth(self) -> int:
        """Number of teeth that carry."""
        return int(np.unique(self.lines.tooth[self.carrying]).size)

    @property
    def normal_force(self) -> float:
        """Sum of all normal forces, N."""
        return float(np.sum(self.load * self.lines.length))

    def mean(self, values: FloatArray) -> float:
        """Return the mean of values over the pieces by the force they carry."""
        force = self.load * self.lines.length
        return float(np.sum(force * values) / np.sum(force))

    @property
    def numbers(self) -> LoadedNumbers:
        """What is found over all lines."""
        return LoadedNumbers(
            worm_angle=float(np.degrees(self.lines.worm_angle)),
            loaded_teeth=self.teeth,
            loaded_length=float(self.lines.length[self.carrying].sum()),
            loaded_twist=self.twist,
            normal_force=self.normal_force,
            line_load_max=float(self.load.max()),
            hertz_pressure_max=float(self.pressure.max()),
            hertz_pressure_mean=self.mean(self.pressure),
            film_mean=self.mean(self.film),
            film_min=float(self.film[self.carrying].min()),
            sliding_speed_mean=self.mean(self.sliding_speed),
            entrainment_mean=self.mean(self.entrainment),
        )


@dataclasses.dataclass(frozen=True, eq=False)
class PressedLines:
    """What contact lines bear; arrays hold a number for each piece of line.

    Attributes
    ----------
    motion : Kinematics
        At the middles of the pieces.
    twist : float
        By which the wheel yields, rad.
    load, radius, pressure : ndarray
        N/mm; of the Hertzian line contact, mm; MPa. No load and pressure where the gap is open.
    """

    motion: Kinematics
    twist: float
    load: FloatArray
    radius: FloatArray
    pressure: FloatArray


def pressed_lines(mesh: Transmission, lines: ContactLines, load: NormalLoading) -> PressedLines:
    """Return load and Hertzian pressure along contact lines of a mesh.

    Raises
    ------
    InputError
        No contact line lies on the flank at this angle of the worm, or none has a lever.
    """
    # The middles of the pieces are brought onto the flank, for curvatures as they are there.
    flank = mesh.search.flank
    found = flank.at(np.minimum(lines.radius, flank.tip_radius(lines.z)), lines.z)
    motion = kinematics(mesh.search.pair, found, flank.side, load.worm_speed, mesh.ahead)
    length = np.where(motion.on_flank, lines.length, 0.0)
    if not length.sum() > 0.0:
        raise InputError(
            f"worm_angle is {lines.worm_angle:g} rad; there is no contact line: take another"
        )
    lever = _lever(motion)
    # A piece that the worm's core meets from within has no lever, and carries nothing.
    length = np.where(lever > 0.0, length, 0.0)
    if not length.sum() > 0.0:
        raise InputError(
            "the worm cuts so deep into the wheel that no contact line has a lever about the "
            "wheel's axis: look at mount"
        )
    torque = load.wheel_torque * 1e3
    twist = _twist(torque / load.line_stiffness, length, lever, motion.gap)
    w = np.where(length > 0.0, load.line_load(motion, twist), 0.0)
    # Where worm and wheel fit each other better than a plane a plane, they do as the latter.
    radius = 1.0 / np.maximum(motion.line_curvature, 1e-9)
    pressure = np.asarray(hertz.line_contact_stress(w, radius, 1.0, load.contact_modulus))
    return PressedLines(motion, twist, w, radius, pressure)


def loaded_lines(mesh: Transmission, lines: ContactLines, load: Load) -> LoadedLines:
    """Return load, pressure and film along contact lines of a mesh.

    Raises
    ------
    InputError
        As of `pressed_lines`.
    """
    pressed = pressed_lines(mesh, lines, load)
    motion = pressed.motion
    return LoadedLines(
        lines=lines,
        twist=pressed.twist,
        load=pressed.load,
        pressure=pressed.pressure,
        film=film_thickness(load, pressed.load, pressed.radius, motion.entrainment),
        sliding_speed=motion.sliding_speed,
        entrainment=motion.entrainment,
    )


def film_thickness(
    load: Load, line_load: FloatArray, radius: FloatArray, entrainment: FloatArray
) -> FloatArray:
    """Return the least film thickness of line contacts, um; 0 where there is no load.

    Line load in N/mm, radius in mm, entrainment in mm/s.
    """
    some = line_load > 0.0
    w = np.where(some, line_load, 1.0) * 1e3
    metres = (
        1.6
        * load.pressure_viscosity**0.6
        * (load.dynamic_viscosity * entrainment * 1e-3) ** 0.7
        * (2e6 * load.contact_modulus) ** 0.03
        * (radius * 1e-3) ** 0.43
        * w**-0.13
    )
    return np.asarray(np.where(some, metres * 1e6, 0.0))


def _lever(motion: Kinematics) -> FloatArray:
    """Lever of the normal about the wheel's axis, mm."""
    place, normal = motion.position, motion.normal
    across = place[..., 0] * normal[..., 1] - place[..., 1] * normal[..., 0]
    return np.asarray(np.abs(across))


def _twist(torque: float, length: FloatArray, lever: FloatArray, gap: FloatArray) -> float:
    """Angle at which the pieces of line carry a torque over the stiffness: piecewise linear."""
    some = length > 0.0
    start = gap[some] / lever[some]
    order = np.argsort(start)
    weight = (length[some] * lever[some] ** 2)[order]
    begin = start[order]
    total = np.cumsum(weight)
    moment = np.cumsum(weight * begin)
    # With the first k pieces in contact.
    angle = (torque + moment) / total
    last = np.append(begin[1:], np.inf)
    return float(angle[np.argmax(angle <= last)])

"""``asperity crossed``: a worm with a helical wheel, such as plastics are moulded as.

No strength is rated: no standard that is built here covers gears whose teeth touch at a point.
"""

import math
from typing import ClassVar, NamedTuple

import numpy as np

from asperity.arrays import FloatArray
from asperity.casefile import Case, naming_source
from asperity.gearset.crossed import Crossed, crossed
from asperity.gearset.parameters import Gearset
from asperity.gearset.point_contact import Ellipse, point_contact
from asperity.rating.driven import driven
from asperity.rating.inputs import scaled
from asperity.rating.parameters import Operation, RatingOptions
from asperity.rating.rate import run_of
from asperity.results import Result, quantity
from asperity.runs import Run
from asperity.units.standards import FROM_SI

_POINTS = 41
_SHARP = 1e-3  # mm
_LEAST_RATIO = 1.0


class CrossedStudy(Result):
    """A worm with a helical wheel.

    Attributes
    ----------
    name : str
        Of the gearset.
    pair : Crossed
        Both gears and their line of contact.
    """

    title: ClassVar[str] = "Worm with a helical wheel"
    stem: ClassVar[str] = "crossed"

    name: str
    pair: Crossed
    centre_distance: float = quantity("a", "mm", "centre distance")
    shaft_angle: float = quantity("Sigma", "deg", "angle between the axes")
    ratio: float = quantity("u", "", "gear ratio")
    normal_module: float = quantity("m_n", "mm", "normal module of both")
    pressure_angle: float = quantity("alpha_n", "deg", "normal pressure angle of both, at work too")
    worm_helix: float = quantity("beta_1", "deg", "helix angle of the worm")
    wheel_helix: float = quantity("beta_2", "deg", "helix angle of the wheel, of the worm's hand")
    profile_shift: float = quantity("x_n2", "", "profile shift of the wheel, in normal modules")
    worm_diameter: float = quantity("d_1", "mm", "reference diameter of the worm")
    wheel_diameter: float = quantity("d_2", "mm", "reference diameter of the wheel")
    wheel_tip_diameter: float = quantity("d_a2", "mm", "tip diameter of the wheel")
    worm_base_diameter: float = quantity("d_b1", "mm", "base diameter of the worm")
    wheel_base_diameter: float = quantity("d_b2", "mm", "base diameter of the wheel")
    wheel_thickness: float = quantity(
        "s_n2", "mm", "normal tooth thickness of the wheel at d_2, without backlash"
    )
    play: float = quantity(
        "dj_n/da", "", "normal backlash for each part of a greater centre distance"
    )
    base_pitch: float = quantity("p_bn", "mm", "normal base pitch")
    path: float = quantity("g", "mm", "length of the path of contact")
    begins_by: str = quantity("", "", "where contact begins")
    ends_by: str = quantity("", "", "where contact ends")
    contact_ratio: float = quantity("eps_n", "", "contact ratio in the normal section")
    between_generators: float = quantity("", "deg", "angle between the flanks' straight lines")
    sliding: float | None = quantity(
        "v_g", "m/s", "sliding speed at the height of the worm's reference cylinder", optional=True
    )
    most_sliding: float | None = quantity(
        "v_g,max", "m/s", "greatest sliding speed on the path", optional=True
    )
    force: float | None = quantity(
        "F_n", "N", "normal force on one pair of teeth, without friction", optional=True
    )
    pressure: float | None = quantity(
        "p_C",
        "MPa",
        "Hertzian pressure at the height of the worm's reference cylinder, one pair",
        optional=True,
    )
    most_pressure: float | None = quantity(
        "p_max", "MPa", "greatest Hertzian pressure on the path, one pair of teeth", optional=True
    )
    long_axis: float | None = quantity(
        "a_H", "mm", "longer semi-axis of the ellipse of contact there", optional=True
    )
    short_axis: float | None = quantity("b_H", "mm", "shorter semi-axis of it", optional=True)

    way: FloatArray = quantity("s", "mm", "way on the path from where it begins", dims=("way",))
    worm_curvature: FloatArray = quantity(
        "rho_1", "mm", "radius of curvature of the worm's flank", dims=("way",)
    )
    wheel_curvature: FloatArray = quantity(
        "rho_2", "mm", "radius of curvature of the wheel's flank", dims=("way",)
    )
    slides: FloatArray | None = quantity(
        "v_g", "m/s", "sliding speed", dims=("way",), optional=True, key="sliding_on_path_m_per_s"
    )
    pressures: FloatArray | None = quantity(
        "p", "MPa", "Hertzian pressure", dims=("way",), optional=True
    )

    def heading(self) -> str:
        """Return the gearset's name."""
        return self.name or "worm gearset"

    def headline(self) -> tuple[str, ...]:
        """Return that its strength is not rated."""
        return ("geometry alone; strength is not rated",)


class Problem(NamedTuple):
    """A gearset, and how it is run where that is known."""

    gearset: Gearset
    pair: Crossed
    operation: Operation | None


def prepare(case: Case) -> Problem:
    """Return the worm of a case with a helical wheel in place of its own.

    Parameters
    ----------
    case : Case
        With its gearset, whose worm is of the flank ZI, and perhaps ``[operation]``.

    Returns
    -------
    Problem
        For `answer`.

    Raises
    ------
    InputError
        The worm's flank is another, or both gears never touch.
    """
    gearset = case.require(Gearset).require_consistent()
    operation = run_of(case) if Operation.table in case else None
    with naming_source(case):
        if operation is not None and operation.driven_by:
            options = case.get(RatingOptions, RatingOptions())
            operation = driven(gearset, operation, options)
        return Problem(gearset, crossed(gearset.geometry), operation)


def answer(problem: Problem, _: Run) -> CrossedStudy:
    """Return its geometry, and speed and pressure where the case says how it is run.

    Parameters
    ----------
    problem : Problem
        From `prepare`.

    Returns
    -------
    CrossedStudy
        Lengths in mm.
    """
    gearset, pair, operation = problem
    g = gearset.geometry
    notes = [
        "no strength is rated: the teeth touch at a point, and no standard that is built here "
        "covers crossed helical gears (VDI 2736-3 does, of plastics); pressures are those of "
        "Hertz, elastic and without friction",
        "the wheel has the teeth, tip diameter and width of the one that envelops the worm; "
        "fillets are not looked at",
    ]
    if pair.contact_ratio < _LEAST_RATIO:
        notes.append(
            f"the contact ratio is {pair.contact_ratio:.3g}; below 1 the teeth leave each other "
            "before the next ones touch"
        )
    ways = np.linspace(*pair.ends, _POINTS)
    radii = np.array([pair.radii_of_curvature(way) for way in ways])
    loaded = None if operation is None else _loaded(problem, ways)
    if operation is None:
        notes.append("the case has no [operation]: speed and pressure are left out")
    thick = g.normal_module * (math.pi / 2.0 + 2.0 * pair.shift * math.tan(g.pressure_angle))
    return CrossedStudy(
        name=gearset.name,
        pair=pair,
        centre_distance=g.centre_distance,
        shaft_angle=90.0,
        ratio=g.gear_ratio,
        normal_module=g.normal_module,
        pressure_angle=math.degrees(g.pressure_angle),
        worm_helix=90.0 - math.degrees(g.lead_angle),
        wheel_helix=math.degrees(pair.helix),
        profile_shift=pair.shift,
        worm_diameter=g.worm_pitch_diameter,
        wheel_diameter=pair.wheel_diameter,
        wheel_tip_diameter=2.0 * pair.wheel.tip_radius,
        worm_base_diameter=2.0 * pair.worm.base_radius,
        wheel_base_diameter=2.0 * pair.wheel.base_radius,
        wheel_thickness=thick,
        play=2.0 * math.sin(pair.pressure_angle),
        base_pitch=pair.base_pitch,
        path=pair.path,
        begins_by=pair.ended_by[0],
        ends_by=pair.ended_by[1],
        contact_ratio=pair.contact_ratio,
        between_generators=math.degrees(pair.between_generators),
        way=ways - pair.ends[0],
        worm_curvature=radii[:, 0],
        wheel_curvature=radii[:, 1],
        **(dict.fromkeys(_Loaded._fields) if loaded is None else loaded._asdict()),
        notes=tuple(notes),
    )


class _Loaded(NamedTuple):
    slides: FloatArray
    pressures: FloatArray
    sliding: float
    most_sliding: float
    force: float
    pressure: float
    most_pressure: float
    long_axis: float
    short_axis: float


def _loaded(problem: Problem, ways: FloatArray) -> _Loaded:
    """Return what speed and torque bring, on the whole path and at the worm's reference."""
    gearset, pair, operation = problem
    assert operation is not None
    modulus = 1.0 / sum(
        (1.0 - each.poisson_ratio**2) / (each.youngs_modulus * FROM_SI["MPa"])
        for each in (gearset.worm_material, gearset.wheel_material)
    )
    torque = operation.application_factor * scaled(operation.output_torque, 1.0)
    force = 1e3 * torque / pair.wheel.lever

    def pressed(way: float) -> Ellipse:
        # At its end a path may have come to a base cylinder, where nothing is curved any more.
        one, other = (max(r, _SHARP) for r in pair.radii_of_curvature(way))
        return point_contact(force, (one, other), pair.between_generators, modulus)

    def slid(way: float) -> float:
        return 1e-3 * math.hypot(*pair.sliding(way, operation.worm_speed))

    # At the worm's reference cylinder, or what of the path is next to it.
    pitch = min(max(0.0, pair.ends[0]), pair.ends[1])
    there = pressed(pitch)
    slides = np.array([slid(way) for way in ways])
    pressures = np.array([pressed(way).pressure for way in ways])
    return _Loaded(
        slides, pressures, slid(pitch), float(slides.max()), force, there.pressure,
        max(there.pressure, float(pressures.max())), there.long, there.short,
    )  # fmt: skip

"""Where AGMA 6034-B92 is valid, where its formulas jump, and how far each can be trusted."""

import math
from collections.abc import Callable, Mapping

import numpy as np

from asperity.rating.agma6034.capacity import ratio_correction_factor, velocity_factor
from asperity.rating.agma6034.mesh import friction
from asperity.rating.agma6034.units import VELOCITY
from asperity.rating.jump import Jump
from asperity.sources import Range, Source

LIFE_HOURS = 25000.0
"""Life the allowable load is meant for, hours."""

_STANDARD = Source("ANSI/AGMA 6034-B92", "verified")
_ONE_SOURCE = Source("ANSI/AGMA 6034-B92", "one source")
_FROM_MEMORY = Source("ANSI/AGMA 6034-B92", "from memory")
_BOOK = Source("Budynas and Nisbett, Shigley's Mechanical Engineering Design, ch. 15", "verified")

SOURCES: Mapping[str, Source] = {
    "sliding_velocity": _STANDARD,
    "pitch_line_velocity": _STANDARD,
    "friction": _STANDARD,
    "worm_driving_efficiency": _STANDARD,
    "wheel_driving_efficiency": _STANDARD,
    "maximum_lead_angle": _FROM_MEMORY,
    "materials_factor": _STANDARD,
    "ratio_correction_factor": _STANDARD,
    "velocity_factor": _STANDARD,
    "effective_face_width": _STANDARD,
    "allowable_tangential_load": _STANDARD,
    "wheel_torque": _STANDARD,
    "wheel_load_from_power": _BOOK,
    "worm_tangential_load": _BOOK,
    "friction_force": _ONE_SOURCE,
    "lewis_form_factor": _BOOK,
    "bending_stress": _BOOK,
    "friction_power": _ONE_SOURCE,
    "output_power": _ONE_SOURCE,
    "input_power": _ONE_SOURCE,
    "heat_transfer_coefficient": _ONE_SOURCE,
    "minimum_housing_area": _ONE_SOURCE,
    "sump_temperature": _ONE_SOURCE,
    "LIFE_HOURS": _ONE_SOURCE,
}
"""Who says so, for each formula by its name."""

VALIDITY: Mapping[str, Range] = {
    "sliding_velocity": Range(
        "sliding velocity V_s", 0.0, 6000.0 * VELOCITY.size, "m/s", _FROM_MEMORY
    ),
    "worm_speed": Range("worm speed n_W", 0.0, 3600.0, "rpm", _FROM_MEMORY),
    "gear_ratio": Range("gear ratio m_G", 3.0, 1.1483 / 0.00658, "", _STANDARD),
    "pressure_angle": Range("pressure angle", 14.5, 30.0, "deg", _STANDARD),
    "worm_hardness": Range("hardness of the worm", 58.0, math.inf, "HRC", _FROM_MEMORY),
}
"""Where the standard is valid, by the parameter; see also `maximum_lead_angle`."""


def _by_velocity(formula: Callable[..., float]) -> Callable[[float], float]:
    return lambda v: formula(v, units="inch")


def jumps() -> tuple[Jump, ...]:
    """Measure where the standard's own formulas jump.

    Returns
    -------
    tuple of Jump
        All there are, at their branch points in the standard's units.

    Examples
    --------
    >>> for jump in jumps():
    ...     print(f"{jump.formula} at {jump.at:g} {jump.unit}: {100 * jump.relative:+.2f} %")
    friction at 0 ft/min: -17.33 %
    friction at 10 ft/min: -2.12 %
    ratio_correction_factor at 20 : -0.07 %
    ratio_correction_factor at 76 : +0.62 %
    velocity_factor at 700 ft/min: +3.55 %
    velocity_factor at 3000 ft/min: -3.10 %
    """
    places: tuple[tuple[str, Callable[[float], float], float, str], ...] = (
        ("friction", _by_velocity(friction), 0.0, "ft/min"),
        ("friction", _by_velocity(friction), 10.0, "ft/min"),
        ("ratio_correction_factor", ratio_correction_factor, 20.0, ""),
        ("ratio_correction_factor", ratio_correction_factor, 76.0, ""),
        ("velocity_factor", _by_velocity(velocity_factor), 700.0, "ft/min"),
        ("velocity_factor", _by_velocity(velocity_factor), 3000.0, "ft/min"),
    )
    return tuple(
        Jump(
            name,
            at,
            unit,
            formula(max(float(np.nextafter(at, -np.inf)), 0.0)),
            formula(float(np.nextafter(at, np.inf))),
        )
        for name, formula, at, unit in places
    )

"""The numbers that define a worm gearset, completed and checked against each other."""

from typing import NamedTuple

from asperity.errors import InputError
from asperity.gearset import relations

TOLERANCE = 5e-4
"""By how much an over-determined centre distance may differ, as a share of itself."""

LARGEST_SHIFT = 1.0
"""Profile shift beyond which centre distance, module, diameter factor and teeth contradict."""


class Macro(NamedTuple):
    """The three numbers that, with the teeth, define the macro-geometry; lengths in mm."""

    axial_module: float
    diameter_factor: float
    profile_shift: float


def complete(
    wheel_teeth: int,
    *,
    centre_distance: float | None = None,
    axial_module: float | None = None,
    diameter_factor: float | None = None,
    worm_pitch_diameter: float | None = None,
    profile_shift: float | None = None,
) -> Macro:
    """Return module, diameter factor and profile shift from those that are given; lengths in mm.

    The worm is given by its diameter factor or its pitch diameter. The profile shift is zero where
    it neither is given nor follows.

    Raises
    ------
    InputError
        Too few are given, or they contradict each other.

    Examples
    --------
    >>> complete(60, centre_distance=102.0, diameter_factor=8.0)
    Macro(axial_module=3.0, diameter_factor=8.0, profile_shift=0.0)
    """
    worm_given = diameter_factor is not None or worm_pitch_diameter is not None
    if [centre_distance is not None, axial_module is not None, worm_given].count(True) < 2:
        raise InputError(
            "gearset.axial_module is missing; give two or three of 'centre_distance', "
            "'axial_module' and 'diameter_factor'"
        )
    shift = profile_shift or 0.0
    m, q = axial_module, diameter_factor
    if m is None and centre_distance is not None:
        m = _module(wheel_teeth, centre_distance, q, worm_pitch_diameter, shift)
    assert m is not None
    if worm_pitch_diameter is not None:
        q = worm_pitch_diameter / m
    if q is None:
        assert centre_distance is not None
        q = relations.diameter_factor(centre_distance, m, wheel_teeth, shift)
        if q <= 0.0:
            raise InputError(
                f"gearset.centre_distance is {centre_distance:g} mm; with an axial module of "
                f"{m:g} mm and {wheel_teeth} teeth it must be above "
                f"{m * (wheel_teeth + 2.0 * shift) / 2.0:g} mm"
            )
    if centre_distance is not None and axial_module is not None and worm_given:
        return Macro(m, q, _agreed(wheel_teeth, centre_distance, m, q, profile_shift))
    return Macro(m, q, shift)


def _module(
    wheel_teeth: int, a: float, q: float | None, worm_pitch_diameter: float | None, shift: float
) -> float:
    if worm_pitch_diameter is None:
        assert q is not None
        return float(relations.axial_module(a, q, wheel_teeth, shift))
    if worm_pitch_diameter >= 2.0 * a:
        raise InputError(
            f"gearset.worm_pitch_diameter is {worm_pitch_diameter:g} mm; it must be below twice "
            f"the centre distance, {2.0 * a:g} mm"
        )
    return (2.0 * a - worm_pitch_diameter) / (wheel_teeth + 2.0 * shift)


def _agreed(wheel_teeth: int, a: float, m: float, q: float, shift: float | None) -> float:
    """Return the profile shift that makes the others exact."""
    if shift is not None:
        needed = relations.centre_distance(m, q, wheel_teeth, shift)
        if abs(needed - a) > TOLERANCE * a:
            raise InputError(
                f"gearset.centre_distance is {a:g} mm; {wheel_teeth} teeth, an axial module of "
                f"{m:g} mm, a diameter factor of {q:g} and a profile shift of {shift:g} give "
                f"{needed:.6g} mm: leave one of the four out"
            )
    return float(relations.profile_shift(a, m, q, wheel_teeth))

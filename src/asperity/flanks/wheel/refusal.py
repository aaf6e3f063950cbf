"""Why a wheel cannot be cut, in words, and how wide its face may be instead."""

import math
from collections.abc import Callable

from asperity.flanks.wheel.cutting import trim
from asperity.flanks.worm.setting import Pair

POINTED = -1
CUT_AGAIN = -2

_HALVINGS = 12
_STEPS = 48

_REMEDIES = {
    POINTED: "take a smaller gearset.pressure_angle or gearset.profile_shift",
    trim.SHORT: "take a larger gearset.diameter_factor",
    trim.LOST: "take a larger gearset.pressure_angle or gearset.diameter_factor",
    trim.NO_FLANK: "take a larger gearset.diameter_factor or a smaller hob.tip_radius",
    trim.UNDERCUT: "take a larger gearset.profile_shift, gearset.pressure_angle or more teeth",
    CUT_AGAIN: "take a larger gearset.profile_shift or gearset.pressure_angle",
    trim.NO_INVOLUTE: "take a larger gearset.pressure_angle or gearset.diameter_factor",
}


def widest_face(sound: Callable[[float], bool], half: float) -> float | None:
    """Return the face width up to which all is sound, mm, rounded down; None if none is.

    ``sound`` tells whether a tooth can be cut at a distance from mid-face, mm, on both sides of it,
    ``half`` is half the face width asked for, mm.
    """
    good, bad = -1.0, half
    for k in range(_STEPS + 1):
        z = half * k / _STEPS
        if not sound(z):
            bad = z
            break
        good = z
    if good < 0.0:
        return None
    for _ in range(_HALVINGS):
        middle = 0.5 * (good + bad)
        if sound(middle):
            good = middle
        else:
            bad = middle
    rounded = math.floor(200.0 * good) / 100.0
    return rounded if rounded > 0.0 else None


def _cause(pair: Pair, status: int, z: float) -> str:
    g, hob = pair.geometry, pair.hob
    place = f"{round(abs(z), 3):g} mm from mid-face"
    if status == POINTED:
        return (
            f"gearset.pressure_angle is {math.degrees(g.pressure_angle):.4g} deg; the wheel's "
            f"teeth are pointed before their tip {place}"
        )
    if status == trim.SHORT:
        return (
            f"hob too short: its threads are {hob.tip_radius - hob.root_radius:.4g} mm high and do "
            f"not reach the wheel's tip {place}"
        )
    if status == trim.UNDERCUT:
        return f"gearset.wheel_teeth is {g.wheel_teeth}; undercut takes all the flank {place}"
    if status == CUT_AGAIN:
        return (
            f"gearset.profile_shift is {g.profile_shift:.4g}; the hob undercuts the flank again "
            f"that it has made {place}"
        )
    if status == trim.NO_INVOLUTE:
        return (
            f"gearset.pressure_angle is {math.degrees(g.pressure_angle):.4g} deg; the involute of "
            f"the hob ends at its base radius of {hob.profile.base_radius:.5g} mm and does not "
            f"reach the wheel's tip {place}"
        )
    if status == trim.NO_FLANK:
        return (
            f"gearset.wheel_face_width is {g.wheel_face_width:.5g} mm; the hob's flank does not "
            f"reach the tooth {place}, all of which the rounding of its tip cuts"
        )
    return (
        f"gearset.wheel_face_width is {g.wheel_face_width:.5g} mm; hob too short: only an endless "
        f"one would finish the flank {place}"
    )


def refusal(pair: Pair, status: int, z: float, widest: float | None) -> str:
    """Return the one line that says why there is no tooth at ``z`` (mm) and what to do.

    ``status`` is how the section ended, of `asperity.flanks.wheel.cutting.trim`, or of this module;
    ``widest`` the widest face that can be cut, mm.
    """
    remedy = _REMEDIES[status]
    if pair.cutting.tilt != 0.0 and status != POINTED:
        remedy += ", or a smaller hob.tilt"
    if widest is not None:
        remedy += f", or a gearset.wheel_face_width of at most {widest:g} mm"
    return f"{_cause(pair, status, z)}: {remedy}"

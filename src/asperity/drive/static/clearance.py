"""Worms that are mounted too near to touch a flank of their wheel first, in one line each."""

from asperity.errors import InputError
from asperity.flanks.meshing.backlash import core_clearance
from asperity.flanks.wheel.enveloped import Wheel
from asperity.flanks.wheel.interference import interference

_MICROMETRES = 1e3
# Of tips beyond a core, mm: rounding.
_TOUCH = 1e-3


def refuse_cut_core(wheel: Wheel) -> None:
    """Refuse a wheel whose tips reach into the core of its worm, whatever else touches.

    Parameters
    ----------
    wheel : Wheel
        As it is cut and mounted.

    Raises
    ------
    InputError
        They do by more than a micrometre: the drive could not turn through a pitch.
    """
    core = core_clearance(wheel.pair, wheel.blank)
    if core < -_TOUCH:
        raise InputError(
            f"the wheel's tips reach {-_MICROMETRES * core:.4g} um into the worm's core as they "
            "pass it, so that no flank touches first: take a smaller mount.axial_offset, or a "
            f"mount.centre_distance_error that is {-core:.3g} mm larger"
        )


def cut_root(wheel: Wheel) -> InputError | None:
    """Return the line that refuses a worm whose tips reach into the root of the wheel.

    Parameters
    ----------
    wheel : Wheel
        As it is cut and mounted.

    Returns
    -------
    InputError or None
        None where they are clear of it.
    """
    least = float(interference(wheel).root_gap.min())
    if least >= 0.0:
        return None
    return InputError(
        f"the worm's tips reach {-_MICROMETRES * least:.4g} um into the root of the wheel, so that "
        "no flank touches first: take a smaller mount.centre_distance_error or mount.axial_offset"
    )

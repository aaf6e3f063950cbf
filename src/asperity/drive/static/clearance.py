"""Why a worm that is mounted too near touches no flank of its wheel, in one line."""

from asperity.errors import InputError
from asperity.flanks.meshing.backlash import core_clearance
from asperity.flanks.wheel.enveloped import Wheel
from asperity.flanks.wheel.interference import interference

_MICROMETRES = 1e3


def cut_into(wheel: Wheel) -> InputError | None:
    """Return the line that refuses a worm which reaches into the wheel, or the wheel into it.

    Parameters
    ----------
    wheel : Wheel
        As it is cut and mounted.

    Returns
    -------
    InputError or None
        None where tips and roots are clear of each other.
    """
    root = float(interference(wheel).root_gap.min())
    if root < 0.0:
        return InputError(
            f"the worm's tips reach {-_MICROMETRES * root:.4g} um into the root of the wheel, so "
            "that no flank touches first: take a smaller mount.centre_distance_error or "
            "mount.axial_offset"
        )
    core = core_clearance(wheel.pair, wheel.blank)
    if core < 0.0:
        return InputError(
            f"the wheel's tips reach {-_MICROMETRES * core:.4g} um into the worm's core however "
            "the wheel stands, so that no flank touches first: take a smaller mount.axial_offset, "
            f"or a mount.centre_distance_error that is {-core:.3g} mm larger"
        )
    return None

r"""Whether worm and hob have threads: lands at their tips, and spaces that do not close.

Everything scales with the axial module, so that starts, diameter factor and pressure angle say it
all. The flanks of ZI and ZA are closed forms; for those of the other types
`asperity.flanks` has to find the profile first.
"""

import numpy as np
import numpy.typing as npt

from asperity.arrays import FloatArray
from asperity.gearset import relations
from asperity.gearset.proportions import RULES

LEAST_LAND = 0.01
"""Land that is left at the tip of a thread, in parts of the axial pitch."""

LEAST_SPACE = 0.02
"""Width of the thread space that is left at the root, in parts of the axial pitch."""

CLOSED_FORMS = ("ZI", "ZA")
"""Types of flank that `thread_room` knows."""


def thread_room(
    flank: str,
    tooth_proportions: str,
    starts: npt.ArrayLike,
    diameter_factor: npt.ArrayLike,
    pressure_angle: npt.ArrayLike,
) -> FloatArray:
    r"""Return what is left of the axial pitch where threads or their spaces are thinnest.

    Half the width of the space is :math:`w(\rho) = \pi m/4 + f(\rho) - f(r_1)`, with
    :math:`f = \sqrt{\rho^2 - r_b^2}\tan\gamma_b - p \arctan(\sqrt{\rho^2 - r_b^2}/r_b)` for ZI and
    :math:`f = \rho\tan\alpha_x` for ZA. The hob of the worm's own size, which reaches the wheel's
    root, has the least land; the spaces must be open down to the wheel's tip.

    Parameters
    ----------
    flank : str
        Type of the flank.
    tooth_proportions : str
        Rule of the tooth heights.
    starts, diameter_factor, pressure_angle : array_like
        :math:`z_1`, :math:`q_1` and :math:`\alpha_n`, rad; shapes broadcast.

    Returns
    -------
    ndarray
        In parts of the axial pitch; not above zero where there is no such worm or hob. Infinite
        for a flank that is not among `CLOSED_FORMS`.
    """
    z1, q, alpha = np.broadcast_arrays(
        *(np.asarray(each, dtype=np.float64) for each in (starts, diameter_factor, pressure_angle))
    )
    if flank not in CLOSED_FORMS:
        return np.full(z1.shape, np.inf)
    gamma = relations.lead_angle(z1, q)
    heights = RULES[tooth_proportions](1.0, gamma)
    radius, lead = 0.5 * q, relations.reduced_lead(1.0, z1)

    def profile(rho: FloatArray) -> FloatArray:
        if flank == "ZA":
            return np.asarray(rho * np.tan(relations.axial_pressure_angle(alpha, gamma)))
        base_lead = relations.base_lead_angle(alpha, gamma)
        base = relations.base_radius(lead, base_lead)
        # Below the base cylinder the flank goes on radially.
        t = np.sqrt(np.maximum(rho * rho - base * base, 0.0))
        return np.asarray(t * np.tan(base_lead) - lead * np.arctan2(t, base))

    def space(rho: FloatArray) -> FloatArray:
        return 0.5 + 2.0 / np.pi * (profile(rho) - profile(radius))

    land = 1.0 - LEAST_LAND - space(radius + heights.wheel_dedendum)
    return np.minimum(land, space(radius - heights.wheel_addendum) - LEAST_SPACE)

r"""Tooth heights of worm and wheel by two rules.

Heights of the worm count from its reference diameter :math:`d_{m1}`, heights of the wheel from its
mean diameter :math:`d_{m2} = 2a - d_{m1}`, which holds the profile shift. In both rules tip and
root leave the same clearance on both sides:
:math:`h_{f1} = h_{a2} + c` and :math:`h_{f2} = h_{a1} + c`.
"""

from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

import numpy as np

from asperity.arrays import Real, plain
from asperity.formulas import Symbol, acute, check, positive, real
from asperity.sources import Source

_M = Symbol("m_x1", "", positive)
_GAMMA = Symbol("gamma_m1", "rad", acute)


class Heights(NamedTuple):
    """Tooth heights, in the unit of the module; arrays where arrays were given."""

    worm_addendum: Any
    worm_dedendum: Any
    wheel_addendum: Any
    wheel_dedendum: Any
    clearance: Any


def bs721_heights(axial_module: Real, lead_angle: Real) -> Heights:
    r"""Tooth heights of BS 721, as Jindal, Machine Design, example 28-2 has them.

    :math:`h_{a1} = m`, :math:`h_{f1} = m (2.2 \cos\gamma - 1)`,
    :math:`h_{a2} = m (2 \cos\gamma - 1)`, :math:`h_{f2} = m (1 + 0.2 \cos\gamma)`,
    :math:`c = 0.2\, m \cos\gamma`. Valid below :math:`\gamma` = 60 deg, where the wheel's addendum
    vanishes.

    Examples
    --------
    >>> round(bs721_heights(2.1538, 0.44442).worm_dedendum, 4)
    2.1243
    """
    m = check("axial_module", real("axial_module", axial_module), _M)
    cosine = np.cos(check("lead_angle", real("lead_angle", lead_angle), _GAMMA))
    return Heights(
        plain(m * np.ones_like(cosine)),
        plain(m * (2.2 * cosine - 1.0)),
        plain(m * (2.0 * cosine - 1.0)),
        plain(m * (1.0 + 0.2 * cosine)),
        plain(0.2 * m * cosine),
    )


def iso_heights(axial_module: Real, lead_angle: Real) -> Heights:
    r"""Tooth heights of ISO/TR 10828.

    :math:`h_{a1} = h_{a2} = m`, :math:`h_{f1} = h_{f2} = 1.2\, m`, :math:`c = 0.2\, m`, for any
    lead angle.
    """
    angle = check("lead_angle", real("lead_angle", lead_angle), _GAMMA)
    m = check("axial_module", real("axial_module", axial_module), _M) * np.ones_like(angle)
    addendum, dedendum = plain(m), plain(1.2 * m)
    return Heights(addendum, dedendum, addendum, dedendum, plain(0.2 * m))


RULES: Mapping[str, Callable[[Real, Real], Heights]] = {
    "bs721": bs721_heights,
    "iso": iso_heights,
}
"""The rules by the name they have in a case file."""

SOURCES: Mapping[str, Source] = {
    "bs721": Source("BS 721-2:1983, by Jindal, Machine Design, example 28-2", "one source"),
    "iso": Source("ISO/TR 10828", "from memory", "clearance 0.2 m as is customary"),
}
"""Where each rule comes from."""

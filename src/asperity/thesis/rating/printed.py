"""What the printed efficiency of gearset 2 gives with other frictions, by equation (6) alone.

Friction goes as the base friction does, so that one printed efficiency and the printed reduction
are enough, at any lead angle.
"""

import math

from asperity.studies.comparison import Compared

EFFICIENCY, MINERAL = 0.38, 0.0715
"""Of gearset 2, and the base friction that it has it with (3.2.1, 3.2.2)."""

LEADS = (2.0, 9.0)
"""Lead angles that it is tried at, deg."""

BETWEEN = f"{LEADS[0]:g} to {LEADS[1]:g}"
HOW = "asperity.thesis.rating.printed.efficiency(share, lead)"


def _friction_angle(lead: float) -> float:
    """The friction angle that the printed efficiency means at a lead angle, rad."""
    return math.atan(math.tan(lead) / EFFICIENCY) - lead


def efficiency(share: float, lead: float) -> float:
    """Return the efficiency by (6) with a share of the friction, at a lead angle in rad.

    Examples
    --------
    >>> round(efficiency(1.0, 0.1), 12)
    0.38
    """
    angle = math.atan(share * math.tan(_friction_angle(lead)))
    return math.tan(lead) / math.tan(lead + angle)


def efficiencies(row: Compared) -> tuple[float, ...]:
    """Return the efficiencies that a method comes to at the lead angles tried."""
    return tuple(efficiency(row.base_friction / MINERAL, math.radians(lead)) for lead in LEADS)


def locks(row: Compared) -> tuple[bool, ...]:
    """Return whether it leaves the worm locked at each, by (1): the lead below the friction angle.

    Friction that leaves more than half of the power through, but for the lead angle, does not lock.
    """
    return tuple(
        found <= 0.5 * (1.0 - math.tan(math.radians(lead)) ** 2)
        for found, lead in zip(efficiencies(row), LEADS, strict=True)
    )

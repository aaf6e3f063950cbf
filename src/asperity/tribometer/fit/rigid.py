r"""Contacts that are as good as rigid: between the closed form and a contact that is solved.

The stiffer a contact, the shorter the steps of its periodic state, without end, while its ratio
goes to that of rigid friction: on a rigid drive under a sine, by the first power of the deflection
along the sliding, where the slip turns round at once, and by its square across it, where it turns
smoothly. So what is stiffer than needed for that is found from the closed form and from one
deflection at which it holds: a body at :math:`s_0`, of ratio :math:`r(s_0)`, tells
:math:`r(s) = r_0 + (r(s_0) - r_0)(s/s_0)^n`.
"""

import dataclasses
import math

from asperity.slider.closed_forms import directed_ratio
from asperity.slider.model import Model

DEFLECTION = "friction.max_deflection"
_STRAIGHT = 1e-9  # of a direction, along or across
_ALONG = 0.02  # of the slip that goes back in a cycle
_ACROSS = 0.05  # of the slip in the time in which its direction turns
_FAR = 0.02  # of the sliding in a cycle over 2 pi


@dataclasses.dataclass(frozen=True)
class Limit:
    """How a ratio goes to that of rigid friction.

    Attributes
    ----------
    deflection : float
        At which the body is solved instead, m.
    rigid : float
        Ratio of rigid friction.
    share : float
        Of the solved body's difference from that, which is left at the true deflection.
    """

    deflection: float
    rigid: float
    share: float

    def ratio(self, solved: float) -> float:
        """Return the ratio at the true deflection."""
        return self.rigid + self.share * (solved - self.rigid)


def limit_of(model: Model) -> Limit | None:
    """Return how a body goes to the rigid limit; None where it is solved as it is."""
    friction, slider, vibration = model.friction, model.slider, model.vibration
    if (
        not slider.rigid or slider.free or model.normal is not None or vibration is None
        or not model.vibrates or vibration.waveform != "sine" or friction.model != "dahl"
        or friction.max_deflection is None
    ):  # fmt: skip
        return None
    along, across = model.unit_direction[0], friction.transfer * model.unit_direction[1]
    k = model.peak_velocity / slider.drive_velocity
    if abs(across) < _STRAIGHT:
        k, angle, order = k * abs(along), 0.0, 1
        back = 2.0 * (math.sqrt(k * k - 1.0) - math.acos(1.0 / k)) if k > 1.0 else 1.0
        most = min(_ALONG * back, _FAR)
    elif abs(along) < _STRAIGHT:
        k, angle, order = k * abs(across), 0.5 * math.pi, 2
        most = min(_ACROSS / k, _FAR)
    else:
        return None
    stiff = most * slider.drive_velocity / (2.0 * math.pi * model.frequency)
    if friction.max_deflection >= stiff:
        return None
    rigid = float(directed_ratio(k, angle))
    return Limit(stiff, rigid, (friction.max_deflection / stiff) ** order)

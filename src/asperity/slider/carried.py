"""Whether friction carries a body along with what is shaken: a cycle-mean law leaves it out."""

import math
from collections.abc import Iterator

from asperity.slider.model import Model


def carried(model: Model) -> Iterator[str]:
    """Say that a body which slides steadily may stick to what is shaken as well.

    Its inertia asks for m omega v of friction to be carried along. Where friction at its limit
    gives more, the body has a state in which it goes with the vibration, beside the one in which it
    goes at the mean velocity of a cycle-mean law.
    """
    slider, vibration = model.slider, model.vibration
    if vibration is None or slider.rigid or not slider.mass:
        return
    inertia = (
        2.0 * math.pi * model.frequency * slider.mass
        * model.peak_velocity * math.hypot(*model.unit_direction[:2])
    )  # fmt: skip
    if 0.0 < inertia < model.full_friction:
        yield (
            f"friction, {model.full_friction:.3g} N at its limit, could carry the body along with "
            f"the vibration, which takes {inertia:.3g} N: it may have another state, in which it "
            "goes with it; compare solve.method 'march'"
        )

"""What the package's friction model says of a segment: torque with over torque before."""

import math
from collections.abc import Sequence

from asperity.casefile import Case
from asperity.errors import AsperityError
from asperity.friction import Friction
from asperity.results.settled import unsettled
from asperity.slider.batch import solve_many
from asperity.slider.closed_forms import (
    longitudinal_ratio,
    transverse_ratio,
    triangle_longitudinal_ratio,
    triangle_transverse_ratio,
)
from asperity.slider.model import Model
from asperity.slider.parameters import Slider, Solve
from asperity.tribometer.parameters import TRANSVERSE
from asperity.vibration import Vibration

Asked = tuple[str, str, float, float, float]
"""Direction and waveform; sliding velocity and peak velocity, m/s; frequency, Hz."""

_RIGID = {
    ("transverse", "sine"): transverse_ratio,
    ("longitudinal", "sine"): longitudinal_ratio,
    ("transverse", "triangle"): triangle_transverse_ratio,
    ("longitudinal", "triangle"): triangle_longitudinal_ratio,
}


def model_ratios(case: Case, load: float, asked: Sequence[Asked | None]) -> list[float | None]:
    """Return the ratio of each segment, None where the model has no answer.

    With the table [friction] in the configuration it is the periodic state of a body on a rigid
    drive, at the sliding velocity with vibration; without it, rigid friction's closed form.
    """
    found: list[float | None] = [None] * len(asked)
    friction = case.get(Friction)
    models: dict[int, Model] = {}
    for place, one in enumerate(asked):
        if one is None or not one[2] > 0.0:
            continue
        mode, waveform, sliding, peak, frequency = one
        if friction is None or friction.model == "coulomb":
            share = friction.transfer if friction is not None and mode == TRANSVERSE else 1.0
            found[place] = float(_RIGID[mode, waveform](share * peak / sliding))
            continue
        shaken = {
            "waveform": waveform, "frequency": frequency, "velocity_amplitude": peak,
            "direction": 0.5 * math.pi if mode == TRANSVERSE else 0.0,
        }  # fmt: skip
        slider = Slider.model_validate({"drive_velocity": sliding, "normal_force": load})
        vibration = Vibration.model_validate(shaken)
        models[place] = Model(slider, friction, vibration, Solve(method="periodic"))
    # What has not settled is dropped: nothing beside it is wanted.
    answers = solve_many(list(models.values()), beside=False)
    for place, answer in zip(models, answers, strict=True):
        if not isinstance(answer, AsperityError) and not unsettled(answer):
            found[place] = answer.ratio
    return found

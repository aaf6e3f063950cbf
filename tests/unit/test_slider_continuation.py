"""A body that follows another begins where that one was left, and as fast."""

import numpy as np
import pytest

from asperity.casefile import read_case
from asperity.slider import TABLES, Model
from asperity.slider.continuation import _IN_PLANE, _NORMAL, _take_over
from asperity.slider.cycle_map import Cycle
from asperity.slider.periodic import cycle_steps


def cycle(name, *settings):
    model = Model.from_case(read_case(name, TABLES, ["solve.method=periodic", *settings]))
    steps = cycle_steps(model)
    return model, Cycle(model, steps, 1.0 / (model.frequency * steps))


@pytest.mark.parametrize(
    ("name", "names", "normal"),
    [("table-4.4", _IN_PLANE, False), ("normal-pin", {**_IN_PLANE, **_NORMAL}, True)],
)
def test_places_and_velocities_are_the_same_in_si(name, names, normal):
    settings = "vibration.direction=20 deg", "slider.lateral=free"
    if normal:
        settings = ("vibration.elevation=60 deg",)
    before, other = cycle(name, *settings)
    after, one = cycle(
        name, *settings, "vibration.frequency=2.2 kHz", "slider.normal_force=40 N",
        "friction.max_deflection=90 nm", "slider.drive_velocity=0.7 mm/s",
    )  # fmt: skip
    rng = np.random.default_rng(4)
    for key in names:
        other.body.state[key] = rng.uniform(0.5, 2.0)
    _take_over(one, before, other)

    def of(model, found, key):
        step = found.body.rate / model.frequency
        unit = model.normal_length if key in _NORMAL else model.length(step)
        rate = key.startswith("velocity") or key == "rise"
        return float(found.body.state[key]) * unit / (step if rate else 1.0)

    lengths = {before.length(1e-6) / after.length(1e-6), before.frequency / after.frequency}
    assert not any(ratio == pytest.approx(1.0, rel=0.05) for ratio in lengths)
    for key in names:
        assert of(after, one, key) == pytest.approx(of(before, other, key), rel=1e-12)

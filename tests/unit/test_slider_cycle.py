"""A cycle that is drawn is the last one, and its base moves as the vibration has it."""

import math

import numpy as np
import pytest

from asperity.casefile import read_case
from asperity.slider import TABLES, Model, solve
from asperity.slider.cycle import cycle_of

ANGLE = math.radians(30.0)


def cycle(*settings, points=64):
    case = read_case("table-4.4", TABLES, ["vibration.direction=30 deg", *settings])
    model = Model.from_case(case)
    history = solve(model, history=True).history
    return model, history, cycle_of(model, history, points)


@pytest.mark.parametrize(
    ("applied_to", "sense"), [("base", -1.0), ("body", 1.0)], ids=["base", "body"]
)
@pytest.mark.parametrize("method", ["periodic", "march"])
def test_the_base_moves_as_a_sine_has_it_and_the_body_slides_on_it(method, applied_to, sense):
    settings = f"solve.method={method}", f"vibration.applied_to={applied_to}"
    extra = ("vibration.start=0.1 ms", "solve.duration=4 ms") if method == "march" else ()
    model, history, found = cycle(*settings, *extra)
    start = 1e-4 if method == "march" else 0.0
    # One cycle, the last, of evenly many points and its end among them.
    assert found["phase"][0] == 0.0
    assert found["phase"][-1] == pytest.approx(1.0, abs=0.02)
    step = 3000.0 * (history.time[1] - history.time[0])
    assert np.ptp(np.diff(found["phase"])) < 1.1 * step
    time = history.time[-1] - (found["phase"][-1] - found["phase"]) / 3000.0
    rows = np.searchsorted(history.time, time - 1e-12)
    wave = 6.0 * 0.5e-3 * np.cos(2.0 * np.pi * 3000.0 * (time - start))
    assert found["base_velocity"] == pytest.approx(math.cos(ANGLE) * wave, abs=1e-6)
    assert found["base_velocity_across"] == pytest.approx(math.sin(ANGLE) * wave, abs=1e-6)
    assert not found["base_velocity_up"].any()
    own = history.velocity[rows]
    for n, name in enumerate(("", "_across")):
        slides = own[:, n] + sense * found[f"base_velocity{name}"]
        assert found[f"sliding_velocity{name}"] == pytest.approx(slides, abs=1e-9)
        assert np.array_equal(found[f"force{name}"], history.friction[rows, n])
    assert (found["normal_force"] == model.slider.normal_force).all()


def test_up_it_leads_and_the_force_is_that_of_the_moment():
    settings = (
        "vibration.normal_phase=70 deg",
        "vibration.velocity_ratio=0.5",
        "solve.method=periodic",
    )
    model = Model.from_case(
        read_case("normal-pin", TABLES, ["vibration.elevation=40 deg", *settings])
    )
    history = solve(model, history=True).history
    found = cycle_of(model, history, 50)
    rows = np.linspace(0, len(history.time) - 1, 50).round().astype(int)
    turned = 2.0 * np.pi * model.frequency * history.time[rows]
    most = 2.0 * np.pi * model.frequency * model.amplitude
    along, _, up = model.unit_direction
    lead = 2.0 * np.pi * model.normal_lead
    assert lead == pytest.approx(math.radians(70.0))
    assert found["base_velocity"] == pytest.approx(along * most * np.cos(turned), abs=1e-3 * most)
    aloft = up * most * np.cos(turned + lead)
    assert found["base_velocity_up"] == pytest.approx(aloft, abs=1e-3 * most)
    assert np.array_equal(found["normal_force"], history.normal_force[rows])
    assert np.ptp(found["normal_force"]) > 0.0


def test_nothing_shakes_a_body_that_is_not_shaken():
    _, history, found = cycle("vibration.velocity_ratio=0", "solve.duration=20 ms")
    for name in ("base_velocity", "base_velocity_across", "base_velocity_up"):
        assert not found[name].any()
    assert found["force"][-1] == history.friction[-1, 0]
    assert found["sliding_velocity"][-1] == history.velocity[-1, 0]


def test_of_few_rows_all_are_kept_and_of_one_nothing():
    _, history, found = cycle("solve.method=periodic", points=10**6)
    assert len(found["phase"]) == len(history.time)
    _, _, few = cycle("solve.method=periodic", points=5)
    assert len(few["phase"]) == 5

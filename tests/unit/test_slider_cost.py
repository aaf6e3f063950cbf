import contextlib
import dataclasses
import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from asperity.casefile import read_case
from asperity.errors import AsperityError
from asperity.friction import Friction
from asperity.runs import Run
from asperity.slider import TABLES, Model, Slider, Solve, slide
from asperity.slider.cost import estimate
from asperity.vibration import Vibration


def body(*settings):
    return Model.from_case(read_case("table-4.3", TABLES, settings))


def test_twice_the_steps_take_twice_as_long():
    once, twice = (estimate(body(f"solve.duration={span} s")) for span in (1, 2))
    assert once == pytest.approx(0.09, rel=0.5)
    assert twice == pytest.approx(2.0 * once)


def test_a_periodic_state_is_cheaper_than_a_march_and_a_table_of_them_dearer_than_one():
    marched, periodic, homogenised = (
        estimate(body(f"solve.method={method}")) for method in ("march", "periodic", "homogenised")
    )
    assert periodic < 0.1 * marched
    assert homogenised == 120 * periodic


def test_a_step_out_of_the_plane_costs_a_little_more_and_one_of_springs_twice():
    def one(*settings):
        case = read_case("normal-pin", TABLES, ["vibration.elevation=0 deg", *settings])
        return Model.from_case(case)

    pressed, springs = one(), one("friction.model=springs")
    flat = estimate(dataclasses.replace(pressed, normal=None))
    assert estimate(pressed) == pytest.approx(1.2 * flat)
    assert estimate(springs) == pytest.approx(2.0 * flat)


def test_a_long_work_is_announced_before_it_begins(monkeypatch):
    told = []

    def begun(*_, **__):
        raise RuntimeError("begun")

    monkeypatch.setattr(slide, "march", begun)
    for span in (1, 9000):
        with pytest.raises(RuntimeError, match="begun"):
            slide.answer(body(f"solve.duration={span} s"), Run(notify=told.append))
    assert told == ["9e+09 steps take about 14 minutes"]


sizes = st.sampled_from([0.0, 5e-324, 1e-300, 1e-160, 1e-9, 1.0, 1e9, 1e160, 1e300])


@pytest.mark.slow
@given(st.lists(sizes, min_size=12, max_size=12), st.sampled_from(["march", "periodic"]),
       st.sampled_from(["coulomb", "dahl", "lugre"]))  # fmt: skip
def test_no_size_of_a_number_ends_in_anything_but_a_refusal(numbers, method, law):
    speed, force, pull, drag, mass, mu, stiff, frequency, shake, start, step, duration = numbers
    with contextlib.suppress(AsperityError):
        model = Model(
            Slider(
                drive_velocity=speed, normal_force=force, drive_stiffness=pull, drive_damping=drag,
                mass=mass, units="SI"
            ),
            Friction(
                model=law,
                mu=mu,
                tangential_stiffness=None if law == "coulomb" else stiff,
                units="SI",
            ),
            Vibration(frequency=frequency, velocity_amplitude=shake, start=start, units="SI"),
            Solve(method=method, step=step, duration=duration, units="SI"),
        )  # fmt: skip
        assert math.isfinite(estimate(model))
        assert all(map(math.isfinite, model.parameters(model.step)))

"""Two stable states of one body, followed along an axis and back, against the contact alone."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from asperity.casefile import read_case
from asperity.errors import ConvergenceError
from asperity.slider import TABLES, Model, solve
from asperity.slider.continuation import follow

BELOW_RESONANCE = ["vibration.frequency=1.7 kHz", "vibration.elevation=90 deg"]


def bodies(values, *settings, key="vibration.displacement_amplitude"):
    case = read_case("normal-pin", TABLES, [*BELOW_RESONANCE, *settings])
    return [Model.from_case(case.replace_values({key: float(value)})) for value in values]


def swing_alone(model, start):
    """Half of what the penetration changes, by another integrator from a start of its own.

    A mass under its weight W on the contact N = W (d/d0)^1.5 (1 + c d'), on a base that shakes.
    """
    load, mass = model.slider.normal_force, model.slider.mass
    depth, loss = model.normal_length * 1.5, model.normal.loss(load, mass)
    turn = 2.0 * math.pi * model.frequency

    def rates(t, state):
        z, v = state
        d = model.amplitude * math.sin(turn * t) - z
        speed = model.amplitude * turn * math.cos(turn * t) - v
        force = load * (max(d, 0.0) / depth) ** 1.5 * max(1.0 + loss * speed, 0.0)
        return [v, (force - load) / mass]

    last = 160.0 / model.frequency
    times = np.linspace(last - 4.0 / model.frequency, last, 4001)
    answer = solve_ivp(
        rates, (0.0, last), start, method="DOP853", rtol=1e-8, atol=1e-12, t_eval=times,
        max_step=0.04 / model.frequency,
    )  # fmt: skip
    d = model.amplitude * np.sin(turn * times) - answer.y[0]
    return 0.5 * (d.max() - d.min())


@pytest.mark.slow
def test_a_ball_flies_or_stays_in_contact_by_where_it_comes_from():
    amplitudes = np.linspace(0.2e-6, 0.5e-6, 7)
    models = bodies(amplitudes)
    there, back = [], []
    for index, state in enumerate(follow([*models, *reversed(models)])):
        (there if index < len(models) else back).append(state)
    back.reverse()
    two = [abs(a.ratio - b.ratio) > 0.1 for a, b in zip(there, back, strict=True)]
    assert two == [False, True, True, True, True, True, False]
    assert all(state.normal.multiplier < 1.0 for state in (*there, *back))
    assert there[2].normal.open_share == 0.0
    assert back[2].normal.open_share > 0.5
    depth = models[2].normal_length * 1.5
    at_rest, thrown = [-depth, 0.0], [-depth, 0.03]
    for state, start in ((there[2], at_rest), (back[2], thrown)):
        assert state.normal.penetration_swing == pytest.approx(
            swing_alone(models[2], start), rel=2e-3
        )


def test_from_rest_a_body_finds_one_of_the_two():
    models = bodies([0.3e-6, 0.4e-6], "solve.method=periodic")
    states = list(follow([*models, *bodies([0.6e-6]), *reversed(models)]))
    alone = [solve(model, history=False).ratio for model in models]
    assert alone == pytest.approx([states[0].ratio, states[3].ratio], abs=1e-7)


@pytest.mark.ordinary(3)
@pytest.mark.parametrize(
    ("key", "values"),
    [
        ("vibration.frequency", [3.0e3, 3.4e3]),
        ("slider.normal_force", [50.0, 60.0]),
        ("slider.drive_velocity", [0.5e-3, 0.8e-3]),
        ("friction.mu", [0.1, 0.15]),
    ],
)
def test_a_state_is_taken_over_in_the_units_of_the_next_body(key, values):
    settings = ["solve.method=periodic", "vibration.displacement_amplitude=0.05 um"]
    models = bodies(values, *settings, key=key)
    states = list(follow(models))
    for model, state in zip(models, states, strict=True):
        assert state.ratio == pytest.approx(solve(model, history=False).ratio, abs=1e-6)
    # A step that fits leaves little to be done.
    assert states[1].cycles < 200


def test_springs_and_rigid_machines_are_followed_too():
    case = read_case("normal-machine", TABLES, ["friction.springs=4", "normal.law=hertz"])
    models = [
        Model.from_case(case.replace_values({"vibration.elevation": angle, "solve.method": word}))
        for angle, word in ((1.2, "periodic"), (1.4, "periodic"), (1.2, "periodic"))
    ]
    first, second, again = follow(models)
    assert second.ratio == pytest.approx(solve(models[1], history=False).ratio, abs=1e-7)
    assert again.ratio == pytest.approx(first.ratio, abs=1e-9)


@pytest.mark.slow
def test_a_body_that_never_repeats_itself_is_told_and_the_next_is_followed_on():
    models = bodies([1.2e-6, 0.1e-6], "vibration.frequency=4.3 kHz", "normal.damping_ratio=0.001")
    first, second = follow(models)
    assert isinstance(first, ConvergenceError) or first.normal.multiplier < 1.001
    assert second.normal.open_share == 0.0

"""A first march does not wait for what its step's error is told with: Python does the same."""

import itertools

import numpy as np
import pytest
from apparatus.bodies import draw
from apparatus.called import copied, words

from asperity.casefile import read_case
from asperity.kernels.native.entries import listed
from asperity.slider import TABLES, Model, at_hand, march_end, on_twice, step_error
from asperity.slider.cycle_map import Cycle
from asperity.slider.march import march
from asperity.slider.periodic import cycle_steps
from asperity.slider.unknowns import most_unknowns

TASKS = on_twice.DIFFERENTIATE, on_twice.CLOSE_HERE, on_twice.CLOSE_ON_TWICE


def model_of(*settings):
    return Model.from_case(read_case("table-4.4", TABLES, settings))


def drawn(seed, folder):
    """A body in the plane by lot, somewhere in its cycle."""
    rng = np.random.default_rng((4610, seed))
    model = draw(rng, models=("dahl", "lugre", "coulomb"), pressed=False).model(folder)
    steps = cycle_steps(model)
    cycle = Cycle(model, steps, 1.0 / (steps * model.frequency))
    state = cycle.body.state
    for name in ("stretch", "velocity_x", "velocity_y", "deflection_x", "deflection_y"):
        state[name] = rng.uniform(-0.6, 0.6)
    unknowns = march_end.scales_at(cycle).size
    return cycle, rng.uniform(-1.0, 1.0, (unknowns + 1, unknowns))


@pytest.mark.ordinary(12)
@pytest.mark.parametrize("task", TASKS)
@pytest.mark.parametrize("seed", range(40))
def test_python_does_the_same_to_the_last_bit(seed, task, tmp_path, monkeypatch):
    cycle, jacobian = drawn(seed, tmp_path)
    if task != on_twice.DIFFERENTIATE:
        jacobian = np.ascontiguousarray(jacobian[:-1])
    answers = []
    for is_there in (True, False):
        own, matrix = cycle.copied(), copied(jacobian)
        monkeypatch.setattr(at_hand, "_is_made", lambda _, there=is_there: there)
        sums = own.body.no_sums()
        found = at_hand.done_at(own, sums, matrix, 4, task)
        answers.append(words((found, own.body.kept["state"], own.springs, sums, matrix)))
    assert answers[0] == answers[1]


@pytest.fixture
def called(monkeypatch):
    """Have the kernel made nowhere; gives what it is called for."""
    calls = []

    def at_state(*arguments):
        calls.append(arguments[-1])
        return on_twice.at_state(*arguments)

    at_state.is_made = lambda *_: False
    at_state._function = on_twice.at_state._function
    monkeypatch.setattr(at_hand, "_IS_MADE", [])
    monkeypatch.setattr(at_hand, "at_state", at_state)
    return calls


@pytest.mark.parametrize("settings", [(), ("friction.law=vector", "vibration.waveform=triangle")])
def test_a_march_tells_the_same_error_without_the_kernel(called, settings, monkeypatch):
    model = model_of("solve.method=march", *settings)
    by_python = march(model, history=False)
    assert not called
    monkeypatch.setattr(at_hand, "_is_made", lambda _: True)
    assert march(model, history=False).step_error == by_python.step_error > 0.0
    assert called


def test_who_asks_for_many_states_waits_for_it_after_a_while(called, tmp_path, monkeypatch):
    monkeypatch.setattr(at_hand, "_TIMES", itertools.count(1))
    monkeypatch.setattr(at_hand, "_MOST", 3)
    cycle, _ = drawn(1, tmp_path)
    for _ in range(5):
        step_error.closed(cycle.copied(), np.zeros((most_unknowns(cycle.springs),) * 2))
    assert called == [on_twice.CLOSE_HERE] * 2


def test_it_is_asked_no_more_once_it_is_there(called, tmp_path):
    cycle, _ = drawn(1, tmp_path)
    asked = []
    at_hand.at_state.is_made = lambda *_: asked.append(1) or True
    for _ in range(3):
        step_error.closed(cycle.copied(), np.zeros((most_unknowns(cycle.springs),) * 2))
    assert asked == [1]


def test_no_first_slide_of_a_body_in_the_plane_is_listed_to_wait_for_it():
    """So that the processes that compile do not begin with it, which takes longest."""
    held = listed()
    plane, _ = held.named("asperity.slider.on_twice.at_state")
    lines = [called for line, called in held.lines.items() if line.startswith("slide table-4")]
    assert not any(plane.number in called for called in lines)
    # Many states are worth it.
    assert any(plane.number in called for called in held.lines.values())
